//! The squares that a picture is traced in, and the rays of a square side by side.

pub(crate) mod hits;
pub(crate) mod radiance;

use glam::{DVec2, Vec2};

use crate::geometry::bvh::stream::STREAM;
use crate::simd::vector::Vector;
use crate::simd::{MOST_LANES, Mask as _, SceneKernel, SimdKernel, Width, Word as _};
use crate::transport::camera::{CameraRays, RenderCamera};
use crate::transport::control::RenderControl;
use crate::transport::counts::RayCounts;
use crate::transport::integrator::whitted::WhittedIntegrator;
use crate::transport::interaction::SurfaceInteraction;
use crate::transport::path::{PathObserver, PathState, RayQueue, SecondaryRays};
use crate::transport::sampler::Sampler;
use crate::transport::scene::RenderScene;
use crate::transport::shading::PacketSource;
use crate::transport::stream::StreamShading;
use crate::transport::tile::hits::{FirstHitRows, TileHits};
use crate::transport::tile::radiance::TileRadiance;
use crate::transport::tile_rect::{TILE, TileRect};

/// Where rays go by streams, threads take so many tiles across and down at once: of more rays, more meet the same part of
/// the hierarchy.
const GROUP: usize = 2;

/// If that leaves so many groups in a picture, so that threads still find enough of them.
const LEAST_GROUPS: usize = 40;

/// Edge of the squares of a picture that threads take one by one, pixels: one tile or a [`GROUP`]. It depends on no number
/// of threads, since the order does in which the light of a pixel's rays is summed.
pub(crate) fn edge_for(scene: &RenderScene, width: usize, height: usize) -> usize {
    let edge = GROUP * TILE;
    let is_large = width.div_ceil(edge) * height.div_ceil(edge) >= LEAST_GROUPS;
    if is_large && scene.goes_by_streams() { edge } else { TILE }
}

/// Traces tiles and groups of them; reusable from one to the next by one thread.
pub(crate) struct TileRenderer<'a> {
    whitted: WhittedIntegrator<'a>,
    control: &'a RenderControl,
    /// The rays that `control` knows of.
    rays_told: u64,
    /// The rays that wait, by their distance in the tree from the eye.
    levels: Vec<DepthQueues>,
    /// Made when they are needed.
    streams: Option<StreamShading>,
    light: TileRadiance,
    /// What primary rays meet, if that is wanted: then these are all rays.
    hits: Option<TileHits>,
}

/// Rays of the same distance from the eye.
#[derive(Debug, Default)]
struct DepthQueues {
    reflected: RayQueue,
    refracted: RayQueue,
}

impl<'a> TileRenderer<'a> {
    pub(crate) fn new(scene: &'a RenderScene, camera: &'a RenderCamera, control: &'a RenderControl) -> Self {
        Self {
            whitted: WhittedIntegrator::through(scene, camera, &control.cancel),
            control,
            rays_told: 0,
            levels: Vec::new(),
            streams: None,
            light: TileRadiance::default(),
            hits: None,
        }
    }

    /// Traces the first generation alone, and takes up what its rays meet.
    pub(crate) fn of_first_hits(
        scene: &'a RenderScene,
        camera: &'a RenderCamera,
        control: &'a RenderControl,
    ) -> Self {
        let all = Self::new(scene, camera, control);
        let whitted = all.whitted.with_limits(1, scene.threshold());
        Self { whitted, hits: Some(TileHits::new(camera)), ..all }
    }

    /// The rays traced so far.
    pub(crate) fn counts(&self) -> RayCounts {
        self.whitted.counts()
    }

    /// The light of one sample of each pixel; `None` if it was cancelled midway.
    pub(crate) fn trace(&mut self, place: TileRect, size: DVec2, sample: u32) -> Option<&TileRadiance> {
        self.trace_into(place, size, sample, TileRows::default()).then_some(&self.light)
    }

