//! The nearest hits of rays by the thousand.

use std::ops::Range;

use bytemuck::Zeroable;

use crate::geometry::bvh::stream::{STREAM, StreamRayRows, StreamRow, StreamTraversalStack, StreamVisitor};
use crate::geometry::membership::{BodyMembership, MembershipSource};
use crate::geometry::query::candidates::Candidates;
use crate::geometry::query::closest::{ClosestHit, ClosestHits, margin, t_max_for};
use crate::geometry::query::{PacketHits, RayQuery};
use crate::geometry::ray::RayPacket;
use crate::geometry::{Accelerator, Geometry};
use crate::simd::{Float as _, Float32 as _, MOST_LANES, Mask as _, Width};

/// Rays that are searched for together, and what they met.
#[derive(Debug, Zeroable)]
pub(crate) struct RayStream {
    rays: StreamRayRows,
    entering: ClosestHitRows,
    leaving: ClosestHitRows,
    count: usize,
}

/// The nearest hits so far of one direction through the surface.
#[derive(Debug, Zeroable)]
struct ClosestHitRows {
    t: StreamRow<f32>,
    body: StreamRow<u32>,
    face: StreamRow<f32>,
    /// The parameters of the hits after them.
    second: StreamRow<f32>,
}

/// Working memory of a search by streams.
#[derive(Debug, Default)]
pub(crate) struct StreamScratch {
    pub(crate) stack: StreamTraversalStack,
    pub(crate) inside: BodyMembership,
}

impl ClosestHitRows {
    #[inline(always)]
    fn load<W: Width>(&self, w: W, at: usize) -> ClosestHit<W> {
        ClosestHit {
            t: w.load(&self.t[at..]),
            body: w.load_words(&self.body[at..]),
            face: w.load(&self.face[at..]),
            second: w.load(&self.second[at..]),
        }
    }
}

impl RayStream {
    /// Forgets all rays.
    pub(crate) fn begin(&mut self) {
        self.count = 0;
    }

    /// Adds rays; all but the last ones of a stream fill the vectors.
    #[inline(always)]
    pub(crate) fn push<W: Width>(&mut self, w: W, rays: &RayPacket<W>, media: W::W, lanes: W::M) {
        let never = w.real(f32::INFINITY);
        self.rays.set(w, self.count, rays, media, never);
        for nearest in [&mut self.entering, &mut self.leaving] {
            never.store(&mut nearest.t[self.count..]);
            never.store(&mut nearest.second[self.count..]);
        }
        self.count += lanes.bits().count_ones() as usize;
    }

    /// The number of rays.
    pub(crate) fn len(&self) -> usize {
        self.count
    }

    /// Looks for the nearest of the bounded bodies that each ray meets.
    pub(crate) fn search<W: Width>(
        &mut self,
        w: W,
        geometry: &Geometry,
        memberships: &impl MembershipSource,
        memory: &mut StreamScratch,
    ) {
        let Accelerator::Many(bvh) = &geometry.hierarchy else { return };
        let StreamScratch { stack, inside } = memory;
        let count = self.count;
        let mut visitor = StreamClosestHitVisitor { w, geometry, memberships, inside, stream: self };
        w.run(
            #[inline(always)]
            || bvh.traverse_stream(w, stack, count, geometry.parts_streams(), &mut visitor),
        );
    }

    /// What the rays from number `at` on, which are in `query`, met, planes included.
    #[inline(always)]
    pub(crate) fn hits<W: Width>(&self, w: W, at: usize, query: &RayQuery<'_, W>) -> PacketHits<W> {
        let (_, t_max) = self.rays.load(w, at);
        let (leaving, entering) = (self.leaving.load(w, at), self.entering.load(w, at));
        let origin_error_bound = query.origin_error_bound();
        let margin = margin(query.geometry, origin_error_bound);
        let mut best = ClosestHits { leaving, entering, t_max, origin_error_bound, margin };
        for index in query.geometry.planes() {
            query.test(index, query.geometry.body(index), query.lanes, &mut best);
        }
        let hits = best.first(w, query.geometry, query.lanes);
        hits.resolved(w, query.geometry, &query.rays(), query.membership)
    }
}

