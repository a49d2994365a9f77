//! The estimated time of a render.

use std::sync::Arc;
use std::time::Duration;

use catoptric_live::RenderJob;
use catoptric_tracer::RenderSettings;
use egui::Context;

use crate::base::job::let_go;
use crate::shell::studio::Studio;
use crate::state::render_choices::RenderChoices;

/// Pixels of the longer side of the tiny picture that is traced to count rays.
const SIDE: f64 = 96.0;

/// The estimated time of a render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum RenderTime {
    /// Not known, perhaps not yet.
    Unknown,
    /// The estimate in seconds.
    Seconds(f64),
}

/// Counts the rays of a pixel, in a tiny picture of the same view, as the speed depends on what is seen. The rest is
/// known from the viewport: rays a second.
#[derive(Default)]
pub(super) struct RenderEstimate {
    running: Option<(EstimateKey, RenderJob)>,
    counted: Option<(EstimateKey, f64)>,
}

/// The choices that the number of rays depends on. The scene does not change while the dialog is open.
#[derive(Clone, Copy, PartialEq)]
struct EstimateKey {
    size: [u32; 2],
    generations: Option<u32>,
}

impl RenderEstimate {
    /// The time as far as it is known.
    pub(super) fn time(&mut self, context: &Context, studio: &Studio, choices: &RenderChoices) -> RenderTime {
        self.poll(context);
        let asked = EstimateKey { size: tiny(choices), generations: choices.generations };
        let is_known = self.counted.is_some_and(|(known, _)| known == asked);
        if !is_known && self.running.is_none() {
            self.count(context, studio, asked);
        }
        let speed = studio.live.status().rays_per_second;
        match self.counted {
            Some((_, rays)) if speed > 0.0 && rays.is_finite() => {
                let samples = choices.pixels() as f64 * f64::from(choices.samples);
                RenderTime::Seconds(samples * rays / speed)
            }
            _ => RenderTime::Unknown,
        }
    }

    fn poll(&mut self, context: &Context) {
        let Some((asked, job)) = self.running.take() else { return };
        match job.take_result() {
            None => {
                context.request_repaint_after(Duration::from_millis(50));
                self.running = Some((asked, job));
            }
            Some(result) => {
                let_go(job);
                // Without a count it is not tried again; the render itself will tell why.
                let rays = result.map_or(f64::NAN, |rendering| {
                    rendering.counts.total() as f64 / rendering.counts.primary.max(1) as f64
                });
                self.counted = Some((asked, rays));
            }
        }
    }

    fn count(&mut self, context: &Context, studio: &Studio, asked: EstimateKey) {
        let scene = Arc::clone(studio.editor.scene());
        let settings = RenderSettings { width: asked.size[0], height: asked.size[1], samples: 1 };
        self.running = RenderJob::start(scene, settings, asked.generations, 1).ok().map(|job| (asked, job));
        context.request_repaint_after(Duration::from_millis(50));
    }
}

impl Drop for RenderEstimate {
    fn drop(&mut self) {
        if let Some((_, job)) = self.running.take() {
            job.cancel();
            let_go(job);
        }
    }
}

/// A small size of about the same proportions.
fn tiny(choices: &RenderChoices) -> [u32; 2] {
    let [width, height] = [choices.width, choices.height].map(f64::from);
    let scale = SIDE / width.max(height);
    [width, height].map(|side| ((side * scale).round() as u32).max(1))
}
