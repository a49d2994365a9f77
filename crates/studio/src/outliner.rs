//! The panel of everything in the scene.

use egui::Ui;

use crate::context::Cx;

/// What the outliner keeps from frame to frame.
#[derive(Default)]
pub(crate) struct Outliner {}

/// Draws the camera, the lights, the bodies and the materials.
pub(crate) fn outliner_ui(_ui: &mut Ui, _cx: &mut Cx<'_>, _outliner: &mut Outliner) {}
