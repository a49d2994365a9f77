//! Windows over the window: one open at a time.

use egui::Ui;

use crate::app::Studio;

/// The dialogs' state.
#[derive(Default)]
pub(crate) struct Dialogs {}

/// Draws the open dialogs.
pub(crate) fn dialogs_ui(_ui: &mut Ui, _studio: &mut Studio) {}
