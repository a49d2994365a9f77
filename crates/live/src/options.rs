//! Options of the worker.

/// How the worker works.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LiveOptions {
    /// Threads that trace; 0 (the default) for one on each processor.
    pub threads: usize,
    /// What a picture may take while something moves, milliseconds.
    pub budget: f64,
    /// Whether the worker gets a thread of its own where there are threads, as by default; else
    /// [`advance`](crate::Live::advance) does the work.
    pub own_thread: bool,
}

impl Default for LiveOptions {
    fn default() -> Self {
        Self { threads: 0, budget: 13.0, own_thread: true }
    }
}
