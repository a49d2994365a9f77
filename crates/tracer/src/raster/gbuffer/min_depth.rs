//! In front of which depths there is nothing: what lets a march pass over many pixels at once.

use catoptric_picture::SizeError;
use glam::DVec2;
use rayon::prelude::*;

use crate::raster::gbuffer::GBufferTexel;
use crate::raster::sample_sums::FrameSize;

/// The least depths around pixels, and those of squares of pixels.
///
/// What is interpolated between a pixel and its neighbors cannot be less than the least of them; a mark of a ray that is
/// before that has met nothing, whatever the pixel shows. So nothing changes by looking here first.
#[derive(Clone, Debug)]
pub(crate) struct MinDepthGrid {
    frame: FrameSize,
    /// For each pixel, the least depth of it and its eight neighbors.
    pixels: Vec<f32>,
    /// The least of each square.
    squares: Vec<f32>,
}

/// A square of pixels: where it begins and ends, and the least depth in it and around it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MinDepthCell {
    pub(crate) low: DVec2,
    pub(crate) high: DVec2,
    pub(crate) front: f64,
}

impl MinDepthGrid {
    /// Edge of a square, pixels.
    const SIDE: usize = 16;

    pub(crate) fn new(frame: FrameSize) -> Result<Self, SizeError> {
        let count = frame.width.div_ceil(Self::SIDE) * frame.height.div_ceil(Self::SIDE);
        Ok(Self { frame, pixels: frame.buffer(f32::INFINITY)?, squares: vec![f32::INFINITY; count] })
    }

    /// Looks at the depths of a sample.
    pub(crate) fn find(&mut self, texels: &[GBufferTexel]) {
        let width = self.frame.width;
        self.pixels.par_chunks_mut(width).enumerate().for_each(|(y, fronts)| {
            let rows = texels.chunks(width).skip(y.saturating_sub(1)).take(if y == 0 { 2 } else { 3 });
            for (x, front) in fronts.iter_mut().enumerate() {
                let near = x.saturating_sub(1)..(x + 2).min(width);
                let around = rows.clone().flat_map(|row| row.get(near.clone()).into_iter().flatten());
                *front = around.map(|texel| texel.depth).fold(f32::INFINITY, f32::min);
            }
        });
        self.squares.fill(f32::INFINITY);
        let across = width.div_ceil(Self::SIDE);
        for (y, row) in self.pixels.chunks(width).enumerate() {
            let squares = self.squares.iter_mut().skip(y / Self::SIDE * across);
            for (square, pixels) in squares.zip(row.chunks(Self::SIDE)) {
                *square = pixels.iter().copied().fold(*square, f32::min);
            }
        }
    }

    /// The least depth around a pixel.
    pub(crate) fn around(&self, pixel: usize) -> f64 {
        self.pixels.get(pixel).copied().map_or(f64::NEG_INFINITY, f64::from)
    }

    /// The square of a pixel.
    pub(crate) fn square(&self, pixel: usize) -> MinDepthCell {
        let (x, y) = (pixel % self.frame.width / Self::SIDE, pixel / self.frame.width / Self::SIDE);
        let low = DVec2::new(x as f64, y as f64) * Self::SIDE as f64;
        let front = self.squares.get(y * self.frame.width.div_ceil(Self::SIDE) + x);
        let front = front.copied().map_or(f64::NEG_INFINITY, f64::from);
        MinDepthCell { low, high: low + Self::SIDE as f64, front }
    }
}
