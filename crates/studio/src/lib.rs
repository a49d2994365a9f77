#![doc = include_str!("../README.md")]
#![cfg_attr(target_family = "wasm", allow(dead_code, reason = "what only the desktop's window uses"))]

mod base;
mod panels;
mod shell;
mod state;

pub use base::texts::{Language, Texts};
pub use base::theme::Theme;
pub use shell::failure::StudioError;
pub use shell::host;
pub use shell::interruption::Interruption;
pub use shell::repaint;
pub use shell::studio::{StartDocument, Studio};
#[doc(hidden)]
#[cfg(not(target_family = "wasm"))]
pub use shell::window::{InjectedLoss, open_with_fault};
#[cfg(not(target_family = "wasm"))]
pub use shell::window::{open, prepare as prepare_window};
pub use state::command::{
    AddCommand, AuditCommand, CameraCommand, Command, CommandGroup, CommandStyle, CompareCommand,
    DisplayCommand, FileCommand, HelpCommand, MeasureCommand, PictureCommand, SelectionCommand, Tool,
    ToolCommand, WindowCommand, ZoomStep,
};
pub use state::images::ImageUse;
pub use state::layout::Pane;
pub use state::methods::MethodSettings;
pub use state::render_choices::{PictureKind, RenderChoices};
pub use state::settings::{LastScene, Settings};
