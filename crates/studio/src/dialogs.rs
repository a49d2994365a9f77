//! Windows over the window: one open at a time.

use egui::{Context, Ui};

use crate::app::Studio;
use crate::command::Command;

/// The dialogs' state.
#[derive(Default)]
pub(crate) struct Dialogs {}

/// Draws the open dialogs.
pub(crate) fn dialogs_ui(_ui: &mut Ui, _studio: &mut Studio) {}

/// Opens the dialog that `command` asks for.
pub(crate) fn run(_context: &Context, _studio: &mut Studio, _command: Command) {}
