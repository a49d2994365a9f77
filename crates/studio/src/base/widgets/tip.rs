//! Explanations that leave in view what they explain.

use egui::{Rect, RectAlign, Response, Tooltip, Ui};

/// Where there is room beside a panel.
const BESIDE: [RectAlign; 4] =
    [RectAlign::LEFT_START, RectAlign::RIGHT_START, RectAlign::BOTTOM_START, RectAlign::TOP_START];

/// Explains a widget of a panel when the pointer rests on it: beside the panel, so that the widget and the rows below
/// it stay in view.
pub(crate) fn tip_beside(ui: &Ui, response: Response, text: &str) -> Response {
    let panel = ui.clip_rect().intersect(ui.ctx().content_rect());
    show(&response, Rect::from_x_y_ranges(panel.x_range(), response.rect.y_range()), &BESIDE, text);
    response
}

/// Explains an entry of a menu when the pointer rests on it: beside the menu, so that the other entries stay in view.
pub(crate) fn tip_beside_entry(response: Response, text: &str) -> Response {
    let [left, right, below, above] = BESIDE;
    show(&response, response.rect, &[right, left, below, above], text);
    response
}

fn show(response: &Response, anchor: Rect, places: &[RectAlign], text: &str) {
    if text.is_empty() {
        return;
    }
    let mut tooltip =
        if response.enabled() { Tooltip::for_enabled(response) } else { Tooltip::for_disabled(response) };
    let first = places.first().copied().unwrap_or_default();
    tooltip.popup = tooltip.popup.anchor(anchor).align(first).align_alternatives(places).gap(8.0);
    tooltip.show(|ui| {
        ui.set_max_width(ui.spacing().tooltip_width);
        ui.label(text);
    });
}
