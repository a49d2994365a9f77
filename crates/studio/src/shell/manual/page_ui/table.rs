//! Tables: columns as wide as their longest cell, narrower where there is no room.

use egui::{Align, Layout, Rect, Ui, pos2, vec2};

use super::spans;
use crate::base::texts::Texts;
use crate::base::theme;
use crate::shell::manual::markdown::{ManualLink, TextSpan};

/// Room at the sides of a cell, above and below it, points.
const SIDE: f32 = 8.0;
const ABOVE: f32 = 3.0;
/// No column is narrower, points.
const LEAST: f32 = 46.0;

/// Draws a table; returns the link that was followed.
pub(super) fn table_ui(ui: &mut Ui, rows: &[Vec<Vec<TextSpan>>], texts: &Texts) -> Option<ManualLink> {
    let palette = theme::palette(ui.visuals());
    let natural = natural_widths(ui, rows);
    let widths = fitted(&natural, ui.available_width());
    let whole: f32 = widths.iter().sum();
    let mut followed = None;
    for (place, row) in rows.iter().enumerate() {
        let background = ui.painter().add(egui::Shape::Noop);
        let corner = ui.cursor().min;
        let mut bottom = corner.y + spans::ROW + 2.0 * ABOVE;
        let mut left = corner.x;
        for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
            let top_left = pos2(left + SIDE, corner.y + ABOVE);
            let room = Rect::from_min_size(top_left, vec2(width - 2.0 * SIDE, f32::INFINITY));
            let builder = egui::UiBuilder::new().max_rect(room).layout(Layout::top_down(Align::Min));
            let drawn = ui.scope_builder(builder.id_salt((place, column)), |ui| {
                spans::spans_ui(ui, cell, spans::BODY, texts)
            });
            followed = drawn.inner.or(followed.take());
            bottom = bottom.max(drawn.response.rect.bottom() + ABOVE);
            left += width;
        }
        let rect = Rect::from_min_max(corner, pos2(corner.x + whole, bottom));
        let fill = match place {
            0 => palette.button,
            place if place % 2 == 0 => palette.bar,
            _ => palette.panel,
        };
        ui.painter().set(background, egui::Shape::rect_filled(rect, 0.0, fill));
        ui.advance_cursor_after_rect(rect);
    }
    followed
}

/// How wide each column would like to be.
fn natural_widths(ui: &Ui, rows: &[Vec<Vec<TextSpan>>]) -> Vec<f32> {
    let mut widths: Vec<f32> = Vec::new();
    for row in rows {
        for (column, cell) in row.iter().enumerate() {
            let width = (spans::width(ui, cell) + 2.0 * SIDE + 2.0).max(LEAST);
            match widths.get_mut(column) {
                Some(widest) => *widest = widest.max(width),
                None => widths.push(width),
            }
        }
    }
    widths
}

/// Widths that fit into `room`: wide columns give way first.
fn fitted(natural: &[f32], room: f32) -> Vec<f32> {
    let fits = |limit: f32| natural.iter().map(|width| width.min(limit)).sum::<f32>() <= room;
    let widest = natural.iter().copied().fold(LEAST, f32::max);
    if fits(widest) {
        return natural.to_vec();
    }
    let (mut low, mut high) = (LEAST, widest);
    for _ in 0..24 {
        let middle = 0.5 * (low + high);
        if fits(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    natural.iter().map(|width| width.min(low)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wide_columns_give_way_first() {
        assert_eq!(fitted(&[50.0, 80.0], 200.0), [50.0, 80.0]);
        let widths = fitted(&[50.0, 400.0, 300.0], 450.0);
        assert!(widths[0] == 50.0 && (widths[1] - 200.0).abs() < 0.1 && (widths[2] - 200.0).abs() < 0.1);
    }
}
