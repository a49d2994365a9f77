//! What lies between points and a light, for shadow rays by the thousand.

use std::ops::Range;

use bytemuck::{Zeroable, zeroed_box};

use crate::geometry::bvh::stream::{STREAM, StreamRayRows, StreamRow, vector_at};
use crate::geometry::membership::{BodyMembership, MembershipSource as _};
use crate::geometry::query::RayQuery;
use crate::geometry::query::candidates::Candidates;
use crate::geometry::query::stream::{StreamScratch, StreamSearch, each_lane, search_stream};
use crate::geometry::ray::{POINT_ROUNDING, RayPacket};
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, MOST_LANES, Mask as _, Width};
use crate::transport::media::MediumStacks;
use crate::transport::media::absorption::MediumIntervals;
use crate::transport::media::transmittance::{Transmittance, TransmittanceVisitor, all_of};
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
        let count = self.count;
        let Self { rays, share, .. } = self;
        let mut search = ShadowStreamSearch { scene, intervals, rays, share };
        search_stream(w, &scene.geometry, table, memory, count, &mut search);
        if scene.absorbs {
            self.absorb(w, scene, table, &mut memory.inside, intervals);
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
                        query.note_medium(index, t_max, lanes, intervals);
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
        let passed = Transmittance { lanes, share };
        let mut visitor = TransmittanceVisitor::resumed(w, scene, t_max, passed, None);
        if lanes.any() {
            query.visit_planes(&mut visitor);
        }
        let passed = visitor.passed;
        let mut share = passed.share.unwrap_or_else(|| all_of(w));
        if scene.absorbs {
            share = share.times(vector_at(w, &self.left, at));
        }
        (passed.lanes & !share.is_zero(), vector_at(w, &self.answer, at).times(share))
    }
}

/// The rays of a stream on their way to a light.
struct ShadowStreamSearch<'s> {
    scene: &'s RenderScene,
    intervals: &'s mut MediumIntervals,
    rays: &'s mut StreamRayRows,
    share: &'s mut StreamRow<[f32; 4]>,
}

impl<W: Width> StreamSearch<W> for ShadowStreamSearch<'_> {
    const NEAREST_FIRST: bool = false;

    #[inline(always)]
    fn rays(&self) -> &StreamRayRows {
        self.rays
    }

    #[inline(always)]
    fn leaf(&mut self, query: &RayQuery<'_, W>, t_max: W::R, bodies: Range<u32>, numbers: &[u32]) {
        let (w, lanes) = (query.w, query.lanes);
        let mut passed = Transmittance::all(lanes);
        if query.geometry.has_transparency {
            let [x, y, z, _] = w.gather(self.share, numbers);
            passed.share = Some(Vector::new(x, y, z));
        }
        let first = self.intervals.len();
        let noted = Some(&mut *self.intervals);
        let mut visitor = TransmittanceVisitor::resumed(w, self.scene, t_max, passed, noted);
        query.visit_leaf(bodies, lanes, &mut visitor);
        let passed = visitor.passed;
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
