//! The statistics of a render, as JSON.

use std::time::Duration;

use catoptric_tracer::RayCounts;
use catoptric_tracer::raster::{CubeMapUse, PassName};
use serde_json::{Map, Value, json};

use crate::card::Card;

/// Milliseconds of each step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct StepTimes {
    pub read: f64,
    pub prepare: f64,
    pub trace: f64,
    pub develop: f64,
    pub write: f64,
}

/// The statistics of `--stats`.
pub(crate) struct Stats<'a> {
    pub scene: &'a str,
    pub width: u32,
    pub height: u32,
    pub samples: u32,
    pub generations: u32,
    pub threads: usize,
    /// The card that drew, if one did.
    pub card: Option<&'a Card>,
    /// What the card worked, by its own clock.
    pub on_card: Option<Duration>,
    pub bodies: usize,
    pub lights: usize,
    pub stage_bytes: usize,
    pub method: &'a str,
    pub passes: &'a [(PassName, Duration)],
    pub cube_maps: Option<CubeMapUse>,
    pub times: StepTimes,
    pub rays: RayCounts,
    pub peak_memory_bytes: Option<u64>,
}

impl Stats<'_> {
    /// Millions of rays of all kinds traced in a second.
    pub(crate) fn mrays_per_second(&self) -> f64 {
        let rays = self.rays.total() as f64;
        if self.times.trace > 0.0 { rounded(rays / (self.times.trace * 1e3)) } else { 0.0 }
    }

    /// Milliseconds of each pass.
    fn passes(&self) -> Map<String, Value> {
        let passes = self.passes.iter();
        passes.map(|(name, time)| (name.name().to_owned(), milliseconds(*time).into())).collect()
    }

    /// The card, and what it worked by its own clock.
    fn card_to_json(&self, card: &Card) -> Value {
        let mut described = card.to_json();
        described["milliseconds"] = json!(self.on_card.map(milliseconds));
        described
    }

    pub(crate) fn to_json(&self) -> Value {
        let StepTimes { read, prepare, trace, develop, write } = self.times;
        let RayCounts { primary, shadow, reflected, refracted } = self.rays;
        json!({
            "scene": self.scene,
            "width": self.width,
            "height": self.height,
            "samples": self.samples,
            "generations": self.generations,
            "method": self.method,
            "backend": if self.card.is_some() { "gpu" } else { "cpu" },
            "gpu": self.card.map(|card| self.card_to_json(card)),
            "threads": self.threads,
            "bodies": self.bodies,
            "lights": self.lights,
            "milliseconds": {
                "read": rounded(read),
                "prepare": rounded(prepare),
                "trace": rounded(trace),
                "develop": rounded(develop),
                "write": rounded(write),
            },
            "passes": self.passes(),
            "cube_maps": self.cube_maps.map(|CubeMapUse { built, kept, build_time, bytes }| json!({
                "built": built,
                "kept": kept,
                "build_milliseconds": milliseconds(build_time),
                "bytes": bytes,
            })),
            "rays": {
                "primary": primary,
                "shadow": shadow,
                "reflected": reflected,
                "refracted": refracted,
                "total": self.rays.total(),
            },
            "mrays_per_second": self.mrays_per_second(),
            "stage_bytes": self.stage_bytes,
            "peak_memory_bytes": self.peak_memory_bytes,
        })
    }
}

fn milliseconds(time: Duration) -> f64 {
    rounded(time.as_secs_f64() * 1e3)
}

/// To three places: more would be noise.
fn rounded(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}
