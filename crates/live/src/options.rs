//! Options of the worker.

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
        Self { threads: 0, budget: 13.0 }
    }
}
