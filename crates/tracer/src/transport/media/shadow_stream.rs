//! What lies between points and a light, for shadow rays by the thousand.

use std::ops::Range;

use bytemuck::{Zeroable, zeroed_box};

use crate::geometry::Accelerator;
use crate::geometry::bvh::stream::{STREAM, StreamRayRows, StreamRow, StreamVisitor, vector_at};
use crate::geometry::membership::{BodyMembership, MembershipSource as _};
use crate::geometry::query::RayQuery;
use crate::geometry::query::candidates::Candidates;
use crate::geometry::query::stream::{StreamScratch, each_lane};
use crate::geometry::ray::{POINT_ROUNDING, RayPacket};
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, MOST_LANES, Mask as _, Width};
use crate::transport::media::MediumStacks;
use crate::transport::media::absorption::MediumIntervals;
use crate::transport::media::transmittance::{Transmittance, all_of};
use crate::transport::scene::RenderScene;

/// Shadow rays of a stream's hits to one light.
#[derive(Debug, Zeroable)]
pub(crate) struct ShadowStream {
    /// Of those that are blocked, the reach is -∞.
    rays: StreamRayRows,
    /// What the bodies between let through.
    share: StreamRow<[f32; 4]>,
    /// What the media leave, planes among them; meaningless where nothing absorbs.
    left: StreamRow<[f32; 4]>,
    /// What the surface sends on if nothing is between.
    answer: StreamRow<[f32; 4]>,
    count: usize,
    is_empty: bool,
}

impl ShadowStream {
    /// One for at most so many rays.
    #[cold]
    pub(crate) fn of(count: usize) -> Box<Self> {
        let mut shadows: Box<Self> = zeroed_box();
        shadows.begin(count);
        shadows
    }

    /// Forgets all rays; at most the first `count` will be [put](Self::put).
    pub(crate) fn begin(&mut self, count: usize) {
        (self.count, self.is_empty) = (count, true);
        self.rays.block(count);
    }

    /// Whether there are any.
    pub(crate) fn is_empty(&self) -> bool {
        self.is_empty
    }

    /// Adds the rays `lanes` as those from number `at` on, with what they bring if nothing is between.
    #[inline(always)]
    pub(crate) fn put<W: Width>(
        &mut self,
        w: W,
        at: usize,
        rays: &RayPacket<W>,
        (media, distance): (W::W, W::R),
        answer: Vector<W::R>,
        lanes: W::M,
    ) {
        // A body that touches the light does not hide it.
        let t_max = distance * (1.0 - POINT_ROUNDING);
        let t_max = W::R::select(lanes, t_max, w.real(f32::NEG_INFINITY));
        self.rays.set(w, at, rays, media, t_max);
        let (zero, one) = (w.real(0.0), w.real(1.0));
        w.store_fours([answer.x, answer.y, answer.z, zero], &mut self.answer[at..]);
        w.store_fours([one, one, one, zero], &mut self.share[at..]);
        self.is_empty = false;
    }

    /// Looks for the bounded bodies between.
    pub(crate) fn search<W: Width>(
        &mut self,
        w: W,
        scene: &RenderScene,
        table: &MediumStacks,
        memory: &mut StreamScratch,
        intervals: &mut MediumIntervals,
    ) {
        let Accelerator::Many(bvh) = &scene.geometry.hierarchy else { return };
        let Self { rays, share, count, .. } = self;
        let StreamScratch { stack, inside } = memory;
        let mut visitor = StreamTransmittanceVisitor { w, scene, table, inside, intervals, rays, share };
        w.run(
            #[inline(always)]
            || bvh.traverse_stream(w, stack, *count, scene.geometry.parts_streams(), &mut visitor),
        );
        if scene.absorbs {
            self.absorb(w, scene, table, inside, intervals);
        }
    }

    /// Finds what the media leave of the light of each ray, once it is known which bounded ones it goes through.
    #[cold]
    #[inline(never)]
    fn absorb<W: Width>(
        &mut self,
        w: W,
        scene: &RenderScene,
        table: &MediumStacks,
        inside: &mut BodyMembership,
        intervals: &mut MediumIntervals,
    ) {
        let Self { rays: stream, left, count, .. } = self;
        left.iter_mut().take(*count).for_each(|left| *left = [1.0; 4]);
        w.run(
            #[inline(always)]
            || {
                for at in (0..*count).step_by(W::LANES) {
                    let (rays, t_max) = stream.load(w, at);
                    let lanes = w.first(*count - at) & t_max.gt(w.real(f32::NEG_INFINITY));
                    table.fill::<W>(inside, stream.media(w, at), lanes);
                    let first = intervals.len();
                    let query = RayQuery::new(w, &scene.geometry, &rays, lanes, inside, Candidates::All);
                    for index in scene.geometry.planes() {
                        query.note_medium(index, scene.geometry.body(index), t_max, lanes, intervals);
                    }
                    let numbers: [u32; MOST_LANES] = std::array::from_fn(|lane| (at + lane) as u32);
                    intervals.name_rays(first, &numbers);
                }
            },
        );
        intervals.each_left(
            scene,
            table,
            |ray| stream.media(ScalarWidth, ray as usize % STREAM),
            |ray, Vector { x, y, z }| left[ray as usize % STREAM] = [x, y, z, 1.0],
        );
    }

