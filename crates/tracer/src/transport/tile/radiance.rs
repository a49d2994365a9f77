//! The light of a tile's pixels.

use glam::DVec3;

use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float32 as _, MOST_LANES, Mask as _, Width, Word as _};
use crate::transport::path::PathState;
use crate::transport::surface::MOST_OF_PIXEL;
use crate::transport::tile::PixelBlock;
use crate::transport::tile_rect::TileRect;

/// The order of the pixels of a tile or a group: block by block, so that those whose rays are traced side by side are
/// neighbors in memory too.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct BlockLayout {
    /// Size of a block, pixels.
    block: [usize; 2],
    /// Blocks across.
    across: usize,
    /// Pixels of all blocks.
    pub(crate) pixels: usize,
}

impl BlockLayout {
    fn new(place: TileRect, block: [usize; 2]) -> Self {
        let [width, height] = block;
        let across = place.width.div_ceil(width);
        Self { block, across, pixels: across * place.height.div_ceil(height) * width * height }
    }

    /// Pixels of a block.
    pub(crate) fn lanes(&self) -> usize {
        let [width, height] = self.block;
        width * height
    }

    /// Pixels of a row of a block.
    pub(crate) fn block_width(&self) -> usize {
        self.block[0]
    }

    /// Where row `y` begins.
    pub(crate) fn start(&self, y: usize) -> usize {
        let [width, height] = self.block;
        y / height * self.across * self.lanes() + y % height * width
    }

    /// Writes row `y` of three planes, made of blocks of this width, into a row of pixels.
    #[inline(always)]
    pub(crate) fn write_threes<W: Width, T: Copy>(
        &self,
        w: W,
        (planes, y): ([&[T]; 3], usize),
        row: &mut [[f32; 3]],
        number: impl Fn(T) -> f32 + Copy,
    ) {
        let [width, _] = PixelBlock::<W>::SIZE;
        let [a, b, c] = planes;
        let (mut start, (whole, rest)) = (self.start(y), row.split_at_mut(row.len() / W::LANES * W::LANES));
        for to in whole.chunks_exact_mut(W::LANES) {
            let parts = [
                row_of_blocks(w, &a[start..], number),
                row_of_blocks(w, &b[start..], number),
                row_of_blocks(w, &c[start..], number),
            ];
            w.store_threes(parts, to);
            start += W::LANES / width * W::LANES;
        }
        for (x, to) in rest.iter_mut().enumerate() {
            let at = start + x / width * W::LANES + x % width;
            *to = [number(a[at]), number(b[at]), number(c[at])];
        }
    }
}

/// The light of one sample of the pixels of a tile or a group, in the order of a [`BlockLayout`].
#[derive(Debug, Default)]
pub(crate) struct TileRadiance {
    /// The sums of what all rays of a pixel bring.
    sums: ChannelPlanes,
    pub(crate) layout: BlockLayout,
}

/// Red, green and blue of all pixels, each in a row of its own; as long as the largest tile so far needed.
type ChannelPlanes = [Vec<f64>; 3];

/// A sum of light in single precision. Sums may be of very many rays; none is infinite afterwards.
#[inline(always)]
fn rounded(sum: f64) -> f32 {
    (sum as f32).clamp(-MOST_OF_PIXEL, MOST_OF_PIXEL)
}

impl TileRadiance {
    /// Prepares for the pixels of a tile or a group in blocks of this size.
    pub(crate) fn begin(&mut self, place: TileRect, block: [usize; 2]) {
        self.layout = BlockLayout::new(place, block);
        let pixels = self.layout.pixels;
        for plane in &mut self.sums {
            if plane.len() < pixels {
                plane.resize(pixels, 0.0);
            }
        }
    }

    /// Sets the light of the pixels of a block, from number `first` on.
    #[inline(always)]
    pub(crate) fn set<W: Width>(&mut self, first: usize, light: Vector<W::R>) {
        let [red, green, blue] = &mut self.sums;
        each_with::<W>(&mut red[first..], light.x, |sum, part| *sum = part);
        each_with::<W>(&mut green[first..], light.y, |sum, part| *sum = part);
        each_with::<W>(&mut blue[first..], light.z, |sum, part| *sum = part);
    }

