//! The worker's handle.

use std::io;
use std::sync::{Arc, Mutex, PoisonError};

use catoptric_platform::threads::{self, Pool, Priority, Thread};
use catoptric_platform::time::Instant;
use catoptric_tracer::RenderScene;

use crate::card::CardSource;
use crate::frame::Frame;
use crate::options::LiveOptions;
use crate::request::Request;
use crate::shared::SharedState;
use crate::status::Status;
use crate::worker::Worker;

/// A worker that traces what is asked of it, the newest request first. Dropping it stops the worker.
pub struct Live {
    shared: Arc<SharedState>,
    place: WorkerPlace,
}

/// Where the worker works.
enum WorkerPlace {
    /// On a thread of its own, until that has ended.
    Thread(Option<Thread>),
    /// In the window's thread, where there are no others: in slices, by [`Live::advance`].
    Window(Box<Mutex<Worker>>),
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
        let pool = Pool::new("live trace", options.threads, Priority::Low).map_err(io::Error::other)?;
        let status = Status { backend: "CPU", threads: pool.threads(), is_idle: true, ..Status::default() };
        let shared = Arc::new(SharedState::new(status, wake));
        let worker = Worker::new(Arc::clone(&shared), pool, options.budget);
        let place = if options.own_thread && threads::are_available() {
            WorkerPlace::Thread(Some(Thread::start("live", move || worker.run())?))
        } else {
            WorkerPlace::Window(Box::new(Mutex::new(worker)))
        };
        Ok(Self { shared, place })
    }

    /// Whether the worker has a thread of its own.
    pub fn has_thread(&self) -> bool {
        matches!(self.place, WorkerPlace::Thread(_))
    }

    /// Works until `end`, where the worker has no thread of its own; the window calls this in every frame. Pictures by
    /// Whitted's tree are traced in slices; what else there is to do is done whole.
    pub fn advance(&self, end: Instant) {
        if let WorkerPlace::Window(worker) = &self.place {
            worker.lock().unwrap_or_else(PoisonError::into_inner).advance(end);
        }
    }

    /// Asks for another picture; returns at once. What was asked before and not yet begun is forgotten.
    pub fn request(&self, request: Request) {
        self.shared.request(request);
    }

    /// Lets a graphics card draw Whitted's tree from now on, or the processor, which draws until the card is open and has
    /// compiled its shader. If the card is lost, the processor goes on,
    /// and [`Status::card_lost`] says why.
    pub fn draw_with(&self, card: Option<CardSource>) {
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
        if let WorkerPlace::Thread(thread) = &mut self.place
            && let Some(thread) = thread.take()
        {
            thread.join();
        }
    }
}
