//! Differences channel by channel: the largest, the mean, RMSE, PSNR, and how many pixels are off.

use std::cmp::Ordering;

use crate::picture::Picture;

/// Pictures of different sizes cannot be compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error(
    "the pictures differ in size: {}x{} and {}x{} pixels; make them the same size", a[0], a[1], b[0], b[1]
)]
pub struct SizeMismatch {
    /// Width and height of the first, in pixels.
    pub a: [u32; 2],
    /// Width and height of the second, in pixels.
    pub b: [u32; 2],
}

impl SizeMismatch {
    /// Whether two pictures have the same size.
    pub(crate) fn check(a: &Picture, b: &Picture) -> Result<(), SizeMismatch> {
        let (a, b) = ([a.width(), a.height()], [b.width(), b.height()]);
        if a == b { Ok(()) } else { Err(SizeMismatch { a, b }) }
    }
}

/// The settings of a comparison.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Comparison {
    /// Whether values are first clamped to 0…1, as the display clamps them. Default true.
    pub clamp: bool,
    /// The largest difference of a channel, in linear light, at which a pixel still counts as equal.
    /// Default 1/255.
    pub bound: f64,
}

impl Default for Comparison {
    fn default() -> Comparison {
        Comparison { clamp: true, bound: 1.0 / 255.0 }
    }
}

/// The difference of two pictures in linear light.
///
/// The difference of a channel is |a − b|; a NaN on either side counts as 1 when clamped, as infinite when
/// not, and always as above the bound. Means run over all channels of all pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// The largest difference of a channel.
    pub max: f64,
    /// The mean difference.
    pub mean: f64,
    /// The root of the mean squared difference.
    pub rmse: f64,
    /// The peak signal-to-noise ratio −20 log₁₀(rmse), in decibels, with the peak 1; +∞ when equal.
    pub psnr_db: f64,
    /// The number of pixels of which a channel differs by more than [`Comparison::bound`].
    pub above: u64,
    /// `above` as a share of all pixels, 0…1.
    pub share_above: f64,
    /// The number of pixels with a NaN on either side.
    pub not_a_number: u64,
    /// Column and row (from the top) of the pixel with the largest difference, the first of several;
    /// `None` when the pictures are equal.
    pub worst: Option<[u32; 2]>,
}

impl Difference {
    /// Compares with the default [`Comparison`]: clamped, with the bound 1/255.
    ///
    /// ```
    /// use catoptric_picture::{Difference, Picture};
    /// let a = Picture::new(10, 10)?;
    /// let mut b = a.clone();
    /// b.pixels_mut()[42] = [0.0, 0.1, 0.0];
    /// let difference = Difference::between(&a, &b)?;
    /// assert_eq!((difference.above, difference.worst), (1, Some([2, 4])));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// When the sizes differ.
    pub fn between(a: &Picture, b: &Picture) -> Result<Difference, SizeMismatch> {
        Comparison::default().compare(a, b)
    }
}

impl Comparison {
    /// Compares two pictures in this way; which is first does not matter.
    ///
    /// # Errors
    /// When the sizes differ.
    pub fn compare(&self, a: &Picture, b: &Picture) -> Result<Difference, SizeMismatch> {
        SizeMismatch::check(a, b)?;
        let mut tally = DifferenceSums::default();
        for (y, (row_a, row_b)) in (0..).zip(a.rows().zip(b.rows())) {
            for (x, (pixel_a, pixel_b)) in (0..).zip(row_a.iter().zip(row_b)) {
                self.count(&mut tally, [x, y], pixel_a, pixel_b);
            }
        }
        Ok(tally.finish(a.pixels().len()))
    }

    /// Adds one pixel.
    fn count(&self, tally: &mut DifferenceSums, at: [u32; 2], a: &[f32; 3], b: &[f32; 3]) {
        let mut worst = 0.0_f64;
        for (&a, &b) in a.iter().zip(b) {
            let error = channel_error(a, b, self.clamp);
            tally.sum += error;
            tally.squares += error * error;
            worst = worst.max(error);
        }
        if worst > tally.max {
            tally.max = worst;
            tally.worst = Some(at);
        }
        let not_a_number = a.iter().chain(b).any(|value| value.is_nan());
        tally.not_a_number += u64::from(not_a_number);
        // Also above when the bound is NaN: such a comparison must not pass.
        let within = matches!(worst.partial_cmp(&self.bound), Some(Ordering::Less | Ordering::Equal));
        tally.above += u64::from(not_a_number || !within);
    }
}

/// The difference of one channel, never NaN; see [`Difference`].
pub(crate) fn channel_error(a: f32, b: f32, clamp: bool) -> f64 {
    let (a, b) = (f64::from(a), f64::from(b));
    let (a, b) = if clamp { (a.clamp(0.0, 1.0), b.clamp(0.0, 1.0)) } else { (a, b) };
    if a == b {
        0.0 // also ∞ and ∞
    } else if a.is_nan() || b.is_nan() {
        if clamp { 1.0 } else { f64::INFINITY }
    } else {
        (a - b).abs()
    }
}

/// The sums over the pixels that were compared so far.
#[derive(Default)]
struct DifferenceSums {
    sum: f64,
    squares: f64,
    max: f64,
    above: u64,
    not_a_number: u64,
    worst: Option<[u32; 2]>,
}

impl DifferenceSums {
    fn finish(self, pixels: usize) -> Difference {
        let pixels = pixels as f64;
        let rmse = (self.squares / (3.0 * pixels)).sqrt();
        Difference {
            max: self.max,
            mean: self.sum / (3.0 * pixels),
            rmse,
            psnr_db: -20.0 * rmse.log10(),
            above: self.above,
            share_above: self.above as f64 / pixels,
            not_a_number: self.not_a_number,
            worst: self.worst,
        }
    }
}
