//! The thread that traces what is asked for.

mod card;
mod drawing;

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use catoptric_picture::{Development, Picture};
use catoptric_platform::threads::Pool;
use catoptric_platform::time::{Duration, Instant};
use catoptric_tracer::{AcceleratorChoice, Film, RayCounts, RenderControl, RenderScene};
use rayon::prelude::*;

use crate::canvas::{AddedSample, Canvas, PassError};
use crate::card::CardPort;
use crate::frame::Frame;
use crate::method_picture::{CubeMapStore, MethodPicture, has_light};
use crate::options::LiveOptions;
use crate::pace::{Pace, PassCost, milliseconds_since};
use crate::request::{DisplayContent, Request};
use crate::request_state::{RequestState, SceneUpdate, StaleParts, check, is_new};
use crate::shared::{PreemptionRule, SharedState, WorkerMessage};
use crate::status::LiveError;

/// A picture under way while something moves is finished though a newer one is asked for, since otherwise none would
/// ever be; but not if it takes so many times its budget, and a coarser one would be quicker.
const OVERRUN: f64 = 3.0;

/// The coarsest picture may take this long.
const LONGEST: Duration = Duration::from_secs(1);

/// Between frames that only show one more sample.
const BETWEEN_FRAMES: Duration = Duration::from_millis(60);

pub(crate) struct Worker {
    shared: Arc<SharedState>,
    pub(crate) pool: Pool,
    /// When the slice ends that is worked on in the window's thread; `None` on a thread of its own.
    slice_end: Option<Instant>,
    budget: Duration,
    pub(crate) pace: Pace,
    pub(crate) view: Option<RequestState>,
    pub(crate) maps: CubeMapStore,
    /// The graphics card that draws, if one is to.
    pub(crate) card: Option<CardPort>,
    serial: u64,
    picture_serial: u64,
}

/// The end of a pass.
enum PassEnd {
    Finished(PassCost),
    /// Something newer came first.
    Superseded,
    /// The slice ended first; the pass is taken up again.
    Paused,
}

impl Worker {
    pub(crate) fn new(shared: Arc<SharedState>, pool: Pool, budget: f64) -> Self {
        // What is no number of milliseconds becomes one.
        let budget =
            if budget.is_finite() { budget.clamp(1.0, 10_000.0) } else { LiveOptions::default().budget };
        Self {
            shared,
            pool,
            slice_end: None,
            budget: Duration::from_secs_f64(1e-3 * budget),
            pace: Pace::new(budget),
            view: None,
            maps: CubeMapStore::default(),
            card: None,
            serial: 0,
            picture_serial: 0,
        }
    }

    pub(crate) fn run(mut self) {
        loop {
            let call = self.shared.look(self.wait());
            if matches!(call, WorkerMessage::Stop) {
                return;
            }
            self.guarded_turn(call);
        }
    }

    /// Works in the caller's thread until `end`, or until there is nothing to do.
    pub(crate) fn advance(&mut self, end: Instant) {
        self.slice_end = Some(end);
        loop {
            if self.waits_for_card() {
                return;
            }
            // The answer of the card is for the present request.
            let has_answer = self.card.as_ref().is_some_and(CardPort::has_answer);
            let is_patient = self.view.as_ref().is_some_and(RequestState::is_patient);
            let call = self.shared.glance(self.wait(), !has_answer && !is_patient);
            let is_due = call.is_some();
            if let Some(call) = call {
                self.guarded_turn(call);
            }
            if let Some(card) = self.card.as_ref().filter(|_| has_answer) {
                // Otherwise one that nobody wants would keep requests away.
                card.forget_answer();
            }
            if !is_due && !has_answer {
                return;
            }
            if Instant::now() >= end {
                return;
            }
        }
    }

    fn guarded_turn(&mut self, call: WorkerMessage) {
        let done = catch_unwind(AssertUnwindSafe(|| self.turn(call)))
            .unwrap_or_else(|panic| Err(LiveError::Fault(message_of(&*panic))));
        if let Err(error) = done {
            self.view = None;
            self.shared.publish_error(error);
        }
    }

