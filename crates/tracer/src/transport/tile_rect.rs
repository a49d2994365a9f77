//! The squares that a picture is traced in, and their primary rays.

use glam::{DVec2, UVec2, Vec2};

use crate::simd::vector::Vector;
use crate::transport::camera::{CameraRays, RenderCamera};
use crate::transport::sampling::sample_offset;

/// Edge of a tile, pixels: small enough to balance, large enough that rays of a tile meet the same bodies and that
/// vectors of them are full.
pub(crate) const TILE: usize = 64;

/// No block has more pixels across or down.
const LARGEST_BLOCK: DVec2 = DVec2::splat(8.0);

/// Where a tile or a group of them lies: its upper left pixel and its size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TileRect {
    pub(crate) x: usize,
    pub(crate) y: usize,
    pub(crate) width: usize,
    pub(crate) height: usize,
}

impl TileRect {
    /// The squares of a picture, row by row; those at its right and lower borders may be smaller.
    pub(crate) fn all(width: usize, height: usize, edge: usize) -> impl Iterator<Item = Self> {
        Self { x: 0, y: 0, width, height }.squares(edge)
    }

    /// The squares that it is made of, row by row.
    pub(crate) fn squares(self, edge: usize) -> impl Iterator<Item = Self> {
        let Self { x: left, y: top, width, height } = self;
        (0..height).step_by(edge).flat_map(move |y| {
            (0..width).step_by(edge).map(move |x| Self {
                x: left + x,
                y: top + y,
                width: edge.min(width - x),
                height: edge.min(height - y),
            })
        })
    }

    fn extent(self) -> DVec2 {
        DVec2::new(self.width as f64, self.height as f64)
    }

    /// The square of this pixel in a picture of `size` pixels that has it.
    pub(crate) fn around(pixel: UVec2, size: UVec2, edge: usize) -> Self {
        let first = |at: u32| at as usize / edge * edge;
        let (x, y) = (first(pixel.x), first(pixel.y));
        Self { x, y, width: edge.min(size.x as usize - x), height: edge.min(size.y as usize - y) }
    }

    /// The primary rays of the tile as they are for every sample.
    pub(crate) fn rays_near(self, camera: &RenderCamera, size: DVec2) -> CameraRays {
        self.rays(camera, size, 0).0
    }

    /// The primary rays of the tile, how far they reach, and where the sample of its upper left pixel lies among them.
    pub(crate) fn rays(self, camera: &RenderCamera, size: DVec2, sample: u32) -> (CameraRays, DVec2, Vec2) {
        let middle = DVec2::new(self.x as f64, self.y as f64) + 0.5 * self.extent();
        // The last blocks may reach beyond the tile.
        let reach = 0.5 * self.extent() + LARGEST_BLOCK;
        let offset = (sample_offset(sample) - 0.5 * self.extent()).as_vec2();
        (camera.near(middle, reach, size), reach, offset)
    }

    /// The origin and direction of one of them: those that the rendering of the tile has, bit by bit.
    pub(crate) fn ray(
        self,
        camera: &RenderCamera,
        (pixel, size): (UVec2, UVec2),
        sample: u32,
    ) -> (Vector<f32>, Vector<f32>) {
        let (near, _, offset) = self.rays(camera, size.as_dvec2(), sample);
        let [x, y] = [pixel.x as usize - self.x, pixel.y as usize - self.y];
        near.rays(x as f32 + offset.x, y as f32 + offset.y)
    }

    /// How many pixels it has.
    pub(crate) fn pixels(self) -> usize {
        self.width * self.height
    }
}
