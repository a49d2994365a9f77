//! The window on the desktop.

mod failure;
mod software;

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};

use eframe::NativeOptions;
use egui::{IconData, ViewportBuilder};

use crate::app::{Start, Studio};
use crate::host::{Desktop, Host as _};
use crate::settings::Settings;
pub use failure::StudioError;
use failure::{Quiet, of_eframe};

/// A way to end the studio from outside, such as by Ctrl-C: unsaved work is kept for the next start.
#[derive(Clone, Debug, Default)]
pub struct Interruption {
    is_asked: Arc<AtomicBool>,
    context: Arc<OnceLock<egui::Context>>,
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
}

/// Opens the studio and stays until its window is closed.
///
/// # Errors
/// When there is no display, or neither the graphics card nor a software driver can draw a window.
pub fn open(start: Start, interruption: &Interruption) -> Result<(), StudioError> {
    if !has_display() {
        return Err(StudioError::NoDisplay);
    }
    let settings = Desktop.settings_path().map_or_else(Settings::first, |path| Settings::load(&path));
    let size = settings.window_size.unwrap_or([1440.0, 900.0]);
    let viewport = ViewportBuilder::default()
        .with_title("Catoptric")
        .with_app_id("catoptric")
        .with_inner_size(size)
        .with_min_inner_size([800.0, 500.0])
        .with_drag_and_drop(true)
        .with_icon(Arc::new(icon()));
    let options = NativeOptions { viewport, ..NativeOptions::default() };
    let interruption = interruption.clone();
    let quiet = Quiet::default();
    let loud = quiet.clone();
    let create = move |creation: &eframe::CreationContext<'_>| {
        loud.end();
        let context = &creation.egui_ctx;
        prepare(creation);
        let _ = interruption.context.set(context.clone());
        let mut studio = Studio::interruptible(context, &start, Box::new(Desktop), Some(interruption))?;
        if let Some(state) = &creation.wgpu_render_state {
            studio.use_window_card(state);
        }
        Ok(Box::new(studio) as Box<dyn eframe::App>)
    };
    quiet.during(|| eframe::run_native("Catoptric", options, Box::new(create)))?.map_err(of_eframe)
}

/// Makes a new window ready: to be called before its first frame.
pub fn prepare(creation: &eframe::CreationContext<'_>) {
    if let Some(state) = &creation.wgpu_render_state {
        software::install(&creation.egui_ctx, state);
    }
}

/// A mirror ball; see `assets/icon.toml`.
fn icon() -> IconData {
    eframe::icon_data::from_png_bytes(include_bytes!("../assets/icon.png")).unwrap_or_default()
}

#[cfg(target_os = "linux")]
fn has_display() -> bool {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    is_set("DISPLAY") || is_set("WAYLAND_DISPLAY") || is_set("WAYLAND_SOCKET")
}

#[cfg(not(target_os = "linux"))]
fn has_display() -> bool {
    true
}
