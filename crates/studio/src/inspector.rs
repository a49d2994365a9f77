//! The panel of values of what is selected.

use egui::Ui;

use crate::context::Cx;

/// What the inspector keeps from frame to frame.
#[derive(Default)]
pub(crate) struct Inspector {}

/// Draws the values of what is selected.
pub(crate) fn inspector_ui(_ui: &mut Ui, _cx: &mut Cx<'_>, _inspector: &mut Inspector) {}
