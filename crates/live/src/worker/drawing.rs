//! Pictures by other methods than Whitted's: drawn as a whole, coarsely while something moves, then at full size, then with
//! more and more samples.

use catoptric_platform::time::Instant;
use catoptric_tracer::raster::{
    CubeMapSettings, Method, MethodError, MethodOutput, PassName, SsrFallback, draw_through,
};
use catoptric_tracer::{RenderControl, RenderSettings};

use super::Worker;
use crate::method_picture::{CubeMapStore, MethodPicture, maps_of};
use crate::pace::{PassCost, milliseconds_since};
use crate::status::LiveError;

/// A drawing is repeated with so many times the samples of the one before.
const MORE: u32 = 4;

/// While bodies move, all cube maps are made anew for every picture; then their faces have at most this edge, pixels.
const ROUGH_FACE: u32 = 48;

/// The method with small cube maps.
fn roughly(method: Method) -> Method {
    let small = |maps: CubeMapSettings| CubeMapSettings { size: maps.size.min(ROUGH_FACE), ..maps };
    match method {
        Method::CubeMap(maps) => Method::CubeMap(small(maps)),
        Method::Ssr(mut ssr) => {
            if let SsrFallback::CubeMap(maps) = &mut ssr.fallback {
                *maps = small(*maps);
            }
            Method::Ssr(ssr)
        }
        other => other,
    }
}

/// One drawing by a method: its size, samples and deadline.
struct DrawingStep {
    size: [u32; 2],
    samples: u32,
    is_rough: bool,
    /// Until when nothing newer interrupts it.
    until: Option<Instant>,
}

impl Worker {
    /// Draws the first picture after a change, as large as time allows.
    pub(crate) fn first_drawing(&mut self) -> Result<(), LiveError> {
        let Some(view) = &self.view else { return Ok(()) };
        let size = self.pace.coarse(view.request.size);
        let is_rough = view.request.moving && view.has_old_maps && maps_of(&view.request.method).is_some();
        let until = Some(Instant::now() + self.patience(size));
        self.draw(&DrawingStep { size, samples: 1, is_rough, until })
    }

    /// Takes the next step towards the full picture with all samples.
    pub(crate) fn refine_drawing(&mut self) -> Result<(), LiveError> {
        let Some(view) = &self.view else { return Ok(()) };
        let full = view.request.size;
        let Some(drawn) = &view.drawn else { return Ok(()) };
        let (size, samples) = if drawn.size == full {
            (full, drawn.samples.saturating_mul(MORE).min(view.samples_wanted()))
        } else {
            (self.pace.sharper(full, drawn.size), 1)
        };
        self.draw(&DrawingStep { size, samples, is_rough: false, until: None })
    }

    /// Draws, and shows what came of it unless something newer came first.
    fn draw(&mut self, step: &DrawingStep) -> Result<(), LiveError> {
        let mut maps = std::mem::take(&mut self.maps);
        let start = Instant::now();
        let control = RenderControl::default();
        let result = self.drawing(step, &control, &mut maps);
        let milliseconds = milliseconds_since(start);
        self.maps = maps;
        let pixels = u64::from(step.size[0]) * u64::from(step.size[1]) * u64::from(step.samples);
        let drawing = match result {
            Some(Ok(drawing)) => drawing,
            None | Some(Err(MethodError::Cancelled)) => {
                if step.until.is_some() {
                    let share = control.pixels_done() as f64 / control.pixels_expected().max(1) as f64;
                    self.pace.gave_up((share * pixels as f64) as u64, milliseconds);
                }
                return Ok(());
            }
            Some(Err(error)) => return Err(error.into()),
        };
        self.maps.bytes = drawing.cube_maps.map_or(0, |used| used.bytes);
        let of_maps = drawing.passes.iter().find(|(name, _)| *name == PassName::CubeMaps);
        let of_maps = of_maps.map_or(0.0, |(_, time)| 1e3 * time.as_secs_f64());
        // Maps take the same time whatever the size of the picture.
        self.pace.passed(pixels, (milliseconds - of_maps).max(0.01));
        let Some(view) = &mut self.view else { return Ok(()) };
        if !step.is_rough {
            view.has_old_maps = false;
        }
        let passed = PassCost { rays: drawing.counts, milliseconds };
        view.drawn = Some(MethodPicture { drawing, size: step.size, samples: step.samples });
        view.drop_films();
        view.due.picture = false;
        self.show(Some(&passed))
    }

    fn drawing(
        &self,
        step: &DrawingStep,
        control: &RenderControl,
        maps: &mut CubeMapStore,
    ) -> Option<Result<MethodOutput, MethodError>> {
        let view = self.view.as_ref()?;
        let [width, height] = step.size;
        let settings = RenderSettings { width, height, samples: step.samples };
        let (method, maps) = if step.is_rough {
            (roughly(view.request.method), &mut maps.rough)
        } else {
            (view.request.method, &mut maps.whole)
        };
        let before = view.full_samples() as f32;
        let progress = |done: u64| {
            if step.size != view.request.size {
                return 0.0;
            }
            let share = done as f32 / control.pixels_expected().max(1) as f32;
            (before + share.min(1.0) * (step.samples as f32 - before)) / view.samples_wanted() as f32
        };
        let work = || draw_through(&view.render_scene, &view.camera, &method, settings, control, maps);
        self.watched(view, control, step.until, &progress, work)
    }
}
