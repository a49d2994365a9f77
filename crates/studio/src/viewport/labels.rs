//! Short texts over the picture.

use egui::text::LayoutJob;
use egui::{Align, Align2, FontId, Painter, Pos2, Rect, Stroke, StrokeKind, vec2};

use super::gizmo::handle_drag::DragAmount;
use crate::texts::Texts;
use crate::theme::ThemeColors;

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

/// How much was changed.
pub(crate) fn amount_text(texts: &Texts, amount: DragAmount, grain: f64) -> String {
    match amount {
        DragAmount::Meters(parts) => {
            let parts: Vec<String> = ["X", "Y", "Z"]
                .iter()
                .zip(parts)
                .filter_map(|(axis, part)| {
                    part.map(|part| format!("{axis} {}", texts.localized(signed(part, grain))))
                })
                .collect();
            // Figure spaces, so that the numbers stand apart.
            texts.with("viewport-amount-meters", &[("parts", parts.join("\u{2002}").into())])
        }
        DragAmount::Degrees(degrees) => {
            let degrees = texts.localized(minus(&format!("{degrees:.1}")));
            texts.with("viewport-amount-degrees", &[("degrees", degrees.into())])
        }
        DragAmount::Factor(factor) => texts
            .with("viewport-amount-factor", &[("factor", texts.localized(format!("{factor:.2}")).into())]),
    }
}

/// Stops with their sign.
pub(crate) fn signed_stops(texts: &Texts, stops: f64) -> String {
    let text = minus(&format!("{stops:+.2}"));
    texts.localized(text.trim_end_matches('0').trim_end_matches('.').to_owned())
}

/// A number with its sign and the digits that suit the precision of the pointer.
fn signed(value: f64, grain: f64) -> String {
    let digits = (-super::gizmo::steps::decimal_below(grain).log10()).clamp(1.0, 5.0) as usize;
    minus(&format!("{value:+.digits$}"))
}

/// With a true minus sign, and none before zero.
fn minus(number: &str) -> String {
    let is_zero = number.chars().all(|letter| !letter.is_ascii_digit() || letter == '0');
    if is_zero { number.replace('-', "+") } else { number.replace('-', "\u{2212}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texts::Language;

    #[test]
    fn amounts_read_well() {
        let texts = Texts::new(Language::English);
        let text = |amount| amount_text(&texts, amount, 0.03);
        assert_eq!(
            text(DragAmount::Meters([Some(0.35), None, Some(-1.2)])),
            "X +0.35\u{2002}Z \u{2212}1.20 m"
        );
        assert_eq!(text(DragAmount::Meters([None, Some(-0.001), None])), "Y +0.00 m");
        assert_eq!(text(DragAmount::Degrees(-15.0)), "\u{2212}15.0°");
        assert_eq!(text(DragAmount::Factor(1.2)), "×1.20");
        let texts = Texts::new(Language::Russian);
        assert_eq!(amount_text(&texts, DragAmount::Degrees(-15.0), 0.03), "\u{2212}15,0°");
    }
}
