//! Threads that a page starts as workers.

use std::io;
use std::pin::{Pin, pin};
use std::sync::OnceLock;
use std::task::{Context, Poll, Waker};
use std::time::Duration;

use rayon::{ThreadBuilder, ThreadPoolBuilder};

use crate::time::Instant;

/// What a thread does. What it gives is done afterwards, between the turns of its worker.
pub type ThreadWork = Box<dyn FnOnce() -> Option<ThreadTask> + Send>;

/// What is done between the turns of a worker.
pub type ThreadTask = Pin<Box<dyn Future<Output = ()>>>;

static THREADS: OnceLock<PageThreads> = OnceLock::new();

struct PageThreads {
    processors: usize,
    start: fn(&str, ThreadWork) -> io::Result<()>,
}

/// From now on `start` starts threads, of which so many run at the same time, also those of rayon. Only the first call
/// counts.
pub fn use_threads(processors: usize, start: fn(&str, ThreadWork) -> io::Result<()>) {
    if THREADS.set(PageThreads { processors, start }).is_err() {
        return;
    }
    let pool = ThreadPoolBuilder::new().num_threads(processors.max(1));
    let spawn = |thread: ThreadBuilder| self::start("rayon", || thread.run());
    // Left to itself, rayon would take the first worker that uses it for its pool, and others would wait for that one
    // when it is gone. If there is a pool already, it stays.
    let _ = pool.spawn_handler(spawn).build_global();
}

/// Whether there are threads.
pub fn are_available() -> bool {
    THREADS.get().is_some()
}

/// The number of threads that run at the same time; 1 without threads.
pub fn processors() -> usize {
    THREADS.get().map_or(1, |threads| threads.processors.max(1))
}

/// Lets time pass.
pub fn sleep(time: Duration) {
    if cfg!(target_feature = "atomics") {
        std::thread::sleep(time);
    } else {
        let start = Instant::now();
        while start.elapsed() < time {
            std::hint::spin_loop();
        }
    }
}

/// Does work that is done at once. `None` if it has to wait for something: a browser does nothing for a thread that waits,
/// so that it would wait for ever.
pub fn wait<T>(work: impl Future<Output = T>) -> Option<T> {
    match pin!(work).poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(done) => Some(done),
        Poll::Pending => None,
    }
}

pub(super) fn start(name: &str, work: impl FnOnce() + Send + 'static) -> io::Result<()> {
    match THREADS.get() {
        Some(threads) => {
            let work = move || {
                work();
                None
            };
            (threads.start)(name, Box::new(work))
        }
        None => Err(io::ErrorKind::Unsupported.into()),
    }
}

pub(super) fn start_task<F: Future<Output = ()> + 'static>(
    name: &str,
    task: impl FnOnce() -> F + Send + 'static,
) -> io::Result<()> {
    match THREADS.get() {
        Some(threads) => (threads.start)(name, Box::new(|| Some(Box::pin(task())))),
        None => {
            js_sys::futures::spawn_local(task());
            Ok(())
        }
    }
}
