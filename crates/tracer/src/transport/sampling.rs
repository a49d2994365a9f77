//! Where the samples of a pixel lie.

use glam::DVec2;

use crate::simd::Width;

/// The places of a pixel's samples in the unit square, the same in every pixel: the additive recurrence R₂
/// (Roberts 2018, The unreasonable effectiveness of quasirandom sequences).
///
/// Any number of first samples is spread evenly, so a picture can be refined sample by sample; the first is the
/// pixel's center.
pub fn sample_offset(index: u32) -> DVec2 {
    // 1/φ₂ and 1/φ₂², with φ₂ the plastic number, the real root of x³ = x + 1.
    const STEP: DVec2 = DVec2::new(0.754_877_666_246_692_8, 0.569_840_290_998_053_3);
    (DVec2::splat(0.5) + f64::from(index) * STEP).fract()
}

/// Numbers for rays side by side.
#[derive(Clone, Copy)]
pub(crate) struct Sample2D<W: Width> {
    /// Cosine and sine of an angle that is anything.
    pub(crate) cos: W::R,
    pub(crate) sin: W::R,
    /// From 0 to below 1, independent of the angle.
    pub(crate) second: W::R,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_sample_is_the_center() {
        assert_eq!(sample_offset(0), DVec2::splat(0.5));
    }

    /// The share of samples in any axis-aligned box at the corner differs little from its area.
    #[test]
    fn samples_are_spread_evenly() {
        for count in [4_u32, 9, 16, 64, 256] {
            let samples: Vec<DVec2> = (0..count).map(sample_offset).collect();
            let mut worst: f64 = 0.0;
            for corner in &samples {
                let inside = samples.iter().filter(|s| s.x < corner.x && s.y < corner.y).count();
                worst = worst.max((inside as f64 / f64::from(count) - corner.x * corner.y).abs());
            }
            let bound = 1.2 * f64::from(count).ln() / f64::from(count);
            assert!(worst < bound, "{count} samples: discrepancy {worst:.3}, bound {bound:.3}");
        }
    }
}
