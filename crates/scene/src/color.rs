//! Linear RGB.

/// A color or an amount of light: linear RGB with the sRGB primaries, not limited to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Color {
    /// Red.
    pub r: f64,
    /// Green.
    pub g: f64,
    /// Blue.
    pub b: f64,
}

impl Color {
    /// (0, 0, 0).
    pub const BLACK: Self = Self::gray(0.0);
    /// (1, 1, 1).
    pub const WHITE: Self = Self::gray(1.0);

    /// From three linear components.
    pub const fn new(r: f64, g: f64, b: f64) -> Self {
        Self { r, g, b }
    }

    /// Three equal components.
    pub const fn gray(value: f64) -> Self {
        Self::new(value, value, value)
    }

    /// From 8-bit sRGB, decoded to linear light (IEC 61966-2-1:1999).
    pub fn from_srgb8(rgb: [u8; 3]) -> Self {
        let [r, g, b] = rgb.map(|component| linear_from_srgb(f64::from(component) / 255.0));
        Self { r, g, b }
    }

    /// Encodes the color as 8-bit sRGB, clamped to 0..1 and rounded to the nearest code; NaN counts as 0. The inverse
    /// of [`Self::from_srgb8`] on its values.
    pub fn to_srgb8(self) -> [u8; 3] {
        // A float to an integer saturates, and takes NaN to 0.
        self.to_array().map(|component| (srgb_from_linear(component.clamp(0.0, 1.0)) * 255.0).round() as u8)
    }

    /// The three components in order.
    pub const fn to_array(self) -> [f64; 3] {
        [self.r, self.g, self.b]
    }
}

impl From<[f64; 3]> for Color {
    fn from([r, g, b]: [f64; 3]) -> Self {
        Self { r, g, b }
    }
}

/// sRGB electro-optical transfer function (IEC 61966-2-1:1999), 0..1 to 0..1.
fn linear_from_srgb(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// The inverse of [`linear_from_srgb`], 0..1 to 0..1.
fn srgb_from_linear(linear: f64) -> f64 {
    if linear <= 0.04045 / 12.92 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_comes_back() {
        for code in 0..=255 {
            assert_eq!(Color::from_srgb8([code; 3]).to_srgb8(), [code; 3]);
        }
        assert_eq!(Color::new(7.0, -1.0, f64::NAN).to_srgb8(), [255, 0, 0]);
    }
}