    fn turn(&mut self, call: WorkerMessage) -> Result<(), LiveError> {
        match call {
            WorkerMessage::Request(request) => return self.accept(*request),
            WorkerMessage::Card(card) => {
                self.change_card(card);
                return Ok(());
            }
            WorkerMessage::Ready => {
                self.take_card_news();
                return Ok(());
            }
            WorkerMessage::Stop | WorkerMessage::Nothing => {}
        }
        match &self.view {
            None => Ok(()),
            Some(view) if view.due.picture && !view.request.method.abilities().accumulates => {
                self.first_drawing()
            }
            Some(view) if view.due.picture => self.first_picture(),
            Some(view) if view.due != StaleParts::NOTHING => self.show(None),
            Some(view) if !view.request.method.abilities().accumulates => self.refine_drawing(),
            Some(_) => self.refine(),
        }
    }

    /// Prepares what a request needs; tracing comes after another look at the mail.
    fn accept(&mut self, request: Request) -> Result<(), LiveError> {
        #[cfg(test)]
        assert!(request.revision != tests::FAULTY, "a fault for the test");
        let checked = check(&request);
        if checked.is_err() || request.size.contains(&0) {
            if let Some(view) = &mut self.view {
                view.is_at_rest = true;
            }
            match checked {
                Ok(()) => self.shared.change_status(|status| status.error = None),
                Err(error) => self.shared.publish_error(error),
            }
            return Ok(());
        }
        let old = self.view.take();
        if old.as_ref().is_none_or(|old| old.request.method.kind() != request.method.kind()) {
            // What a picture takes is another matter now.
            self.pace = Pace::new(1e3 * self.budget.as_secs_f64());
            self.maps.change_to(&request.method);
        }
        let state = old.as_ref().map(|old| old.render_scene.state());
        let view = self.pool.install(|| self.view_of(request, old))?;
        if let Some(card) = &mut self.card {
            card.look_again(state != Some(view.render_scene.state()));
        }
        self.view = Some(view);
        self.shared.change_status(|status| status.error = None);
        Ok(())
    }

    /// A view of a request, its scene prepared or made from that of the view before; on the current rayon pool.
    fn view_of(&self, request: Request, old: Option<RequestState>) -> Result<RequestState, LiveError> {
        let revision = request.revision;
        let publish =
            |render_scene: &Arc<RenderScene>| self.shared.publish_scene(revision, Arc::clone(render_scene));
        let Some(old) = old else {
            let render_scene = Arc::new(RenderScene::build_for_camera(
                &request.scene,
                &request.camera,
                AcceleratorChoice::Quickest,
            )?);
            publish(&render_scene);
            return Ok(RequestState::new(request, render_scene));
        };
        let scene = Arc::clone(&request.scene);
        Ok(match old.step_to(&request) {
            SceneUpdate::Same => {
                publish(&old.render_scene);
                old.succeed(request, true, |render_scene| render_scene)
            }
            SceneUpdate::Edit(edit) => old.succeed(request, false, |render_scene| {
                self.shared
                    .edit_scene(revision, render_scene, |render_scene| render_scene.apply(edit, &scene))
            }),
            SceneUpdate::Anew => {
                let render_scene = Arc::new(RenderScene::build_for_camera(
                    &scene,
                    &request.camera,
                    AcceleratorChoice::Quickest,
                )?);
                publish(&render_scene);
                old.succeed(request, false, |_| render_scene)
            }
        })
    }

    /// Traces the first picture after a change, as large as time allows.
    fn first_picture(&mut self) -> Result<(), LiveError> {
        let begun = self.view.as_mut().and_then(|view| view.begun.take());
        // What is under way goes on where it is.
        let is_ready = if begun.is_some() { Some(false) } else { self.is_card_ready() };
        let Some(is_on_card) = is_ready else { return Ok(()) };
        let Some(view) = &mut self.view else { return Ok(()) };
        let size = self.pace.coarse(view.request.size);
        let film = match (begun, view.film.take()) {
            (Some(_), Some(film)) => Ok(film),
            (_, film) => {
                view.film = film;
                view.blank_film(is_on_card, size)
            }
        };
        let mut film = film?;
        let until = begun.unwrap_or_else(|| Instant::now() + self.patience(size));
        let passed = self.pass(&mut film, Some(until))?;
        let Some(view) = &mut self.view else { return Ok(()) };
        (view.film, view.drawn) = (Some(film), None);
        match passed {
            PassEnd::Superseded => Ok(()),
            PassEnd::Paused => {
                view.begun = Some(until);
                Ok(())
            }
            PassEnd::Finished(passed) => {
                view.due.picture = false;
                view.sharper = None;
                self.show(Some(&passed))
            }
        }
    }

