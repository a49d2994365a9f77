//! A final picture, rendered in the background.

use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use catoptric_picture::{Picture, SizeError};
use catoptric_platform::threads::{self, Pool, Priority, Thread};
use catoptric_platform::time::{Duration, Instant};
use catoptric_scene::Scene;
use catoptric_tracer::raster::{Method, MethodError, SettingError, draw};
use catoptric_tracer::{
    RenderControl, RenderError, RenderOutput, RenderScene, RenderSettings, SceneBuildError, render,
};

use crate::method_picture::unfolded;
use crate::request::DisplayContent;
use crate::worker::message_of;

/// A render on threads of its own. Dropping it cancels it.
pub struct RenderJob {
    work: Arc<JobState>,
    thread: Option<Thread>,
}

/// The state that a job shares with its thread.
struct JobState {
    scene: Arc<Scene>,
    method: Method,
    shows: DisplayContent,
    settings: RenderSettings,
    generations: Option<u32>,
    threads: usize,
    start: Instant,
    control: RenderControl,
    done: Mutex<JobOutcome>,
}

#[derive(Default)]
struct JobOutcome {
    /// When tracing began.
    tracing_since: Option<Instant>,
    finished: Option<Duration>,
    result: Option<Result<RenderOutput, JobError>>,
}

/// The progress of a render.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JobProgress {
    /// The share done, 0…1.
    pub fraction: f64,
    /// Time since the start, or of the whole render once it is done.
    pub elapsed: Duration,
    /// Time of the tracing alone, without the start of threads and the preparation of the scene.
    pub tracing: Duration,
    /// Time left at the speed so far; `None` before there is a speed.
    pub remaining: Option<Duration>,
    /// Whether there is a result.
    pub is_finished: bool,
}

/// The reason why a render has no picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum JobError {
    /// The scene cannot be prepared.
    #[error(transparent)]
    Stage(#[from] SceneBuildError),
    /// There can be no picture of this size.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// A setting of the method is out of its range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The cube maps of all reflecting bodies would take too much memory.
    #[error("the cube maps of {bodies} bodies with faces of {size}x{size} pixels take too much memory")]
    TooManyCubeMaps {
        /// How many bodies reflect in the picture.
        bodies: usize,
        /// Edge of a face, pixels.
        size: u32,
    },
    /// The job was cancelled.
    #[error("the render was cancelled")]
    Cancelled,
    /// The system gives no threads, or the program itself failed.
    #[error("the render failed: {0}")]
    Fault(String),
}

impl RenderJob {
    /// Starts to render `scene` through its own camera, followed to `generations` if given, on `threads` threads
    /// (0: one on each processor).
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn start(
        scene: Arc<Scene>,
        settings: RenderSettings,
        generations: Option<u32>,
        threads: usize,
    ) -> io::Result<Self> {
        Self::drawn(scene, Method::Whitted, DisplayContent::Picture, settings, generations, threads)
    }

    /// Starts to draw `scene` by any method, or a layer behind its picture.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn drawn(
        scene: Arc<Scene>,
        method: Method,
        shows: DisplayContent,
        settings: RenderSettings,
        generations: Option<u32>,
        threads: usize,
    ) -> io::Result<Self> {
        let (start, control, done) = (Instant::now(), RenderControl::default(), Mutex::default());
        let work =
            Arc::new(JobState { scene, method, shows, settings, generations, threads, start, control, done });
        let own = Arc::clone(&work);
        if !threads::are_available() {
            own.run();
            return Ok(Self { work, thread: None });
        }
        let thread = Thread::start("render", move || own.run())?;
        Ok(Self { work, thread: Some(thread) })
    }

    /// How far it is.
    pub fn progress(&self) -> JobProgress {
        let JobState { settings, control, start, .. } = &*self.work;
        let pixels = match control.pixels_expected() {
            0 => u64::from(settings.width) * u64::from(settings.height),
            expected => expected,
        };
        let fraction = (control.pixels_done() as f64 / pixels.max(1) as f64).min(1.0);
        let done = self.work.done();
        let elapsed = done.finished.unwrap_or_else(|| start.elapsed());
        let tracing = done.tracing_since.map(|since| (*start + elapsed).duration_since(since));
        let left = tracing.map(|time| time.as_secs_f64() * (1.0 - fraction) / fraction);
        let is_finished = done.finished.is_some();
        JobProgress {
            fraction,
            elapsed,
            tracing: tracing.unwrap_or_default(),
            remaining: if is_finished { Some(Duration::ZERO) } else { left.and_then(duration) },
            is_finished,
        }
    }

    /// Asks it to stop; the result is then [`JobError::Cancelled`], unless it was finished already.
    pub fn cancel(&self) {
        self.work.control.cancel();
    }

    /// The result, once, when there is one.
    pub fn take_result(&self) -> Option<Result<RenderOutput, JobError>> {
        self.work.done().result.take()
    }
}

