//! The feature pipeline of ꟻLIP: edges and points that are in one picture only (section 4.2).

use crate::compare::plane::{Plane, kernel, normalized};
use crate::compare::too_little_memory;
use crate::picture::{Picture, SizeError};

/// Width of the features that the eye looks for, degrees.
const WIDTH: f64 = 0.082;
/// The exponent of feature differences, 1/2, is a square root below.
const LARGEST: f32 = std::f32::consts::SQRT_2;

/// The difference of the features in each pixel, 0…1; the pictures are in YCxCz.
pub(super) fn feature_difference(
    reference: &Picture,
    test: &Picture,
    density: f64,
) -> Result<Plane, SizeError> {
    let memory = || too_little_memory(reference);
    let filters = FeatureFilters::new(density);
    let lightness = |picture| Plane::of(picture, |[y, _, _]| (y + 16.0) / 116.0);
    let (reference, test) = (lightness(reference)?, lightness(test)?);
    let difference = |derivative: &[f32]| {
        let (one, other) =
            (filters.magnitude(&reference, derivative)?, filters.magnitude(&test, derivative)?);
        Some(one.combine([&other], |one, [other]| (one - other).abs()))
    };
    let edges = difference(&filters.first).ok_or_else(memory)?;
    let points = difference(&filters.second).ok_or_else(memory)?;
    Ok(edges.combine([&points], |edge, [point]| (edge.max(point) / LARGEST).sqrt()))
}

/// The pixels that the filters reach to each side: three standard deviations.
pub(super) fn radius(density: f64) -> usize {
    (3.0 * (0.5 * WIDTH * density)).ceil() as usize
}

/// A Gaussian and its derivatives along a line.
struct FeatureFilters {
    gaussian: Vec<f32>,
    first: Vec<f32>,
    second: Vec<f32>,
}

impl FeatureFilters {
    fn new(density: f64) -> Self {
        let deviation = 0.5 * WIDTH * density;
        let radius = radius(density);
        let bell = |x: f64| (-x * x / (2.0 * deviation * deviation)).exp();
        Self {
            gaussian: normalized(&kernel(radius, bell)),
            first: balanced(&kernel(radius, |x| -x * bell(x))),
            second: balanced(&kernel(radius, |x| (x * x / (deviation * deviation) - 1.0) * bell(x))),
        }
    }

    /// The length of the vector of derivatives across and down.
    fn magnitude(&self, plane: &Plane, derivative: &[f32]) -> Option<Plane> {
        let across = plane.filtered(derivative, &self.gaussian)?;
        let down = plane.filtered(&self.gaussian, derivative)?;
        Some(across.combine([&down], |across, [down]| (across * across + down * down).sqrt()))
    }
}

/// The kernel with its positive weights adding up to 1 and its negative ones to −1.
fn balanced(kernel: &[f64]) -> Vec<f32> {
    let sum = |sign: f64| kernel.iter().map(|weight| (sign * weight).max(0.0)).sum::<f64>();
    let (above, below) = (sum(1.0), sum(-1.0));
    kernel.iter().map(|&weight| (if weight > 0.0 { weight / above } else { weight / below }) as f32).collect()
}
