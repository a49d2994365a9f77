//! Numbers as the audit writes them: four digits that count.

use glam::{DVec3, Vec3};

use crate::widgets::number::shown;

/// A number with four digits that count.
pub(crate) fn short(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".to_owned() } else { format!("{value}") };
    }
    let before = value.abs().log10().floor() as i32;
    shown(value, usize::try_from(3 - before).unwrap_or(0).min(7))
}

/// Three channels: one number if they are alike.
pub(crate) fn color_text(color: DVec3) -> String {
    let [r, g, b] = color.to_array().map(short);
    if r == g && g == b { r } else { format!("({r}  {g}  {b})") }
}

/// The same of single-precision numbers.
pub(super) fn color(color: Vec3) -> String {
    color_text(color.as_dvec3())
}

/// A point or a direction. What is small beside the others is nothing.
pub(super) fn vector(vector: Vec3) -> String {
    let least = 1e-5 * vector.abs().max_element();
    let [x, y, z] =
        vector.to_array().map(|part| if part.abs() < least { 0.0 } else { f64::from(part) }).map(short);
    format!("({x}, {y}, {z})")
}

/// Radians as degrees, to a hundredth.
pub(super) fn degrees(radians: f64) -> String {
    format!("{:.2}°", radians.to_degrees())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_those_that_count() {
        assert_eq!([0.0, 1.0, 0.123_456, 12.345_678, -0.5].map(short), ["0", "1", "0.1235", "12.35", "−0.5"]);
        assert_eq!(short(1234.56), "1235");
        assert_eq!(color(Vec3::ONE), "1");
        assert_eq!(color(Vec3::new(1.0, 0.5, 0.25)), "(1  0.5  0.25)");
        assert_eq!(vector(Vec3::new(1.0, 1e-9, -2.0)), "(1, 0, −2)");
        assert_eq!(degrees(std::f64::consts::FRAC_PI_4), "45.00°");
    }
}
