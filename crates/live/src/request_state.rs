//! The state of the request that is being worked on.

use std::sync::Arc;

use catoptric_picture::SizeError;
use catoptric_platform::time::{Duration, Instant};
use catoptric_scene::{Camera, Color, Falloff, Light, Projection, Scene};
use catoptric_tracer::{RayCounts, RenderCamera, RenderScene, SceneEdit};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::canvas::Canvas;
use crate::card::CardPicture;
use crate::frame::{GridLine, Polyline};
use crate::method_picture::MethodPicture;
use crate::outline::OutlineTracer;
use crate::pace::PassCost;
use crate::request::{DisplayContent, Request};
use crate::shared::WaitLimit;
use crate::status::LiveError;

/// After this time without a change during a drag, the picture sharpens.
const STILL: Duration = Duration::from_millis(150);

/// A request with its results so far, and what is still to be done.
pub(crate) struct RequestState {
    pub(crate) request: Request,
    pub(crate) render_scene: Arc<RenderScene>,
    pub(crate) camera: RenderCamera,
    /// The light of the picture that is shown.
    pub(crate) film: Option<Canvas>,
    /// The light of a sharper picture under way.
    pub(crate) sharper: Option<Canvas>,
    /// A film of the full size that is not in use; a new one takes as long as a coarse picture.
    spare: Option<Canvas>,
    /// While the coarse picture is traced in slices: until when it is finished though a newer one is asked for.
    pub(crate) begun: Option<Instant>,
    /// What passes took that did not finish the sample under way, milliseconds.
    pub(crate) spent: f64,
    /// What the pass took whose picture a card is developing.
    pub(crate) unshown: Option<PassCost>,
    /// What a method other than Whitted's has drawn.
    pub(crate) drawn: Option<MethodPicture>,
    /// Whether the scene has changed since cube maps of the full size were made.
    pub(crate) has_old_maps: bool,
    pub(crate) shown: LastFrame,
    outlines: Option<OutlineTracer>,
    hover: Option<OutlineTracer>,
    pub(crate) due: StaleParts,
    /// The last request had nothing to trace: the view waits, for what it has to be of use to the next one.
    pub(crate) is_at_rest: bool,
    /// When the picture changed last.
    changed: Instant,
}

/// The content of the last frame.
#[derive(Default)]
pub(crate) struct LastFrame {
    pub(crate) pixels: Arc<Vec<u8>>,
    pub(crate) card: Option<Arc<CardPicture>>,
    /// Whether a card drew it.
    pub(crate) is_of_card: bool,
    pub(crate) size: [u32; 2],
    pub(crate) shows: DisplayContent,
    pub(crate) outline: Arc<Vec<Polyline>>,
    pub(crate) hover: Arc<Vec<Polyline>>,
    pub(crate) grid: Arc<Vec<GridLine>>,
    pub(crate) milliseconds: f64,
    pub(crate) rays: RayCounts,
    pub(crate) at: Option<Instant>,
}

/// The parts that a change has made out of date.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct StaleParts {
    /// All light; the first picture is coarse.
    pub(crate) picture: bool,
    /// The codes of the light.
    pub(crate) development: bool,
    /// Outlines and grid.
    pub(crate) overlays: bool,
    /// The frame with its numbers.
    pub(crate) frame: bool,
}

impl StaleParts {
    pub(crate) const ALL: Self = Self { picture: true, development: true, overlays: true, frame: true };
    pub(crate) const NOTHING: Self =
        Self { picture: false, development: false, overlays: false, frame: false };
}

impl RequestState {
    /// A view of a request in a prepared scene.
    pub(crate) fn new(request: Request, render_scene: Arc<RenderScene>) -> Self {
        let camera = render_scene.camera_for(&request.camera);
        Self {
            outlines: outlines(&request, &render_scene, &request.outline),
            hover: outlines(&request, &render_scene, hovered(&request)),
            request,
            render_scene,
            camera,
            film: None,
            sharper: None,
            spare: None,
            begun: None,
            spent: 0.0,
            unshown: None,
            drawn: None,
            has_old_maps: false,
            shown: LastFrame::default(),
            due: StaleParts::ALL,
            is_at_rest: false,
            changed: Instant::now(),
        }
    }