    /// Writes the light of one sample of each pixel into the rows of a picture, and what primary rays meet into those of
    /// buffers. False if it was cancelled midway.
    pub(crate) fn trace_into(
        &mut self,
        place: TileRect,
        size: DVec2,
        sample: u32,
        rows: TileRows<'_, '_>,
    ) -> bool {
        self.whitted.shading.trim_media();
        let (lanes, is_full) = (self.whitted.shading.scene.lanes, self.whitted.is_full());
        let is_finished = if is_full {
            lanes.run(TileSampleKernel::<true> { tracer: self, place, size, sample, rows })
        } else {
            lanes.run(TileSampleKernel::<false> { tracer: self, place, size, sample, rows })
        };
        self.tell_rays(1);
        if !is_finished {
            self.levels.iter_mut().for_each(DepthQueues::clear);
        }
        is_finished
    }

    /// Tells the control of the rays since the last time, if there are so many.
    fn tell_rays(&mut self, least: u64) {
        let rays = self.whitted.counts().total();
        if rays - self.rays_told >= least {
            self.control.add_rays(rays - self.rays_told);
            self.rays_told = rays;
        }
    }
}

/// Where what is traced of a tile or a group is written to, if anywhere: from the uppermost row on.
#[derive(Default)]
pub(crate) struct TileRows<'t, 'r> {
    pub(crate) light: &'t mut [&'r mut [[f32; 3]]],
    pub(crate) hits: Option<&'t mut FirstHitRows<'r>>,
}

/// One sample of the pixels of a tile or a group. `FULL` stands where [`RenderScene::is_full`] may be true.
struct TileSampleKernel<'t, 'r, 'a, const FULL: bool> {
    tracer: &'t mut TileRenderer<'a>,
    place: TileRect,
    size: DVec2,
    sample: u32,
    rows: TileRows<'t, 'r>,
}

impl<const FULL: bool> SimdKernel for TileSampleKernel<'_, '_, '_, FULL> {
    type Output = bool;

    #[inline(always)]
    fn run<W: Width>(self, w: W) -> bool {
        let Self { tracer, place, size, sample, rows } = self;
        let is_finished =
            tracer.primary::<W, FULL>(w, place, size, sample) && tracer.trace_queues::<W, FULL>(w);
        if is_finished {
            tracer.light.write(w, rows.light);
            if let (Some(hits), Some(rows)) = (&tracer.hits, rows.hits) {
                hits.write(w, &tracer.light.layout, rows);
            }
        }
        is_finished
    }
}

impl<'t, 'r, 'a, const FULL: bool> SceneKernel for TileSampleKernel<'t, 'r, 'a, FULL> {
    type General = TileSampleKernel<'t, 'r, 'a, true>;

    fn general(self) -> Self::General {
        let Self { tracer, place, size, sample, rows } = self;
        TileSampleKernel { tracer, place, size, sample, rows }
    }
}

