//! Ctrl-C, and requests to end.
//!
//! The program leaves at once, wherever it is, except while a file is being written: then the file is finished first,
//! so that neither half a file nor a temporary stays behind. A second request is obeyed at once even then.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};
use std::thread;
use std::time::Duration;

use crate::console::say;
use crate::progress;

/// The exit status of an interrupted program.
pub(crate) const INTERRUPTED: u8 = 130;

/// The time that an interrupted program has to end by itself.
const PATIENCE: Duration = Duration::from_secs(10);

/// The files written so far; locked while one is being written.
static WRITTEN: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// What asks the studio, or a measurement under way, to end by itself.
static ASKED: OnceLock<Box<dyn Fn() + Send + Sync>> = OnceLock::new();

/// From now on, Ctrl-C (or a request to end) ends the program with exit status 130.
pub(crate) fn listen() {
    // Without a handler the system's own is at work, which ends the program too.
    let _ = on_request(request());
}

/// The first request only calls `ask`: the studio keeps unsaved work, a measurement what was measured, and each ends by
/// itself, or else is ended soon.
pub(crate) fn ask_first(ask: impl Fn() + Send + Sync + 'static) {
    // A command asks once at most.
    let _ = ASKED.set(Box::new(ask));
}

/// What to do at each request.
fn request() -> impl FnMut() + Send + 'static {
    let mut again = false;
    move || {
        // A thread of its own waits for the file or what was asked, and this one for a second request.
        let end = || match ASKED.get() {
            Some(ask) => {
                ask();
                thread::sleep(PATIENCE);
                std::process::exit(INTERRUPTED.into());
            }
            None => leave(&written()),
        };
        let waits = !again && thread::Builder::new().spawn(end).is_ok();
        again = true;
        if !waits {
            std::process::exit(INTERRUPTED.into());
        }
    }
}

/// Calls `act` at every SIGINT, SIGTERM and SIGHUP. Those that are ignored stay so: `nohup` has it that a render
/// outlives its terminal.
#[cfg(unix)]
fn on_request(mut act: impl FnMut() + Send + 'static) -> io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};

    let ignored = ignored_signals();
    let heard = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| ignored & (1 << (signal - 1)) == 0);
    let mut signals = signal_hook::iterator::Signals::new(heard)?;
    thread::Builder::new().spawn(move || signals.forever().for_each(|_| act())).map(drop)
}

/// The signals that this process ignores, a bit each: signal 1 is the lowest. Linux only so far; elsewhere none.
#[cfg(unix)]
fn ignored_signals() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}

#[cfg(not(unix))]
fn on_request(act: impl FnMut() + Send + 'static) -> io::Result<()> {
    ctrlc::set_handler(act).map_err(io::Error::other)
}

/// Does `work`, which creates or replaces the file at `path`, undisturbed by interruptions.
pub(crate) fn while_writing<T, E>(path: &Path, work: impl FnOnce() -> Result<T, E>) -> Result<T, E> {
    if catoptric_platform::files::is_stream(path) {
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

fn leave(written: &[PathBuf]) -> ! {
    progress::clear();
    if written.is_empty() {
        say("interrupted; nothing was written");
    } else {
        let names: Vec<String> = written.iter().map(|path| path.display().to_string()).collect();
        say(&format!("interrupted; written before that: {}", names.join(", ")));
    }
    std::process::exit(INTERRUPTED.into())
}
