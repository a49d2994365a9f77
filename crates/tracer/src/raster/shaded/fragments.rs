//! What the pixels of a sample show of a batch of faces: interpolated, lit, colored.

use catoptric_picture::SizeError;
use glam::{DVec2, DVec3, Vec3};
use rayon::prelude::*;

use crate::geometry::membership::MembershipSource as _;
use crate::geometry::ray::{INWARDS, RayOrigin};
use crate::raster::error::MethodError;
use crate::raster::point_shader::colors_of;
use crate::raster::rasterizer::{NO_TRIANGLE, VisibilityBuffer};
use crate::raster::sample_sums::FrameSize;
use crate::raster::settings::LightModel;
use crate::raster::shaded::batch::FaceBatch;
use crate::raster::shaded::{ShadingFrequency, ShadingJob};
use crate::raster::tile_sample::TileSample;
use crate::simd::vector::Vector;
use crate::simd::{MOST_LANES, Mask as _, SimdKernel, Width, Word as _};
use crate::transport::counts::RayCounts;
use crate::transport::interaction::{SurfaceInteraction, each_word};
use crate::transport::path::{PathState, Unobserved};
use crate::transport::sampling::sample_offset;
use crate::transport::shading::{PacketSource, ShadingContext};
use crate::transport::tile::PixelBlock;
use crate::transport::tile_rect::{TILE, TileRect};

/// Rows that a thread takes at once, whole blocks of every width.
pub(crate) const BAND: usize = 32;

/// What is known of the pixels of a sample.
pub(crate) struct SampleBuffers {
    pub(crate) visible: VisibilityBuffer,
    /// The light of faces of earlier batches; empty as long as there are none.
    earlier: Vec<[f32; 3]>,
    /// The body that each pixel shows in the first sample.
    pub(crate) bodies: Vec<u32>,
}

impl SampleBuffers {
    pub(crate) fn new(frame: FrameSize) -> Result<Self, SizeError> {
        let visible = VisibilityBuffer::new(frame)?;
        Ok(Self { visible, earlier: Vec::new(), bodies: frame.buffer(u32::MAX)? })
    }

    /// Gives the pixels in which faces of `batch` are nearest their light. The last batch of a sample adds the light of all
    /// pixels to the `sums` of the picture.
    pub(crate) fn shade(
        &mut self,
        job: &ShadingJob<'_>,
        batch: &FaceBatch,
        sample: u32,
        sums: &mut [DVec3],
    ) -> Result<RayCounts, MethodError> {
        let is_last = batch.is_last;
        if !is_last && self.earlier.is_empty() {
            self.earlier = job.frame.buffer([0.0; 3])?;
        }
        let (scene, width) = (job.scene, job.frame.width);
        let bands: Vec<FragmentBand<'_>> = self.bands(width, sample, sums).collect();
        let counts = bands.into_par_iter().map_init(
            || ShadingContext::new(scene, job.camera),
            |shading, mut band| {
                let before = shading.counts;
                let place = TileRect { x: 0, y: band.y, width, height: band.sums.len() / width };
                for part in place.squares(TILE) {
                    if job.control.is_cancelled() {
                        break;
                    }
                    let part = TileSample::new(part, job.frame, sample);
                    let band = &mut band;
                    if scene.is_full {
                        scene.lanes.run_in_few(FragmentKernel::<true> { job, batch, shading, part, band });
                    } else {
                        scene.lanes.run_in_few(FragmentKernel::<false> { job, batch, shading, part, band });
                    }
                }
                if is_last {
                    job.control.add_pixels(place.pixels() as u64);
                }
                shading.counts - before
            },
        );
        let counts = counts.reduce(RayCounts::default, std::ops::Add::add);
        if job.control.is_cancelled() { Err(MethodError::Cancelled) } else { Ok(counts) }
    }

    fn bands<'b>(
        &'b mut self,
        width: usize,
        sample: u32,
        sums: &'b mut [DVec3],
    ) -> impl Iterator<Item = FragmentBand<'b>> {
        let Self { visible, earlier, bodies } = self;
        let (stride, size) = (visible.stride, BAND * width);
        let bodies: &mut [u32] = if sample == 0 { bodies } else { &mut [] };
        let (mut earlier, mut bodies) = (earlier.chunks_mut(size), bodies.chunks_mut(size));
        let visible = visible.depths.chunks(BAND * stride).zip(visible.triangles.chunks(BAND * stride));
        let rows = sums.chunks_mut(size).zip(visible);
        rows.zip((0..).step_by(BAND)).map(move |((sums, (depths, triangles)), y)| {
            let (earlier, bodies) = (earlier.next().unwrap_or_default(), bodies.next().unwrap_or_default());
            FragmentBand { y, width, stride, sums, earlier, bodies, depths, triangles }
        })
    }
}

