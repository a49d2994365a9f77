//! Numbers over the picture in words.

use super::gizmo::handle_drag::DragAmount;
use crate::base::texts::Texts;

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
    use crate::base::texts::Language;

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