    /// The rays from number `at` on.
    #[inline(always)]
    pub(crate) fn rays<W: Width>(&self, w: W, at: usize) -> RayPacket<W> {
        self.rays.load(w, at).0
    }

    /// What the rays from number `at` on, which are in `query`, bring, and which of them bring any.
    #[inline(always)]
    pub(crate) fn brought<W: Width>(
        &self,
        w: W,
        at: usize,
        scene: &RenderScene,
        query: &RayQuery<'_, W>,
    ) -> (W::M, Vector<W::R>) {
        let (_, t_max) = self.rays.load(w, at);
        let lanes = t_max.gt(w.real(f32::NEG_INFINITY)) & query.lanes;
        let share = Some(vector_at(w, &self.share, at));
        let mut passed: Transmittance<W> = Transmittance { lanes, share, occluder: 0 };
        for index in query.geometry.planes() {
            if !passed.lanes.any() {
                break;
            }
            query.filter(scene, index, query.geometry.body(index), t_max, passed.lanes, (&mut passed, None));
        }
        let mut share = passed.share.unwrap_or_else(|| all_of(w));
        if scene.absorbs {
            share = share.times(vector_at(w, &self.left, at));
        }
        (passed.lanes & !share.is_zero(), vector_at(w, &self.answer, at).times(share))
    }
}

/// Looks for what shades.
struct StreamTransmittanceVisitor<'s, W> {
    w: W,
    scene: &'s RenderScene,
    table: &'s MediumStacks,
    inside: &'s mut BodyMembership,
    intervals: &'s mut MediumIntervals,
    rays: &'s mut StreamRayRows,
    share: &'s mut StreamRow<[f32; 4]>,
}

impl<W: Width> StreamVisitor for StreamTransmittanceVisitor<'_, W> {
    const NEAREST_FIRST: bool = false;

    #[inline(always)]
    fn rays(&self) -> &StreamRayRows {
        self.rays
    }

    #[inline(always)]
    fn fetch(&self, bodies: Range<u32>) {
        self.scene.geometry.fetch(bodies);
    }

    #[inline(always)]
    fn leaf(&mut self, bodies: Range<u32>, rays: &[u32], count: usize) {
        let Self { w, scene, .. } = *self;
        for at in (0..count).step_by(W::LANES) {
            let numbers = &rays[at..];
            let (rays, media, t_max) = self.rays.gather(w, numbers);
            let lanes = w.first(count - at) & t_max.gt(w.real(f32::NEG_INFINITY));
            if !lanes.any() {
                continue;
            }
            let mut share = None;
            if scene.geometry.has_transparency {
                self.table.fill::<W>(self.inside, media, lanes);
                let [x, y, z, _] = w.gather(self.share, numbers);
                share = Some(Vector::new(x, y, z));
            }
            let query = RayQuery::new(w, &scene.geometry, &rays, lanes, self.inside, Candidates::All);
            let mut passed: Transmittance<W> = Transmittance { lanes, share, occluder: 0 };
            let first = self.intervals.len();
            for index in bodies.clone() {
                let lanes = passed.lanes & query.meets_sphere(index, t_max);
                if lanes.any() {
                    let noted = (&mut passed, Some(&mut *self.intervals));
                    query.filter(scene, index, scene.geometry.body(index), t_max, lanes, noted);
                }
            }
            self.intervals.name_rays(first, numbers);
            each_lane(
                (lanes & !passed.lanes).bits(),
                numbers,
                #[inline(always)]
                |_, ray| self.rays.shorten(ray, f32::NEG_INFINITY),
            );
            if let Some(Vector { x, y, z }) = passed.share {
                let mut shares = [[0.0; 4]; MOST_LANES];
                w.store_fours([x, y, z, w.real(0.0)], &mut shares);
                each_lane(passed.lanes.bits(), numbers, |lane, ray| {
                    self.share[ray as usize % STREAM] = shares[lane];
                });
            }
        }
    }
}
