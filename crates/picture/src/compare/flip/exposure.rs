//! The exposures of HDR-ꟻLIP.

use crate::compare::too_little_memory;
use crate::picture::{Picture, SizeError};

/// The curve (c₀x² + c₁x + c₂) / (c₃x² + c₄x + c₅): Narkowicz's fit of ACES (2015), with light scaled by 0.6 first.
const CURVE: [f64; 6] = [0.6 * 0.6 * 2.51, 0.6 * 0.03, 0.0, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14];
/// What the curve makes of the brightest light at the first exposure, and of the median at the last.
const TARGET: f64 = 0.85;
/// The most exposures: more than from the brightest light of single precision down to its epsilon.
const MOST: usize = 160;

/// Light that can be compared: no number, or one below zero, is black.
#[expect(clippy::manual_clamp, reason = "NaN must become 0")]
fn sane(light: [f32; 3]) -> [f64; 3] {
    light.map(|value| f64::from(value.max(0.0).min(f32::MAX)))
}

/// Light at an exposure, in stops, under the tone curve, 0…1.
pub(super) fn toned(light: [f32; 3], exposure: f64) -> [f32; 3] {
    let [c0, c1, c2, c3, c4, c5] = CURVE;
    sane(light).map(|value| {
        let x = value * exposure.exp2();
        let toned = ((c0 * x + c1) * x + c2) / ((c3 * x + c4) * x + c5);
        toned.clamp(0.0, 1.0) as f32
    })
}

/// The exposures, in stops, at which a picture of this reference is compared; always at least two.
pub(super) fn exposures(reference: &Picture) -> Result<Vec<f64>, SizeError> {
    let mut luminances = Vec::new();
    luminances.try_reserve_exact(reference.pixels().len()).map_err(|_| too_little_memory(reference))?;
    luminances.extend(reference.pixels().iter().map(|&light| {
        let [red, green, blue] = sane(light);
        (0.212_671 * red + 0.715_16 * green + 0.072_169 * blue) as f32
    }));
    let middle = luminances.len() / 2;
    // Of an even number of pixels the upper of the two in the middle, as the authors' program.
    let (_, &mut median, above) = luminances.select_nth_unstable_by(middle, f32::total_cmp);
    let largest = above.iter().fold(median, |largest, &value| largest.max(value));
    let stops = |luminance: f32| (reached() / f64::from(luminance.max(f32::EPSILON))).log2();
    let (first, last) = (stops(largest), stops(median));
    let count = ((last - first).ceil() as usize).clamp(2, MOST);
    let step = (last - first) / (count - 1) as f64;
    Ok((0..count).map(|index| first + step * index as f64).collect())
}

/// The light that the curve carries to [`TARGET`]: the larger root of a quadratic equation.
fn reached() -> f64 {
    let [c0, c1, c2, c3, c4, c5] = CURVE;
    let (a, b, c) = (c0 - TARGET * c3, c1 - TARGET * c4, c2 - TARGET * c5);
    let middle = -0.5 * b / a;
    middle + (middle * middle - c / a).sqrt()
}
