//! The heat map of the difference of two pictures.

use super::difference::{SizeMismatch, channel_error};
use super::inferno::inferno;
use super::{CompareError, digits};
use crate::picture::{Picture, SizeError};
use crate::srgb;

/// The settings of a heat map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatMap {
    /// Whether values are first clamped to 0…1, as in [`Comparison::clamp`](crate::Comparison::clamp).
    /// Default true.
    pub clamp: bool,
    /// The difference, in linear light, that gets the lightest color; larger ones get it too.
    /// Default 16/255, so that the usual bound of 1/255 is visible.
    pub maximum: f64,
    /// Whether a strip is added at the bottom: the scale from 0 on the left to `maximum` on the right, with
    /// ticks at its quarters and, where the map is wide enough, numbers. The pixels of the map keep their places.
    /// Default true.
    pub legend: bool,
}

impl Default for HeatMap {
    fn default() -> HeatMap {
        HeatMap { clamp: true, maximum: 16.0 / 255.0, legend: true }
    }
}

/// Rows between the map and the scale, which hold the ticks.
const GAP: u32 = 4;
/// Rows of the scale.
const SCALE: u32 = 8;
/// Rows of the numbers below the scale, where the map is wide enough for them.
const NUMBERS: u32 = digits::HEIGHT + 4;
/// The color of pixels with a NaN, which is not on the scale.
const NOT_A_NUMBER: [f32; 3] = [0.0, 1.0, 0.0];

/// Colors every pixel by the largest difference of its channels, on the scale "inferno": black where the
/// pictures are equal, pale yellow from `maximum` on, pure green where either has a NaN.
///
/// The map is in linear light; the default [`Development`](crate::Development) shows the scale's own colors.
///
/// # Errors
/// When the sizes differ, or the map would be too large.
pub fn heat_map(a: &Picture, b: &Picture, options: &HeatMap) -> Result<Picture, CompareError> {
    SizeMismatch::check(a, b)?;
    let worst = |(a, b): (&[f32; 3], &[f32; 3])| {
        let not_a_number = a.iter().chain(b).any(|value| value.is_nan());
        let errors = a.iter().zip(b).map(|(&a, &b)| channel_error(a, b, options.clamp));
        (!not_a_number).then(|| errors.fold(0.0, f64::max))
    };
    let errors = a.pixels().iter().zip(b.pixels()).map(worst);
    Ok(map_of(a.width(), a.height(), errors, options)?)
}

/// The map of these errors, row by row; `None` is a NaN.
pub(super) fn map_of(
    width: u32,
    height: u32,
    errors: impl Iterator<Item = Option<f64>>,
    options: &HeatMap,
) -> Result<Picture, SizeError> {
    let labels = if options.legend { labels(width, options.maximum) } else { Vec::new() };
    let legend = match (options.legend, labels.is_empty()) {
        (false, _) => 0,
        (true, true) => GAP + SCALE,
        (true, false) => GAP + SCALE + NUMBERS,
    };
    let mut map = Picture::new(width, height.saturating_add(legend))?;
    for (target, error) in map.pixels_mut().iter_mut().zip(errors) {
        *target = error.map_or(NOT_A_NUMBER, |error| error_color(error, options.maximum));
    }
    for (y, row) in map.rows_mut().skip(height as usize).take((GAP + SCALE) as usize).enumerate() {
        draw_legend_row(row, y < GAP as usize);
    }
    for (x, text) in labels {
        digits::draw(&mut map, [x, height + GAP + SCALE + 2], &text, [1.0; 3]);
    }
    Ok(map)
}

/// The color of an error.
fn error_color(error: f64, maximum: f64) -> [f32; 3] {
    // No difference is dark whatever the maximum; any is light when the maximum is 0 or makes no sense.
    scale_color(if error > 0.0 { error / maximum.max(0.0) } else { 0.0 })
}

/// The color of the scale "inferno" at `t`, clamped to 0…1, in linear light.
pub fn scale_color(t: f64) -> [f32; 3] {
    inferno(t).map(|channel| srgb::decode(channel) as f32)
}

/// The column of a quarter of the scale.
fn tick(width: u32, quarter: u32) -> u32 {
    (width.saturating_sub(1) * quarter + 2) / 4
}

/// The numbers at the ticks and the columns where they begin; none where there is no room.
fn labels(width: u32, maximum: f64) -> Vec<(u32, String)> {
    if !(maximum.is_finite() && maximum > 0.0) {
        return Vec::new();
    }
    // Three significant digits of the maximum.
    let places = (2 - maximum.log10().floor() as i32).clamp(0, 9) as usize;
    let text = |quarter: u32| {
        let text = format!("{:.places$}", maximum * f64::from(quarter) / 4.0);
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    };
    let labels: Vec<(u32, String)> = (0..=4)
        .map(|quarter| {
            let text = text(quarter);
            let room = digits::width(&text);
            (tick(width, quarter).saturating_sub(room / 2).min(width.saturating_sub(room)), text)
        })
        .collect();
    let widest = labels.iter().map(|(_, text)| digits::width(text)).max().unwrap_or_default();
    if width >= 5 * (widest + 6) { labels } else { Vec::new() }
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
