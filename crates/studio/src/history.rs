//! The panel of the steps of editing.

use egui::Ui;

use crate::context::Cx;

/// Draws the history; a click goes to that step.
pub(crate) fn history_ui(_ui: &mut Ui, _cx: &mut Cx<'_>) {}