impl Drop for RenderJob {
    fn drop(&mut self) {
        self.cancel();
        if let Some(thread) = self.thread.take() {
            thread.join();
        }
    }
}

impl JobState {
    fn done(&self) -> MutexGuard<'_, JobOutcome> {
        self.done.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn run(&self) {
        let result = catch_unwind(AssertUnwindSafe(|| self.render()))
            .unwrap_or_else(|panic| Err(JobError::Fault(message_of(&*panic))));
        let mut done = self.done();
        done.finished = Some(self.start.elapsed());
        done.result = Some(result);
    }

    fn render(&self) -> Result<RenderOutput, JobError> {
        Picture::check_size(self.settings.width, self.settings.height)?;
        let pool = Pool::new("render", self.threads, Priority::Lowest)
            .map_err(|error| JobError::Fault(error.to_string()))?;
        let go_on = || if self.control.is_cancelled() { Err(JobError::Cancelled) } else { Ok(()) };
        pool.install(|| {
            go_on()?;
            let mut render_scene = RenderScene::build(&self.scene)?;
            if let Some(generations) = self.generations {
                render_scene = render_scene.with_generations(generations);
            }
            go_on()?;
            self.done().tracing_since = Some(Instant::now());
            if !self.method.abilities().accumulates {
                return self.draw(&render_scene);
            }
            render(&render_scene, self.settings, &self.control).map_err(|error| match error {
                RenderError::Size(error) => error.into(),
                RenderError::Cancelled => JobError::Cancelled,
            })
        })
    }

    fn draw(&self, render_scene: &RenderScene) -> Result<RenderOutput, JobError> {
        let drawing = draw(render_scene, &self.method, self.settings, &self.control)?;
        let shown = match self.shows {
            DisplayContent::Picture => None,
            DisplayContent::Layer(layer) => drawing.layer(render_scene, layer)?,
            DisplayContent::UnfoldedCube(body) => {
                unfolded(&drawing, render_scene, body)?.map(|(picture, _)| picture)
            }
        };
        Ok(RenderOutput { picture: shown.unwrap_or(drawing.picture), counts: drawing.counts })
    }
}

impl From<MethodError> for JobError {
    fn from(error: MethodError) -> Self {
        match error {
            MethodError::Cancelled => Self::Cancelled,
            MethodError::Size(error) => Self::Size(error),
            MethodError::Setting(error) => Self::Setting(error),
            MethodError::TooManyCubeMaps { bodies, size, .. } => Self::TooManyCubeMaps { bodies, size },
            // It does not come from drawing a picture.
            error @ MethodError::SizeMismatch { .. } => Self::Fault(error.to_string()),
        }
    }
}

/// A time of so many seconds; `None` for what is none.
fn duration(seconds: f64) -> Option<Duration> {
    Duration::try_from_secs_f64(seconds).ok()
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{Body, MaterialChoice};

    use super::*;

    #[test]
    fn a_cancelled_job_prepares_nothing() {
        let gold = Body { material: MaterialChoice::Named("gold".into()), ..Body::default() };
        let work = JobState {
            scene: Arc::new(Scene { bodies: [gold].into(), ..Scene::default() }),
            method: Method::Whitted,
            shows: DisplayContent::Picture,
            settings: RenderSettings { width: 8, height: 8, samples: 1 },
            generations: None,
            threads: 1,
            start: Instant::now(),
            control: RenderControl::default(),
            done: Mutex::default(),
        };
        assert!(matches!(work.render(), Err(JobError::Stage(_))));
        work.control.cancel();
        assert_eq!(work.render().unwrap_err(), JobError::Cancelled);
        assert_eq!(work.done().tracing_since, None);
    }
}
