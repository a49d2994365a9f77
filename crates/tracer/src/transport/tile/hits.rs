//! The points that the primary rays of a tile meet.

use bytemuck::{Pod, Zeroable};

use crate::geometry::ray::NO_START;
use crate::simd::{Float as _, Float32 as _, MOST_LANES, Mask as _, Width, Word as _, each_lane};
use crate::transport::camera::{RenderCamera, ScreenDepth};
use crate::transport::interaction::SurfaceInteraction;
use crate::transport::path::PathState;
use crate::transport::tile::PixelBlock;
use crate::transport::tile::radiance::{BlockLayout, first_of_neighbors};

/// How deep the surface lies that a pixel shows, and which one it is: all that a search on the screen reads of most pixels.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct SurfaceTexel {
    /// A number of [`ScreenDepth`].
    pub(crate) depth: f32,
    /// [`RayOrigin::word`](crate::geometry::ray::RayOrigin::word) of rays on the viewer's side.
    pub(crate) start: u32,
}

impl SurfaceTexel {
    /// The background.
    pub(crate) const EMPTY: Self = Self { depth: ScreenDepth::NOTHING, start: NO_START };

    pub(crate) fn is_empty(self) -> bool {
        self.start == NO_START
    }
}

/// Rows of the buffers that the points of a tile are written to, from the uppermost on.
#[derive(Default)]
pub(crate) struct FirstHitRows<'r> {
    pub(crate) positions: Vec<&'r mut [[f32; 3]]>,
    pub(crate) normals: Vec<&'r mut [[f32; 3]]>,
    pub(crate) surfaces: Vec<&'r mut [SurfaceTexel]>,
}

/// The points that the primary rays of a tile or a group meet, in the order of a [`BlockLayout`].
pub(crate) struct TileHits {
    depth: ScreenDepth,
    positions: [Vec<f32>; 3],
    normals: [Vec<f32>; 3],
    depths: Vec<f32>,
    starts: Vec<u32>,
}

impl TileHits {
    pub(crate) fn new(camera: &RenderCamera) -> Self {
        Self {
            depth: ScreenDepth::new(camera),
            positions: Default::default(),
            normals: Default::default(),
            depths: Vec::new(),
            starts: Vec::new(),
        }
    }

    /// Forgets all points, and prepares for so many pixels.
    pub(crate) fn begin(&mut self, pixels: usize) {
        let planes = self.positions.iter_mut().chain(&mut self.normals);
        planes.filter(|plane| plane.len() < pixels).for_each(|plane| plane.resize(pixels, 0.0));
        self.depths.clear();
        self.depths.resize(pixels, SurfaceTexel::EMPTY.depth);
        self.starts.clear();
        self.starts.resize(pixels, SurfaceTexel::EMPTY.start);
    }

    /// Takes up the points that the rays `hit` met.
    #[inline(always)]
    pub(crate) fn record<W: Width>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        hit: W::M,
        at: &SurfaceInteraction<W>,
    ) {
        let depths = self.depth.of_point(at.position);
        let first = if (!paths.lanes).any() { None } else { first_of_neighbors(w, paths) };
        let (position, normal) = (at.position, at.bsdf.normal);
        let [x, y, z] = &mut self.positions;
        let [normal_x, normal_y, normal_z] = &mut self.normals;
        let planes = [
            (x, position.x),
            (y, position.y),
            (z, position.z),
            (normal_x, normal.x),
            (normal_y, normal.y),
            (normal_z, normal.z),
        ];
        if let Some(first) = first {
            planes.into_iter().for_each(|(plane, part)| part.store(&mut plane[first..]));
            W::R::select(hit, depths, w.real(SurfaceTexel::EMPTY.depth)).store(&mut self.depths[first..]);
            W::W::select(hit, at.start, w.word(SurfaceTexel::EMPTY.start)).store(&mut self.starts[first..]);
            return;
        }
        let mut pixels = [0; MOST_LANES];
        paths.pixel.store(&mut pixels);
        let scatter = |plane: &mut [f32], part: W::R| {
            let mut numbers = [0.0; MOST_LANES];
            part.store(&mut numbers);
            each_lane(hit.bits(), |lane| plane[pixels[lane] as usize] = numbers[lane]);
        };
        planes.into_iter().for_each(|(plane, part)| scatter(plane, part));
        scatter(&mut self.depths, depths);
        let mut starts = [0; MOST_LANES];
        at.start.store(&mut starts);
        each_lane(hit.bits(), |lane| self.starts[pixels[lane] as usize] = starts[lane]);
    }

    /// Writes the points into rows of pixels, as the blocks are that rays of this width were traced in.
    #[inline(always)]
    pub(crate) fn write<W: Width>(&self, w: W, layout: &BlockLayout, rows: &mut FirstHitRows<'_>) {
        let [width, _] = PixelBlock::<W>::SIZE;
        let FirstHitRows { positions, normals, surfaces } = rows;
        for (planes, rows) in [(&self.positions, positions), (&self.normals, normals)] {
            let [x, y, z] = planes;
            for (row, to) in rows.iter_mut().enumerate() {
                layout.write_threes(w, ([x, y, z], row), to, |number: f32| number);
            }
        }
        for (row, to) in surfaces.iter_mut().enumerate() {
            let starts = (layout.start(row)..).step_by(W::LANES);
            for (to, first) in to.chunks_mut(width).zip(starts) {
                let (depths, starts) =
                    (&self.depths[first..first + width], &self.starts[first..first + width]);
                for ((to, &depth), &start) in to.iter_mut().zip(depths).zip(starts) {
                    *to = SurfaceTexel { depth, start };
                }
            }
        }
    }
}