    /// A view of another request, which takes over from this one what still holds. `render_scene` makes the scene from that of
    /// this view, which is let go of before; it may be the same.
    pub(crate) fn succeed(
        self,
        request: Request,
        is_same_scene: bool,
        render_scene: impl FnOnce(Arc<RenderScene>) -> Arc<RenderScene>,
    ) -> Self {
        let render_scene = render_scene(self.render_scene);
        let camera = render_scene.camera_for(&request.camera);
        let before = &self.request;
        let picture = !is_same_scene || request.camera != before.camera || request.size != before.size;
        let picture = picture || request.method != before.method;
        let due = StaleParts {
            picture: picture || self.due.picture,
            development: self.due.development
                || request.development != before.development
                || request.shows != before.shows,
            overlays: picture
                || self.due.overlays
                || request.outline != before.outline
                || request.hover != before.hover
                || request.grid != before.grid,
            // After a rest too, so that the window hears that there is a picture again.
            frame: self.due.frame || self.is_at_rest || request.revision != before.revision,
        };
        let same = is_same_scene && request.outline == before.outline;
        let same_hover = same && request.hover == before.hover;
        Self {
            outlines: if same { self.outlines } else { outlines(&request, &render_scene, &request.outline) },
            hover: if same_hover { self.hover } else { outlines(&request, &render_scene, hovered(&request)) },
            changed: if picture { Instant::now() } else { self.changed },
            // Films of another picture are of use too: their memory is.
            film: self.film,
            sharper: self.sharper,
            spare: self.spare,
            // The same picture under way goes on.
            begun: self.begun.filter(|_| !picture),
            spent: if picture { 0.0 } else { self.spent },
            unshown: self.unshown.filter(|_| !picture),
            drawn: self.drawn,
            has_old_maps: self.has_old_maps || !is_same_scene,
            shown: self.shown,
            request,
            render_scene,
            camera,
            due,
            is_at_rest: false,
        }
    }

    /// A film of this size for a new picture, which takes the place of the one before; on the card or not.
    pub(crate) fn blank_film(&mut self, is_on_card: bool, size: [u32; 2]) -> Result<Canvas, SizeError> {
        let mut blank = None;
        self.spent = 0.0;
        // While a sharper picture is traced, the present one stays: it may have to be developed again.
        let film = if self.due.picture { self.film.take() } else { None };
        for film in [film, self.sharper.take(), self.spare.take()].into_iter().flatten() {
            if film.is_on_card() != is_on_card {
                continue;
            }
            if film.size() == size {
                blank = Some(film);
            } else if film.size() == self.request.size {
                self.spare = Some(film);
            }
        }
        match blank {
            Some(mut film) => {
                film.clear();
                Ok(film)
            }
            None => Canvas::new(is_on_card, size),
        }
    }

    /// Lets go of the light of traced pictures.
    pub(crate) fn drop_films(&mut self) {
        (self.film, self.sharper, self.spare) = (None, None, None);
    }

    /// Whether a coarse picture that is traced in slices is finished before the next is begun.
    pub(crate) fn is_patient(&self) -> bool {
        self.begun.is_some_and(|until| Instant::now() < until)
    }

    /// How long there is nothing to do.
    pub(crate) fn wait(&self) -> WaitLimit {
        if self.is_at_rest {
            WaitLimit::ForEver
        } else if self.due != StaleParts::NOTHING {
            WaitLimit::No
        } else if self.request.paused || self.is_refined() {
            WaitLimit::ForEver
        } else if self.request.moving && self.changed.elapsed() < STILL {
            WaitLimit::Until(self.changed + STILL)
        } else {
            WaitLimit::No
        }
    }

    pub(crate) fn samples_wanted(&self) -> u32 {
        let samples = self.request.samples.max(1);
        if self.render_scene.is_noisy() { samples.saturating_mul(Request::NOISY) } else { samples }
    }

    /// The samples of the picture, if it is of the full size.
    pub(crate) fn full_samples(&self) -> u32 {
        let size = self.request.size;
        if self.request.method.abilities().accumulates {
            self.film.as_ref().filter(|film| film.size() == size).map_or(0, Canvas::samples)
        } else {
            self.drawn.as_ref().filter(|drawn| drawn.size == size).map_or(0, |drawn| drawn.samples)
        }
    }

    /// The size of the picture that was made last, pixels.
    pub(crate) fn picture_size(&self) -> [u32; 2] {
        self.drawn.as_ref().map_or(self.shown.size, |drawn| drawn.size)
    }

    pub(crate) fn is_refined(&self) -> bool {
        self.full_samples() >= self.samples_wanted()
    }