/// Rows of a picture, of its buffers and of the batch that was drawn last.
struct FragmentBand<'b> {
    /// The first row in the picture.
    y: usize,
    /// Pixels from one row of the picture to the next.
    width: usize,
    /// Pixels from one row of the visibility buffer to the next.
    stride: usize,
    /// Where the light of samples adds up.
    sums: &'b mut [DVec3],
    /// The light of faces of earlier batches; empty as long as there are none.
    earlier: &'b mut [[f32; 3]],
    /// The body that each pixel shows; empty in other samples than the first.
    bodies: &'b mut [u32],
    /// Distances of the nearest faces along the view, meters.
    depths: &'b [f64],
    /// Numbers of the nearest triangles of the batch.
    triangles: &'b [u32],
}

impl FragmentBand<'_> {
    /// The numbers of the triangles in a block.
    #[inline(always)]
    fn triangles_of<W: Width>(&self, (x, y): (usize, usize)) -> [u32; MOST_LANES] {
        let [width, height] = PixelBlock::<W>::SIZE;
        let mut numbers = [NO_TRIANGLE; MOST_LANES];
        for (row, numbers) in numbers.chunks_exact_mut(width).take(height).enumerate() {
            let first = (y + row) * self.stride + x;
            if let Some(found) = self.triangles.get(first..first + width) {
                numbers.copy_from_slice(found);
            }
        }
        numbers
    }

    /// Takes up the light of the pixels of a block. `starts` are those of the `seen` lanes, which show faces of the batch;
    /// others have the light that is behind all faces.
    #[inline(always)]
    fn take<W: Width>(
        &mut self,
        (x, y): (usize, usize),
        (seen, starts): (u32, &[u32; MOST_LANES]),
        light: &[[f32; 3]; MOST_LANES],
        is_last: bool,
    ) {
        let [width, height] = PixelBlock::<W>::SIZE;
        let count = width.min(self.width - x);
        let rows = light.chunks_exact(width).zip(starts.chunks_exact(width)).take(height).enumerate();
        for (row, (light, starts)) in rows {
            let first = (y + row) * self.width + x;
            let seen = seen >> (row * width);
            let is_seen = |column: usize| seen >> column & 1 == 1;
            if let Some(bodies) = self.bodies.get_mut(first..first + count) {
                for (column, (body, start)) in bodies.iter_mut().zip(starts).enumerate() {
                    if is_seen(column) {
                        *body = RayOrigin::of_word(*start).body;
                    }
                }
            }
            let Some(sums) = self.sums.get_mut(first..first + count) else { continue };
            let Some(earlier) = self.earlier.get_mut(first..first + count) else {
                for (sum, light) in sums.iter_mut().zip(light) {
                    *sum += Vec3::from(*light).as_dvec3();
                }
                continue;
            };
            let first_depth = (y + row) * self.stride + x;
            let depths = self.depths.get(first_depth..first_depth + count).unwrap_or_default();
            for (column, ((sum, earlier), (light, depth))) in
                sums.iter_mut().zip(earlier).zip(light.iter().zip(depths)).enumerate()
            {
                // What is neither of this batch nor background is of an earlier one.
                if is_seen(column) || depth.is_infinite() {
                    *earlier = *light;
                }
                if is_last {
                    *sum += Vec3::from(*earlier).as_dvec3();
                }
            }
        }
    }
}

/// One sample of some rows of a tile. `FULL` stands where [`RenderScene::is_full`](crate::RenderScene) may be true.
struct FragmentKernel<'k, 'a, 'b, const FULL: bool> {
    job: &'k ShadingJob<'a>,
    batch: &'k FaceBatch,
    shading: &'k mut ShadingContext<'a>,
    part: TileSample,
    band: &'k mut FragmentBand<'b>,
}

