//! The menu bar.

use egui::Ui;

use crate::app::Studio;

/// Draws the menus, and at the right the language and the theme.
pub(crate) fn menu_ui(ui: &mut Ui, studio: &mut Studio) {
    ui.label(studio.texts.get("app-name"));
}
