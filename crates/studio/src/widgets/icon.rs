//! Icons, and buttons that show nothing else.

use egui::{Align2, Color32, FontId, Pos2, Response, Role, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo};
use egui_material_icons::MaterialIcon;

use crate::theme;

/// Side of an icon button, points.
pub(crate) const SIDE: f32 = 22.0;

/// A flat button with an icon, on or off; `name` is what it is called, `tip` what it does.
pub(crate) fn toggle(ui: &mut Ui, icon: MaterialIcon, name: &str, tip: &str, is_on: bool) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(SIDE), Sense::click());
    let palette = theme::palette(ui.visuals());
    let is_enabled = ui.is_enabled();
    let fill = match (is_on, response.hovered() || response.has_focus()) {
        (_, true) => palette.hovered,
        (true, false) => palette.selection,
        (false, false) => Color32::TRANSPARENT,
    };
    ui.painter().rect_filled(rect, 4.0, fill);
    if response.has_focus() {
        let ring = Stroke::new(1.0, palette.accent);
        ui.painter().rect_stroke(rect, 4.0, ring, StrokeKind::Inside);
    }
    let color = if is_enabled { palette.text } else { palette.weak };
    paint(ui, icon, rect.center(), 16.0, color);
    response.widget_info(|| WidgetInfo::selected(Role::Button, is_enabled, is_on, name));
    response.on_hover_text(tip)
}

/// Paints an icon around a point.
pub(crate) fn paint(ui: &Ui, icon: MaterialIcon, center: Pos2, size: f32, color: Color32) {
    let font = FontId::new(size, icon.font_family());
    ui.painter().text(center, Align2::CENTER_CENTER, icon.codepoint, font, color);
}
