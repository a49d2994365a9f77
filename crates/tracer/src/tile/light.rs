//! The light of a tile's pixels.

use super::{Place, TILE};
use crate::lanes::{MOST_LANES, Mask as _, Real as _, Width, Word as _};
use crate::vector::Vector;
use crate::whitted::Beams;

/// The light of one sample of a tile's pixels.
///
/// Pixels are numbered block by block, so that those whose rays are traced side by side are neighbors in memory too.
#[derive(Debug)]
pub(crate) struct TileLight {
    /// Red, green and blue, each in a row of its own: the sums of what all rays of a pixel bring.
    sums: Box<[[f64; PIXELS]; 3]>,
    /// Size of a block, pixels.
    block: [usize; 2],
    /// Blocks across.
    across: usize,
}

/// No tile has more.
const PIXELS: usize = TILE * TILE;

impl Default for TileLight {
    fn default() -> Self {
        Self { sums: Box::new([[0.0; PIXELS]; 3]), block: [1; 2], across: 0 }
    }
}

impl TileLight {
    /// Prepares for the pixels of a tile in blocks of this size.
    pub(super) fn begin(&mut self, place: Place, block: [usize; 2]) {
        self.block = block;
        self.across = place.width.div_ceil(block[0]);
    }

    /// Sets the light of the pixels of a block.
    #[inline(always)]
    pub(super) fn set<W: Width>(&mut self, first: usize, light: Vector<W::R>) {
        self.each_channel::<W>(
            first,
            light,
            #[inline(always)]
            |sum, light| *sum = light,
        );
    }

    /// Adds light to the pixels that it belongs to.
    #[inline(always)]
    pub(super) fn add<W: Width>(&mut self, w: W, beams: &Beams<W>, light: Vector<W::R>) {
        let mut pixels = [0; MOST_LANES];
        beams.pixel.store(&mut pixels);
        let first = pixels[0];
        // Rays that were neither mixed with others nor thinned out belong to pixels that are neighbors in memory.
        let others = !beams.pixel.plus(w.load_words(&BEFORE)).is(first);
        if !others.any() {
            let zero = w.real(0.0);
            let light = light.map(|part| W::R::select(beams.lanes, part, zero));
            return self.each_channel::<W>(
                first as usize,
                light,
                #[inline(always)]
                |sum, light| *sum += light,
            );
        }
        let parts = channels::<W>(light);
        let mut left = beams.lanes.bits();
        while left != 0 {
            let lane = left.trailing_zeros() as usize % MOST_LANES;
            left &= left - 1;
            let pixel = pixels[lane] as usize % PIXELS;
            for (sums, part) in self.sums.iter_mut().zip(&parts) {
                sums[pixel] += f64::from(part[lane]);
            }
        }
    }

    #[inline(always)]
    fn each_channel<W: Width>(
        &mut self,
        first: usize,
        light: Vector<W::R>,
        mut take: impl FnMut(&mut f64, f64),
    ) {
        for (sums, part) in self.sums.iter_mut().zip(&channels::<W>(light)) {
            for (sum, &part) in sums[first..first + W::LANES].iter_mut().zip(part) {
                take(sum, f64::from(part));
            }
        }
    }

    /// Shows `take` the pixels of row `y`, from left to right, each with one of `to`.
    #[inline]
    pub(crate) fn each<T>(&self, y: usize, to: &mut [T], mut take: impl FnMut(&mut T, [f32; 3])) {
        let [width, height] = self.block;
        let lanes = width * height;
        let start = y / height * self.across * lanes + y % height * width;
        for (to, start) in to.chunks_mut(width).zip((start..).step_by(lanes)) {
            let [red, green, blue] = self.sums.each_ref().map(|sums| &sums[start..start + to.len()]);
            for (((to, &red), &green), &blue) in to.iter_mut().zip(red).zip(green).zip(blue) {
                take(to, [red as f32, green as f32, blue as f32]);
            }
        }
    }
}

/// What makes the numbers of neighbors equal.
const BEFORE: [u32; MOST_LANES] = {
    let mut before = [0; MOST_LANES];
    let mut lane = 1;
    while lane < MOST_LANES {
        before[lane] = (lane as u32).wrapping_neg();
        lane += 1;
    }
    before
};

#[inline(always)]
fn channels<W: Width>(Vector { x, y, z }: Vector<W::R>) -> [[f32; MOST_LANES]; 3] {
    [x, y, z].map(
        #[inline(always)]
        |part| {
            let mut numbers = [0.0; MOST_LANES];
            part.store(&mut numbers);
            numbers
        },
    )
}