    /// How long the first picture of this size may take though a newer one is asked for.
    pub(crate) fn patience(&self, size: [u32; 2]) -> Duration {
        let view = self.view.as_ref().map_or(size, |view| view.request.size);
        if self.pace.can_be_coarser(view, size) {
            self.budget.mul_f64(OVERRUN)
        } else {
            LONGEST * self.pace.patience()
        }
    }

    /// Takes the next step towards the full picture with all samples.
    fn refine(&mut self) -> Result<(), LiveError> {
        let Some(view) = &mut self.view else { return Ok(()) };
        let full = view.request.size;
        let size = view.film.as_ref().map_or([1, 1], Canvas::size);
        let is_on_card = view.film.as_ref().is_some_and(Canvas::is_on_card);
        let mut sharper = match view.sharper.take() {
            Some(film) => Some(film),
            None if size == full => None,
            None => Some(view.blank_film(is_on_card, self.pace.sharper(full, size))?),
        };
        let mut film = view.film.take();
        let Some(growing) = sharper.as_mut().or(film.as_mut()) else { return Ok(()) };
        let passed = self.pass(growing, None);
        let Some(view) = &mut self.view else { return Ok(()) };
        let passed = match passed {
            Ok(PassEnd::Finished(passed)) => passed,
            unfinished => {
                // What is traced already is taken up again later, if nothing moved.
                (view.film, view.sharper) = (film, sharper);
                return unfinished.map(drop);
            }
        };
        view.film = sharper.or(film);
        let samples = view.full_samples();
        let waited = view.shown.at.is_none_or(|at| at.elapsed() >= BETWEEN_FRAMES);
        if waited || samples.is_power_of_two() || samples == 0 || view.is_refined() {
            self.show(Some(&passed))
        } else {
            self.report(passed.milliseconds, passed.rays);
            Ok(())
        }
    }

    /// Adds a sample to a film, unless something newer comes first, or the slice ends. Until `until` nothing newer does.
    fn pass(&mut self, film: &mut Canvas, until: Option<Instant>) -> Result<PassEnd, LiveError> {
        let Some(view) = &self.view else { return Ok(PassEnd::Superseded) };
        let control = Arc::new(match self.slice_end {
            Some(end) => RenderControl::pausing_when(move || Instant::now() >= end),
            None => RenderControl::default(),
        });
        let start = Instant::now();
        let [width, height] = film.size();
        let pixels = u64::from(width) * u64::from(height);
        let is_full = film.size() == view.request.size;
        let before = if is_full { film.samples() } else { 0 };
        let (render_scene, camera) = (&view.render_scene, &view.camera);
        let progress = |done: u64| {
            let share = if is_full { done as f32 / pixels as f32 } else { 0.0 };
            (before as f32 + share.min(1.0)) / view.samples_wanted() as f32
        };
        let card = self.card.as_ref();
        let work = || film.add_sample(card, render_scene, camera, &control);
        let result = self.watched(view, &control, until, &progress, work);
        let result = result.unwrap_or(Err(PassError::Cancelled));
        let (pixels, milliseconds) = match &result {
            Ok(AddedSample { on_card: Some(work), .. }) => *work,
            _ => (control.pixels_done(), milliseconds_since(start)),
        };
        let is_paused = match &result {
            Err(PassError::UnderWay) => true,
            Err(PassError::Cancelled) => self.slice_end.is_some(),
            _ => false,
        };
        match (&result, until) {
            (Err(_), Some(_)) if !is_paused => self.pace.gave_up(pixels, milliseconds),
            _ => self.pace.passed(pixels, milliseconds),
        }
        let Some(RequestState { spent, .. }) = &mut self.view else { return Ok(PassEnd::Superseded) };
        match result {
            Ok(AddedSample { rays, .. }) => {
                let milliseconds = milliseconds + std::mem::take(spent);
                Ok(PassEnd::Finished(PassCost { rays, milliseconds }))
            }
            Err(PassError::Cancelled | PassError::UnderWay) => {
                *spent += milliseconds;
                Ok(if is_paused { PassEnd::Paused } else { PassEnd::Superseded })
            }
            Err(PassError::Size(error)) => Err(error.into()),
            Err(PassError::Card(error)) => {
                self.card_fails(error);
                Ok(PassEnd::Superseded)
            }
        }
    }

