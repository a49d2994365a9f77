//! Ctrl-C.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context as _, Result};
use catoptric_tracer::Control;

/// From now on, the first Ctrl-C (or a request to end) cancels `control`, so that work stops in order and no half file
/// stays behind; a second one ends the program at once.
pub(crate) fn cancels(control: &Arc<Control>) -> Result<()> {
    let control = Arc::clone(control);
    let again = AtomicBool::new(false);
    ctrlc::set_handler(move || {
        control.cancel();
        if again.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    })
    .context("cannot listen to Ctrl-C")
}
