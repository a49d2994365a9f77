//! One sample of a tile, whose pixels are looked at in the tracer's own blocks, along its own primary rays.

use glam::{UVec2, Vec2};

use crate::raster::sample_sums::FrameSize;
use crate::simd::{Width, Word as _};
use crate::transport::camera::CameraRays;
use crate::transport::path::PathState;
use crate::transport::sampler::Sampler;
use crate::transport::shading::ShadingContext;
use crate::transport::tile::PixelBlock;
use crate::transport::tile_rect::{TILE, TileRect};

/// Some rows of a tile of the picture, in one sample.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileSample {
    tile: TileRect,
    /// The rows of the tile.
    part: TileRect,
    frame: FrameSize,
    sample: u32,
}

impl TileSample {
    /// The sample of a `part` of the picture that lies within one tile.
    pub(crate) fn new(part: TileRect, frame: FrameSize, sample: u32) -> Self {
        let size = UVec2::new(frame.width as u32, frame.height as u32);
        let tile = TileRect::around(UVec2::new(part.x as u32, part.y as u32), size, TILE);
        Self { tile, part, frame, sample }
    }

    /// Which sample it is.
    pub(crate) fn sample(&self) -> u32 {
        self.sample
    }

    /// Shows `take` block by block: the primary rays of its pixels, their `lanes` those that lie in the part, and the column
    /// in the picture and row in the part of the first.
    #[inline(always)]
    pub(crate) fn each_block<'a, W: Width>(
        &self,
        w: W,
        shading: &mut ShadingContext<'a>,
        mut take: impl FnMut(&mut ShadingContext<'a>, &mut PathState<W>, (usize, usize)),
    ) {
        let Self { tile, part, frame, sample } = *self;
        let [width, height] = PixelBlock::<W>::SIZE;
        let across = tile.width.div_ceil(width);
        let (near, reach, offset): (CameraRays, _, Vec2) = tile.rays(shading.camera, frame.size(), sample);
        shading.trim_media();
        shading.begin_sample(sample, Sampler::new(sample, [tile.x, tile.y], [width, height], across));
        shading.begin_tile(&near, reach);
        let block = PixelBlock::new(w);
        let mut paths = PathState::from_eye(w);
        for top in (0..part.height).step_by(height) {
            let row = part.y - tile.y + top;
            for left in (0..part.width).step_by(width) {
                // Whole numbers are added first: a pixel's ray is the same in blocks of every width.
                let (x, y) = (block.x + left as f32 + offset.x, block.y + row as f32 + offset.y);
                paths.rays.set(near.rays(x, y));
                paths.lanes = w.mask(PixelBlock::<W>::lanes(part, left, top));
                let first = (row / height * across + left / width) * W::LANES;
                paths.pixel = block.pixel.plus(w.word(first as u32));
                take(shading, &mut paths, (part.x + left, top));
            }
        }
    }
}
