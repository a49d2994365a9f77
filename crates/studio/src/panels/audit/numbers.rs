//! Numbers as the audit writes them: four digits that count.

use glam::{DVec3, Vec3};

use crate::base::texts::Texts;
use crate::base::widgets::number::{list, shown};

/// A number with four digits that count.
pub(crate) fn short(texts: &Texts, value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".to_owned() } else { format!("{value}") };
    }
    let before = value.abs().log10().floor() as i32;
    shown(texts, value, usize::try_from(3 - before).unwrap_or(0).min(7))
}

/// Three channels: one number if they are alike.
pub(crate) fn color_text(texts: &Texts, color: DVec3) -> String {
    let [r, g, b] = color.to_array().map(|part| short(texts, part));
    if r == g && g == b { r } else { format!("({r}  {g}  {b})") }
}

/// Writes three single-precision channels: one number if they are equal.
pub(super) fn color(texts: &Texts, color: Vec3) -> String {
    color_text(texts, color.as_dvec3())
}

/// A point or a direction. What is small beside the others is nothing.
pub(super) fn vector(texts: &Texts, vector: impl Into<DVec3>) -> String {
    let vector = vector.into();
    let least = 1e-5 * vector.abs().max_element();
    let parts = vector.to_array().map(|part| if part.abs() < least { 0.0 } else { part });
    format!("({})", list(texts, parts.map(|part| short(texts, part))))
}

/// Radians as degrees, to a hundredth.
pub(super) fn degrees(texts: &Texts, radians: f64) -> String {
    texts.localized(format!("{:.2}°", radians.to_degrees()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::texts::Language;

    #[test]
    fn digits_are_those_that_count() {
        let texts = Texts::new(Language::English);
        let numbers = [0.0, 1.0, 0.123_456, 12.345_678, -0.5].map(|value| short(&texts, value));
        assert_eq!(numbers, ["0", "1", "0.1235", "12.35", "−0.5"]);
        assert_eq!(short(&texts, 1234.56), "1235");
        assert_eq!(color(&texts, Vec3::ONE), "1");
        assert_eq!(color(&texts, Vec3::new(1.0, 0.5, 0.25)), "(1  0.5  0.25)");
        assert_eq!(vector(&texts, Vec3::new(1.0, 1e-9, -2.0)), "(1, 0, −2)");
        assert_eq!(degrees(&texts, std::f64::consts::FRAC_PI_4), "45.00°");
        let texts = Texts::new(Language::Russian);
        assert_eq!(vector(&texts, Vec3::new(1.5, 1e-9, -2.0)), "(1,5; 0; −2)");
        assert_eq!(degrees(&texts, std::f64::consts::FRAC_PI_4), "45,00°");
    }
}