    /// Does `work` on the threads that trace and watches it meanwhile. `progress` tells from the pixels done how far the
    /// picture is refined.
    pub(crate) fn watched<T: Send>(
        &self,
        view: &RequestState,
        control: &RenderControl,
        until: Option<Instant>,
        progress: &dyn Fn(u64) -> f32,
        work: impl FnOnce() -> T + Send,
    ) -> Option<T> {
        let report = |done: u64| {
            let progress = progress(done).min(1.0);
            self.shared.change_status(|status| status.progress = progress);
            self.shared.wake();
        };
        let Some(pool) = self.pool.inner() else { return Some(work()) };
        let patience =
            PreemptionRule { is_new: &|request| is_new(request, &view.request), until, report: &report };
        let mut result = None;
        let place = &mut result;
        pool.in_place_scope(|scope| {
            let end = self.shared.begin_pass();
            scope.spawn(move |_| {
                let _end = end;
                *place = Some(work());
            });
            self.shared.watch_pass(control, &patience);
        });
        result
    }

    /// Brings a frame up to date and publishes it, after a pass if there was one.
    pub(crate) fn show(&mut self, passed: Option<&PassCost>) -> Result<(), LiveError> {
        let Some(view) = &mut self.view else { return Ok(()) };
        let samples = match (&view.film, &view.drawn) {
            (_, Some(drawn)) => drawn.samples,
            (Some(film), None) => film.samples(),
            (None, None) => return Ok(()),
        };
        let passed = passed.copied().or(view.unshown.take());
        if passed.is_some() || view.due.development {
            let start = Instant::now();
            let card = &self.card;
            match self.pool.install(|| develop_shown(view, card.as_ref())) {
                Ok(()) => {}
                Err(PassError::UnderWay) => {
                    (view.due.development, view.unshown) = (true, passed);
                    return Ok(());
                }
                Err(error) => return self.without_film(error),
            }
            view.due.development = false;
            self.picture_serial += 1;
            if let Some(passed) = passed {
                view.shown.milliseconds = passed.milliseconds + milliseconds_since(start);
                view.shown.rays = passed.rays;
            }
        }
        if view.due.overlays {
            let start = Instant::now();
            self.pool.install(|| view.trace_overlays());
            self.pace.overlaid(milliseconds_since(start));
        }
        view.due.frame = false;
        view.shown.at = Some(Instant::now());
        self.serial += 1;
        let shown = &view.shown;
        let frame = Frame {
            serial: self.serial,
            picture_serial: self.picture_serial,
            revision: view.request.revision,
            camera: view.request.camera,
            view_size: view.request.size,
            picture_size: shown.size,
            shows: shown.shows,
            pixels: Arc::clone(&shown.pixels),
            card: shown.card.clone(),
            samples,
            milliseconds: shown.milliseconds,
            rays: shown.rays,
            outline: Arc::clone(&shown.outline),
            hover: Arc::clone(&shown.hover),
            grid: Arc::clone(&shown.grid),
        };
        let (milliseconds, rays) = (shown.milliseconds, shown.rays);
        self.report(milliseconds, rays);
        self.shared.publish(frame);
        Ok(())
    }

