//! The worker's handle.

use std::io;
use std::sync::Arc;

use catoptric_tracer::Stage;

use crate::frame::Frame;
use crate::request::Request;
use crate::status::Status;

/// How the worker works.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiveOptions {
    /// Threads that trace; 0 (the default) for one on each processor.
    pub threads: usize,
    /// What a picture may take while something moves, milliseconds.
    pub budget: f64,
}

impl Default for LiveOptions {
    fn default() -> Self {
        Self { threads: 0, budget: 18.0 }
    }
}

/// A worker that traces what is asked of it, the newest request first. Dropping it stops the worker.
pub struct Live {}

impl Live {
    /// Starts a worker; `wake` is called from its thread whenever there is something new to show.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn start(wake: impl Fn() + Send + Sync + 'static) -> io::Result<Self> {
        Self::with_options(LiveOptions::default(), wake)
    }

    /// The same with other threads and another budget.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn with_options(_options: LiveOptions, _wake: impl Fn() + Send + Sync + 'static) -> io::Result<Self> {
        Ok(Self {})
    }

    /// Asks for another picture; returns at once. What was asked before and not yet begun is forgotten.
    pub fn request(&self, _request: Request) {}

    /// The newest frame.
    pub fn latest(&self) -> Option<Arc<Frame>> {
        None
    }

    /// How the worker is doing.
    pub fn status(&self) -> Status {
        Status::default()
    }

    /// The stage of the newest prepared scene with its revision: for picking, one ray being cheap.
    pub fn stage(&self) -> Option<(u64, Arc<Stage>)> {
        None
    }
}
