//! The light of a tile's pixels.

use super::Place;
use crate::lanes::{MOST_LANES, Mask as _, Real as _, Width, Word as _};
use crate::vector::Vector;
use crate::whitted::Beams;

/// The light of one sample of a tile's pixels.
///
/// Pixels are numbered block by block, so that those whose rays are traced side by side are neighbors in memory too.
#[derive(Debug)]
pub(crate) struct TileLight {
    /// Red, green and blue.
    light: [Vec<f32>; 3],
    /// The same, while rays are added of which a pixel has many.
    sums: [Vec<f64>; 3],
    /// Size of a block, pixels.
    block: [usize; 2],
    /// Blocks across.
    across: usize,
}

impl Default for TileLight {
    fn default() -> Self {
        Self { light: Default::default(), sums: Default::default(), block: [1; 2], across: 0 }
    }
}

impl TileLight {
    /// Makes room for the pixels of a tile in blocks of this size.
    pub(super) fn begin(&mut self, place: Place, block: [usize; 2]) {
        let [width, height] = block;
        self.block = block;
        self.across = place.width.div_ceil(width);
        let pixels = self.across * place.height.div_ceil(height) * width * height;
        self.light.iter_mut().for_each(|row| row.resize(pixels, 0.0));
    }

    /// Sets the light of the pixels of a block.
    #[inline(always)]
    pub(super) fn set<R: crate::lanes::Real>(&mut self, first: usize, light: Vector<R>) {
        let [red, green, blue] = &mut self.light;
        light.x.store(&mut red[first..]);
        light.y.store(&mut green[first..]);
        light.z.store(&mut blue[first..]);
    }

    /// Prepares for more light than was [set](Self::set).
    #[inline(always)]
    pub(super) fn open(&mut self) {
        for (sums, light) in self.sums.iter_mut().zip(&self.light) {
            sums.clear();
            sums.extend(light.iter().map(|&light| f64::from(light)));
        }
    }

    /// Adds light to the pixels that it belongs to.
    #[inline(always)]
    pub(super) fn add<W: Width>(&mut self, beams: &Beams<W>, light: Vector<W::R>) {
        let mut pixels = [0; MOST_LANES];
        beams.pixel.store(&mut pixels);
        // An iterator over arrays of vectors would move them through memory, unaligned.
        let [mut red, mut green, mut blue] = [[0.0; MOST_LANES]; 3];
        light.x.store(&mut red);
        light.y.store(&mut green);
        light.z.store(&mut blue);
        let [reds, greens, blues] = &mut self.sums;
        let (reds, greens, blues) = (reds.as_mut_slice(), greens.as_mut_slice(), blues.as_mut_slice());
        let mut left = beams.lanes.bits();
        while left != 0 {
            let lane = left.trailing_zeros() as usize % MOST_LANES;
            left &= left - 1;
            let pixel = pixels[lane] as usize;
            reds[pixel] += f64::from(red[lane]);
            greens[pixel] += f64::from(green[lane]);
            blues[pixel] += f64::from(blue[lane]);
        }
    }

    /// Ends what [`Self::open`] began.
    #[inline(always)]
    pub(super) fn close(&mut self) {
        for (sums, light) in self.sums.iter().zip(&mut self.light) {
            for (sum, light) in sums.iter().zip(light) {
                *light = *sum as f32;
            }
        }
    }

    /// Shows `take` the pixels of row `y`, from left to right, each with one of `to`.
    #[inline]
    pub(crate) fn each<T>(&self, y: usize, to: &mut [T], mut take: impl FnMut(&mut T, [f32; 3])) {
        let [width, height] = self.block;
        let lanes = width * height;
        let start = y / height * self.across * lanes + y % height * width;
        let [red, green, blue] = &self.light;
        for (to, start) in to.chunks_mut(width).zip((start..).step_by(lanes)) {
            let parts = red[start..].iter().zip(&green[start..]).zip(&blue[start..]);
            for (to, ((&red, &green), &blue)) in to.iter_mut().zip(parts) {
                take(to, [red, green, blue]);
            }
        }
    }
}