impl<const FULL: bool> SimdKernel for FragmentKernel<'_, '_, '_, FULL> {
    type Output = ();

    #[inline(always)]
    fn run<W: Width>(self, w: W) {
        let Self { job, batch, shading, part, band } = self;
        let offset = sample_offset(part.sample());
        part.each_block(
            w,
            shading,
            #[inline(always)]
            |shading, paths, at| {
                let lanes = paths.lanes;
                let numbers = w.load_words(&band.triangles_of::<W>(at));
                let seen = lanes & !numbers.is(NO_TRIANGLE);
                let mut light = Vector::splat(w.real(0.0), job.scene.sky.even());
                if FULL && batch.is_last && (lanes & !seen).any() {
                    light = job.scene.sky.light(w, paths.rays.direction, lanes & !seen);
                }
                let mut starts = [0; MOST_LANES];
                if seen.any() {
                    paths.lanes = seen;
                    let places = block_places::<W>((at.0, band.y + at.1), offset);
                    let fragments = BlockFragments::new(w, batch, numbers, seen, &places);
                    fragments.start.store(&mut starts);
                    let own = fragments.light::<FULL>(w, job, shading, paths);
                    light = Vector::select(seen, own, light);
                }
                let mut colors = [[0.0; 3]; MOST_LANES];
                w.store_threes([light.x, light.y, light.z], &mut colors);
                band.take::<W>(at, (seen.bits(), &starts), &colors, batch.is_last);
            },
        );
    }
}

/// The columns and rows where the samples of a block lie, whose first pixel is this one.
#[inline(always)]
fn block_places<W: Width>((x, y): (usize, usize), offset: DVec2) -> [[f64; MOST_LANES]; 2] {
    let mut places = [[0.0; MOST_LANES]; 2];
    let [columns, rows] = &mut places;
    for (lane, (column, row)) in columns.iter_mut().zip(rows).enumerate().take(W::LANES) {
        let [x, y] = PixelBlock::<W>::place(lane, (x, y));
        (*column, *row) = (x as f64 + offset.x, y as f64 + offset.y);
    }
    places
}

/// What the pixels of a block show of a batch.
struct BlockFragments<W: Width> {
    /// Body and side, as a word.
    start: W::W,
    /// The interpolated values of the triangles' corners.
    values: [Vector<W::R>; 3],
}

impl<W: Width> BlockFragments<W> {
    /// Looks at the triangles one after the other: neighboring pixels mostly show the same.
    #[inline(always)]
    fn new(w: W, batch: &FaceBatch, numbers: W::W, lanes: W::M, places: &[[f64; MOST_LANES]; 2]) -> Self {
        let mut all = Self { start: w.word(0), values: [Vector::splat(w.real(0.0), [0.0; 3]); 3] };
        each_word::<W>(
            numbers,
            lanes,
            #[inline(always)]
            |number, same| {
                let Some(triangle) = batch.triangles.get(number as usize) else { return };
                all.start = W::W::select(same, w.word(triangle.start), all.start);
                let values = triangle.values(w, &batch.corners, places);
                for (all, value) in all.values.iter_mut().zip(values) {
                    *all = Vector::select(same, value, *all);
                }
            },
        );
        all
    }

    /// The light that comes to the eye from where the `paths` meet the faces.
    #[inline(always)]
    fn light<const FULL: bool>(
        &self,
        w: W,
        job: &ShadingJob<'_>,
        shading: &mut ShadingContext<'_>,
        paths: &mut PathState<W>,
    ) -> Vector<W::R> {
        let scene = job.scene;
        let Self { start, values: [first, second, in_body] } = *self;
        if job.shading != ShadingFrequency::Phong {
            let mut color = first;
            each_word::<W>(
                start.and(!INWARDS),
                paths.lanes,
                #[inline(always)]
                |index, same| {
                    let own = colors_of(w, scene, scene.geometry.body(index), (in_body, in_body), same);
                    color = Vector::select(same, own, color);
                },
            );
            return first.times(color) + second;
        }
        shading.enter_media_at_eye(w, paths);
        let mut membership = std::mem::take(&mut shading.membership);
        shading.media.fill::<W>(&mut membership, paths.media, paths.lanes);
        let normal = second.normalize_or(Vector::splat(w.real(0.0), [0.0, 1.0, 0.0]));
        let (points, direction) = ((first, normal), paths.rays.direction);
        let mut at = SurfaceInteraction::at_points::<FULL>(
            w,
            scene,
            start,
            points,
            direction,
            paths.lanes,
            #[inline(always)]
            |body, same| colors_of(w, scene, body, (in_body, in_body), same),
        );
        if job.settings.model == LightModel::Lambert {
            (at.bsdf.glossy, at.bsdf.rough) = (w.mask(0), w.mask(0));
        }
        let mut from = if job.settings.shadows { PacketSource::Anywhere } else { PacketSource::Unshadowed };
        let light = shading.direct_light::<W, FULL>(w, paths, &mut from, &membership, &at, &mut Unobserved);
        shading.membership = membership;
        light
    }
}
