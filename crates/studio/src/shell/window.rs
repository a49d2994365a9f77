//! The window on the desktop.

mod card;
mod fault;
mod losses;
mod software;

use std::cell::OnceCell;
use std::sync::{Arc, Mutex, PoisonError};

use catoptric_gpu::LossWatch;
use catoptric_platform::time::Instant;
use eframe::NativeOptions;
use egui::{
    Context, Event, IconData, Modifiers, PointerButton, RawInput, Ui, ViewportBuilder, ViewportCommand,
};

use crate::shell::documents;
use crate::shell::failure::StudioError;
use crate::shell::host::{DesktopHost, Host as _};
use crate::shell::interruption::Interruption;
use crate::shell::studio::{StartDocument, Studio};
use crate::state::settings::Settings;
use fault::{PanicFilter, of_eframe};
use losses::DeviceLosses;

/// Makes the device that draws the window fail: for tests, which cannot wait for a driver to do so.
#[doc(hidden)]
#[derive(Clone, Debug, Default)]
pub struct InjectedLoss {
    window: Arc<Mutex<Option<Arc<LossWatch>>>>,
}

impl InjectedLoss {
    /// Loses the device of the open window, if there is one.
    pub fn strike(&self) {
        if let Some(watch) = self.window.lock().unwrap_or_else(PoisonError::into_inner).take() {
            watch.destroy();
        }
    }

    fn aim(&self, watch: &Arc<LossWatch>) {
        *self.window.lock().unwrap_or_else(PoisonError::into_inner) = Some(Arc::clone(watch));
    }
}

/// Opens the studio and stays until its window is closed. When the device that draws it is lost, the window is opened
/// anew with everything in it.
///
/// # Errors
/// When there is no display, when neither the graphics card nor a software driver can draw a window, or when devices
/// are lost again and again.
pub fn open(start: &StartDocument, interruption: &Interruption) -> Result<(), StudioError> {
    open_with_fault(start, interruption, &InjectedLoss::default())
}

/// Opens the studio with a device that a test can make fail.
#[doc(hidden)]
pub fn open_with_fault(
    start: &StartDocument,
    interruption: &Interruption,
    fault: &InjectedLoss,
) -> Result<(), StudioError> {
    if !has_display() {
        return Err(StudioError::NoDisplay);
    }
    let mut opened = None;
    let mut losses = DeviceLosses::default();
    let mut is_broken_off = false;
    loop {
        let watch = OnceCell::new();
        let shown = show(&mut opened, &watch, (start, interruption, fault));
        let Some(WindowSession { studio, context }) = &mut opened else { return shown };
        // What the toolkit still holds of a device that is lost can make it panic. Its loop then has to end first,
        // which it does without a window.
        let was_broken_off = std::mem::replace(&mut is_broken_off, shown.is_err());
        if was_broken_off && shown.is_ok() && watch.get().is_none() {
            continue;
        }
        let lost = watch.get().and_then(|watch| watch.lost());
        let reason = match (lost, shown) {
            (None, Err(error)) if !losses.is_empty() => error.to_string(),
            (None, shown) => return shown,
            (Some(_), _) if documents::is_leaving(studio) => return Ok(()),
            (Some(_), _) if losses.add(Instant::now()) => {
                studio.outlive_window(context);
                continue;
            }
            (Some(reason), _) => reason.to_owned(),
        };
        documents::leave(studio);
        return Err(StudioError::Lost(reason));
    }
}

/// The studio, which outlives its windows, and its egui context.
struct WindowSession {
    studio: Studio,
    context: Context,
}

