//! A final picture, rendered in the background.

use std::io;
use std::sync::Arc;
use std::time::Duration;

use catoptric_picture::SizeError;
use catoptric_scene::Scene;
use catoptric_tracer::{RenderSettings, Rendering, StageError};

/// A render on threads of its own. Dropping it cancels it.
pub struct RenderJob {}

/// How far a render is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JobProgress {
    /// The share done, 0…1.
    pub fraction: f64,
    /// Time since the start, or of the whole render once it is done.
    pub elapsed: Duration,
    /// Time left at the speed so far; `None` before there is a speed.
    pub remaining: Option<Duration>,
    /// Whether there is a result.
    pub is_finished: bool,
}

/// Why a render has no picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum JobError {
    /// The scene cannot be prepared.
    #[error(transparent)]
    Stage(#[from] StageError),
    /// There can be no picture of this size.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// It was cancelled.
    #[error("the render was cancelled")]
    Cancelled,
    /// The system gives no threads, or the program itself failed.
    #[error("the render failed: {0}")]
    Fault(String),
}

impl RenderJob {
    /// Starts to render `scene` through its own camera, followed to `generations` if given, on `threads` threads (0: one on each processor).
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn start(
        _scene: Arc<Scene>,
        _settings: RenderSettings,
        _generations: Option<u32>,
        _threads: usize,
    ) -> io::Result<Self> {
        Ok(Self {})
    }

    /// How far it is.
    pub fn progress(&self) -> JobProgress {
        JobProgress::default()
    }

    /// Asks it to stop; the result is then [`JobError::Cancelled`].
    pub fn cancel(&self) {}

    /// The result, once, when there is one.
    pub fn take_result(&self) -> Option<Result<Rendering, JobError>> {
        None
    }
}