    /// Traces outlines and grid, on the current rayon pool.
    pub(crate) fn trace_overlays(&mut self) {
        let Request { scene, camera, grid, .. } = &self.request;
        let size = DVec2::from(self.request.size.map(f64::from));
        let trace = |outlines: &Option<OutlineTracer>| {
            let lines = outlines
                .as_ref()
                .map(|outlines| outlines.trace(scene, &self.render_scene, &self.camera, size));
            Arc::new(lines.unwrap_or_default())
        };
        self.shown.outline = trace(&self.outlines);
        self.shown.hover = trace(&self.hover);
        let lines = grid.map(|grid| crate::grid::trace(grid, camera, &self.camera, &self.render_scene, size));
        self.shown.grid = Arc::new(lines.unwrap_or_default());
        self.due.overlays = false;
    }
}

/// The body under the pointer, unless it is outlined anyway.
fn hovered(request: &Request) -> &[usize] {
    match &request.hover {
        Some(body) if !request.outline.contains(body) => std::slice::from_ref(body),
        _ => &[],
    }
}

fn outlines(request: &Request, render_scene: &RenderScene, bodies: &[usize]) -> Option<OutlineTracer> {
    (!bodies.is_empty()).then(|| OutlineTracer::new(&request.scene, render_scene, bodies))
}

/// Whether a request, seen while another is worked on, asks for something that should not wait.
pub(crate) fn is_new(new: &Request, current: &Request) -> bool {
    !Arc::ptr_eq(&new.scene, &current.scene)
        || new.revision != current.revision
        || new.camera != current.camera
        || new.size != current.size
        || new.development != current.development
        || new.method != current.method
        || new.shows != current.shows
        || new.outline != current.outline
        || new.hover != current.hover
        || new.grid != current.grid
        || (new.paused && !current.paused)
}

/// The update that turns the scene of one request into that of the next.
pub(crate) enum SceneUpdate {
    /// Nothing that is traced is different, apart from the camera.
    Same,
    /// A few bodies are, or the lights.
    Edit(SceneEdit),
    /// The scene has to be prepared.
    Anew,
}

impl RequestState {
    /// What has to be done to the scene for another request; on the current rayon pool.
    pub(crate) fn step_to(&self, new: &Request) -> SceneUpdate {
        let (before, after) = (&*self.request.scene, &*new.scene);
        let Some(changed) = changed_bodies(&self.request, new) else { return SceneUpdate::Anew };
        if !self.render_scene.suits(after, &new.camera) {
            return SceneUpdate::Anew;
        }
        let lights = |scene: &Scene| scene.lights.iter().map(traced_light).collect::<Vec<_>>();
        let is_same = changed.is_empty()
            && before.environment == after.environment
            && before.tracing == after.tracing
            && before.materials == after.materials
            && lights(before) == lights(after);
        if is_same {
            return SceneUpdate::Same;
        }
        self.render_scene.edit(before, after, &changed).map_or(SceneUpdate::Anew, SceneUpdate::Edit)
    }
}

/// The places of all bodies that a picture shows otherwise; `None` when there are more or fewer than before.
fn changed_bodies(old: &Request, new: &Request) -> Option<Vec<usize>> {
    if Arc::ptr_eq(&old.scene, &new.scene) {
        return Some(Vec::new());
    }
    let (before, after) = (&old.scene.bodies, &new.scene.bodies);
    let is_changed = |&index: &usize| {
        let both = before.get(index).zip(after.get(index));
        !both.is_some_and(|(old, new)| old.looks_like(new))
    };
    (before.len() == after.len()).then(|| before.unshared(after).par_bridge().filter(is_changed).collect())
}

/// What a picture depends on.
fn traced_light(light: &Light) -> (DVec3, Color, f64, Falloff, f64, bool) {
    let Light { name: _, locked: _, position, color, intensity, falloff, radius, hidden } = light;
    (*position, *color, *intensity, *falloff, *radius, *hidden)
}

/// Refuses what cannot be traced.
pub(crate) fn check(request: &Request) -> Result<(), LiveError> {
    let [width, height] = request.size;
    if u64::from(width) * u64::from(height) > Request::MAX_PIXELS {
        return Err(LiveError::TooLarge { width, height });
    }
    let Camera { position, target, up, projection } = request.camera;
    let number = match projection {
        Projection::Perspective { fov_degrees } => fov_degrees,
        Projection::Parallel { height } => height,
    };
    if position.is_finite() && target.is_finite() && up.is_finite() && number.is_finite() {
        Ok(())
    } else {
        Err(LiveError::Camera)
    }
}
