//! Tone curves: how light brighter than the display's white is fitted in.

use std::fmt;
use std::str::FromStr;

use crate::srgb;

/// A curve from exposed linear light to displayable linear light, each channel by itself.
///
/// Every curve is monotonic, maps 0, negative values and NaN to 0, and ends within 0…1.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum ToneCurve {
    /// Clamp to 0…1: what is below white is shown exactly. The default.
    #[default]
    None,
    /// x / (1 + x), which never quite reaches white.
    /// Source: E. Reinhard, M. Stark, P. Shirley, J. Ferwerda, "Photographic Tone Reproduction for
    /// Digital Images", SIGGRAPH 2002, equation 3, taken per channel instead of on luminance.
    Reinhard,
    /// x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14), then clamped: a toe, and a soft shoulder.
    /// Source: K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016, without his optional factor 0.6.
    Filmic,
    /// Clamp to 0…1, then undo the sRGB function, so that codes are in proportion to the light: so write programs that
    /// know no such function.
    LinearCodes,
}

/// There is no tone curve of this name.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("there is no tone curve \"{name}\"; choose one of: {}", ToneCurve::ALL.map(ToneCurve::name).join(", "))]
pub struct UnknownToneCurve {
    /// The name that was asked for.
    pub name: String,
}

impl ToneCurve {
    /// All curves, in the order in which to offer them.
    pub const ALL: [ToneCurve; 4] =
        [ToneCurve::None, ToneCurve::Reinhard, ToneCurve::Filmic, ToneCurve::LinearCodes];

    /// The name in files and on the command line: `none`, `reinhard`, `filmic` or `linear-codes`.
    pub fn name(self) -> &'static str {
        match self {
            ToneCurve::None => "none",
            ToneCurve::Reinhard => "reinhard",
            ToneCurve::Filmic => "filmic",
            ToneCurve::LinearCodes => "linear-codes",
        }
    }

    /// The curve's value, within 0…1. NaN gives 0, +∞ gives 1.
    pub fn apply(self, x: f32) -> f32 {
        match self {
            ToneCurve::None => clamp(x),
            ToneCurve::Reinhard => reinhard(x),
            ToneCurve::Filmic => filmic(x),
            ToneCurve::LinearCodes => linear_codes(x),
        }
    }
}

impl fmt::Display for ToneCurve {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for ToneCurve {
    type Err = UnknownToneCurve;

    fn from_str(name: &str) -> Result<ToneCurve, UnknownToneCurve> {
        let known = ToneCurve::ALL.into_iter().find(|curve| curve.name() == name);
        known.ok_or_else(|| UnknownToneCurve { name: name.to_owned() })
    }
}

/// Into 0…1; NaN becomes 0, and so does -0, of which `max` could make either: codes are looked up by the bits.
#[inline]
pub(crate) fn clamp(x: f32) -> f32 {
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}

/// Infinity is taken as the largest number, so that ∞ / ∞ does not arise. In double precision, since
/// rounding in 1 + x would let the curve step back now and then.
#[inline]
pub(crate) fn reinhard(x: f32) -> f32 {
    let x = f64::from(if x > 0.0 { x.min(f32::MAX) } else { 0.0 });
    (x / (1.0 + x)) as f32
}

/// The fit passes 1 near x = 7; from 100 on the clamped value is 1 anyway.
#[expect(clippy::manual_clamp, reason = "NaN must become 0")]
#[inline]
pub(crate) fn filmic(x: f32) -> f32 {
    let x = f64::from(x.max(0.0).min(100.0));
    clamp(((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14)) as f32)
}

/// The light whose sRGB code is in proportion to x.
#[inline]
pub(crate) fn linear_codes(x: f32) -> f32 {
    clamp(srgb::decode(f64::from(clamp(x))) as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_round_trip_and_unknown_ones_list_the_choice() {
        for curve in ToneCurve::ALL {
            assert_eq!(curve.to_string().parse(), Ok(curve));
        }
        let error = "sepia".parse::<ToneCurve>().unwrap_err().to_string();
        assert!(error.contains("sepia") && error.contains("none, reinhard, filmic, linear-codes"), "{error}");
        assert_eq!(ToneCurve::default(), ToneCurve::None);
    }

    #[test]
    fn every_curve_is_monotonic_and_total() {
        for curve in ToneCurve::ALL {
            let values: Vec<f32> = (0..4000).map(|i| curve.apply(1.01_f32.powi(i - 2000))).collect();
            assert!(values.windows(2).all(|pair| pair[0] <= pair[1]), "{curve}");
            assert!(values.iter().all(|v| (0.0..=1.0).contains(v)), "{curve}");
            for x in [0.0, -0.0, -3.0, f32::NEG_INFINITY, f32::NAN] {
                assert_eq!(curve.apply(x), 0.0, "{curve} of {x}");
            }
            assert_eq!(curve.apply(f32::INFINITY), 1.0, "{curve}");
            assert_eq!(curve.apply(f32::MAX), 1.0, "{curve}");
        }
    }

    #[test]
    fn known_values() {
        assert_eq!(ToneCurve::None.apply(0.25), 0.25);
        assert_eq!(ToneCurve::Reinhard.apply(1.0), 0.5);
        assert_eq!(ToneCurve::Reinhard.apply(3.0), 0.75);
        assert!((f64::from(ToneCurve::LinearCodes.apply(0.5)) - 0.214_041_140_482_232_55).abs() < 1e-7);
        assert!((ToneCurve::Filmic.apply(1.0) - 2.54 / 3.16).abs() < 1e-6);
    }
}
