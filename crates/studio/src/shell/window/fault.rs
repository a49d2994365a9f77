//! What the libraries of windows say when they fail, and their panics.

use std::any::Any;
use std::panic::{self, AssertUnwindSafe};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use eframe::egui_wgpu::WgpuError;

use crate::shell::failure::StudioError;

/// What the libraries of windows say.
pub(crate) fn of_eframe(error: eframe::Error) -> StudioError {
    match error {
        eframe::Error::AppCreation(error) => match error.downcast::<StudioError>() {
            Ok(error) => *error,
            Err(error) => StudioError::Window(one_line(&error.to_string())),
        },
        eframe::Error::Wgpu(
            WgpuError::RequestAdapterError(_)
            | WgpuError::CreateSurfaceError(_)
            | WgpuError::RequestDeviceError(_)
            | WgpuError::NoSurfaceFormatsAvailable,
        ) => StudioError::NoGraphics,
        other => of_words(&other.to_string()),
    }
}

/// The libraries tell what is wrong in words only.
fn of_words(words: &str) -> StudioError {
    let line = one_line(words);
    let has = |parts: &[&str]| parts.iter().any(|part| words.contains(part));
    if has(&["could not be loaded", "failed to load", "cannot open shared object", "shared libraries"]) {
        StudioError::Library(line)
    } else if has(&["XOpenDisplayFailed", "Failed to open connection", "wayland compositor", "XNotSupported"])
    {
        StudioError::Unreachable(line)
    } else {
        StudioError::Window(line)
    }
}

/// The words in one line, without the place in the source that some begin with.
fn one_line(words: &str) -> String {
    let after_place = words.find(".rs:").and_then(|at| words.get(at..)?.split_once(": "));
    let said = after_place.map_or(words, |(_, said)| said);
    said.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Turns panics of the window's libraries into errors, until the window is open and when its device is lost.
#[derive(Clone, Default)]
pub(crate) struct PanicFilter {
    state: Arc<PanicFilterState>,
}

#[derive(Default)]
struct PanicFilterState {
    is_open: AtomicBool,
    is_lost: AtomicBool,
    /// Whether the studio itself is at work.
    is_ours: AtomicBool,
}

impl PanicFilter {
    /// Does `work`; what panics in it is returned as an error, in words, if it is none of the studio.
    pub(crate) fn during<T>(&self, work: impl FnOnce() -> T) -> Result<T, StudioError> {
        let usual = Arc::new(panic::take_hook());
        let (quiet, loud) = (self.clone(), Arc::clone(&usual));
        panic::set_hook(Box::new(move |info| {
            if !quiet.is_quiet() {
                loud(info);
            }
        }));
        let result = panic::catch_unwind(AssertUnwindSafe(work));
        panic::set_hook(Box::new(move |info| usual(info)));
        match result {
            Ok(value) => Ok(value),
            Err(payload) if self.is_quiet() => Err(of_words(&words(payload.as_ref()))),
            // Already told.
            Err(payload) => panic::resume_unwind(payload),
        }
    }

    /// The window is open.
    pub(crate) fn end(&self) {
        self.state.is_open.store(true, Ordering::Relaxed);
    }

    /// The device that draws the window is lost.
    pub(crate) fn begin_again(&self) {
        self.state.is_lost.store(true, Ordering::Relaxed);
    }

    /// Does what the studio does itself: its faults are never those of others.
    pub(crate) fn except<T>(&self, work: impl FnOnce() -> T) -> T {
        self.state.is_ours.store(true, Ordering::Relaxed);
        let done = work();
        self.state.is_ours.store(false, Ordering::Relaxed);
        done
    }

    fn is_quiet(&self) -> bool {
        let PanicFilterState { is_open, is_lost, is_ours } = &*self.state;
        let is = |flag: &AtomicBool| flag.load(Ordering::Relaxed);
        !is(is_open) || is(is_lost) && !is(is_ours)
    }
}

fn words(payload: &(dyn Any + Send)) -> String {
    let words = payload.downcast_ref::<&str>().map(|words| (*words).to_owned());
    words.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_the_libraries_lead_to_advice() {
        for (words, part) in [
            ("Library libxkbcommon-x11.so could not be loaded.", "install it"),
            ("os error at /a/linux/mod.rs:7: Failed to open connection to X", "reached (Failed to open"),
            ("something\n else", "cannot be opened: something else"),
        ] {
            let told = of_words(words).to_string();
            assert!(told.contains(part) && !told.contains('\n'), "{told}");
        }
    }
}
