//! The squares that a picture is traced in, and the rays of a square side by side.

use glam::{DVec2, DVec3, UVec2, Vec2};

use crate::counts::RayCounts;
use crate::lanes::{Lanes, MOST_LANES, Mask as _, Real as _, Width, Work};
use crate::render::Control;
use crate::sampling::sample_offset;
use crate::stage::{RaysNear, Stage, StageCamera};
use crate::vector::Vector;
use crate::whitted::{Beams, Offspring, Queue, Whitted};

/// Edge of a tile, pixels: small enough to balance, large enough that rays of a tile meet the same bodies and that
/// vectors of them are full.
pub(crate) const TILE: usize = 32;

/// Where a tile lies: its upper left pixel and its size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    pub(crate) x: usize,
    pub(crate) y: usize,
    pub(crate) width: usize,
    pub(crate) height: usize,
}

impl Place {
    /// The tiles of a picture, row by row.
    pub(crate) fn all(width: usize, height: usize) -> impl Iterator<Item = Self> {
        (0..height).step_by(TILE).flat_map(move |y| {
            (0..width).step_by(TILE).map(move |x| Self {
                x,
                y,
                width: TILE.min(width - x),
                height: TILE.min(height - y),
            })
        })
    }

    fn extent(self) -> DVec2 {
        DVec2::new(self.width as f64, self.height as f64)
    }

    /// The tile of this pixel in a picture of `size` pixels that has it.
    pub(crate) fn around(pixel: UVec2, size: UVec2) -> Self {
        let first = |at: u32| at as usize / TILE * TILE;
        let (x, y) = (first(pixel.x), first(pixel.y));
        Self { x, y, width: TILE.min(size.x as usize - x), height: TILE.min(size.y as usize - y) }
    }

    /// The primary rays of the tile, and where the sample of its upper left pixel lies among them.
    fn rays(self, camera: &StageCamera, size: DVec2, sample: u32) -> (RaysNear, Vec2) {
        let middle = DVec2::new(self.x as f64, self.y as f64) + 0.5 * self.extent();
        // The last blocks may reach beyond the tile.
        let reach = 0.5 * self.extent() + LARGEST_BLOCK;
        let offset = (sample_offset(sample) - 0.5 * self.extent()).as_vec2();
        (camera.near(middle, reach, size), offset)
    }

    /// The origin and direction of one of them: those that the rendering of the tile has, bit by bit.
    pub(crate) fn ray(
        self,
        camera: &StageCamera,
        (pixel, size): (UVec2, UVec2),
        sample: u32,
    ) -> (Vector<f32>, Vector<f32>) {
        let (near, offset) = self.rays(camera, size.as_dvec2(), sample);
        let [x, y] = [pixel.x as usize - self.x, pixel.y as usize - self.y];
        near.rays(x as f32 + offset.x, y as f32 + offset.y)
    }

    /// How many pixels it has.
    pub(crate) fn pixels(self) -> usize {
        self.width * self.height
    }
}

/// Traces tiles; reusable from tile to tile by one thread.
pub(crate) struct TileTracer<'a> {
    whitted: Whitted<'a>,
    lanes: Lanes,
    /// The rays that wait, by their distance in the tree from the eye.
    levels: Vec<Level>,
    sums: Vec<[f64; 3]>,
}

/// Rays of the same distance from the eye.
#[derive(Debug, Default)]
struct Level {
    reflected: Queue,
    refracted: Queue,
}

impl<'a> TileTracer<'a> {
    pub(crate) fn new(stage: &'a Stage, camera: &'a StageCamera, control: &'a Control) -> Self {
        Self {
            whitted: Whitted::through(stage, camera, &control.cancel),
            lanes: Lanes::widest(),
            levels: Vec::new(),
            sums: Vec::new(),
        }
    }

    /// The rays traced so far.
    pub(crate) fn counts(&self) -> RayCounts {
        self.whitted.counts()
    }

    /// The light of one sample of each pixel, row by row; `None` if it was cancelled midway.
    pub(crate) fn trace(
        &mut self,
        place: Place,
        size: DVec2,
        sample: u32,
    ) -> Option<impl Iterator<Item = DVec3>> {
        self.sums.clear();
        self.sums.resize(place.pixels(), [0.0; 3]);
        self.whitted.tidy();
        let is_finished = self.lanes.run(Sample { tracer: self, place, size, sample });
        if !is_finished {
            self.levels.iter_mut().for_each(Level::clear);
        }
        is_finished.then(|| self.sums.iter().copied().map(DVec3::from))
    }
}

/// One sample of the pixels of a tile.
struct Sample<'t, 'a> {
    tracer: &'t mut TileTracer<'a>,
    place: Place,
    size: DVec2,
    sample: u32,
}

impl Work for Sample<'_, '_> {
    type Output = bool;

    #[inline(always)]
    fn run<W: Width>(self, w: W) -> bool {
        let Self { tracer, place, size, sample } = self;
        tracer.primary(w, place, size, sample) && tracer.drain(w)
    }
}

