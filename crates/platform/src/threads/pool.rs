//! Threads for parallel work.

use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};

use super::{Priority, are_available, lower_priority, start};

/// Threads for the parallel work of rayon, or the caller's own where there are no others.
#[derive(Debug)]
pub struct Pool(Option<ThreadPool>);

/// The reason why there are no threads for parallel work.
#[derive(Debug, thiserror::Error)]
#[error("cannot start threads; close other programs or ask for fewer")]
pub struct PoolError(#[from] ThreadPoolBuildError);

impl Pool {
    /// Starts `threads` threads, or one on each processor for 0.
    ///
    /// # Errors
    /// When the system does not give as many.
    pub fn new(name: &'static str, threads: usize, priority: Priority) -> Result<Self, PoolError> {
        if !are_available() {
            return Ok(Self(None));
        }
        let threads = if threads == 0 { super::processors() } else { threads };
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .thread_name(move |index| format!("{name} {index}"))
            .start_handler(move |_| lower_priority(priority))
            .spawn_handler(|thread| {
                let name = thread.name().unwrap_or_default().to_owned();
                start::start(&name, || thread.run())
            })
            .build()?;
        Ok(Self(Some(pool)))
    }

    /// The number of threads.
    pub fn threads(&self) -> usize {
        self.0.as_ref().map_or(1, ThreadPool::current_num_threads)
    }

    /// The pool of rayon; `None` where there are no threads besides the caller's.
    pub fn inner(&self) -> Option<&ThreadPool> {
        self.0.as_ref()
    }

    /// Does `work` on its threads and waits for the end.
    pub fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match &self.0 {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pool_has_the_threads_asked_for() {
        let pool = Pool::new("test", 3, Priority::Normal).unwrap();
        assert_eq!((pool.threads(), pool.install(rayon::current_num_threads)), (3, 3));
    }
}
