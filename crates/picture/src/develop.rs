//! Development: from linear light to display codes.

use crate::picture::{Picture, SizeError};
use crate::quantize::{Table8, exact16};
use crate::tone::{self, ToneCurve};

/// The development of linear light to display codes: exposure, then tone curve, then sRGB.
///
/// A value `x` becomes ⌊maximum · encode(curve(x · 2^stops)) + ½⌋, with `encode` of [`crate::srgb`], the
/// maximum 255 or 65535; the exposed value and the curve's are rounded to single precision. NaN and negative values
/// become 0, +∞ white.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Development {
    /// Exposure in stops: each doubles the light, negative ones halve it. Default 0.
    pub exposure_stops: f64,
    /// The tone curve. Default [`ToneCurve::None`].
    pub tone_curve: ToneCurve,
}

impl Development {
    /// The shader by which a graphics card develops, in WGSL: the twin of [`Self::develop_rgba8`] but for rounding. Its
    /// uniform is [`Self::words`] and then width and height.
    pub const SHADER: &str = include_str!("develop.wgsl");

    /// The first two words of the shader's uniform: the factor of the exposure, and the tone curve.
    pub fn words(&self) -> [u32; 2] {
        let curve = match self.tone_curve {
            ToneCurve::None => 0,
            ToneCurve::Reinhard => 1,
            ToneCurve::Filmic => 2,
            ToneCurve::LinearCodes => 3,
        };
        let scale = self.scale();
        [if scale.is_finite() { scale } else { 0.0 }.to_bits(), curve]
    }

    /// Displayable linear light, 0…1, for one value of linear light: exposure and tone curve.
    pub fn tone(&self, x: f32) -> f32 {
        self.tone_curve.apply(x * self.scale())
    }

    /// The factor of the exposure.
    fn scale(&self) -> f32 {
        self.exposure_stops.exp2() as f32
    }

    /// Develops a picture into display codes.
    ///
    /// ```
    /// use catoptric_picture::{BitDepth, Codes, Development, Picture};
    /// let gray = Picture::from_fn(1, 1, |_, _| [0.5; 3])?;
    /// let developed = Development::default().develop(&gray, BitDepth::Eight)?;
    /// assert_eq!(developed.codes(), &Codes::Eight(vec![188; 3]));
    /// # Ok::<(), catoptric_picture::SizeError>(())
    /// ```
    ///
    /// # Errors
    /// When there is too little memory.
    pub fn develop(&self, picture: &Picture, depth: BitDepth) -> Result<Developed, SizeError> {
        let codes = match depth {
            BitDepth::Eight => {
                let table = Table8::get();
                Codes::Eight(self.codes(picture, |x| table.code(x))?)
            }
            BitDepth::Sixteen => Codes::Sixteen(self.codes(picture, exact16)?),
        };
        Ok(Developed { width: picture.width(), height: picture.height(), codes })
    }

    /// Develops a run of pixels for a texture: red, green, blue as by [`Self::develop`] with 8 bits, and 255. What is
    /// longer of the two is left as it is. Threads can develop a picture in pieces.
    pub fn develop_rgba8(&self, light: &[[f32; 3]], rgba: &mut [[u8; 4]]) {
        let table = Table8::get();
        let scale = self.scale();
        match self.tone_curve {
            ToneCurve::None => fill_rgba(light, rgba, |x| table.code(tone::clamp(x * scale))),
            ToneCurve::Reinhard => fill_rgba(light, rgba, |x| table.code(tone::reinhard(x * scale))),
            ToneCurve::Filmic => fill_rgba(light, rgba, |x| table.code(tone::filmic(x * scale))),
            ToneCurve::LinearCodes => {
                fill_rgba(light, rgba, |x| table.code(tone::linear_codes(x * scale)));
            }
        }
    }

