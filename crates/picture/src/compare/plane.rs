//! A value for each pixel, and filters that are the product of one over rows and one over columns.

use super::too_little_memory;
use crate::picture::{Picture, SizeError};

/// One number for each pixel, row by row from the top.
#[derive(Clone, Debug)]
pub(super) struct Plane {
    width: usize,
    values: Vec<f32>,
}

impl Plane {
    /// The plane of `value` of each pixel.
    pub(super) fn of(picture: &Picture, value: impl FnMut(&[f32; 3]) -> f32) -> Result<Self, SizeError> {
        let mut plane = Self::empty(picture.width() as usize, picture.pixels().len())
            .ok_or_else(|| too_little_memory(picture))?;
        plane.values.extend(picture.pixels().iter().map(value));
        Ok(plane)
    }

    /// A plane without values yet and room for all; `None` when there is too little memory.
    fn empty(width: usize, count: usize) -> Option<Self> {
        let mut values = Vec::new();
        values.try_reserve_exact(count).ok()?;
        Some(Self { width, values })
    }

    pub(super) fn values(&self) -> &[f32] {
        &self.values
    }

    pub(super) fn into_values(self) -> Vec<f32> {
        self.values
    }

    /// Puts another value for each pixel, made of those of several planes of the same size.
    pub(super) fn combine<const N: usize>(
        mut self,
        others: [&Self; N],
        value: impl Fn(f32, [f32; N]) -> f32,
    ) -> Self {
        for (index, target) in self.values.iter_mut().enumerate() {
            let others = others.map(|plane| plane.values.get(index).copied().unwrap_or_default());
            *target = value(*target, others);
        }
        self
    }

    /// Filters the rows by one kernel and the columns by another, both of odd length and with their middle on the
    /// pixel; beyond the border the outermost pixels repeat. `None` when there is too little memory.
    pub(super) fn filtered(&self, rows: &[f32], columns: &[f32]) -> Option<Self> {
        let mut across = Self::empty(self.width, self.values.len())?;
        across.values.resize(self.values.len(), 0.0);
        let mut padded = Vec::new();
        for (source, target) in self.values.chunks(self.width).zip(across.values.chunks_mut(self.width)) {
            pad(source, rows.len() / 2, &mut padded);
            for (weight, shifted) in rows.iter().zip(padded.windows(self.width)) {
                add(target, *weight, shifted);
            }
        }
        let mut both = Self::empty(self.width, self.values.len())?;
        both.values.resize(self.values.len(), 0.0);
        let height = self.values.len() / self.width;
        for (y, target) in both.values.chunks_mut(self.width).enumerate() {
            for (step, weight) in columns.iter().enumerate() {
                let row = (y + step).saturating_sub(columns.len() / 2).min(height - 1);
                let from = row * self.width;
                add(target, *weight, across.values.get(from..from + self.width).unwrap_or_default());
            }
        }
        Some(both)
    }
}

/// Writes a row with its ends repeated `margin` times to either side.
fn pad(row: &[f32], margin: usize, padded: &mut Vec<f32>) {
    let (Some(&first), Some(&last)) = (row.first(), row.last()) else { return };
    padded.clear();
    padded.resize(margin, first);
    padded.extend_from_slice(row);
    padded.resize(row.len() + 2 * margin, last);
}

fn add(target: &mut [f32], weight: f32, source: &[f32]) {
    for (target, source) in target.iter_mut().zip(source) {
        *target += weight * source;
    }
}

/// A kernel of `2 · radius + 1` weights, from a function of the distance to the middle.
pub(super) fn kernel(radius: usize, weight: impl Fn(f64) -> f64) -> Vec<f64> {
    (0..=2 * radius).map(|index| weight(index as f64 - radius as f64)).collect()
}

/// The kernel with the sum 1, in single precision.
pub(super) fn normalized(kernel: &[f64]) -> Vec<f32> {
    let sum: f64 = kernel.iter().sum();
    kernel.iter().map(|weight| (weight / sum) as f32).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_becomes_the_product_of_the_kernels_and_a_border_repeats() {
        let picture = Picture::from_fn(7, 5, |x, y| [if (x, y) == (3, 2) { 1.0 } else { 0.0 }; 3]).unwrap();
        let plane = Plane::of(&picture, |pixel| pixel[0]).unwrap();
        let filtered = plane.filtered(&[1.0, 2.0, 3.0], &[5.0, 7.0, 11.0]).unwrap();
        // Correlation: the weight after the middle looks right and down, so the point is met on its left first.
        let row = |y: usize| filtered.values()[7 * y..][..7].to_vec();
        assert_eq!(row(0), [0.0; 7]);
        assert_eq!(row(1), [0.0, 0.0, 33.0, 22.0, 11.0, 0.0, 0.0]);
        assert_eq!(row(3), [0.0, 0.0, 15.0, 10.0, 5.0, 0.0, 0.0]);
        let even = Picture::from_fn(2, 3, |_, _| [0.25; 3]).unwrap();
        let wide = normalized(&kernel(9, |x| (-x * x / 8.0).exp()));
        let smooth = Plane::of(&even, |pixel| pixel[0]).unwrap().filtered(&wide, &wide).unwrap();
        assert!(smooth.values().iter().all(|value| (value - 0.25).abs() < 1e-6), "{smooth:?}");
    }
}
