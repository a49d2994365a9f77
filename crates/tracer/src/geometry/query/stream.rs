//! The nearest hits of rays by the thousand.

use std::ops::Range;

use bytemuck::Zeroable;

use crate::geometry::bvh::stream::{
    STREAM, StreamLeafVisitor, StreamRayRows, StreamRow, StreamTraversalStack,
};
use crate::geometry::membership::{BodyMembership, MembershipSource};
use crate::geometry::query::candidates::Candidates;
use crate::geometry::query::closest::{ClosestHit, ClosestHits};
use crate::geometry::query::{PacketHits, RayQuery};
use crate::geometry::ray::RayPacket;
use crate::geometry::{Accelerator, Geometry};
use crate::simd::{Float as _, Float32 as _, MOST_LANES, Mask as _, Width, Word as _};

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
        let count = self.count;
        search_stream(w, geometry, memberships, memory, count, self);
    }

    /// What the rays from number `at` on, which are in `query`, met, planes included.
    #[inline(always)]
    pub(crate) fn hits<W: Width>(&self, w: W, at: usize, query: &RayQuery<'_, W>) -> PacketHits<W> {
        let (_, t_max) = self.rays.load(w, at);
        let mut best = ClosestHits::new(w, query.geometry, query.origin_error_bound());
        (best.leaving, best.entering) = (self.leaving.load(w, at), self.entering.load(w, at));
        best.t_max = t_max;
        query.visit_planes(&mut best);
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

/// What is searched for along the rays of a stream.
pub(crate) trait StreamSearch<W: Width> {
    /// Whether the search goes from the rays' starts on, see [`StreamLeafVisitor::NEAREST_FIRST`].
    const NEAREST_FIRST: bool;

    fn rays(&self) -> &StreamRayRows;
    /// Shows a visitor the bodies of a leaf that the rays of `query` may meet before `t_max`, and keeps what it found for
    /// the rays of these numbers.
    fn leaf(&mut self, query: &RayQuery<'_, W>, t_max: W::R, bodies: Range<u32>, numbers: &[u32]);
}

/// Shows `search` the bounded bodies that its first `count` rays may meet.
pub(crate) fn search_stream<W: Width>(
    w: W,
    geometry: &Geometry,
    memberships: &impl MembershipSource,
    scratch: &mut StreamScratch,
    count: usize,
    search: &mut impl StreamSearch<W>,
) {
    let Accelerator::Many(bvh) = &geometry.hierarchy else { return };
    let StreamScratch { stack, inside } = scratch;
    let mut leaves = StreamLeaves { w, geometry, memberships, inside, search };
    w.run(
        #[inline(always)]
        || bvh.traverse_stream(w, stack, count, geometry.parts_streams(), &mut leaves),
    );
}

/// The leaves that a stream meets.
struct StreamLeaves<'s, W, M, S> {
    w: W,
    geometry: &'s Geometry,
    memberships: &'s M,
    inside: &'s mut BodyMembership,
    search: &'s mut S,
}

impl<W: Width, M: MembershipSource, S: StreamSearch<W>> StreamLeafVisitor for StreamLeaves<'_, W, M, S> {
    const NEAREST_FIRST: bool = S::NEAREST_FIRST;

    #[inline(always)]
    fn rays(&self) -> &StreamRayRows {
        self.search.rays()
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
            let (rays, media, t_max) = self.search.rays().gather(w, numbers);
            let lanes = w.first(count - at) & t_max.gt(w.real(f32::NEG_INFINITY));
            if !lanes.any() {
                continue;
            }
            if geometry.has_transparency {
                self.memberships.fill::<W>(self.inside, media, lanes);
            }
            let query = RayQuery::new(w, geometry, &rays, lanes, self.inside, Candidates::All);
            self.search.leaf(&query, t_max, bodies.clone(), numbers);
        }
    }
}

impl<W: Width> StreamSearch<W> for RayStream {
    const NEAREST_FIRST: bool = true;

    #[inline(always)]
    fn rays(&self) -> &StreamRayRows {
        &self.rays
    }

    #[inline(always)]
    fn leaf(&mut self, query: &RayQuery<'_, W>, t_max: W::R, bodies: Range<u32>, numbers: &[u32]) {
        let mut best = ClosestHits::new(query.w, query.geometry, query.origin_error_bound());
        best.t_max = t_max;
        query.visit_leaf(bodies, query.lanes, &mut best);
        let mut reaches = [0.0; MOST_LANES];
        best.t_max.store(&mut reaches);
        for (found, nearest) in [(best.entering, &mut self.entering), (best.leaving, &mut self.leaving)] {
            let lanes = found.t.le(t_max) & found.t.lt(query.w.real(f32::INFINITY));
            if lanes.any() {
                nearest.merge(&found, lanes, numbers);
                each_lane(
                    lanes.bits(),
                    numbers,
                    #[inline(always)]
                    |lane, ray| self.rays.shorten(ray, reaches[lane]),
                );
            }
        }
    }
}

impl ClosestHitRows {
    /// Takes up the nearest hits with other bodies.
    #[inline(always)]
    fn merge<W: Width>(&mut self, found: &ClosestHit<W>, lanes: W::M, numbers: &[u32]) {
        let [mut ts, mut faces, mut seconds] = [[0.0; MOST_LANES]; 3];
        let mut bodies = [0; MOST_LANES];
        found.t.store(&mut ts);
        found.face.store(&mut faces);
        found.second.store(&mut seconds);
        found.body.store(&mut bodies);
        each_lane(
            lanes.bits(),
            numbers,
            #[inline(always)]
            |lane, ray| {
                let place = ray as usize % STREAM;
                let (t, old) = (ts[lane], self.t[place]);
                if t < old {
                    (self.t[place], self.body[place]) = (t, bodies[lane]);
                    self.face[place] = faces[lane];
                    self.second[place] = old.min(seconds[lane]);
                } else {
                    self.second[place] = self.second[place].min(t);
                }
            },
        );
    }
}
