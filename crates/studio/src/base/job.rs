//! Work that a thread does while the window goes on; without threads it is done at once.

use std::io;
use std::sync::mpsc::{self, Receiver, TryRecvError};

use catoptric_platform::threads;
use catoptric_platform::time::Instant;

use egui::Context;

/// Work under way. Dropping this lets it end unheard.
pub(crate) struct Job<T> {
    receiver: Receiver<T>,
    since: Instant,
}

/// The status of a job.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum JobStatus<T> {
    /// The work is under way.
    Waiting,
    /// The result of the work.
    Done(T),
    /// The work panicked.
    Lost,
}

impl<T: Send + 'static> Job<T> {
    /// Starts `work` on a thread of its own, if there are any; the window wakes up when it is done.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub(crate) fn start(
        context: &Context,
        name: &str,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> io::Result<Self> {
        let (sender, receiver) = mpsc::channel();
        let context = context.clone();
        threads::start_or_do(name, move || {
            let wake = WakeAtEnd(context);
            // Whoever started it may have gone.
            let _ = sender.send(work());
            drop(sender);
            drop(wake);
        })?;
        Ok(Self { receiver, since: Instant::now() })
    }

    /// How it is doing; the result comes once.
    pub(crate) fn poll(&self) -> JobStatus<T> {
        match self.receiver.try_recv() {
            Ok(result) => JobStatus::Done(result),
            Err(TryRecvError::Empty) => JobStatus::Waiting,
            Err(TryRecvError::Disconnected) => JobStatus::Lost,
        }
    }

    /// When it was started.
    pub(crate) fn since(&self) -> Instant {
        self.since
    }
}

/// Drops something that may take its time: gigabytes to be given back, a thread to be waited for.
pub(crate) fn let_go(thing: impl Send + 'static) {
    // Without a thread it is dropped here and now.
    let _ = threads::start_or_do("let go", move || drop(thing));
}

/// Wakes the window even when the work panics.
struct WakeAtEnd(Context);

impl Drop for WakeAtEnd {
    fn drop(&mut self) {
        self.0.request_repaint();
    }
}
