//! From linear light to what a display shows.

use crate::picture::Picture;
use crate::quantize::{Table8, exact16};
use crate::tone::{self, ToneCurve};

/// How linear light becomes display codes: exposure, then tone curve, then sRGB.
///
/// A value `x` becomes ⌊maximum · encode(curve(x · 2^stops)) + ½⌋, with `encode` of [`crate::srgb`], the
/// maximum 255 or 65535; the exposed value and the curve's are rounded to single precision. NaN and negative values become 0, +∞ white.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Development {
    /// Exposure in stops: each doubles the light, negative ones halve it. Default 0.
    pub exposure_stops: f64,
    /// The tone curve. Default [`ToneCurve::None`].
    pub tone_curve: ToneCurve,
}

impl Development {
    /// Displayable linear light, 0…1, for one value of linear light: exposure and tone curve.
    pub fn tone(&self, x: f32) -> f32 {
        self.tone_curve.apply(x * self.scale())
    }

    /// The factor of the exposure.
    fn scale(&self) -> f32 {
        self.exposure_stops.exp2() as f32
    }

    /// Appends the 8-bit codes of these pixels.
    pub(crate) fn append8(&self, pixels: &[[f32; 3]], codes: &mut Vec<u8>) {
        let table = Table8::get();
        self.append(pixels, codes, |x| table.code(x));
    }

    /// Appends the 16-bit codes of these pixels.
    pub(crate) fn append16(&self, pixels: &[[f32; 3]], codes: &mut Vec<u16>) {
        self.append(pixels, codes, exact16);
    }

    /// The curve is chosen outside the loop over the pixels.
    fn append<T>(&self, pixels: &[[f32; 3]], codes: &mut Vec<T>, quantize: impl Fn(f32) -> T) {
        let scale = self.scale();
        let light = pixels.as_flattened().iter().map(|x| x * scale);
        match self.tone_curve {
            ToneCurve::None => codes.extend(light.map(|x| quantize(tone::clamp(x)))),
            ToneCurve::Reinhard => codes.extend(light.map(|x| quantize(tone::reinhard(x)))),
            ToneCurve::Filmic => codes.extend(light.map(|x| quantize(tone::filmic(x)))),
        }
    }
}

/// The picture as 8-bit sRGB: red, green, blue of every pixel, row by row from the top.
///
/// ```
/// use catoptric_picture::{Development, Picture, develop8};
/// let grey = Picture::from_fn(1, 1, |_, _| [0.5; 3])?;
/// assert_eq!(develop8(&grey, &Development::default()), [188; 3]);
/// # Ok::<(), catoptric_picture::SizeError>(())
/// ```
pub fn develop8(picture: &Picture, development: &Development) -> Vec<u8> {
    let mut codes = Vec::new();
    development.append8(picture.pixels(), &mut codes);
    codes
}

/// The picture as 16-bit sRGB: red, green, blue of every pixel, row by row from the top.
pub fn develop16(picture: &Picture, development: &Development) -> Vec<u16> {
    let mut codes = Vec::new();
    development.append16(picture.pixels(), &mut codes);
    codes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantize::exact8;

    const SPECIAL: [f32; 8] =
        [0.0, -0.0, -1.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN_POSITIVE];

    fn ramp() -> Picture {
        let value = |i: u32| SPECIAL.get(i as usize).copied().unwrap_or(i as f32 * 3.7e-4);
        Picture::from_fn(100, 30, |x, y| [0, 1, 2].map(|c| value((y * 100 + x) * 3 + c))).unwrap()
    }

    #[test]
    fn the_quick_way_gives_what_the_formula_gives() {
        let picture = ramp();
        for tone_curve in ToneCurve::ALL {
            for exposure_stops in [0.0, 1.0, -2.3, 5.5] {
                let development = Development { exposure_stops, tone_curve };
                let exact: Vec<u8> =
                    picture.pixels().as_flattened().iter().map(|&x| exact8(development.tone(x))).collect();
                assert_eq!(develop8(&picture, &development), exact, "{development:?}");
            }
        }
    }

    #[test]
    fn special_values_are_black_or_white() {
        let picture = ramp();
        let expected = [0, 0, 0, 0, 255, 0, 255, 0];
        assert_eq!(develop8(&picture, &Development::default())[..8], expected);
        let expected = expected.map(|code: u8| u16::from(code) * 257);
        assert_eq!(develop16(&picture, &Development::default())[..8], expected);
        for exposure_stops in [f64::NAN, f64::NEG_INFINITY, -1e9] {
            let development = Development { exposure_stops, ..Development::default() };
            assert!(develop8(&picture, &development)[8..].iter().all(|&code| code == 0));
        }
    }

    #[test]
    fn a_stop_doubles_the_light() {
        let picture = Picture::from_fn(50, 1, |x, _| [x as f32 / 100.0; 3]).unwrap();
        let doubled = Picture::from_fn(50, 1, |x, _| [2.0 * (x as f32 / 100.0); 3]).unwrap();
        let stop = Development { exposure_stops: 1.0, ..Development::default() };
        assert_eq!(develop16(&picture, &stop), develop16(&doubled, &Development::default()));
    }
}
