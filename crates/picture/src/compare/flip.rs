//! ꟻLIP: how different two pictures look when one is flipped to the other.

mod color;
mod exposure;
mod feature;
mod spatial;

use rayon::prelude::*;

use super::difference::SizeMismatch;
use super::heat::{HeatMap, map_of};
use super::{CompareError, displayed, too_little_memory};
use crate::picture::{Picture, SizeError};

/// Pixels of a band, if the filters reach less far.
const BAND: usize = 1 << 18;
/// Bands that are compared at once, however many threads there are: each takes some 120 bytes for each of its pixels.
const BANDS_AT_ONCE: usize = 8;

/// The settings of a comparison by ꟻLIP.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flip {
    /// Pixels per degree of visual angle. Default 67.02: a display of 3840 pixels and 0.7 m across, seen from 0.7 m.
    /// Kept to 1…1000.
    pub pixels_per_degree: f64,
}

impl Default for Flip {
    fn default() -> Self {
        Self::seen_from(0.7, 3840.0, 0.7)
    }
}

/// The difference that an observer sees in each pixel, 0 (none) to 1.
#[derive(Clone, PartialEq)]
pub struct FlipMap {
    width: u32,
    height: u32,
    errors: Vec<f32>,
}

impl Flip {
    /// For a display of `pixels` pixels and `width` meters across, seen from `distance` meters.
    pub fn seen_from(distance: f64, pixels: f64, width: f64) -> Self {
        Self { pixels_per_degree: distance * pixels / width * std::f64::consts::PI / 180.0 }
    }

    /// LDR-ꟻLIP of a picture against its reference, as a display shows them without a tone curve: light clamped to
    /// 0…1 (NaN is black), not rounded to codes.
    ///
    /// Colors are filtered by the eye's contrast sensitivity at this distance and compared by the HyAB distance in
    /// L\*a\*b\*, with chroma after Hunt; edges and points weigh more. Borders repeat the outermost pixels. The
    /// constants are those of the authors' program, which agrees to four digits (see `tests/flip.rs`).
    ///
    /// Source: P. Andersson, J. Nilsson, T. Akenine-Möller, M. Oskarsson, K. Åström, M. D. Fairchild, "ꟻLIP: A
    /// difference evaluator for alternating images", Proc. ACM Comput. Graph. Interact. Tech. 3 (2), 2020.
    ///
    /// # Errors
    /// When the sizes differ or there is too little memory.
    pub fn compare(&self, reference: &Picture, test: &Picture) -> Result<FlipMap, CompareError> {
        SizeMismatch::check(reference, test)?;
        Ok(self.compare_shown(reference, test, displayed)?)
    }

    /// HDR-ꟻLIP: the largest error of each pixel over exposures from that which barely clips the brightest light of
    /// the reference to that which lights up its median, under the tone curve of ACES. For pictures with light beyond
    /// white; negative light and NaN count as black, infinite light as the largest of single precision.
    ///
    /// Source: P. Andersson, J. Nilsson, P. Shirley, T. Akenine-Möller, "Visualizing errors in rendered high dynamic
    /// range images", Eurographics 2021 (short papers), section 3.
    ///
    /// # Errors
    /// When the sizes differ or there is too little memory.
    pub fn compare_hdr(&self, reference: &Picture, test: &Picture) -> Result<FlipMap, CompareError> {
        SizeMismatch::check(reference, test)?;
        let mut worst: Option<FlipMap> = None;
        for exposure in exposure::exposures(reference)? {
            let map = self.compare_shown(reference, test, |light| exposure::toned(light, exposure))?;
            worst = Some(match worst {
                Some(worst) => worst.larger(&map),
                None => map,
            });
        }
        // There is always an exposure.
        worst.ok_or_else(|| too_little_memory(reference).into())
    }

    /// The error of each pixel, where `shown` makes of light what a display emits, 0…1.
    ///
    /// The picture is compared band by band, with as many rows around each as the filters reach, so that what is needed
    /// in between does not grow with the picture. Each error is the same as that of the whole.
    fn compare_shown(
        &self,
        reference: &Picture,
        test: &Picture,
        shown: impl Fn([f32; 3]) -> [f32; 3] + Sync,
    ) -> Result<FlipMap, SizeError> {
        #[expect(clippy::manual_clamp, reason = "NaN must become 1")]
        let density = self.pixels_per_degree.max(1.0).min(1000.0);
        let (width, height) = (reference.width() as usize, reference.height() as usize);
        let margin = spatial::radius(density).max(feature::radius(density));
        let rows = (BAND / width).max(2 * margin).min(height);
        let mut errors = bytemuck::allocation::try_zeroed_vec(width * height)
            .map_err(|()| too_little_memory(reference))?;
        let compare_band = |first: usize, errors: &mut [f32]| {
            let last = first + errors.len() / width;
            let around = first.saturating_sub(margin)..(last + margin).min(height);
            let opponent = |picture: &Picture| {
                let mut opponent = Picture::new(picture.width(), around.len() as u32)?;
                let light = picture.pixels().iter().skip(around.start * width);
                for (target, light) in opponent.pixels_mut().iter_mut().zip(light) {
                    *target = color::ycxcz_from_linear(shown(*light));
                }
                Ok::<_, SizeError>(opponent)
            };
            let (reference, test) = (opponent(reference)?, opponent(test)?);
            let color = spatial::color_difference(&reference, &test, density)?;
            let feature = feature::feature_difference(&reference, &test, density)?;
            let band = color.combine([&feature], |color, [feature]| color.powf(1.0 - feature)).into_values();
            let inner = band.iter().skip((first - around.start) * width);
            errors.iter_mut().zip(inner).for_each(|(target, error)| *target = *error);
            Ok(())
        };
        for (group, errors) in errors.chunks_mut(rows * width * BANDS_AT_ONCE).enumerate() {
            let bands = errors.par_chunks_mut(rows * width).enumerate();
            bands
                .try_for_each(|(band, errors)| compare_band((group * BANDS_AT_ONCE + band) * rows, errors))?;
        }
        Ok(FlipMap { width: reference.width(), height: reference.height(), errors })
    }
}

impl FlipMap {
    /// The mean over all pixels, 0…1: the number that is usually quoted.
    pub fn mean(&self) -> f64 {
        self.errors.iter().map(|&error| f64::from(error)).sum::<f64>() / self.errors.len() as f64
    }

    /// The error of each pixel, row by row from the top.
    pub fn errors(&self) -> &[f32] {
        &self.errors
    }

    /// The errors on the color scale of heat maps, from 0 to [`HeatMap::maximum`]; 1 is the usual one.
    ///
    /// # Errors
    /// When the map would be too large.
    pub fn heat_map(&self, options: &HeatMap) -> Result<Picture, SizeError> {
        let errors = self.errors.iter().map(|&error| Some(f64::from(error)));
        map_of(self.width, self.height, errors, options)
    }

    /// The larger of two errors in each pixel.
    fn larger(mut self, other: &Self) -> Self {
        for (error, other) in self.errors.iter_mut().zip(&other.errors) {
            *error = error.max(*other);
        }
        self
    }
}

/// Says the size and the mean, not the thousands of errors.
impl std::fmt::Debug for FlipMap {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "FlipMap({}x{}, mean {:.4})", self.width, self.height, self.mean())
    }
}