impl TileRenderer<'_> {
    /// So many rays of a level may wait where they are traced packet by packet; then the level behind it is traced, so that
    /// memory is bounded, and little of it is touched for the first time. By streams, as many as fill one.
    const MOST_WAITING: usize = 448;

    /// Rays between two reports of a thread: some milliseconds, so that threads do not meet at the count.
    const RAYS_AT_ONCE: u64 = 1 << 14;

    /// Packets of a level between two looks at how many rays wait elsewhere.
    const AT_ONCE: usize = 16;

    fn is_cancelled(&self) -> bool {
        self.whitted.cancel.load(std::sync::atomic::Ordering::Relaxed)
    }

    /// Traces the rays from the eye, in blocks of neighboring pixels. False if it was cancelled.
    #[inline(always)]
    fn primary<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        place: TileRect,
        size: DVec2,
        sample: u32,
    ) -> bool {
        let [width, height] = PixelBlock::<W>::SIZE;
        self.light.begin(place, [width, height]);
        if let Some(hits) = &mut self.hits {
            hits.begin(self.light.layout.pixels);
        }
        let across = place.width.div_ceil(width);
        self.whitted
            .shading
            .begin_sample(sample, Sampler::new(sample, [place.x, place.y], [width, height], across));
        let by_stream = W::USES_HIERARCHY && self.whitted.shading.scene.eye_goes_by_streams();
        if by_stream && self.levels.is_empty() {
            self.levels.push(DepthQueues::default());
        }
        for tile in place.squares(TILE) {
            let first_block = (tile.y - place.y) / height * across + (tile.x - place.x) / width;
            let (near, reach, offset) = tile.rays(self.whitted.shading.camera, size, sample);
            self.whitted.shading.begin_tile(&near, reach);
            if !self.primary_of_tile::<W, FULL>(w, tile, (&near, offset), (first_block, across), by_stream) {
                return false;
            }
        }
        true
    }

    /// Traces the rays from the eye through a tile. Its blocks are numbered from the first on, so many further from one row
    /// of them to the next. False if it was cancelled.
    #[inline(always)]
    fn primary_of_tile<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        place: TileRect,
        (near, offset): (&CameraRays, Vec2),
        (first_block, across): (usize, usize),
        by_stream: bool,
    ) -> bool {
        let block = PixelBlock::new(w);
        let [width, height] = PixelBlock::<W>::SIZE;
        let mut grown = [PathState::none(w); 2];
        // Two that take turns: only what differs from packet to packet is written.
        let mut rooted = [PathState::from_eye(w); 2];
        let [mut paths, mut next] = rooted.each_mut();
        for (row, top) in (0..place.height).step_by(height).enumerate() {
            if self.is_cancelled() {
                return false;
            }
            let mut first = (first_block + row * across) * W::LANES;
            // Whole numbers are added first: a pixel's ray is the same in blocks of every width.
            let y = block.y + top as f32 + offset.y;
            next.rays.set(near.rays(block.x + offset.x, y));
            for left in (0..place.width).step_by(width) {
                // Made one block ahead: their root and division take long, and nothing waits for them here.
                std::mem::swap(&mut paths, &mut next);
                next.rays.set(near.rays(block.x + (left + width) as f32 + offset.x, y));
                paths.lanes = w.mask(PixelBlock::<W>::lanes(place, left, top));
                paths.pixel = block.pixel.plus(w.word(first as u32));
                self.whitted.shading.start_paths(w, paths);
                let mut light = Vector::splat(w.real(0.0), [0.0; 3]);
                if by_stream {
                    self.levels[0].reflected.push(paths);
                } else {
                    light = self.trace_packet::<W, FULL>(w, paths, PacketSource::Eye, 0, &mut grown[0]);
                }
                self.light.set::<W>(first, light);
                if grown[0].lanes.any() {
                    self.trace_while_full::<W, FULL>(w, &mut grown, 1);
                }
                first += W::LANES;
            }
        }
        true
    }

    /// Traces the rays that wait, the nearest to the eye first. False if it was cancelled.
    #[inline(always)]
    fn trace_queues<W: Width, const FULL: bool>(&mut self, w: W) -> bool {
        let by_streams = W::USES_HIERARCHY && self.whitted.shading.scene.goes_by_streams();
        let most_waiting = if by_streams { STREAM } else { Self::MOST_WAITING };
        let mut taken = [PathState::none(w); 2];
        let mut at = 0;
        loop {
            if self.is_cancelled() {
                return false;
            }
            self.tell_rays(Self::RAYS_AT_ONCE);
            if self.waiting(at) == 0 {
                let waits = |&level: &usize| self.waiting(level) > 0;
                let Some(next) = (at..self.levels.len()).find(waits).or_else(|| (0..at).rev().find(waits))
                else {
                    return true;
                };
                at = next;
            } else if by_streams {
                self.trace_stream::<W, FULL>(w, at);
            } else {
                for _ in 0..Self::AT_ONCE {
                    taken[0] = self.levels[at].take(w);
                    self.trace_while_full::<W, FULL>(w, &mut taken, at + 1);
                    if self.waiting(at) == 0 {
                        break;
                    }
                }
            }
            let is_full = |&level: &usize| self.waiting(level) >= most_waiting;
            at = (at + 1..self.levels.len()).find(is_full).unwrap_or(at);
        }
    }

    /// Traces a stream of rays that wait at a level.
    fn trace_stream<W: Width, const FULL: bool>(&mut self, w: W, level: usize) {
        if !W::USES_HIERARCHY {
            // Said once more, so that it is not compiled.
            return;
        }
        if self.levels.len() <= level + 1 {
            self.levels.resize_with(level + 2, DepthQueues::default);
        }
        let Some([level, next]) = self.levels.get_mut(level..level + 2) else { return };
        let queue = level.queue();
        let streams = self.streams.get_or_insert_default();
        w.run(
            #[inline(always)]
            || {
                let mut none = PathState::none(w);
                let count = streams.begin(w, queue);
                self.whitted.search(w, streams);
                for at in (0..count).step_by(W::LANES) {
                    let paths = queue.look(w, at);
                    let hits = self.hits.as_mut();
                    let mut grown = SecondaryRayQueues { level: next, next: &mut none, waits: true, hits };
                    self.whitted.packet_li::<W, FULL>(
                        w,
                        &paths,
                        PacketSource::Stream { streams, at },
                        &mut grown,
                    );
                }
                self.whitted.search_shadows(w, streams);
                for at in (0..count).step_by(W::LANES) {
                    let paths = queue.look(w, at);
                    let light = self.whitted.gather(w, &paths, streams, at);
                    self.light.add(w, &paths, light);
                }
                queue.skip(count);
            },
        );
    }

    fn waiting(&self, level: usize) -> usize {
        self.levels.get(level).map_or(0, |level| level.reflected.len() + level.refracted.len())
    }

    /// Traces the first of these rays, and what grows from them as long as all of them go on; others wait, those of the
    /// first ones at `level`.
    fn trace_while_full<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        paths: &mut [PathState<W>; 2],
        level: usize,
    ) {
        w.run(
            #[inline(always)]
            || {
                let [mut paths, mut grown] = paths.each_mut();
                for level in level.. {
                    let light = self.trace_packet::<W, FULL>(w, paths, PacketSource::Anywhere, level, grown);
                    self.light.add(w, paths, light);
                    std::mem::swap(&mut paths, &mut grown);
                    if !paths.lanes.any() {
                        break;
                    }
                }
            },
        );
    }

    /// Traces rays: the light that each brings. Of those that grow from them, some may be traced `next`, as they are;
    /// others wait at `level`.
    #[inline(always)]
    fn trace_packet<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        from: PacketSource<'_>,
        level: usize,
        next: &mut PathState<W>,
    ) -> Vector<W::R> {
        if self.levels.len() <= level {
            self.levels.resize_with(level + 1, DepthQueues::default);
        }
        next.lanes = w.mask(0);
        let waits = W::USES_HIERARCHY && self.whitted.shading.scene.goes_by_streams();
        let (level, hits) = (&mut self.levels[level], self.hits.as_mut());
        let mut grown = SecondaryRayQueues { level, next, waits, hits };
        self.whitted.packet_li::<W, FULL>(w, paths, from, &mut grown)
    }
}

