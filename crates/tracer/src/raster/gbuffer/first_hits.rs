//! The first hits of a picture's primary rays and their local light: the same packets as the tracer's first generation.

use rayon::prelude::*;

use crate::geometry::membership::MembershipSource as _;
use crate::geometry::query::PacketHits;
use crate::geometry::ray::RayOrigin;
use crate::raster::error::MethodError;
use crate::raster::gbuffer::GBufferTexel;
use crate::raster::point_shader::exact;
use crate::raster::sample_sums::FrameSize;
use crate::raster::tile_sample::TileSample;
use crate::simd::vector::Vector;
use crate::simd::{Float32 as _, MOST_LANES, Mask as _, SimdKernel, Width, Word as _};
use crate::transport::camera::RenderCamera;
use crate::transport::control::RenderControl;
use crate::transport::counts::RayCounts;
use crate::transport::path::{PathState, Unobserved};
use crate::transport::scene::RenderScene;
use crate::transport::shading::{PacketSource, ShadingContext};
use crate::transport::tile::PixelBlock;
use crate::transport::tile_rect::{TILE, TileRect};

/// Rows that a thread takes at once, whole blocks of every width.
const BAND: usize = 32;

/// Finds what each pixel shows in a sample, and how it is lit.
pub(crate) fn find_first_hits(
    (scene, camera): (&RenderScene, &RenderCamera),
    frame: FrameSize,
    sample: u32,
    control: &RenderControl,
    texels: &mut [GBufferTexel],
    lit: &mut [Vector<f32>],
) -> Result<RayCounts, MethodError> {
    let width = frame.width;
    let rows = BAND * width;
    let bands = texels.par_chunks_mut(rows).zip(lit.par_chunks_mut(rows)).enumerate();
    let counts = bands.map_init(
        || ShadingContext::new(scene, camera),
        |shading, (band, (texels, lit))| {
            let before = shading.counts;
            let place = TileRect { x: 0, y: band * BAND, width, height: texels.len() / width };
            for part in place.squares(TILE) {
                if control.is_cancelled() {
                    break;
                }
                let part = TileSample::new(part, frame, sample);
                if scene.is_full {
                    scene.lanes.run_in_few(FirstHitKernel::<true> { shading, part, width, texels, lit });
                } else {
                    scene.lanes.run_in_few(FirstHitKernel::<false> { shading, part, width, texels, lit });
                }
            }
            control.add_pixels(place.pixels() as u64);
            shading.counts - before
        },
    );
    let counts = counts.reduce(RayCounts::default, std::ops::Add::add);
    if control.is_cancelled() { Err(MethodError::Cancelled) } else { Ok(counts) }
}

/// One sample of some rows of a tile. `FULL` stands where [`RenderScene::is_full`] may be true.
struct FirstHitKernel<'k, 'a, const FULL: bool> {
    shading: &'k mut ShadingContext<'a>,
    part: TileSample,
    /// Of the picture, pixels.
    width: usize,
    /// From the pixel in the first column of the first of these rows on.
    texels: &'k mut [GBufferTexel],
    lit: &'k mut [Vector<f32>],
}

impl<const FULL: bool> SimdKernel for FirstHitKernel<'_, '_, FULL> {
    type Output = ();

    #[inline(always)]
    fn run<W: Width>(self, w: W) {
        let Self { shading, part, width, texels, lit } = self;
        part.each_block(
            w,
            shading,
            #[inline(always)]
            |shading, paths, (x, y)| {
                shading.start_paths(w, paths);
                let found = FirstHitPacket::find::<FULL>(w, shading, paths);
                found.each_lane(shading.camera, paths.lanes.bits(), |lane, texel, light| {
                    let [x, y] = PixelBlock::<W>::place(lane, (x, y));
                    let pixel = y * width + x;
                    texels.get_mut(pixel).into_iter().for_each(|to| *to = texel);
                    lit.get_mut(pixel).into_iter().for_each(|to| *to = light);
                });
            },
        );
    }
}

/// What the rays of a packet met.
struct FirstHitPacket<W: Width> {
    hit: W::M,
    /// Body and side, as a word.
    start: W::W,
    position: Vector<W::R>,
    /// The direction of the rays that met nothing.
    normal: Vector<W::R>,
    light: Vector<W::R>,
}

impl<W: Width> FirstHitPacket<W> {
    #[inline(always)]
    fn find<const FULL: bool>(w: W, shading: &mut ShadingContext<'_>, paths: &PathState<W>) -> Self {
        let scene = shading.scene;
        let mut membership = std::mem::take(&mut shading.membership);
        shading.media.fill::<W>(&mut membership, paths.media, paths.lanes);
        let mut from = PacketSource::Eye;
        let hits = shading.closest_hit(w, paths, &from, &membership);
        let hit = hits.hit & paths.lanes;
        let direction = paths.rays.direction;
        let background = if FULL {
            scene.sky.light(w, direction, paths.lanes & !hit)
        } else {
            Vector::splat(w.real(0.0), scene.sky.even())
        };
        let mut found =
            Self { hit, start: w.word(0), position: direction, normal: direction, light: background };
        if hit.any() {
            let hits = PacketHits { hit, ..hits };
            let at = shading.interaction::<W, FULL>(w, paths, &hits);
            let light =
                shading.direct_light::<W, FULL>(w, paths, &mut from, &membership, &at, &mut Unobserved);
            found.start = at.start;
            found.position = at.position;
            found.normal = Vector::select(hit, at.bsdf.normal, direction);
            found.light = Vector::select(hit, light, background);
        }
        shading.membership = membership;
        found
    }

    /// Shows `take` the texel and the light of each of `lanes`.
    #[inline(always)]
    fn each_lane(
        self,
        camera: &RenderCamera,
        lanes: u32,
        mut take: impl FnMut(usize, GBufferTexel, Vector<f32>),
    ) {
        let mut rows = [[0.0; MOST_LANES]; 9];
        let mut starts = [0; MOST_LANES];
        let Self { hit, start, position, normal, light } = self;
        let parts =
            [position.x, position.y, position.z, normal.x, normal.y, normal.z, light.x, light.y, light.z];
        for (row, part) in rows.iter_mut().zip(parts) {
            part.store(row);
        }
        start.store(&mut starts);
        let hit = hit.bits();
        let mut left = lanes;
        while left != 0 {
            let lane = left.trailing_zeros() as usize % MOST_LANES;
            left &= left - 1;
            let vector = |first: usize| Vector {
                x: rows[first][lane],
                y: rows[first + 1][lane],
                z: rows[first + 2][lane],
            };
            let normal = vector(3);
            let texel = if hit >> lane & 1 == 1 {
                let position = vector(0);
                let depth = camera.depth(exact(position)) as f32;
                GBufferTexel { start: RayOrigin::of_word(starts[lane]), depth, position, normal }
            } else {
                GBufferTexel { normal, ..GBufferTexel::EMPTY }
            };
            take(lane, texel, vector(6));
        }
    }
}
