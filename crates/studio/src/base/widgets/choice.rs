//! A choice of few things, side by side.

use egui::{FontId, Id, Rect, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, pos2, vec2};

use crate::base::theme;
use crate::base::widgets::number::HEIGHT;
use crate::base::widgets::tip::tip_beside;
use crate::base::widgets::{line_within, text_width};

/// One item of a choice.
pub(crate) struct ChoiceItem<'a, V> {
    /// What it stands for.
    pub(crate) value: V,
    /// What is written on it.
    pub(crate) text: &'a str,
    /// What it means.
    pub(crate) tip: &'a str,
    /// Whether it can be chosen now.
    pub(crate) is_enabled: bool,
}

/// What stands beside a text at least, points.
const PADDING: f32 = 5.0;

/// Draws the choices over `width`, in several lines where one is too short; `chosen` is lit, if it is one of them.
/// Returns another one when it is clicked.
pub(crate) fn choice_ui<V: Copy + PartialEq>(
    ui: &mut Ui,
    id: Id,
    name: &str,
    width: f32,
    choices: &[ChoiceItem<'_, V>],
    chosen: Option<V>,
) -> Option<V> {
    let font = FontId::proportional(12.5);
    let widths: Vec<f32> = choices.iter().map(|choice| text_width(ui, choice.text, &font)).collect();
    let lines = lines_of(&widths, width);
    let height = HEIGHT * lines.len() as f32;
    let (whole, _) = ui.allocate_exact_size(vec2(width, height), Sense::hover());
    let palette = theme::palette(ui.visuals());
    ui.painter().rect(whole, 4.0, palette.field, Stroke::new(1.0, palette.line), StrokeKind::Inside);
    let mut picked = None;
    for (line, places) in lines.into_iter().enumerate() {
        let taken: f32 = widths.get(places.clone()).unwrap_or_default().iter().sum();
        let padding = (width - taken) / places.len().max(1) as f32;
        let top = whole.top() + HEIGHT * line as f32;
        let mut left = whole.left();
        for place in places {
            let (Some(choice), Some(text_width)) = (choices.get(place), widths.get(place)) else { continue };
            let right = (left + text_width + padding).min(whole.right());
            let rect = Rect::from_min_max(pos2(left, top), pos2(right, top + HEIGHT));
            left = right;
            let is_chosen = chosen == Some(choice.value);
            if cell_ui(ui, id.with(place), rect, name, choice, is_chosen) && !is_chosen {
                picked = Some(choice.value);
            }
        }
    }
    picked
}

/// Draws one of the choices; returns whether it was clicked.
fn cell_ui<V>(ui: &Ui, id: Id, rect: Rect, name: &str, choice: &ChoiceItem<'_, V>, is_chosen: bool) -> bool {
    let palette = theme::palette(ui.visuals());
    let is_enabled = ui.is_enabled() && (choice.is_enabled || is_chosen);
    let sense = if is_enabled { Sense::click() } else { Sense::hover() };
    let response = ui.interact(rect, id, sense);
    let inside = rect.shrink(1.5);
    if is_chosen {
        ui.painter().rect_filled(inside, 3.0, palette.selection);
    } else if response.hovered() && is_enabled {
        ui.painter().rect_filled(inside, 3.0, palette.hovered);
    }
    if response.has_focus() {
        let ring = Stroke::new(1.0, palette.accent);
        ui.painter().rect_stroke(inside, 3.0, ring, StrokeKind::Inside);
    }
    let color = if is_chosen || is_enabled { palette.text } else { palette.weak.gamma_multiply(0.7) };
    let color = if ui.is_enabled() { color } else { palette.weak };
    let galley = line_within(ui, inside.width() + 0.5, choice.text, FontId::proportional(12.5), color);
    let is_elided = galley.elided;
    ui.painter().galley(inside.center() - galley.size() / 2.0, galley, color);
    let label = format!("{name}: {}", choice.text);
    response.widget_info(|| WidgetInfo::selected(Role::RadioButton, is_enabled, is_chosen, &label));
    let tip = match (is_elided, choice.tip.is_empty()) {
        (true, true) => choice.text.to_owned(),
        (true, false) => format!("{}\n{}", choice.text, choice.tip),
        (false, _) => choice.tip.to_owned(),
    };
    tip_beside(ui, response, &tip).clicked()
}

/// Which texts stand in which line.
fn lines_of(widths: &[f32], room: f32) -> Vec<std::ops::Range<usize>> {
    let mut lines = Vec::new();
    let (mut start, mut taken) = (0, 0.0);
    for (place, width) in widths.iter().enumerate() {
        let width = width + 2.0 * PADDING;
        if place > start && taken + width > room {
            lines.push(start..place);
            (start, taken) = (place, 0.0);
        }
        taken += width;
    }
    lines.push(start..widths.len());
    lines
}

#[cfg(test)]
mod tests {
    use super::lines_of;

    #[test]
    fn choices_take_as_many_lines_as_they_need() {
        let ends = |widths: &[f32], room| -> Vec<usize> {
            lines_of(widths, room).into_iter().map(|line| line.end).collect()
        };
        assert_eq!(ends(&[30.0, 40.0, 50.0], 200.0), [3]);
        assert_eq!(ends(&[30.0, 40.0, 50.0], 100.0), [2, 3]);
        assert_eq!(ends(&[300.0, 40.0], 100.0), [1, 2]);
        assert_eq!(ends(&[], 100.0), [0]);
    }
}
