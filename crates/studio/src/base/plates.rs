//! Short texts on little plates, over a picture.

use egui::text::LayoutJob;
use egui::{Align, Align2, FontId, Painter, Pos2, Rect, Stroke, StrokeKind, vec2};

use crate::base::theme::ThemeColors;

/// Draws a text on a little plate beside the pointer, inside `rect`.
pub(crate) fn beside_pointer(
    painter: &Painter,
    rect: Rect,
    pointer: Pos2,
    text: &str,
    palette: &ThemeColors,
) {
    plate(painter, rect, pointer + vec2(16.0, 18.0), Align2::LEFT_TOP, text, palette);
}

/// Draws a text on a little plate, moved as far as it must be to lie inside `rect`.
pub(crate) fn plate(
    painter: &Painter,
    rect: Rect,
    pos: Pos2,
    align: Align2,
    text: &str,
    palette: &ThemeColors,
) -> Rect {
    let room = rect.shrink(6.0);
    let mut job = LayoutJob::simple(
        text.to_owned(),
        FontId::proportional(12.5),
        palette.text,
        (room.width() - 14.0).max(40.0),
    );
    job.halign = Align::Center;
    let galley = painter.layout_job(job);
    let plate = align.anchor_size(pos, galley.size() + vec2(14.0, 7.0));
    let plate = plate.translate(vec2(
        (room.right() - plate.right()).min(0.0) + (room.left() - plate.left()).max(0.0),
        (room.bottom() - plate.bottom()).min(0.0) + (room.top() - plate.top()).max(0.0),
    ));
    let stroke = Stroke::new(1.0, palette.line);
    painter.rect(plate, 5.0, palette.panel.gamma_multiply(0.92), stroke, StrokeKind::Inside);
    // Centered text is laid out about its origin.
    painter.galley(plate.center_top() + vec2(0.0, 3.5), galley, palette.text);
    plate
}
