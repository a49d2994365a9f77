//! Where two pictures differ, as a picture.

use super::difference::{SizeMismatch, channel_error};
use super::inferno::inferno;
use crate::picture::{Picture, SizeError};
use crate::srgb;

/// How to draw a heat map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatMap {
    /// Whether values are first clamped to 0…1, as in [`Comparison::clamp`](crate::Comparison::clamp).
    /// Default true.
    pub clamp: bool,
    /// The difference, in linear light, that gets the lightest color; larger ones get it too.
    /// Default 16/255, so that the usual bound of 1/255 can be told from nothing.
    pub maximum: f64,
    /// Whether a strip is added at the bottom: the scale from 0 on the left to `maximum` on the right, with
    /// ticks at its quarters. The pixels of the map keep their places. Default true.
    pub legend: bool,
}

impl Default for HeatMap {
    fn default() -> HeatMap {
        HeatMap { clamp: true, maximum: 16.0 / 255.0, legend: true }
    }
}

/// Why a heat map cannot be drawn.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum HeatMapError {
    /// The pictures differ in size.
    #[error(transparent)]
    Mismatch(#[from] SizeMismatch),
    /// The map with its legend is too large, or the memory is not there.
    #[error(transparent)]
    Size(#[from] SizeError),
}

/// Rows between the map and the scale, which hold the ticks.
const GAP: u32 = 4;
/// Rows of the scale.
const SCALE: u32 = 8;
/// The color of pixels with a NaN, which is not on the scale.
const NOT_A_NUMBER: [f32; 3] = [0.0, 1.0, 0.0];

/// Colors every pixel by the largest difference of its channels, on the scale "inferno": black where the
/// pictures are equal, pale yellow from `maximum` on, pure green where either has a NaN.
///
/// The map is in linear light; the default [`Development`](crate::Development) shows the scale's own colors.
///
/// # Errors
/// When the sizes differ, or the map would be too large.
pub fn heat_map(a: &Picture, b: &Picture, options: &HeatMap) -> Result<Picture, HeatMapError> {
    SizeMismatch::check(a, b)?;
    let legend = if options.legend { GAP + SCALE } else { 0 };
    let mut map = Picture::new(a.width(), a.height().saturating_add(legend))?;
    let pairs = a.pixels().iter().zip(b.pixels());
    for (target, (a, b)) in map.pixels_mut().iter_mut().zip(pairs) {
        *target = pixel_color(a, b, options);
    }
    for (y, row) in map.rows_mut().skip(a.height() as usize).enumerate() {
        draw_legend_row(row, y < GAP as usize);
    }
    Ok(map)
}

/// The color of one pixel of the map.
fn pixel_color(a: &[f32; 3], b: &[f32; 3], options: &HeatMap) -> [f32; 3] {
    if a.iter().chain(b).any(|value| value.is_nan()) {
        return NOT_A_NUMBER;
    }
    let errors = a.iter().zip(b).map(|(&a, &b)| channel_error(a, b, options.clamp));
    let worst = errors.fold(0.0, f64::max);
    // No difference is dark whatever the maximum; any is light when the maximum is 0 or makes no sense.
    scale_color(if worst > 0.0 { worst / options.maximum.max(0.0) } else { 0.0 })
}

/// The color of the scale "inferno" at `t`, clamped to 0…1, in linear light.
pub fn scale_color(t: f64) -> [f32; 3] {
    inferno(t).map(|channel| srgb::decode(channel) as f32)
}

/// One row of the legend: ticks in the gap, or the scale.
fn draw_legend_row(row: &mut [[f32; 3]], ticks: bool) {
    let last = row.len().saturating_sub(1);
    for (x, pixel) in row.iter_mut().enumerate() {
        let is_tick = (0..=4).any(|quarter| x == (last * quarter + 2) / 4);
        *pixel = match ticks {
            true if is_tick => [1.0; 3],
            true => [0.0; 3],
            false => scale_color(x as f64 / last.max(1) as f64),
        };
    }
}
