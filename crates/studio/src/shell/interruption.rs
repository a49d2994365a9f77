//! A way to end the studio from outside.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use egui::Context;

/// A way to end the studio from outside, such as by Ctrl-C: unsaved work is kept for the next start.
#[derive(Clone, Debug, Default)]
pub struct Interruption {
    is_asked: Arc<AtomicBool>,
    context: Arc<OnceLock<Context>>,
}

impl Interruption {
    /// Asks the studio to end.
    pub fn ask(&self) {
        self.is_asked.store(true, Ordering::Relaxed);
        if let Some(context) = self.context.get() {
            context.request_repaint();
        }
    }

    /// Whether it has been asked to.
    pub fn is_asked(&self) -> bool {
        self.is_asked.load(Ordering::Relaxed)
    }

    /// Wakes `context` whenever it is asked to from now on.
    pub(crate) fn attach(&self, context: Context) {
        let _ = self.context.set(context);
    }
}
