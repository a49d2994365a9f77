//! What a render took, as JSON.

use catoptric_tracer::RayCounts;
use serde_json::{Value, json};

/// Milliseconds of each step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Times {
    pub read: f64,
    pub prepare: f64,
    pub trace: f64,
    pub develop: f64,
    pub write: f64,
}

/// Everything `--stats` reports.
pub(crate) struct Stats<'a> {
    pub scene: &'a str,
    pub width: u32,
    pub height: u32,
    pub samples: u32,
    pub generations: u32,
    pub threads: usize,
    pub bodies: usize,
    pub lights: usize,
    pub stage_bytes: usize,
    pub times: Times,
    pub rays: RayCounts,
    pub peak_memory_bytes: Option<u64>,
}

impl Stats<'_> {
    /// Millions of rays of all kinds traced in a second.
    pub(crate) fn mrays_per_second(&self) -> f64 {
        let rays = self.rays.total() as f64;
        if self.times.trace > 0.0 { rounded(rays / (self.times.trace * 1e3)) } else { 0.0 }
    }

    pub(crate) fn to_json(&self) -> Value {
        let Times { read, prepare, trace, develop, write } = self.times;
        let RayCounts { primary, shadow, reflected, refracted } = self.rays;
        json!({
            "scene": self.scene,
            "width": self.width,
            "height": self.height,
            "samples": self.samples,
            "generations": self.generations,
            "method": "whitted",
            "backend": "cpu",
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

/// To three places: more would be noise.
fn rounded(value: f64) -> f64 {
    (value * 1e3).round() / 1e3
}
