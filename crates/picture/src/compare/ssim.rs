//! Structural similarity.

use std::ops::Range;

use rayon::prelude::*;

use super::difference::SizeMismatch;
use super::plane::kernel;
use super::{CompareError, displayed, too_little_memory};
use crate::picture::Picture;
use crate::srgb;

/// Side of the window, pixels.
pub(super) const WINDOW: usize = 11;
/// Rows of windows for which luma is worked out at a time.
const BAND: usize = 32;
/// Standard deviation of the window's Gaussian weights, pixels.
const SIGMA: f64 = 1.5;
/// (K₁ L)² and (K₂ L)² with K₁ = 0.01, K₂ = 0.03 and the range L = 1.
const C1: f64 = 0.01 * 0.01;
const C2: f64 = 0.03 * 0.03;

/// The mean structural similarity of two pictures, 1 when they are shown alike, near 0 (even a little below) when they
/// have nothing in common.
///
/// Compared is the luma of what a display shows: light clamped to 0…1 (NaN is black), encoded by sRGB, then
/// Y′ = 0.2126 R′ + 0.7152 G′ + 0.0722 B′ in double precision, without rounding to codes. In a window of 11×11 pixels
/// with Gaussian weights of σ = 1.5 pixels and the sum 1,
/// `SSIM = (2 μₐ μᵦ + C₁)(2 σₐᵦ + C₂) / ((μₐ² + μᵦ² + C₁)(σₐ² + σᵦ² + C₂))`, C₁ = 0.01², C₂ = 0.03²; the mean runs over
/// all windows that lie wholly in the picture. Which picture is first does not matter.
///
/// Source: Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli, "Image quality assessment: from error visibility to
/// structural similarity", IEEE Trans. Image Processing 13 (4), 2004, eq. 13 to 17.
///
/// # Errors
/// When the sizes differ, a side is shorter than the window, or there is too little memory.
pub fn ssim(a: &Picture, b: &Picture) -> Result<f64, CompareError> {
    SizeMismatch::check(a, b)?;
    let (width, height) = (a.width() as usize, a.height() as usize);
    if width.min(height) < WINDOW {
        return Err(CompareError::TooSmall { width: a.width(), height: a.height() });
    }
    let bell = kernel(WINDOW / 2, |x| (-x * x / (2.0 * SIGMA * SIGMA)).exp());
    let sum: f64 = bell.iter().sum();
    let weights: Vec<f64> = bell.iter().map(|weight| weight / sum).collect();
    let mut sums = vec![0.0; height - WINDOW + 1];
    let bands = sums.par_chunks_mut(BAND).enumerate();
    bands.try_for_each(|(band, sums)| {
        let rows = band * BAND * width..(band * BAND + sums.len() + WINDOW - 1) * width;
        let (a, b) = (luma(a, rows.clone())?, luma(b, rows)?);
        for (y, sum) in sums.iter_mut().enumerate() {
            let windows = y * width..(y + WINDOW) * width;
            if let (Some(a), Some(b)) = (a.get(windows.clone()), b.get(windows)) {
                *sum = row_of_windows(a, b, width, &weights);
            }
        }
        Ok::<_, CompareError>(())
    })?;
    let sum: f64 = sums.iter().sum();
    Ok(sum / ((width - WINDOW + 1) * (height - WINDOW + 1)) as f64)
}

/// The luma as it is displayed, 0…1, of a range of pixels.
fn luma(picture: &Picture, range: Range<usize>) -> Result<Vec<f64>, CompareError> {
    let pixels = picture.pixels().get(range).unwrap_or_default();
    let mut plane = Vec::new();
    plane.try_reserve_exact(pixels.len()).map_err(|_| too_little_memory(picture))?;
    plane.extend(pixels.iter().map(|&pixel| {
        let [red, green, blue] = displayed(pixel).map(|light| srgb::encode(f64::from(light)));
        0.2126 * red + 0.7152 * green + 0.0722 * blue
    }));
    Ok(plane)
}

/// Adds up the similarity of all windows in one band of eleven rows.
fn row_of_windows(a: &[f64], b: &[f64], width: usize, weights: &[f64]) -> f64 {
    // The five moments of each column, then of each window: means of a, b, a², b², ab.
    let mut columns = vec![[0.0; 5]; width];
    for ((row_a, row_b), weight) in a.chunks(width).zip(b.chunks(width)).zip(weights) {
        for ((column, &a), &b) in columns.iter_mut().zip(row_a).zip(row_b) {
            let moments = [a, b, a * a, b * b, a * b];
            column.iter_mut().zip(moments).for_each(|(sum, moment)| *sum += weight * moment);
        }
    }
    let window = |columns: &[[f64; 5]]| {
        let mut moments = [0.0; 5];
        for (column, weight) in columns.iter().zip(weights) {
            moments.iter_mut().zip(column).for_each(|(sum, moment)| *sum += weight * moment);
        }
        similarity(moments)
    };
    columns.windows(WINDOW).map(window).sum()
}

/// The similarity in a window of these moments.
fn similarity([a, b, aa, bb, ab]: [f64; 5]) -> f64 {
    let (variance_a, variance_b, covariance) = (aa - a * a, bb - b * b, ab - a * b);
    (2.0 * a * b + C1) * (2.0 * covariance + C2) / ((a * a + b * b + C1) * (variance_a + variance_b + C2))
}