    /// Adds light to the pixels that it belongs to.
    #[inline(always)]
    pub(crate) fn add<W: Width>(&mut self, w: W, paths: &PathState<W>, light: Vector<W::R>) {
        let [reds, greens, blues] = &mut self.sums;
        let mut pixels = [0; MOST_LANES];
        paths.pixel.store(&mut pixels);
        if let Some(first) = first_of_neighbors(w, paths) {
            let zero = w.real(0.0);
            let flies = |part| W::R::select(paths.lanes, part, zero);
            each_with::<W>(&mut reds[first..], flies(light.x), |sum, part| *sum += part);
            each_with::<W>(&mut greens[first..], flies(light.y), |sum, part| *sum += part);
            each_with::<W>(&mut blues[first..], flies(light.z), |sum, part| *sum += part);
            return;
        }
        let [red, green, blue] = [numbers::<W>(light.x), numbers::<W>(light.y), numbers::<W>(light.z)];
        let mut left = paths.lanes.bits();
        while left != 0 {
            let lane = left.trailing_zeros() as usize % MOST_LANES;
            left &= left - 1;
            let pixel = pixels[lane] as usize;
            reds[pixel] += f64::from(red[lane]);
            greens[pixel] += f64::from(green[lane]);
            blues[pixel] += f64::from(blue[lane]);
        }
    }

    /// Writes rows of pixels, from the uppermost on, as the blocks are that rays of this width were traced in.
    #[inline(always)]
    pub(crate) fn write<W: Width>(&self, w: W, rows: &mut [&mut [[f32; 3]]]) {
        let [red, green, blue] = &self.sums;
        for (y, row) in rows.iter_mut().enumerate() {
            self.layout.write_threes(w, ([red, green, blue], y), row, rounded);
        }
    }

    /// Takes it into the sums of the pixels of a tile so wide, row by row; `is_first` where there is nothing in them yet.
    pub(crate) fn sum_into(&self, sums: &mut [DVec3], width: usize, is_first: bool) {
        for (y, row) in sums.chunks_mut(width).enumerate() {
            if is_first {
                self.each(y, row, |sum, light| *sum = DVec3::from(light.map(f64::from)));
            } else {
                self.each(y, row, |sum, light| *sum += DVec3::from(light.map(f64::from)));
            }
        }
    }

    /// Shows `take` the pixels of row `y`, from left to right, each with one of `to`.
    #[inline]
    pub(crate) fn each<T>(&self, y: usize, to: &mut [T], mut take: impl FnMut(&mut T, [f32; 3])) {
        let layout = self.layout;
        let starts = (layout.start(y)..).step_by(layout.lanes());
        for (to, start) in to.chunks_mut(layout.block_width()).zip(starts) {
            let row = self.sums.each_ref().map(|plane| &plane[start..start + to.len()]);
            // Blocks are four pixels wide or eight, and four numbers are read at once.
            let [(reds, red), (greens, green), (blues, blue)] = row.map(<[f64]>::as_chunks::<4>);
            let (fours, rest) = to.as_chunks_mut::<4>();
            for (((to, red), green), blue) in fours.iter_mut().zip(reds).zip(greens).zip(blues) {
                let [red, green, blue] = [red, green, blue].map(|numbers| numbers.map(rounded));
                for (at, to) in to.iter_mut().enumerate() {
                    take(to, [red[at], green[at], blue[at]]);
                }
            }
            for (((to, &red), &green), &blue) in rest.iter_mut().zip(red).zip(green).zip(blue) {
                take(to, [rounded(red), rounded(green), rounded(blue)]);
            }
        }
    }
}

/// A row of as many neighboring blocks as make a vector; the first one begins here.
#[inline(always)]
fn row_of_blocks<W: Width, T: Copy>(w: W, parts: &[T], number_of: impl Fn(T) -> f32) -> W::R {
    let [width, _] = PixelBlock::<W>::SIZE;
    let parts = &parts[..(W::LANES / width - 1) * W::LANES + width];
    let mut numbers = [0.0; MOST_LANES];
    for (lane, number) in numbers[..W::LANES].iter_mut().enumerate() {
        *number = number_of(parts[lane / width * W::LANES + lane % width]);
    }
    w.load(&numbers)
}

/// The first pixel of rays that were neither mixed with others nor thinned out: they belong to pixels that are neighbors in
/// memory.
#[inline(always)]
pub(crate) fn first_of_neighbors<W: Width>(w: W, paths: &PathState<W>) -> Option<usize> {
    let mut pixels = [0; MOST_LANES];
    paths.pixel.store(&mut pixels);
    let others = !paths.pixel.plus(w.load_words(&BEFORE)).is(pixels[0]);
    (!others.any()).then_some(pixels[0] as usize)
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

/// Hands the first sums over, each with one of these numbers.
#[inline(always)]
fn each_with<W: Width>(sums: &mut [f64], parts: W::R, take: impl Fn(&mut f64, f64)) {
    for (sum, part) in sums[..W::LANES].iter_mut().zip(numbers::<W>(parts)) {
        take(sum, f64::from(part));
    }
}

#[inline(always)]
fn numbers<W: Width>(part: W::R) -> [f32; MOST_LANES] {
    let mut numbers = [0.0; MOST_LANES];
    part.store(&mut numbers);
    numbers
}