/// Opens a window and stays until it is closed, or its device is lost, as `watch` then reports.
fn show(
    opened: &mut Option<WindowSession>,
    watch: &OnceCell<Arc<LossWatch>>,
    (start, interruption, fault): (&StartDocument, &Interruption, &InjectedLoss),
) -> Result<(), StudioError> {
    let context = opened.as_ref().map(|opened| opened.context.clone());
    let options = NativeOptions { viewport: viewport(opened.as_ref()), ..NativeOptions::default() };
    let quiet = PanicFilter::default();
    let create = |creation: &eframe::CreationContext<'_>| -> Result<Box<dyn eframe::App + '_>, _> {
        quiet.end();
        let context = &creation.egui_ctx;
        prepare(creation);
        let is_first = opened.is_none();
        let opened = match opened {
            Some(opened) => opened,
            none => {
                interruption.attach(context.clone());
                let interruption = Some(interruption.clone());
                let studio = Studio::interruptible(context, start, Box::new(DesktopHost), interruption)?;
                none.insert(WindowSession { studio, context: context.clone() })
            }
        };
        if let Some(state) = &creation.wgpu_render_state {
            let (wake, quiet) = (context.clone(), quiet.clone());
            let tell = move || {
                quiet.begin_again();
                wake.request_repaint();
            };
            let watch = watch.get_or_init(|| LossWatch::over(&state.device, tell));
            watch.mind_errors();
            fault.aim(watch);
            opened.studio.enter_window(state, watch, is_first);
        }
        let held = if is_first { Vec::new() } else { held(context) };
        Ok(Box::new(WindowApp { studio: &mut opened.studio, watch: watch.get(), quiet: &quiet, held }))
    };
    let run = || eframe::run_native_ext("Catoptric", options, context, Box::new(create));
    quiet.during(run)?.map_err(of_eframe)
}

fn viewport(opened: Option<&WindowSession>) -> ViewportBuilder {
    let first = || DesktopHost.settings_path().map_or_else(Settings::first, |path| Settings::load(&path));
    let settings = opened.map_or_else(first, |opened| opened.studio.settings().clone());
    let viewport = ViewportBuilder::default()
        .with_title("Catoptric")
        .with_app_id("catoptric")
        .with_inner_size(settings.window_size.unwrap_or([1440.0, 900.0]))
        .with_maximized(settings.is_maximized)
        .with_min_inner_size([800.0, 500.0])
        .with_drag_and_drop(true)
        .with_icon(Arc::new(icon()));
    let Some(opened) = opened else { return viewport };
    // The new window appears where the old one was.
    let zoom = opened.context.zoom_factor();
    opened.context.input(|input| {
        let old = input.viewport();
        let viewport = viewport
            .with_maximized(old.maximized == Some(true))
            .with_fullscreen(old.fullscreen == Some(true));
        old.outer_rect.map_or(viewport.clone(), |rect| viewport.with_position(rect.min * zoom))
    })
}

/// Releases all keys and buttons that were down in a closed window, since no event reports it.
fn held(context: &Context) -> Vec<Event> {
    context.input(|input| {
        let pos = input.pointer.interact_pos().unwrap_or_default();
        let buttons = [PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle];
        let down = buttons.into_iter().filter(|button| input.pointer.button_down(*button));
        let release =
            |button| Event::PointerButton { pos, button, pressed: false, modifiers: Modifiers::NONE };
        down.map(release).chain([Event::WindowFocused(false)]).collect()
    })
}

/// The studio in one window, as an app of eframe.
struct WindowApp<'a> {
    studio: &'a mut Studio,
    watch: Option<&'a Arc<LossWatch>>,
    quiet: &'a PanicFilter,
    /// What comes before the first input.
    held: Vec<Event>,
}

impl WindowApp<'_> {
    fn is_lost(&self) -> bool {
        self.watch.is_some_and(|watch| watch.lost().is_some())
    }
}

impl eframe::App for WindowApp<'_> {
    fn raw_input_hook(&mut self, _context: &Context, input: &mut RawInput) {
        input.events.splice(0..0, self.held.drain(..));
    }

    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        if self.is_lost() {
            // Nothing may be drawn any more: the toolkit would panic.
            software::leave(ui.ctx());
            ui.ctx().send_viewport_cmd(ViewportCommand::Close);
            return;
        }
        self.quiet.except(|| self.studio.ui(ui));
    }

    fn on_exit(&mut self) {
        if !self.is_lost() || documents::is_leaving(self.studio) {
            documents::leave(self.studio);
        }
    }
}

/// The studio as an app, for windows of others.
impl eframe::App for Studio {
    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        Self::ui(self, ui);
    }

    fn on_exit(&mut self) {
        documents::leave(self);
    }
}

/// Makes a new window ready: to be called before its first frame.
pub fn prepare(creation: &eframe::CreationContext<'_>) {
    if let Some(state) = &creation.wgpu_render_state {
        software::install(&creation.egui_ctx, state);
    }
}

/// A mirror ball; see `assets/icon.toml`.
fn icon() -> IconData {
    eframe::icon_data::from_png_bytes(include_bytes!("../../assets/icon.png")).unwrap_or_default()
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
