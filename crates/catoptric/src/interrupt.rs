//! Ctrl-C, and requests to end.
//!
//! The program leaves at once, wherever it is, except while a file is being written: then the file is finished first,
//! so that neither half a file nor a temporary stays behind. A second request is obeyed at once even then.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;

use crate::output::say;
use crate::progress;

/// The exit status of an interrupted program.
const INTERRUPTED: i32 = 130;

/// The files written so far; locked while one is being written.
static WRITTEN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// From now on, Ctrl-C (or a request to end) ends the program with exit status 130.
///
/// If a signal is already handled or ignored, as under `nohup`, that stays so.
pub(crate) fn listen() {
    let again = AtomicBool::new(false);
    // Without a handler the system's own is at work, which ends the program too.
    let _ = ctrlc::try_set_handler(move || {
        let first = !again.swap(true, Ordering::Relaxed);
        // A thread of its own waits for the file, and this one for a second request.
        let waiting = first && thread::Builder::new().spawn(|| leave(&written())).is_ok();
        if !waiting {
            std::process::exit(INTERRUPTED);
        }
    });
}

/// Does `work`, which creates or replaces the file at `path`, undisturbed by interruptions.
pub(crate) fn while_writing<T, E>(path: &Path, work: impl FnOnce() -> Result<T, E>) -> Result<T, E> {
    if is_device(path) {
        // Nothing to tidy up, and it may block for ever.
        return work();
    }
    let mut written = written();
    let result = work()?;
    written.push(path.to_owned());
    Ok(result)
}

/// Does `work`, which leaves no file behind if it comes to its end.
pub(crate) fn undisturbed<T>(work: impl FnOnce() -> T) -> T {
    let _written = written();
    work()
}

fn written() -> MutexGuard<'static, Vec<PathBuf>> {
    WRITTEN.lock().unwrap_or_else(PoisonError::into_inner)
}

fn is_device(path: &Path) -> bool {
    path.metadata().is_ok_and(|found| !found.is_file() && !found.is_dir())
}

fn leave(written: &[PathBuf]) -> ! {
    progress::clear();
    if written.is_empty() {
        say("interrupted; nothing was written");
    } else {
        let names: Vec<String> = written.iter().map(|path| path.display().to_string()).collect();
        say(&format!("interrupted; written before that: {}", names.join(", ")));
    }
    std::process::exit(INTERRUPTED)
}
