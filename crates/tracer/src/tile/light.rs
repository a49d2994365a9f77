//! The light of a tile's pixels.

use super::Place;
use crate::lanes::{MOST_LANES, Mask as _, Width, Word as _};
use crate::vector::Vector;
use crate::whitted::Beams;

/// The light of one sample of a tile's pixels.
///
/// Pixels are numbered block by block, so that those whose rays are traced side by side are neighbors in memory too.
#[derive(Debug)]
pub(crate) struct TileLight {
    /// Red, green, blue and nothing: what is written and added at once.
    light: Vec<[f32; 4]>,
    /// The same, while rays are added of which a pixel has many.
    sums: Vec<[f64; 4]>,
    /// Size of a block, pixels.
    block: [usize; 2],
    /// Blocks across.
    across: usize,
}

impl Default for TileLight {
    fn default() -> Self {
        Self { light: Vec::new(), sums: Vec::new(), block: [1; 2], across: 0 }
    }
}

impl TileLight {
    /// Makes room for the pixels of a tile in blocks of this size.
    pub(super) fn begin(&mut self, place: Place, block: [usize; 2]) {
        let [width, height] = block;
        self.block = block;
        self.across = place.width.div_ceil(width);
        let pixels = self.across * place.height.div_ceil(height) * width * height;
        self.light.resize(pixels, [0.0; 4]);
    }

    /// Sets the light of the pixels of a block.
    #[inline(always)]
    pub(super) fn set<W: Width>(&mut self, w: W, first: usize, light: Vector<W::R>) {
        w.store_fours(fours(w, light), &mut self.light[first..]);
    }

    /// Prepares for more light than was [set](Self::set).
    #[inline(always)]
    pub(super) fn open(&mut self) {
        self.sums.clear();
        self.sums.extend(self.light.iter().map(|light| light.map(f64::from)));
    }

    /// Adds light to the pixels that it belongs to.
    #[inline(always)]
    pub(super) fn add<W: Width>(&mut self, w: W, beams: &Beams<W>, light: Vector<W::R>) {
        let (mut pixels, mut lights) = ([0; MOST_LANES], [[0.0; 4]; MOST_LANES]);
        beams.pixel.store(&mut pixels);
        w.store_fours(fours(w, light), &mut lights);
        let sums = self.sums.as_mut_slice();
        let mut left = beams.lanes.bits();
        while left != 0 {
            let lane = left.trailing_zeros() as usize % MOST_LANES;
            left &= left - 1;
            let light = lights[lane].map(f64::from);
            let sum = &mut sums[pixels[lane] as usize];
            *sum = std::array::from_fn(|part| sum[part] + light[part]);
        }
    }

    /// Ends what [`Self::open`] began.
    #[inline(always)]
    pub(super) fn close(&mut self) {
        for (sum, light) in self.sums.iter().zip(&mut self.light) {
            *light = sum.map(|part| part as f32);
        }
    }

    /// Shows `take` the pixels of row `y`, from left to right, each with one of `to`.
    #[inline]
    pub(crate) fn each<T>(&self, y: usize, to: &mut [T], mut take: impl FnMut(&mut T, [f32; 3])) {
        let [width, height] = self.block;
        let lanes = width * height;
        let start = y / height * self.across * lanes + y % height * width;
        for (to, start) in to.chunks_mut(width).zip((start..).step_by(lanes)) {
            for (to, &[red, green, blue, _]) in to.iter_mut().zip(&self.light[start..]) {
                take(to, [red, green, blue]);
            }
        }
    }
}

#[inline(always)]
fn fours<W: Width>(w: W, Vector { x, y, z }: Vector<W::R>) -> [W::R; 4] {
    [x, y, z, w.real(0.0)]
}
