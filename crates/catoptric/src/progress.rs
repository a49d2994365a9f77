//! What the terminal shows while one waits.

use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::Duration;

use catoptric_tracer::Control;
use indicatif::{HumanDuration, ProgressBar, ProgressState, ProgressStyle};

use crate::console::is_able;

/// What is shown now, so that an interruption can clear it.
static SHOWN: Mutex<Option<ProgressBar>> = Mutex::new(None);

/// Whether to show how far the work is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Progress {
    shown: bool,
}

impl Progress {
    /// Shown on standard error if that is a terminal that can move its cursor, and the user does not want quiet.
    pub(crate) fn new(quiet: bool) -> Self {
        Self { shown: !quiet && is_able(&std::io::stderr()) }
    }

    /// Whether anything is shown.
    pub(crate) fn is_shown(self) -> bool {
        self.shown
    }

    /// Does `work` while a bar shows `control`'s progress to `pixels`.
    pub(crate) fn of_tracing<T>(self, control: &Control, pixels: u64, work: impl FnOnce() -> T) -> T {
        if !self.shown {
            return work();
        }
        show(ProgressBar::new(pixels), "{bar:40} {percent:>3} %  {elapsed} elapsed{left}");
        let finished = AtomicBool::new(false);
        let result = thread::scope(|scope| {
            let watcher = scope.spawn(|| watch(control, &finished));
            let _end = End { finished: &finished, watcher: watcher.thread().clone() };
            work()
        });
        clear();
        result
    }

    /// Does `work` while a bar shows how many steps of `total` it says are done, and the seconds it says are left.
    pub(crate) fn of_steps<T>(
        self,
        total: usize,
        work: impl FnOnce(&mut (dyn FnMut(usize, Option<Duration>) + Send)) -> T,
    ) -> T {
        if !self.shown {
            return work(&mut |_, _| {});
        }
        show(ProgressBar::new(total as u64), "{bar:40} {pos} of {len}  {elapsed} elapsed{msg}");
        let result = work(&mut |done, left| {
            with_shown(|bar| {
                bar.set_position(done as u64);
                if let Some(left) = left {
                    bar.set_message(format!(", {:#} left", HumanDuration(left)));
                }
                bar.tick();
            });
        });
        clear();
        result
    }

    /// Does `work` under a line that says what it is.
    pub(crate) fn of_writing<T>(self, what: &str, work: impl FnOnce() -> T) -> T {
        if !self.shown {
            return work();
        }
        show(ProgressBar::new_spinner().with_message(format!("writing {what}")), "{msg}");
        with_shown(ProgressBar::tick);
        let result = work();
        clear();
        result
    }
}

/// Ends the watcher when it goes out of scope, even if the work panics: the scope waits for the watcher.
struct End<'a> {
    finished: &'a AtomicBool,
    watcher: thread::Thread,
}

impl Drop for End<'_> {
    fn drop(&mut self) {
        self.finished.store(true, Ordering::Relaxed);
        self.watcher.unpark();
    }
}

/// Takes away what is shown; nothing is drawn any more.
pub(crate) fn clear() {
    let shown = SHOWN.lock().unwrap_or_else(PoisonError::into_inner).take();
    if let Some(bar) = shown {
        bar.finish_and_clear();
    }
}

fn show(bar: ProgressBar, template: &str) {
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    bar.set_style(style.with_key("left", time_left));
    *SHOWN.lock().unwrap_or_else(PoisonError::into_inner) = Some(bar);
}

/// The time left, once there is something to tell it by.
fn time_left(state: &ProgressState, out: &mut dyn fmt::Write) {
    if state.pos() > 0 {
        // A bar that cannot be drawn is no reason to stop.
        let _ = write!(out, ", {:#} left", HumanDuration(state.eta()));
    }
}

fn with_shown(draw: impl FnOnce(&ProgressBar)) {
    if let Some(bar) = &*SHOWN.lock().unwrap_or_else(PoisonError::into_inner) {
        draw(bar);
    }
}

/// Moves the bar until the work is finished; short work shows none.
fn watch(control: &Control, finished: &AtomicBool) {
    const INTERVAL: Duration = Duration::from_millis(100);
    thread::park_timeout(INTERVAL);
    while !finished.load(Ordering::Relaxed) {
        with_shown(|bar| {
            // Some work announces more as it goes on.
            let expected = control.pixels_expected();
            if expected > 0 {
                bar.set_length(expected);
            }
            bar.set_position(control.pixels_done());
        });
        thread::park_timeout(INTERVAL);
    }
}
