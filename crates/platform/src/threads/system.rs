//! Threads of the system.

use std::io;
use std::num::NonZero;
use std::pin::pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::task::{Context, Poll, Wake, Waker};
use std::thread::{self, Thread};
use std::time::Duration;

pub use std::thread::sleep;

/// How long to sleep between looks at work under way: at first, and in the end.
const SHORTEST_PAUSE: Duration = Duration::from_micros(20);
const LONGEST_PAUSE: Duration = Duration::from_micros(500);

/// Whether there are threads.
pub fn are_available() -> bool {
    true
}

/// The number of threads that run at the same time.
pub fn processors() -> usize {
    thread::available_parallelism().map_or(1, NonZero::get)
}

/// Does work that has to wait for something, and waits with it in this thread. It is taken up again when it rings, and
/// after short pauses, since a driver may tell only those who ask; pauses are shortest after a ring. `None` where threads
/// cannot wait and the work is not done at once: on a page.
pub fn wait<T>(work: impl Future<Output = T>) -> Option<T> {
    let mut work = pin!(work);
    let bell = Arc::new(Bell { thread: thread::current(), has_rung: AtomicBool::new(false) });
    let waker = Waker::from(Arc::clone(&bell));
    let mut pause = SHORTEST_PAUSE;
    loop {
        if let Poll::Ready(done) = work.as_mut().poll(&mut Context::from_waker(&waker)) {
            return Some(done);
        }
        if bell.has_rung.swap(false, Ordering::Relaxed) {
            pause = SHORTEST_PAUSE;
        }
        thread::park_timeout(pause);
        pause = (2 * pause).min(LONGEST_PAUSE);
    }
}

/// Wakes a thread that waits.
struct Bell {
    thread: Thread,
    has_rung: AtomicBool,
}

impl Wake for Bell {
    fn wake(self: Arc<Self>) {
        self.wake_by_ref();
    }

    fn wake_by_ref(self: &Arc<Self>) {
        self.has_rung.store(true, Ordering::Relaxed);
        self.thread.unpark();
    }
}

pub(super) fn start(name: &str, work: impl FnOnce() + Send + 'static) -> io::Result<()> {
    thread::Builder::new().name(name.to_owned()).spawn(work).map(drop)
}

pub(super) fn start_task<F: Future<Output = ()> + 'static>(
    name: &str,
    task: impl FnOnce() -> F + Send + 'static,
) -> io::Result<()> {
    start(name, move || {
        wait(task());
    })
}

#[cfg(test)]
mod tests {
    use std::future::poll_fn;

    use super::*;

    #[test]
    fn a_ring_from_another_thread_and_none_at_all_are_both_waited_for() {
        let mut looks = 0;
        let rung = poll_fn(|context| {
            looks += 1;
            let waker = context.waker().clone();
            if looks == 1 {
                thread::spawn(move || waker.wake());
            }
            if looks < 3 { Poll::Pending } else { Poll::Ready(looks) }
        });
        assert_eq!(wait(rung), Some(3));
        let mut looks = 0;
        let silent = poll_fn(|_| {
            looks += 1;
            if looks < 10 { Poll::Pending } else { Poll::Ready("done") }
        });
        assert_eq!(wait(silent), Some("done"));
    }
}
