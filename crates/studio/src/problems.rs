//! The panel of what is wrong in the file.

use egui::Ui;

use crate::context::Cx;

/// What the panel keeps from frame to frame.
#[derive(Default)]
pub(crate) struct Problems {}

/// Lists the findings with their lines.
pub(crate) fn problems_ui(_ui: &mut Ui, _cx: &mut Cx<'_>, _problems: &mut Problems) {}
