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
