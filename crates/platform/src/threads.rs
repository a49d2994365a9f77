//! Threads: of the system, of the workers of a page, or none.
//!
//! A browser gives threads only to pages that are isolated from others. A program that runs in one tells by
//! `use_threads` how to start them; without that there are none, and whoever wants something done in the background
//! does it in slices, or at once.

mod orders;
mod pool;
mod priority;
#[cfg(not(target_family = "wasm"))]
#[path = "threads/system.rs"]
mod start;
#[cfg(target_family = "wasm")]
#[path = "threads/page.rs"]
mod start;

use std::io;
use std::sync::{Arc, Condvar, Mutex, PoisonError};

pub use orders::Orders;
pub use pool::{Pool, PoolError};
pub use priority::{Priority, lower_priority};
#[cfg(target_family = "wasm")]
pub use start::{ThreadTask, ThreadWork, use_threads};
pub use start::{are_available, processors, sleep, wait};

/// A thread under way. Dropping this lets it go on.
#[derive(Debug)]
pub struct Thread {
    end: Arc<ThreadEnd>,
}

#[derive(Debug, Default)]
struct ThreadEnd {
    has_ended: Mutex<bool>,
    bell: Condvar,
}

impl Thread {
    /// Starts `work` on a thread of its own.
    ///
    /// # Errors
    /// When the system gives none; [`io::ErrorKind::Unsupported`] where there are none at all.
    pub fn start(name: &str, work: impl FnOnce() + Send + 'static) -> io::Result<Self> {
        let end = Arc::new(ThreadEnd::default());
        let signal = ThreadEndSignal(Arc::clone(&end));
        start::start(name, move || {
            // By a panic, too.
            let _signal = signal;
            work();
        })?;
        Ok(Self { end })
    }

    /// Waits for its end, however it ends.
    pub fn join(self) {
        let mut has_ended = self.end.has_ended.lock().unwrap_or_else(PoisonError::into_inner);
        while !*has_ended {
            has_ended = self.end.bell.wait(has_ended).unwrap_or_else(PoisonError::into_inner);
        }
    }
}

/// Signals the end of a thread when it is dropped.
struct ThreadEndSignal(Arc<ThreadEnd>);

impl Drop for ThreadEndSignal {
    fn drop(&mut self) {
        *self.0.has_ended.lock().unwrap_or_else(PoisonError::into_inner) = true;
        self.0.bell.notify_all();
    }
}

/// Starts a task that waits for orders, and between them for what it works with: on a thread of its own, or between the
/// turns of this one on a page that has no others. What `task` makes stays where it was made.
///
/// # Errors
/// When the system gives no thread.
pub fn start_task<F: Future<Output = ()> + 'static>(
    name: &str,
    task: impl FnOnce() -> F + Send + 'static,
) -> io::Result<()> {
    start::start_task(name, task)
}

/// Does `work` on a thread of its own, or at once where there are no threads.
///
/// # Errors
/// When the system has threads, but gives none now.
pub fn start_or_do(name: &str, work: impl FnOnce() + Send + 'static) -> io::Result<()> {
    if are_available() {
        return Thread::start(name, work).map(drop);
    }
    work();
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thread_that_panics_has_ended() {
        let thread = Thread::start("for the test", || std::panic::resume_unwind(Box::new(()))).unwrap();
        thread.join();
    }
}