/// Shows `take` each of the rays of a vector that is among `lanes`: its place in the vector, and its number.
#[inline(always)]
pub(crate) fn each_lane(lanes: u32, rays: &[u32], mut take: impl FnMut(usize, u32)) {
    let mut bits = lanes;
    while bits != 0 {
        let lane = bits.trailing_zeros() as usize % MOST_LANES;
        bits &= bits - 1;
        take(lane, rays[lane]);
    }
}

/// Looks for the nearest bodies.
struct StreamClosestHitVisitor<'s, W, M> {
    w: W,
    geometry: &'s Geometry,
    memberships: &'s M,
    inside: &'s mut BodyMembership,
    stream: &'s mut RayStream,
}

impl<W: Width, M: MembershipSource> StreamVisitor for StreamClosestHitVisitor<'_, W, M> {
    const NEAREST_FIRST: bool = true;

    #[inline(always)]
    fn rays(&self) -> &StreamRayRows {
        &self.stream.rays
    }

    #[inline(always)]
    fn fetch(&self, bodies: Range<u32>) {
        self.geometry.fetch(bodies);
    }

    #[inline(always)]
    fn leaf(&mut self, bodies: Range<u32>, rays: &[u32], count: usize) {
        let Self { w, geometry, .. } = *self;
        for at in (0..count).step_by(W::LANES) {
            let numbers = &rays[at..];
            let lanes = w.first(count - at);
            let (rays, media, t_max) = self.stream.rays.gather(w, numbers);
            if geometry.has_transparency {
                self.memberships.fill::<W>(self.inside, media, lanes);
            }
            let query = RayQuery::new(w, geometry, &rays, lanes, self.inside, Candidates::All);
            for index in bodies.clone() {
                let lanes = lanes & query.meets_sphere(index, t_max);
                if !lanes.any() {
                    continue;
                }
                let body = geometry.body(index);
                let Some(meeting) = query.intersect_body(index, body, lanes) else { continue };
                let entering = meeting.entering & meeting.enter.le(t_max);
                let leaving = meeting.leaving & meeting.exit.le(t_max);
                let margin = margin(geometry, query.origin_error_bound());
                if entering.any() {
                    let met = (meeting.enter, meeting.enter_face, margin);
                    self.stream.offer::<W>(index, true, met, entering, numbers);
                }
                if leaving.any() {
                    let met = (meeting.exit, meeting.exit_face, margin);
                    self.stream.offer::<W>(index, false, met, leaving, numbers);
                }
            }
        }
    }
}

impl RayStream {
    /// Takes note of hits with a body; see [`ClosestHits`].
    #[inline(always)]
    fn offer<W: Width>(
        &mut self,
        index: u32,
        is_entering: bool,
        (t, face, margin): (W::R, W::R, W::R),
        lanes: W::M,
        numbers: &[u32],
    ) {
        let Self { rays, entering, leaving, .. } = self;
        let nearest = if is_entering { entering } else { leaving };
        let [mut ts, mut faces, mut reaches] = [[0.0; MOST_LANES]; 3];
        t.store(&mut ts);
        face.store(&mut faces);
        t_max_for(t, margin).store(&mut reaches);
        each_lane(
            lanes.bits(),
            numbers,
            #[inline(always)]
            |lane, ray| {
                let place = ray as usize % STREAM;
                let (t, old) = (ts[lane], nearest.t[place]);
                if t < old {
                    (nearest.t[place], nearest.body[place]) = (t, index);
                    nearest.face[place] = faces[lane];
                    nearest.second[place] = old;
                    rays.shorten(ray, reaches[lane]);
                } else {
                    nearest.second[place] = nearest.second[place].min(t);
                }
            },
        );
    }
}
