//! Threads of the system.

use std::io;
use std::num::NonZero;
use std::thread;

pub use std::thread::sleep;

/// Whether there are threads.
pub fn are_available() -> bool {
    true
}

/// The number of threads that run at the same time.
pub fn processors() -> usize {
    thread::available_parallelism().map_or(1, NonZero::get)
}

pub(super) fn start(name: &str, work: impl FnOnce() + Send + 'static) -> io::Result<()> {
    thread::Builder::new().name(name.to_owned()).spawn(work).map(drop)
}