    /// The curve is chosen outside the loop over the pixels.
    fn codes<T>(&self, picture: &Picture, quantize: impl Fn(f32) -> T) -> Result<Vec<T>, SizeError> {
        let values = picture.pixels().as_flattened();
        let mut codes = Vec::new();
        codes.try_reserve_exact(values.len()).map_err(|_| SizeError::Memory {
            width: picture.width(),
            height: picture.height(),
            bytes: size_of_val(values) as u64 / size_of::<f32>() as u64 * size_of::<T>() as u64,
        })?;
        let scale = self.scale();
        let light = values.iter().map(|x| x * scale);
        match self.tone_curve {
            ToneCurve::None => codes.extend(light.map(|x| quantize(tone::clamp(x)))),
            ToneCurve::Reinhard => codes.extend(light.map(|x| quantize(tone::reinhard(x)))),
            ToneCurve::Filmic => codes.extend(light.map(|x| quantize(tone::filmic(x)))),
            ToneCurve::LinearCodes => codes.extend(light.map(|x| quantize(tone::linear_codes(x)))),
        }
        Ok(codes)
    }
}

fn fill_rgba(light: &[[f32; 3]], rgba: &mut [[u8; 4]], code: impl Fn(f32) -> u8) {
    for (light, codes) in light.iter().zip(rgba) {
        let [red, green, blue] = light.map(&code);
        *codes = [red, green, blue, 255];
    }
}

/// Bits per channel of a developed picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum BitDepth {
    /// 256 codes per channel; what displays show. The default.
    #[default]
    Eight,
    /// 65536 codes per channel; for further processing.
    Sixteen,
}

/// A picture as a display shows it: sRGB codes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Developed {
    width: u32,
    height: u32,
    codes: Codes,
}

/// Red, green, blue of every pixel, row by row from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Codes {
    /// 0 to 255.
    Eight(Vec<u8>),
    /// 0 to 65535.
    Sixteen(Vec<u16>),
}

impl Developed {
    /// Pixels across.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Pixels down.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The codes.
    pub fn codes(&self) -> &Codes {
        &self.codes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantize::exact8;

    const SPECIAL: [f32; 8] =
        [0.0, -0.0, -1.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, f32::MIN_POSITIVE];

    fn develop8(picture: &Picture, development: &Development) -> Vec<u8> {
        match development.develop(picture, BitDepth::Eight).unwrap().codes {
            Codes::Eight(codes) => codes,
            Codes::Sixteen(_) => panic!("asked for 8 bits"),
        }
    }

    fn develop16(picture: &Picture, development: &Development) -> Vec<u16> {
        match development.develop(picture, BitDepth::Sixteen).unwrap().codes {
            Codes::Sixteen(codes) => codes,
            Codes::Eight(_) => panic!("asked for 16 bits"),
        }
    }

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
                let mut rgba = vec![[0; 4]; picture.pixels().len()];
                development.develop_rgba8(picture.pixels(), &mut rgba);
                assert!(
                    rgba.iter()
                        .zip(exact.chunks(3))
                        .all(|(codes, exact)| { codes.starts_with(exact) && codes[3] == 255 })
                );
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
    fn linear_codes_are_in_proportion_to_the_light() {
        let picture = Picture::from_fn(256, 1, |x, _| [x as f32 / 255.0; 3]).unwrap();
        let development = Development { tone_curve: ToneCurve::LinearCodes, ..Development::default() };
        let expected: Vec<u8> = (0..=255).flat_map(|code| [code; 3]).collect();
        assert_eq!(develop8(&picture, &development), expected);
    }

    #[test]
    fn a_stop_doubles_the_light() {
        let picture = Picture::from_fn(50, 1, |x, _| [x as f32 / 100.0; 3]).unwrap();
        let doubled = Picture::from_fn(50, 1, |x, _| [2.0 * (x as f32 / 100.0); 3]).unwrap();
        let stop = Development { exposure_stops: 1.0, ..Development::default() };
        assert_eq!(develop16(&picture, &stop), develop16(&doubled, &Development::default()));
    }
}