impl TileTracer<'_> {
    /// So many rays of a level may wait; then the level behind it is traced, so that memory is bounded.
    const MOST_WAITING: usize = 4096;

    fn is_cancelled(&self) -> bool {
        self.whitted.cancel.load(std::sync::atomic::Ordering::Relaxed)
    }

    /// Traces the rays from the eye, in blocks of neighboring pixels. False if it was cancelled.
    #[inline(always)]
    fn primary<W: Width>(&mut self, w: W, place: Place, size: DVec2, sample: u32) -> bool {
        let block = Block::new(w);
        let (near, offset) = place.rays(self.whitted.camera, size, sample);
        for top in (0..place.height).step_by(block.height) {
            if self.is_cancelled() {
                return false;
            }
            for left in (0..place.width).step_by(block.width) {
                // Whole numbers are added first: a pixel's ray is the same in blocks of every width.
                let x = block.x + left as f32 + offset.x;
                let y = block.y + top as f32 + offset.y;
                let rays = near.rays(x, y);
                let (lanes, pixels) = block.pixels(place, left, top);
                let beams = self.whitted.roots(w, rays, w.load_words(&pixels), w.mask(lanes));
                self.follow(w, &beams, 0);
            }
        }
        true
    }

    /// Traces the rays that wait, the nearest to the eye first. False if it was cancelled.
    #[inline(always)]
    fn drain<W: Width>(&mut self, w: W) -> bool {
        let mut at = 0;
        loop {
            if self.is_cancelled() {
                return false;
            }
            if self.waiting(at) > 0 {
                let beams = self.levels[at].take(w);
                self.follow(w, &beams, at + 1);
                if self.waiting(at + 1) >= Self::MOST_WAITING {
                    at += 1;
                }
            } else if self.waiting(at + 1) > 0 {
                at += 1;
            } else if at > 0 {
                at -= 1;
            } else {
                return true;
            }
        }
    }

    fn waiting(&self, level: usize) -> usize {
        self.levels.get(level).map_or(0, |level| level.reflected.len() + level.refracted.len())
    }

    /// Traces rays; those that grow from them wait at `level`.
    #[inline(always)]
    fn follow<W: Width>(&mut self, w: W, beams: &Beams<W>, level: usize) {
        if self.levels.len() <= level {
            self.levels.resize_with(level + 1, Level::default);
        }
        let followed = self.whitted.follow(w, beams, &mut self.levels[level]);
        self.add(beams, followed.light);
    }

    /// Adds light to the pixels that it belongs to.
    #[inline(always)]
    fn add<W: Width>(&mut self, beams: &Beams<W>, light: Vector<W::R>) {
        use crate::lanes::Word as _;
        let mut pixels = [0; MOST_LANES];
        beams.pixel.store(&mut pixels);
        // An iterator over arrays of vectors would move them through memory, unaligned.
        let [mut red, mut green, mut blue] = [[0.0; MOST_LANES]; 3];
        light.x.store(&mut red);
        light.y.store(&mut green);
        light.z.store(&mut blue);
        let mut left = beams.lanes.bits();
        while left != 0 {
            let lane = left.trailing_zeros() as usize % MOST_LANES;
            left &= left - 1;
            if let Some(sum) = self.sums.get_mut(pixels[lane] as usize) {
                sum[0] += f64::from(red[lane]);
                sum[1] += f64::from(green[lane]);
                sum[2] += f64::from(blue[lane]);
            }
        }
    }
}

impl Level {
    #[inline(always)]
    fn take<W: Width>(&mut self, w: W) -> Beams<W> {
        let queue = if self.reflected.len() > 0 { &mut self.reflected } else { &mut self.refracted };
        queue.take(w)
    }

    fn clear(&mut self) {
        self.reflected.clear();
        self.refracted.clear();
    }
}

impl<W: Width> Offspring<W> for Level {
    #[inline(always)]
    fn reflected(&mut self, beams: Beams<W>) {
        self.reflected.push(&beams);
    }

    #[inline(always)]
    fn refracted(&mut self, beams: Beams<W>) {
        self.refracted.push(&beams);
    }
}

/// Neighboring pixels whose rays are traced side by side.
struct Block<W: Width> {
    width: usize,
    height: usize,
    /// Where the corners of the pixels lie, relative to that of the block.
    x: W::R,
    y: W::R,
}

/// No block has more pixels across or down.
const LARGEST_BLOCK: DVec2 = DVec2::splat(4.0);

impl<W: Width> Block<W> {
    #[inline(always)]
    fn new(w: W) -> Self {
        let width = if W::LANES >= 8 { 4 } else { 2.min(W::LANES) };
        let height = W::LANES / width;
        let [mut x, mut y] = [[0.0; MOST_LANES]; 2];
        for lane in 0..W::LANES {
            x[lane] = (lane % width) as f32;
            y[lane] = (lane / width) as f32;
        }
        Self { width, height, x: w.load(&x), y: w.load(&y) }
    }

    /// A bit for each pixel that lies in the tile, and their places in it.
    #[inline(always)]
    fn pixels(&self, place: Place, left: usize, top: usize) -> (u32, [u32; MOST_LANES]) {
        let mut lanes = 0;
        let mut pixels = [0; MOST_LANES];
        for (lane, pixel) in pixels.iter_mut().enumerate().take(W::LANES) {
            let (x, y) = (left + lane % self.width, top + lane / self.width);
            if x < place.width && y < place.height {
                lanes |= 1 << lane;
                *pixel = (y * place.width + x) as u32;
            }
        }
        (lanes, pixels)
    }
}

#[cfg(test)]
mod tests;
