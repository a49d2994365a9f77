//! Parts of a panel that can be folded.

use egui::collapsing_header::CollapsingState;
use egui::{FontId, Id, Role, Sense, Ui, WidgetInfo, pos2, vec2};
use egui_material_icons::icons::{ICON_CHEVRON_RIGHT, ICON_EXPAND_MORE};

use crate::base::theme;
use crate::base::widgets::{paint_icon, paint_line_in, paint_line_right};

/// Draws a heading with what belongs under it, for which `summary` stands while it is folded. Whether it is, is
/// remembered under its `key`; it can be folded whether or not what belongs to it can be used.
pub(crate) fn section(
    ui: &mut Ui,
    key: &'static str,
    title: &str,
    summary: &str,
    is_enabled: bool,
    body: impl FnOnce(&mut Ui),
) {
    let id = Id::unique(("section", key));
    let mut state = CollapsingState::load_with_default_open(ui.ctx(), id, true);
    ui.add_space(4.0);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), 24.0), Sense::click());
    let response = response.on_hover_cursor(egui::CursorIcon::PointingHand);
    if response.clicked() {
        state.toggle(ui);
    }
    let palette = theme::palette(ui.visuals());
    let is_lit = response.hovered() || response.has_focus();
    let fill = if is_lit { palette.hovered } else { palette.bar };
    ui.painter().rect_filled(rect.expand2(vec2(4.0, 0.0)), 4.0, fill);
    let icon = if state.is_open() { ICON_EXPAND_MORE } else { ICON_CHEVRON_RIGHT };
    let middle = rect.center().y;
    let left = rect.left();
    paint_icon(ui, icon, pos2(left + 8.0, middle), 16.0, palette.weak);
    let title_rect = rect.with_min_x(left + 20.0).with_max_x(rect.right() - 4.0);
    let title_width = paint_line_in(ui, title_rect, title, FontId::proportional(13.5), palette.text);
    if !state.is_open() && !summary.is_empty() {
        let room = title_rect.with_min_x(title_rect.left() + title_width + 12.0);
        paint_line_right(ui, room, summary, FontId::proportional(12.0), palette.weak);
    }
    let is_open = state.is_open();
    response.widget_info(|| WidgetInfo::selected(Role::DisclosureTriangle, true, is_open, title));
    state.show_body_unindented(ui, |ui| {
        ui.add_space(2.0);
        // What is locked stays legible.
        ui.visuals_mut().disabled_alpha = 0.75;
        ui.add_enabled_ui(is_enabled, body);
    });
    state.store(ui.ctx());
}
