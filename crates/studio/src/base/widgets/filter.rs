//! A field that shows only what bears a name.

use egui::{Margin, Rect, Response, Sense, TextEdit, Ui, UiBuilder, pos2, vec2};
use egui_material_icons::icons::{ICON_CLOSE, ICON_SEARCH};

use crate::base::theme;
use crate::base::widgets::{icon_button, paint_icon};

/// Draws the field over `width`, with a button that empties it. The words are its name, what it does, and what the
/// button does.
pub(crate) fn filter_field(
    ui: &mut Ui,
    filter: &mut String,
    width: f32,
    [name, tip, clear]: [&str; 3],
) -> Response {
    let (rect, _) = ui.allocate_exact_size(vec2(width, 26.0), Sense::hover());
    let field = TextEdit::singleline(filter).hint_text(name);
    let field = field.margin(Margin { left: 26, right: 24, top: 4, bottom: 4 });
    let response = ui.put(rect, field.desired_width(f32::INFINITY));
    let response = response.accessible_name(name).on_hover_text(tip);
    let color = theme::palette(ui.visuals()).weak;
    paint_icon(ui, ICON_SEARCH, pos2(rect.left() + 14.0, rect.center().y), 15.0, color);
    if !filter.is_empty() {
        let right = Rect::from_center_size(pos2(rect.right() - 13.0, rect.center().y), vec2(22.0, 22.0));
        let button = |ui: &mut Ui| icon_button(ui, ICON_CLOSE, clear, false);
        if ui.scope_builder(UiBuilder::new().max_rect(right), button).inner.clicked() {
            filter.clear();
        }
    }
    response
}
