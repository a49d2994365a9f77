//! Small widgets that several panels use.

pub(crate) mod choice;
pub(crate) mod color;
pub(crate) mod filter;
pub(crate) mod footer;
pub(crate) mod icon_choice;
pub(crate) mod number;
pub(crate) mod picker;
pub(crate) mod row;
pub(crate) mod section;
pub(crate) mod slider;
pub(crate) mod text;
pub(crate) mod tip;

use egui::{Align2, Response, Sense, TextStyle, Ui, Vec2, WidgetInfo, vec2};
use egui_material_icons::MaterialIcon;

use crate::base::theme;

/// Side of an icon button, points.
pub(crate) const ICON_BUTTON: f32 = 22.0;

/// A flat button that shows only an icon; `name` is its accessible name and its tooltip. `is_on` marks it.
pub(crate) fn icon_button(ui: &mut Ui, icon: MaterialIcon, name: &str, is_on: bool) -> Response {
    explained_icon_button(ui, icon, name, name, is_on)
}

/// A flat button that shows only an icon, with a tooltip that says more than its name.
pub(crate) fn explained_icon_button(
    ui: &mut Ui,
    icon: MaterialIcon,
    name: &str,
    tip: &str,
    is_on: bool,
) -> Response {
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(ICON_BUTTON), Sense::click());
    response
        .widget_info(|| WidgetInfo::selected(egui::accesskit::Role::Button, ui.is_enabled(), is_on, name));
    if ui.is_rect_visible(rect) {
        let palette = theme::palette(ui.visuals());
        let visuals = ui.style().interact(&response);
        let fill = match (is_on, response.hovered() || response.has_focus()) {
            (_, true) => visuals.bg_fill,
            (true, false) => palette.selection,
            (false, false) => egui::Color32::TRANSPARENT,
        };
        ui.painter().rect_filled(rect, 4.0, fill);
        if response.has_focus() {
            let stroke = egui::Stroke::new(1.0, palette.accent);
            ui.painter().rect_stroke(rect, 4.0, stroke, egui::StrokeKind::Inside);
        }
        let color = if ui.is_enabled() { visuals.text_color() } else { palette.weak };
        paint_icon(ui, icon, rect.center(), 16.0, color);
    }
    response.on_hover_text(tip)
}

/// Paints an icon around a point.
pub(crate) fn paint_icon(ui: &Ui, icon: MaterialIcon, center: egui::Pos2, size: f32, color: egui::Color32) {
    let font = egui::FontId::new(size, icon.font_family());
    ui.painter().text(center, Align2::CENTER_CENTER, icon.codepoint, font, color);
}

/// Draws an icon that only adorns the words beside it: who does not see it misses nothing.
pub(crate) fn icon_ui(ui: &mut Ui, icon: MaterialIcon, size: f32, color: egui::Color32) -> Response {
    let height = ui.spacing().interact_size.y.max(size);
    let (rect, response) = ui.allocate_exact_size(vec2(size, height), Sense::hover());
    paint_icon(ui, icon, rect.center(), size, color);
    response
}

/// The width of a line of text, points.
pub(crate) fn text_width(ui: &Ui, text: &str, font: &egui::FontId) -> f32 {
    ui.painter().layout_no_wrap(text.to_owned(), font.clone(), egui::Color32::PLACEHOLDER).size().x
}

/// Paints a line of text in the middle of `rect`, with an ellipsis where it has no room.
pub(crate) fn paint_line(ui: &Ui, rect: egui::Rect, text: &str, color: egui::Color32) {
    paint_line_in(ui, rect, text, TextStyle::Body.resolve(ui.style()), color);
}

/// Paints a line of text like [`paint_line`] in another font; returns how wide it is.
pub(crate) fn paint_line_in(
    ui: &Ui,
    rect: egui::Rect,
    text: &str,
    font: egui::FontId,
    color: egui::Color32,
) -> f32 {
    let galley = line_within(ui, rect.width(), text, font, color);
    let width = galley.size().x;
    let corner = egui::pos2(rect.left(), rect.center().y - galley.size().y / 2.0);
    ui.painter().galley(corner, galley, color);
    width
}

/// Paints a line of text at the right of `rect`, with an ellipsis where it has no room.
pub(crate) fn paint_line_right(
    ui: &Ui,
    rect: egui::Rect,
    text: &str,
    font: egui::FontId,
    color: egui::Color32,
) {
    let galley = line_within(ui, rect.width(), text, font, color);
    if galley.size().x <= rect.width() {
        let corner = egui::pos2(rect.right() - galley.size().x, rect.center().y - galley.size().y / 2.0);
        ui.painter().galley(corner, galley, color);
    }
}

/// Lays out a line of text in `width` points, with an ellipsis where it has no room.
pub(crate) fn line_within(
    ui: &Ui,
    width: f32,
    text: &str,
    font: egui::FontId,
    color: egui::Color32,
) -> std::sync::Arc<egui::Galley> {
    let mut job = egui::text::LayoutJob::simple_singleline(text.to_owned(), font, color);
    job.wrap = egui::text::TextWrapping::truncate_at_width(width);
    ui.painter().layout_job(job)
}

/// A key or a gesture, drawn like the cap of a key.
pub(crate) fn key_caps(ui: &mut Ui, text: &str) -> Response {
    let palette = theme::palette(ui.visuals());
    let font = TextStyle::Small.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap(text.to_owned(), font, palette.text);
    let size = galley.size() + vec2(12.0, 5.0);
    let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(egui::accesskit::Role::Label, true, text));
    let stroke = egui::Stroke::new(1.0, palette.line);
    ui.painter().rect(rect, 4.0, palette.button, stroke, egui::StrokeKind::Inside);
    ui.painter().galley(rect.center() - galley.size() / 2.0, galley, palette.text);
    response
}
