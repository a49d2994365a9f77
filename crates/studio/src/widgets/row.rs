//! Rows of a panel of values: labels in one column, controls in the other, room for a reset button at the end.

use egui::{Id, Rect, Response, Role, Sense, Ui, UiBuilder, WidgetInfo, vec2};
use egui_material_icons::icons::ICON_RESTART_ALT;

use crate::theme;
use crate::typeset::{self, Line};
use crate::widgets::number::HEIGHT;
use crate::widgets::paint_icon;

/// The width of the column of labels.
pub(crate) const LABEL: f32 = 106.0;
/// The width kept free for the reset button.
pub(crate) const RESET: f32 = 20.0;
/// The gap between controls of a row.
pub(crate) const GAP: f32 = 4.0;

/// How a row is labelled.
pub(crate) struct RowLabel<'a> {
    /// Where the widgets of the row have their identity.
    pub(crate) id: Id,
    /// The words.
    pub(crate) text: &'a str,
    /// A symbol before them, as markup of [`typeset`]; empty for none.
    pub(crate) symbol: &'a str,
    /// What they mean.
    pub(crate) tip: String,
    /// Whether something else on the panel points to this row.
    pub(crate) is_highlighted: bool,
}

/// Draws a row; tells what its contents returned and whether the pointer is over it.
pub(crate) fn row<R>(
    ui: &mut Ui,
    label: &RowLabel<'_>,
    contents: impl FnOnce(&mut Ui, &Response) -> R,
) -> (R, bool) {
    let width = ui.available_width();
    let start = ui.cursor().min;
    if label.is_highlighted {
        let rect = Rect::from_min_size(start, vec2(width, HEIGHT)).expand2(vec2(4.0, 2.0));
        ui.painter().rect_filled(rect, 4.0, theme::palette(ui.visuals()).selection.gamma_multiply(0.6));
    }
    let inner = ui.scope_builder(UiBuilder::new().scope_id(label.id), |ui| {
        ui.horizontal(|ui| {
            ui.set_min_size(vec2(width, HEIGHT));
            ui.spacing_mut().item_spacing.x = GAP;
            let response = label_ui(ui, label);
            contents(ui, &response)
        })
        .inner
    });
    let rect = Rect::from_min_size(start, vec2(width, HEIGHT));
    let is_hovered = ui.rect_contains_pointer(rect.expand2(vec2(0.0, 2.0)));
    (inner.inner, is_hovered)
}

/// The room that a row's controls have.
pub(crate) fn control_width(ui: &Ui) -> f32 {
    (ui.available_width() - RESET - GAP).max(60.0)
}

fn label_ui(ui: &mut Ui, label: &RowLabel<'_>) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(LABEL, HEIGHT), Sense::hover());
    let palette = theme::palette(ui.visuals());
    let is_enabled = ui.is_enabled();
    let color = if is_enabled { palette.text } else { palette.weak };
    let mut line = Line::default();
    if !label.symbol.is_empty() {
        line.push(ui, label.symbol, 13.5, color);
        line.space(6.0);
    }
    let room = LABEL - line.width();
    if !label.text.is_empty() {
        let color = if label.symbol.is_empty() { color } else { palette.weak };
        line.push_words(ui, label.text, 13.5, color, room);
    }
    line.paint(ui, rect.left_center());
    let name = typeset::named(label.symbol, label.text);
    response.widget_info(|| WidgetInfo::labeled(Role::Label, is_enabled, &name));
    let tip = label.tip.clone();
    if tip.is_empty() { response } else { response.on_hover_text(tip) }
}

/// The button that brings a default back; nothing but its room when the value is the default.
pub(crate) fn reset_button(ui: &mut Ui, is_default: bool, name: &str, tip: &str) -> bool {
    if is_default {
        ui.allocate_space(vec2(RESET, HEIGHT));
        return false;
    }
    let (rect, response) = ui.allocate_exact_size(vec2(RESET, HEIGHT), Sense::click());
    let palette = theme::palette(ui.visuals());
    let is_lit = response.hovered() || response.has_focus();
    let color = if is_lit { palette.accent } else { palette.weak };
    paint_icon(ui, ICON_RESTART_ALT, rect.center(), 14.0, color);
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, name));
    response.on_hover_text(tip).clicked()
}