    fn report(&self, milliseconds: f64, rays: RayCounts) {
        let Some(view) = &self.view else { return };
        let (done, wanted) = (view.full_samples(), view.samples_wanted());
        let is_on_card = view.shown.is_of_card;
        self.shared.change_status(|status| {
            status.backend = if is_on_card { "GPU" } else { "CPU" };
            status.samples_done = done.min(wanted);
            status.samples_wanted = wanted;
            status.progress = (done as f32 / wanted as f32).min(1.0);
            status.picture_size = view.picture_size();
            status.method = Some(view.request.method.kind());
            status.passes = view.drawn.as_ref().map(MethodPicture::passes).unwrap_or_default();
            status.cube_maps = view.drawn.as_ref().and_then(|drawn| drawn.drawing.cube_maps);
            status.milliseconds = milliseconds;
            status.rays_per_second = 1e3 * rays.total() as f64 / milliseconds.max(1e-6);
        });
    }
}

/// Develops what is to be seen; on the current rayon pool.
fn develop_shown(view: &mut RequestState, card: Option<&CardPort>) -> Result<(), PassError> {
    let development = view.request.development;
    if let (None, Some(Canvas::Card(film)), Some(card)) = (&view.drawn, &view.film, card) {
        let picture = card.develop(film, &development)?;
        (view.shown.card, view.shown.pixels) = (picture.card, picture.pixels);
        view.shown.is_of_card = true;
        (view.shown.size, view.shown.shows) = (film.size(), DisplayContent::Picture);
        return Ok(());
    }
    let (codes, size, shows) = match (&view.drawn, &view.film) {
        (Some(drawn), _) => {
            let (picture, shows) = drawn.seen(&view.render_scene, view.request.shows)?;
            let development = if has_light(shows) { development } else { Development::default() };
            (develop(&picture, &development), [picture.width(), picture.height()], shows)
        }
        (None, Some(Canvas::Processor(film))) => {
            (develop_film(film, &development), [film.width(), film.height()], DisplayContent::Picture)
        }
        (None, Some(Canvas::Card(_)) | None) => return Ok(()),
    };
    (view.shown.card, view.shown.is_of_card) = (None, false);
    view.shown.pixels = Arc::new(codes);
    (view.shown.size, view.shown.shows) = (size, shows);
    Ok(())
}

/// Display codes of what a film shows, four bytes a pixel; on the current rayon pool.
fn develop_film(film: &Film, development: &Development) -> Vec<u8> {
    let mut codes = vec![0; 4 * film.width() as usize * film.height() as usize];
    film.each_row(codes.as_chunks_mut().0, |light, codes| development.develop_rgba8(light, codes));
    codes
}

/// Display codes of a picture, four bytes a pixel; on the current rayon pool.
fn develop(picture: &Picture, development: &Development) -> Vec<u8> {
    const RUN: usize = 1 << 14;
    let mut codes = vec![0; 4 * picture.pixels().len()];
    picture.pixels().par_chunks(RUN).zip(codes.par_chunks_mut(4 * RUN)).for_each(|(light, codes)| {
        development.develop_rgba8(light, codes.as_chunks_mut().0);
    });
    codes
}

/// What a panic said.
pub(crate) fn message_of(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_else(|| "no message".to_owned())
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use catoptric_scene::Scene;

    use super::*;
    use crate::live::Live;

    /// A request of this revision panics.
    pub(super) const FAULTY: u64 = u64::MAX;

    #[test]
    fn a_panic_is_reported_and_the_next_request_is_served() {
        let (ring, bell) = std::sync::mpsc::channel();
        let live = Live::start(move || {
            let _ = ring.send(());
            panic!("the window's own fault");
        })
        .unwrap();
        let scene = Arc::new(Scene::default());
        for revision in [FAULTY, 1, FAULTY, 2] {
            live.request(Request { samples: 1, ..Request::new(Arc::clone(&scene), revision, [40, 30]) });
            while !live.status().is_idle {
                let _ = bell.recv_timeout(Duration::from_millis(100));
            }
            if revision == FAULTY {
                let Some(LiveError::Fault(message)) = live.status().error else {
                    panic!("{:?}", live.status())
                };
                assert_eq!(message, "a fault for the test");
            } else {
                assert_eq!(live.status().error, None);
                assert_eq!(live.latest().map(|frame| frame.revision), Some(revision));
            }
        }
    }
}