impl WhittedIntegrator<'_> {
    /// The light of [`WhittedIntegrator::li`]. In a function of its own, so that this code, which is most of what there is,
    /// is compiled once and not for each place that rays come from.
    #[inline(never)]
    fn packet_li<W: Width, const FULL: bool>(
        &mut self,
        w: W,
        paths: &PathState<W>,
        from: PacketSource<'_>,
        secondary: &mut SecondaryRayQueues<'_, W>,
    ) -> Vector<W::R> {
        w.run(
            #[inline(always)]
            || self.li::<W, FULL>(w, paths, from, secondary).light,
        )
    }
}

/// What grows from rays side by side.
struct SecondaryRayQueues<'l, W: Width> {
    /// Where it waits.
    level: &'l mut DepthQueues,
    /// What is traced next instead: the first that grows, if it fills a vector.
    next: &'l mut PathState<W>,
    /// Whether all waits.
    waits: bool,
    /// What takes up the points where they grow; then none goes on.
    hits: Option<&'l mut TileHits>,
}

impl<W: Width> SecondaryRayQueues<'_, W> {
    /// Whether rays are traced next.
    #[inline(always)]
    fn takes(&self, lanes: W::M) -> bool {
        !self.waits && !(!lanes).any() && !self.next.lanes.any()
    }
}

