//! Numbers as people read them.

use std::fmt::Write as _;

use glam::{DVec3, Vec3};

/// The shortest digits that name this single-precision number and no other.
pub(super) fn exact(number: f32) -> String {
    let size = number.abs();
    if size != 0.0 && !(1e-4..1e7).contains(&size) { format!("{number:e}") } else { format!("{number}") }
}

/// Writes three channels in their shortest digits: one number if they are equal.
pub(super) fn exact_color(color: Vec3) -> String {
    let [r, g, b] = color.to_array().map(exact);
    if r == g && g == b { r } else { format!("({r} {g} {b})") }
}

/// The shortest digits that name a double-precision number and no other.
pub(super) fn exact_double(number: f64) -> String {
    let size = number.abs();
    if size != 0.0 && !(1e-4..1e7).contains(&size) { format!("{number:e}") } else { format!("{number}") }
}

/// Four significant digits.
pub(super) fn short(number: f64) -> String {
    if number == 0.0 || !number.is_finite() {
        return format!("{number}");
    }
    let size = number.abs();
    if !(1e-4..1e7).contains(&size) {
        return format!("{number:.3e}");
    }
    let before = size.log10().floor() as i32;
    let places = usize::try_from(3 - before).unwrap_or(0);
    let digits = format!("{number:.places$}");
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.').to_owned() } else { digits }
}

/// A point or direction with four significant digits.
pub(super) fn short_vector(vector: impl Into<DVec3>) -> String {
    let vector = vector.into();
    let mut text = String::from("(");
    for (index, part) in vector.to_array().into_iter().enumerate() {
        // What is small beside the others is nothing.
        let part = if part.abs() < 1e-5 * vector.abs().max_element() { 0.0 } else { part };
        let _ = write!(text, "{}{}", if index == 0 { "" } else { ", " }, short(part));
    }
    text + ")"
}

/// Three channels with four significant digits: one number if they are alike.
pub(super) fn short_color(color: DVec3) -> String {
    let [r, g, b] = color.to_array().map(short);
    if r == g && g == b { r } else { format!("({r} {g} {b})") }
}

/// Radians in degrees, to a hundredth.
pub(super) fn degrees(radians: f64) -> String {
    format!("{:.2}°", radians.to_degrees())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_those_that_matter() {
        assert_eq!(
            [0.0, 1.0, 0.1, 12.345_678, 1234.5, -0.001_234_56].map(short)[..],
            ["0", "1", "0.1", "12.35", "1234", "-0.001235"]
        );
        assert_eq!([short(1.5e-7), short(3e9)], ["1.500e-7", "3.000e9"]);
        assert_eq!([0.1, 1e-7, 0.0, 123_456.7].map(exact)[..], ["0.1", "1e-7", "0", "123456.7"]);
        assert_eq!(exact_color(Vec3::new(1.0, 0.5, 0.25)), "(1 0.5 0.25)");
        assert_eq!(short_vector(Vec3::new(1.0, 1e-9, -2.0)), "(1, 0, -2)");
    }
}
