//! Pictures by other methods than Whitted's: drawn as a whole, coarsely while something moves, then at full size, then with
//! more and more samples.

use std::borrow::Cow;
use std::time::Instant;

use catoptric_picture::{Picture, SizeError};
use catoptric_tracer::raster::{
    CubeMapSettings, CubeMaps, GBufferLayer, Method, MethodError, MethodOutput, PassName, SsrFallback,
    draw_through,
};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};

use crate::request::DisplayContent;
use crate::status::LiveError;
use crate::worker::{PassCost, Worker, milliseconds_since};

/// A drawing is repeated with so many times the samples of the one before.
const MORE: u32 = 4;

/// While bodies move, all cube maps are made anew for every picture; then their faces have at most this edge, pixels.
const ROUGH_FACE: u32 = 48;

/// Cube maps of no more bytes are kept for when the method is chosen again.
const KEPT: u64 = 256 << 20;

/// The newest picture of a method.
pub(crate) struct MethodPicture {
    pub(crate) drawing: MethodOutput,
    pub(crate) size: [u32; 2],
    pub(crate) samples: u32,
}

/// The cube maps that outlive a picture.
#[derive(Default)]
pub(crate) struct CubeMapStore {
    whole: CubeMaps,
    /// The coarse maps made while bodies move.
    rough: CubeMaps,
    bytes: u64,
}

impl CubeMapStore {
    /// Lets go of maps that are large and that the method has no use for.
    pub(crate) fn change_to(&mut self, method: &Method) {
        if maps_of(method).is_none() && self.bytes > KEPT {
            *self = Self::default();
        }
    }
}

impl MethodPicture {
    /// What is to be seen of it, and what that is.
    pub(crate) fn seen(
        &self,
        render_scene: &RenderScene,
        wanted: DisplayContent,
    ) -> Result<(Cow<'_, Picture>, DisplayContent), SizeError> {
        let found = match wanted {
            DisplayContent::Picture => None,
            DisplayContent::Layer(layer) => {
                self.drawing.layer(render_scene, layer)?.map(|picture| (picture, wanted))
            }
            DisplayContent::UnfoldedCube(body) => unfolded(&self.drawing, render_scene, body)?,
        };
        Ok(match found {
            Some((picture, shows)) => (Cow::Owned(picture), shows),
            None => (Cow::Borrowed(&self.drawing.picture), DisplayContent::Picture),
        })
    }

    /// What each pass took, milliseconds.
    pub(crate) fn passes(&self) -> Vec<(PassName, f64)> {
        self.drawing.passes.iter().map(|(name, time)| (*name, 1e3 * time.as_secs_f64())).collect()
    }
}

/// The unfolded cube map of a body, or else the first there is.
pub(crate) fn unfolded(
    drawing: &MethodOutput,
    render_scene: &RenderScene,
    wanted: Option<usize>,
) -> Result<Option<(Picture, DisplayContent)>, SizeError> {
    let maps = drawing.maps(render_scene);
    let of_body = maps.iter().find(|(body, _)| Some(*body) == wanted);
    let Some((body, map)) = of_body.or(maps.first()) else { return Ok(None) };
    Ok(Some((map.unfolded()?, DisplayContent::UnfoldedCube(Some(*body)))))
}

/// Whether it is light that is seen, to be developed as the picture is.
pub(crate) fn has_light(shows: DisplayContent) -> bool {
    !matches!(shows, DisplayContent::Layer(layer) if !matches!(layer, GBufferLayer::Lit | GBufferLayer::Reflected))
}

/// The settings of the cube maps that a method uses.
fn maps_of(method: &Method) -> Option<CubeMapSettings> {
    match method {
        Method::CubeMap(maps) => Some(*maps),
        Method::Ssr(ssr) => match ssr.fallback {
            SsrFallback::CubeMap(maps) => Some(maps),
            SsrFallback::Background => None,
        },
        Method::Whitted | Method::Flat(_) | Method::Gouraud(_) | Method::Phong(_) => None,
    }
}

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

impl From<MethodError> for LiveError {
    fn from(error: MethodError) -> Self {
        match error {
            MethodError::Setting(error) => Self::Setting(error),
            MethodError::Size(error) => Self::Size(error),
            MethodError::TooManyCubeMaps { bodies, size, .. } => Self::TooManyCubeMaps { bodies, size },
            // None of these comes from drawing a view.
            error @ (MethodError::Cancelled | MethodError::SizeMismatch { .. }) => {
                Self::Fault(error.to_string())
            }
        }
    }
}
