//! The worker's handle.

use std::io;
use std::sync::Arc;
use std::thread::JoinHandle;

use catoptric_gpu::Gpu;
use catoptric_tracer::RenderScene;

use crate::frame::Frame;
use crate::options::LiveOptions;
use crate::priority::{self, Priority};
use crate::request::Request;
use crate::shared::SharedState;
use crate::status::Status;
use crate::worker::Worker;

/// A worker that traces what is asked of it, the newest request first. Dropping it stops the worker.
pub struct Live {
    shared: Arc<SharedState>,
    worker: Option<JoinHandle<()>>,
}

impl Live {
    /// Starts a worker; `wake` is called from its thread whenever there is something new to show.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn start(wake: impl Fn() + Send + Sync + 'static) -> io::Result<Self> {
        Self::with_options(LiveOptions::default(), wake)
    }

    /// Starts a worker with a number of threads and a time budget.
    ///
    /// # Errors
    /// When the system gives no threads.
    pub fn with_options(options: LiveOptions, wake: impl Fn() + Send + Sync + 'static) -> io::Result<Self> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(options.threads)
            .thread_name(|index| format!("live trace {index}"))
            .start_handler(|_| priority::lower(Priority::Low))
            .build()
            .map_err(io::Error::other)?;
        let status = Status {
            backend: "CPU",
            threads: pool.current_num_threads(),
            is_idle: true,
            ..Status::default()
        };
        let shared = Arc::new(SharedState::new(status, wake));
        let worker = Worker::new(Arc::clone(&shared), pool, options.budget);
        let worker = std::thread::Builder::new().name("live".to_owned()).spawn(move || worker.run())?;
        Ok(Self { shared, worker: Some(worker) })
    }

    /// Asks for another picture; returns at once. What was asked before and not yet begun is forgotten.
    pub fn request(&self, request: Request) {
        self.shared.request(request);
    }

    /// Lets a graphics card draw Whitted's tree from now on, or the processor. If the card is lost, the processor goes on,
    /// and [`Status::card_lost`] says why.
    pub fn draw_with(&self, card: Option<Arc<Gpu>>) {
        self.shared.draw_with(card);
    }

    /// The newest frame.
    pub fn latest(&self) -> Option<Arc<Frame>> {
        self.shared.latest()
    }

    /// How the worker is doing.
    pub fn status(&self) -> Status {
        self.shared.status()
    }

    /// The scene of the newest prepared scene with its revision: for picking, one ray being cheap. It should not be kept:
    /// a scene that was dropped is edited when bodies change, one that is kept has to be copied.
    pub fn render_scene(&self) -> Option<(u64, Arc<RenderScene>)> {
        self.shared.render_scene()
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        self.shared.stop();
        if let Some(worker) = self.worker.take() {
            // It catches its panics; there is nothing to do about one that came all the same.
            let _ = worker.join();
        }
    }
}
