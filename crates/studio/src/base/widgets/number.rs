//! Numbers: as text, and as fields that are dragged or typed.

use crate::base::texts::{DecimalSign, Texts};

mod expression;
mod field;

pub(crate) use expression::evaluate;
pub(crate) use field::{NumberField, NumberResponse, Refusal, limits_in_words};

/// What stands for a number that several things do not share.
pub(crate) const MIXED: &str = "—";

/// Height of a field, points.
pub(crate) const HEIGHT: f32 = 22.0;

/// The unit of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unit {
    None,
    Meters,
    Degrees,
    Pixels,
    Stops,
}

impl Unit {
    /// The unit as it is written after a number, with a space where one belongs.
    pub(crate) fn suffix(self, texts: &Texts) -> &str {
        match self {
            Self::None => "",
            Self::Meters => texts.get("unit-meters"),
            Self::Degrees => "°",
            Self::Pixels => texts.get("unit-pixels"),
            Self::Stops => texts.get("unit-stops"),
        }
    }
}

/// A number for people, with at most so many decimals and no zeros at the end. Very small and very large ones have an
/// exponent.
pub(crate) fn shown(texts: &Texts, value: f64, decimals: usize) -> String {
    texts.localized(shown_plain(value, decimals))
}

fn shown_plain(value: f64, decimals: usize) -> String {
    let magnitude = value.abs();
    let least = 0.5 * 10f64.powi(-i32::try_from(decimals).unwrap_or(0));
    if magnitude == 0.0 {
        return "0".to_owned();
    }
    let text = if magnitude < least || magnitude >= 1e7 {
        let text = format!("{value:.2e}");
        match text.split_once('e') {
            Some((mantissa, exponent)) => format!("{}e{exponent}", trimmed(mantissa)),
            None => text,
        }
    } else {
        trimmed(&format!("{value:.decimals$}")).to_owned()
    };
    text.replace('-', "−")
}

/// The number with the most decimals that fit into a number of letters.
fn fitting(texts: &Texts, value: f64, decimals: usize, letters: usize) -> String {
    let mut text = shown(texts, value, decimals);
    for fewer in (0..decimals).rev() {
        if text.chars().count() <= letters || text.contains('e') {
            break;
        }
        text = shown(texts, value, fewer);
    }
    text
}

/// A number in full, free of the noise of binary arithmetic.
pub(crate) fn exact(texts: &Texts, value: f64) -> String {
    texts.localized(exact_plain(value))
}

fn exact_plain(value: f64) -> String {
    let value = tidy(value);
    let magnitude = value.abs();
    let text = if magnitude != 0.0 && !(1e-6..1e9).contains(&magnitude) {
        format!("{value:e}")
    } else {
        format!("{value}")
    };
    text.replace('-', "−")
}

/// The nearest number with twelve digits: what was meant by `0.30000000000000004`.
pub(crate) fn tidy(value: f64) -> f64 {
    let near: f64 = format!("{value:.11e}").parse().unwrap_or(value);
    if near == 0.0 { 0.0 } else { near }
}

fn trimmed(text: &str) -> &str {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { text }
}

/// Numbers side by side, with what separates them in a language.
pub(crate) fn list(texts: &Texts, numbers: impl IntoIterator<Item = String>) -> String {
    let separator = match texts.language().decimal_sign() {
        DecimalSign::Point => ", ",
        DecimalSign::Comma => "; ",
    };
    numbers.into_iter().collect::<Vec<_>>().join(separator)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::texts::Language;

    #[test]
    fn numbers_are_short_and_without_noise() {
        let texts = Texts::new(Language::English);
        let short = |value, decimals| shown(&texts, value, decimals);
        assert_eq!(short(0.1 + 0.2, 3), "0.3");
        assert_eq!(short(-1.75, 3), "−1.75");
        assert_eq!(short(27.0, 2), "27");
        assert_eq!(short(-0.0, 2), "0");
        assert_eq!(short(1e-9, 3), "1e−9");
        assert_eq!(short(2.5e9, 3), "2.5e9");
        assert_eq!(short(100.0, 0), "100");
        assert_eq!(exact(&texts, 0.1 + 0.2), "0.3");
        assert_eq!(exact(&texts, 1.0 / 3.0), "0.333333333333");
        assert_eq!(fitting(&texts, -123.456, 3, 6), "−123.5");
        assert_eq!(tidy(0.1 + 0.2), 0.3);
    }

    #[test]
    fn each_language_has_its_decimal_sign() {
        let texts = Texts::new(Language::Russian);
        assert_eq!(shown(&texts, -1.75, 3), "−1,75");
        assert_eq!(shown(&texts, 2.5e-9, 3), "2,5e−9");
        assert_eq!(exact(&texts, 1e-7), "1e−7");
        assert_eq!(fitting(&texts, -123.456, 3, 6), "−123,5");
        assert_eq!(list(&texts, [0.5, 1.0].map(|part| shown(&texts, part, 2))), "0,5; 1");
        let english = Texts::new(Language::English);
        assert_eq!(list(&english, [0.5, 1.0].map(|part| shown(&english, part, 2))), "0.5, 1");
    }
}