impl<W: Width> PathObserver<W> for SecondaryRayQueues<'_, W> {
    #[inline(always)]
    fn on_hit(&mut self, w: W, paths: &PathState<W>, hit: W::M, at: &SurfaceInteraction<W>) {
        if let Some(hits) = &mut self.hits {
            hits.record(w, paths, hit, at);
        }
    }
}

impl<W: Width> SecondaryRays<W> for SecondaryRayQueues<'_, W> {
    #[inline(always)]
    fn reflected(&mut self, paths: PathState<W>) {
        if self.takes(paths.lanes) {
            *self.next = paths;
        } else {
            self.level.reflected.push(&paths);
        }
    }

    #[inline(always)]
    fn refracted(&mut self, paths: PathState<W>) {
        // In the last generation these go straight through clear bodies.
        if self.hits.is_some() {
            return;
        }
        if self.takes(paths.lanes) {
            *self.next = paths;
        } else {
            self.level.refracted.push(&paths);
        }
    }
}

impl DepthQueues {
    #[inline(always)]
    fn take<W: Width>(&mut self, w: W) -> PathState<W> {
        self.queue().take(w)
    }

    /// The rays that are to be traced first.
    fn queue(&mut self) -> &mut RayQueue {
        if self.reflected.len() > 0 { &mut self.reflected } else { &mut self.refracted }
    }

    fn clear(&mut self) {
        self.reflected.clear();
        self.refracted.clear();
    }
}

/// Neighboring pixels whose rays are traced side by side.
pub(crate) struct PixelBlock<W: Width> {
    /// Where the corners of the pixels lie, relative to that of the block.
    pub(crate) x: W::R,
    pub(crate) y: W::R,
    /// The numbers of the pixels from the block's first on.
    pub(crate) pixel: W::W,
}

impl<W: Width> PixelBlock<W> {
    /// Pixels across and down.
    pub(crate) const SIZE: [usize; 2] = {
        let width = if W::LANES >= 32 {
            8
        } else if W::LANES >= 8 {
            4
        } else if W::LANES >= 2 {
            2
        } else {
            1
        };
        [width, W::LANES / width]
    };

    #[inline(always)]
    pub(crate) fn new(w: W) -> Self {
        let [width, _] = Self::SIZE;
        let ([mut x, mut y], mut pixel) = ([[0.0; MOST_LANES]; 2], [0; MOST_LANES]);
        for lane in 0..W::LANES {
            x[lane] = (lane % width) as f32;
            y[lane] = (lane / width) as f32;
            pixel[lane] = lane as u32;
        }
        Self { x: w.load(&x), y: w.load(&y), pixel: w.load_words(&pixel) }
    }

    /// Where the pixel of a lane lies, if the first one lies at (x, y).
    #[inline(always)]
    pub(crate) fn place(lane: usize, (x, y): (usize, usize)) -> [usize; 2] {
        let [width, _] = Self::SIZE;
        [x + lane % width, y + lane / width]
    }

    /// A bit for each pixel that lies in the tile.
    #[inline(always)]
    pub(crate) fn lanes(place: TileRect, left: usize, top: usize) -> u32 {
        let [width, height] = Self::SIZE;
        if left + width <= place.width && top + height <= place.height {
            return u32::MAX >> (32 - W::LANES);
        }
        let inside = |lane: usize| left + lane % width < place.width && top + lane / width < place.height;
        (0..W::LANES).fold(0, |lanes, lane| lanes | u32::from(inside(lane)) << lane)
    }
}

#[cfg(test)]
mod tests;
