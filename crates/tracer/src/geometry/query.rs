//! What rays meet: the nearest body, and what lies between a point and a light.

pub(crate) mod candidates;
pub(crate) mod cemented;
pub(crate) mod closest;
pub(crate) mod coincident;
pub(crate) mod intersection;
pub(crate) mod joined;
pub(crate) mod stream;

use std::ops::Range;

use crate::geometry::body::RenderBody;
use crate::geometry::bvh::packet::TraversalStack;
use crate::geometry::bvh::{Bvh, LeafVisitor};
use crate::geometry::membership::BodyMembership;
use crate::geometry::query::candidates::Candidates;
use crate::geometry::query::closest::ClosestHits;
use crate::geometry::query::coincident::resolve_coincident;
use crate::geometry::ray::{INWARDS, NO_START, RayPacket, error_bound_at};
use crate::geometry::visible_bodies::{BoundingCone, VisibleBodies};
use crate::geometry::{Accelerator, Geometry};
use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float32 as _, MOST_LANES, Mask as _, Width, Word as _};

/// Where a ray meets a body: the cheap record kept during the search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HitRecord {
    /// Parameter along the ray, 0 or more, finite.
    pub t: f32,
    /// The body's place in the scene.
    pub body: u32,
    /// Whether the ray meets the body's surface from within.
    pub leaving: bool,
}

/// Where rays meet bodies.
#[derive(Clone, Copy)]
pub(crate) struct PacketHits<W: Width> {
    pub t: W::R,
    pub body: W::W,
    pub leaving: W::M,
    /// The face of the body's [`ShapeSpan`](crate::shape::ShapeSpan).
    pub face: W::R,
    /// The rays that meet one at all.
    pub hit: W::M,
    /// The rays that may meet other bodies there too: they have to be [resolved](Self::resolved).
    pub contested: W::M,
    /// Of a [cemented](RayQuery::cemented_hit) contact, the start of a ray that is reflected at the other of its two surfaces;
    /// else [`NO_START`].
    pub contact: W::W,
}

/// What a search does with the bodies that rays may meet: one ray, a packet, or some rays of a stream.
pub(crate) trait BodyVisitor<W: Width> {
    /// Whether the nearer bodies are better shown first.
    const NEAREST_FIRST: bool;

    /// The parameters beyond which nothing is wanted any more.
    fn t_max(&self) -> W::R;
    /// Tests a body that these of the rays of `query` may meet.
    fn body(&mut self, query: &RayQuery<'_, W>, index: u32, lanes: W::M);
}

/// What the rays know about a body before it is tested.
pub(crate) struct RayBodyLanes<M> {
    /// Those that may meet it: they have not just left this convex body.
    pub(crate) lanes: M,
    /// Those that are inside: they meet the far side only.
    pub(crate) inside: M,
}

/// Where rays meet a body first.
pub(crate) struct BodyIntersection<W: Width> {
    /// Those that enter it, and where.
    pub(crate) entering: W::M,
    pub(crate) enter: W::R,
    pub(crate) enter_face: W::R,
    /// Those that leave it without having entered.
    pub(crate) leaving: W::M,
    /// Where all of them leave it.
    pub(crate) exit: W::R,
    pub(crate) exit_face: W::R,
}

/// Where rays first cross the surface of a joined body.
pub(crate) struct JoinedHits<W: Width> {
    pub(crate) t: W::R,
    /// The part that makes the surface there, and its face.
    pub(crate) part: W::W,
    pub(crate) face: W::R,
    /// Those that enter the whole, and those that leave it.
    pub(crate) entering: W::M,
    pub(crate) leaving: W::M,
}

/// Rays in flight.
#[derive(Clone, Copy)]
pub(crate) struct RayQuery<'a, W: Width> {
    pub(crate) w: W,
    pub(crate) geometry: &'a Geometry,
    origin: Vector<W::R>,
    direction: Vector<W::R>,
    /// The bodies that they start from, with [`INWARDS`].
    start: W::W,
    /// Those that fly.
    pub(crate) lanes: W::M,
    pub(crate) membership: &'a BodyMembership,
    candidates: Candidates<'a>,
}

impl<W: Width> PacketHits<W> {
    /// None at all.
    #[inline(always)]
    pub(crate) fn none(w: W) -> Self {
        let (zero, none) = (w.real(0.0), w.mask(0));
        let contact = w.word(NO_START);
        Self { t: zero, body: w.word(0), leaving: none, face: zero, hit: none, contested: none, contact }
    }

    /// The first hits of these rays, of bodies that they meet where others are the first in the scene.
    #[inline(always)]
    pub(crate) fn resolved(
        self,
        w: W,
        geometry: &Geometry,
        rays: &RayPacket<W>,
        inside: &BodyMembership,
    ) -> Self {
        // Number by number: masks that were just written are slow to read as parts of a whole.
        let Self { mut t, mut body, mut leaving, mut face, mut hit, contested, mut contact } = self;
        if contested.any() {
            let first = resolve_coincident(
                w,
                geometry,
                rays,
                inside,
                Self { t, body, leaving, face, hit, contested, contact },
            );
            (t, body, leaving, face, hit) = (first.t, first.body, first.leaving, first.face, first.hit);
            contact = first.contact;
        }
        Self { t, body, leaving, face, hit, contested, contact }
    }
}

impl<'a, W: Width> RayQuery<'a, W> {
    #[inline(always)]
    pub(crate) fn new(
        w: W,
        geometry: &'a Geometry,
        rays: &RayPacket<W>,
        lanes: W::M,
        membership: &'a BodyMembership,
        candidates: Candidates<'a>,
    ) -> Self {
        Self {
            w,
            geometry,
            origin: rays.origin,
            direction: rays.direction,
            start: rays.start,
            lanes,
            membership,
            candidates,
        }
    }

    /// How far the starts may lie from their true places by rounding, meters.
    #[inline(always)]
    fn origin_error_bound(&self) -> W::R {
        error_bound_at(self.origin)
    }

    #[inline(always)]
    fn relation(&self, index: u32, body: &RenderBody, lanes: W::M) -> RayBodyLanes<W::M> {
        let leaves = self.leaves(index);
        let mut inside = self.start.is(index | INWARDS);
        if body.is_transparent() && !self.membership.is_empty() {
            inside = inside | (self.w.mask(self.membership.of(index)) & !leaves);
        }
        RayBodyLanes { lanes: lanes & !leaves, inside }
    }

    /// The rays that have just left this body: they meet it no more.
    #[inline(always)]
    fn leaves(&self, index: u32) -> W::M {
        self.start.is(index)
    }

    /// The nearest body that each ray meets.
    #[inline(always)]
    pub(crate) fn closest_hit(&self, stack: &mut TraversalStack) -> PacketHits<W> {
        self.closest_hit_unresolved(stack).resolved(self.w, self.geometry, &self.rays(), self.membership)
    }

    /// The nearest body that each ray meets, hits to be [resolved](PacketHits::resolved) among them.
    #[inline(always)]
    pub(crate) fn closest_hit_unresolved(&self, stack: &mut TraversalStack) -> PacketHits<W> {
        match self.hierarchy() {
            // The width is asked once more, so that nothing is compiled that it never runs.
            Some(bvh) if W::USES_HIERARCHY => closest_hit_of_many(*self, bvh, stack),
            _ => self.closest_hit_by(
                #[inline(always)]
                |visitor| self.visit_few(visitor),
            ),
        }
    }

    /// The nearest body that each ray meets, of planes and the bounded bodies that `visit` shows.
    #[inline(always)]
    fn closest_hit_by(&self, visit: impl FnOnce(&mut ClosestHits<W>)) -> PacketHits<W> {
        let mut best = ClosestHits::new(self.w, self.geometry, self.origin_error_bound());
        visit(&mut best);
        self.visit_planes(&mut best);
        best.first(self.w, self.geometry, self.lanes)
    }

    fn rays(&self) -> RayPacket<W> {
        RayPacket { origin: self.origin, direction: self.direction, start: self.start }
    }

    /// The boxes in which bodies are looked for, if they are.
    #[inline(always)]
    pub(crate) fn hierarchy(&self) -> Option<&'a Bvh> {
        match &self.geometry.hierarchy {
            Accelerator::Many(bvh) if W::USES_HIERARCHY => Some(bvh),
            Accelerator::Few | Accelerator::Many(_) => None,
        }
    }

    /// Shows `visitor` the bounded bodies that some of the rays may meet.
    #[inline(always)]
    pub(crate) fn visit(&self, stack: &mut TraversalStack, visitor: &mut impl BodyVisitor<W>) {
        match self.hierarchy() {
            Some(bvh) => self.visit_many(bvh, stack, visitor),
            None => self.visit_few(visitor),
        }
    }

    #[inline(always)]
    pub(crate) fn visit_many(
        &self,
        bvh: &Bvh,
        stack: &mut TraversalStack,
        visitor: &mut impl BodyVisitor<W>,
    ) {
        let boxes = bvh.packet(self.w, self.origin, self.direction, self.lanes);
        bvh.traverse_packet(self.w, &boxes, stack, &mut PacketLeaves { query: self, visitor });
    }

    /// Shows `visitor` the bodies of a leaf near whose spheres some of the rays come.
    #[inline(always)]
    pub(crate) fn visit_leaf(&self, bodies: Range<u32>, lanes: W::M, visitor: &mut impl BodyVisitor<W>) {
        for index in bodies {
            let lanes = lanes & self.meets_sphere(index, visitor.t_max());
            if lanes.any() {
                visitor.body(self, index, lanes);
            }
        }
    }

    #[inline(always)]
    pub(crate) fn visit_few(&self, visitor: &mut impl BodyVisitor<W>) {
        match self.candidates {
            Candidates::Only(sights) => self.visit_seen(&sights.bodies, visitor),
            Candidates::All => self.visit_all(visitor),
        }
    }

    /// Shows `visitor` the planes that some of the rays may meet.
    #[inline(always)]
    pub(crate) fn visit_planes(&self, visitor: &mut impl BodyVisitor<W>) {
        match self.candidates {
            Candidates::Only(VisibleBodies { planes, .. }) => {
                for &index in planes {
                    visitor.body(self, index, self.lanes);
                }
            }
            Candidates::All => {
                for index in self.geometry.planes() {
                    visitor.body(self, index, self.lanes);
                }
            }
        }
    }

    /// Up to so many bodies are tested and visited one after the other; of more, all are tested first.
    const ONE_BY_ONE: usize = 10;

    #[inline(always)]
    fn visit_all(&self, visitor: &mut impl BodyVisitor<W>) {
        let spheres = &self.geometry.spheres;
        if spheres.len() > Self::ONE_BY_ONE {
            return self.visit_tested(
                spheres,
                visitor,
                #[inline(always)]
                |sphere, t_max| sphere.is_met(self.origin, self.direction, t_max),
                #[inline(always)]
                |_, place| place as u32,
            );
        }
        for (sphere, index) in spheres.iter().zip(0..) {
            // Often all have just left the same body.
            let lanes = self.lanes & !self.leaves(index);
            if !lanes.any() {
                continue;
            }
            let lanes = lanes & sphere.is_met(self.origin, self.direction, visitor.t_max());
            if lanes.any() {
                visitor.body(self, index, lanes);
            }
        }
    }

    #[inline(always)]
    fn visit_seen(&self, sights: &[BoundingCone], visitor: &mut impl BodyVisitor<W>) {
        if sights.len() > Self::ONE_BY_ONE {
            return self.visit_tested(
                sights,
                visitor,
                #[inline(always)]
                |sight, t_max| sight.is_met(self.direction, t_max),
                #[inline(always)]
                |sight, _| sight.body,
            );
        }
        for sight in sights {
            let lanes = self.lanes & sight.is_met(self.direction, visitor.t_max());
            if lanes.any() {
                visitor.body(self, sight.body, lanes);
            }
        }
    }

    /// Tests bodies, then shows `visitor` those that some of the rays may meet: tests do not wait for each other, and nobody
    /// has to guess after each of them whether there will be a visit.
    #[inline(always)]
    fn visit_tested<T>(
        &self,
        bodies: &[T],
        visitor: &mut impl BodyVisitor<W>,
        is_met: impl Fn(&T, W::R) -> W::M,
        index: impl Fn(&T, usize) -> u32,
    ) {
        const AT_ONCE: usize = 64;
        for (bodies, start) in bodies.chunks(AT_ONCE).zip((0..).step_by(AT_ONCE)) {
            let t_max = visitor.t_max();
            let (mut lanes, mut some) = ([0; AT_ONCE], 0_u64);
            for (at, body) in bodies.iter().enumerate() {
                let met = (self.lanes & is_met(body, t_max)).bits();
                lanes[at % AT_ONCE] = met;
                some |= u64::from(met != 0) << at;
            }
            while some != 0 {
                let at = some.trailing_zeros() as usize % AT_ONCE;
                some &= some - 1;
                if let Some(body) = bodies.get(at) {
                    let index = index(body, start + at);
                    visitor.body(self, index, self.w.mask(lanes[at]));
                }
            }
        }
    }

    /// The first meeting of one ray with every body that it meets, in no particular order.
    pub(crate) fn all_hits(&self, stack: &mut TraversalStack, mut found: impl FnMut(HitRecord)) {
        let mut test = |index: u32| {
            let mut best = ClosestHits::new(self.w, self.geometry, self.origin_error_bound());
            best.body(self, index, self.lanes);
            found_in(&best.first(self.w, self.geometry, self.lanes)).into_iter().for_each(&mut found);
        };
        self.each_body(stack, &mut test);
    }

    /// Shows `test` every body that some of the rays may meet, in no particular order.
    pub(crate) fn each_body(&self, stack: &mut TraversalStack, test: &mut impl FnMut(u32)) {
        let mut visitor = EachBody { t_max: self.w.real(f32::INFINITY), test };
        self.visit(stack, &mut visitor);
        self.visit_planes(&mut visitor);
    }

    /// Which rays come near a body of a leaf before `t_max`, but for those that have just left it: a sphere is a fraction of
    /// a body in memory, and of its test.
    #[inline(always)]
    fn meets_sphere(&self, index: u32, t_max: W::R) -> W::M {
        self.geometry.sphere(index).is_met(self.origin, self.direction, t_max) & !self.leaves(index)
    }

    /// Where rays meet a body first, if they may at all.
    #[inline(always)]
    pub(crate) fn intersect_body(&self, index: u32, lanes: W::M) -> Option<BodyIntersection<W>> {
        let body = self.geometry.body(index);
        let RayBodyLanes { lanes, inside } = self.relation(index, body, lanes);
        if lanes.any() { self.intersection((index, body), lanes, inside) } else { None }
    }

    /// Where rays meet a body first, if any do.
    #[inline(always)]
    pub(crate) fn intersection(
        &self,
        body: (u32, &RenderBody),
        lanes: W::M,
        inside: W::M,
    ) -> Option<BodyIntersection<W>> {
        let span = self.w.run_once(
            #[inline(always)]
            || self.geometry.span(self.w, body, self.origin, self.direction),
        );
        if !(lanes & (inside | span.hit)).any() {
            return None;
        }
        let zero = self.w.real(0.0);
        let ahead = lanes & !inside & span.hit & span.exit.gt(zero);
        let enters = span.enter.gt(zero);
        let mut meeting = BodyIntersection {
            entering: ahead & enters,
            enter: span.enter,
            enter_face: span.enter_face,
            leaving: lanes & inside,
            // Rounding may put the far side just behind a start inside.
            exit: span.exit.max(zero),
            exit_face: span.exit_face,
        };
        let within = ahead & !enters;
        if within.any() {
            let start = start_within(
                self.w,
                (self.geometry, body.0),
                (self.origin, self.direction),
                self.origin_error_bound(),
                within,
            );
            meeting.entering = meeting.entering | start.at_entry;
            meeting.enter = W::R::select(start.at_entry, zero, span.enter);
            meeting.leaving = meeting.leaving | start.inside;
        }
        Some(meeting)
    }
}

/// The nearest body that each ray meets, of many. In a function of its own: the numbers of the loop over a few bodies stay
/// in registers only where nothing is given their address.
#[inline(never)]
fn closest_hit_of_many<W: Width>(
    query: RayQuery<'_, W>,
    bvh: &Bvh,
    stack: &mut TraversalStack,
) -> PacketHits<W> {
    query.w.run(
        #[inline(always)]
        || {
            query.closest_hit_by(
                #[inline(always)]
                |visitor| query.visit_many(bvh, stack, visitor),
            )
        },
    )
}

/// What is true of the rays that start within a body by the numbers, but perhaps only by their rounding.
///
/// Bodies often touch: a box stands on a floor, two panes share a face. A start that is no deeper than the bound of
/// rounding counts as outside: heading in it meets the surface at once, heading out it does not. So neither side of a
/// contact can be slipped through or shade itself. Depths are measured across the surface: along the ray they grow
/// without bound when it grazes. In a body thinner than rounding the nearer surface counts.
///
/// What is rare is given copies: a reference would keep the numbers of the loop that it is called from in memory.
#[cold]
#[inline(never)]
fn start_within<W: Width>(
    w: W,
    (geometry, body): (&Geometry, u32),
    (origin, direction): (Vector<W::R>, Vector<W::R>),
    origin_error_bound: W::R,
    within: W::M,
) -> OriginSide<W::M> {
    w.run(
        #[inline(always)]
        || {
            let (span, [at_enter, at_exit]) = geometry.span_and_cosines(w, body, origin, direction);
            let error_bound = origin_error_bound + geometry.body(body).error_bound;
            let behind_entry = -span.enter * at_enter;
            let before_exit = span.exit * at_exit;
            let at_entry = within & behind_entry.le(error_bound) & behind_entry.le(before_exit);
            let inside = within & !at_entry & !before_exit.le(error_bound);
            OriginSide { at_entry, inside }
        },
    )
}

/// The leaves that a packet meets.
struct PacketLeaves<'f, 'a, W: Width, V> {
    query: &'f RayQuery<'a, W>,
    visitor: &'f mut V,
}

impl<W: Width, V: BodyVisitor<W>> LeafVisitor<W> for PacketLeaves<'_, '_, W, V> {
    const NEAREST_FIRST: bool = V::NEAREST_FIRST;

    #[inline(always)]
    fn t_max(&self) -> W::R {
        self.visitor.t_max()
    }

    #[inline(always)]
    fn leaf(&mut self, bodies: Range<u32>, lanes: W::M) {
        self.query.visit_leaf(bodies, lanes, self.visitor);
    }
}

/// Every body that rays may meet, wherever.
struct EachBody<'f, W: Width, F> {
    t_max: W::R,
    test: &'f mut F,
}

impl<W: Width, F: FnMut(u32)> BodyVisitor<W> for EachBody<'_, W, F> {
    const NEAREST_FIRST: bool = false;

    fn t_max(&self) -> W::R {
        self.t_max
    }

    fn body(&mut self, _query: &RayQuery<'_, W>, index: u32, _lanes: W::M) {
        (self.test)(index);
    }
}

/// Rays that start within a body by the numbers.
struct OriginSide<M> {
    /// Those that meet the surface at once, on the way in.
    at_entry: M,
    /// Those that are inside indeed.
    inside: M,
}

/// The hit of one ray.
pub(crate) fn found_in<W: Width>(hits: &PacketHits<W>) -> Option<HitRecord> {
    let (mut t, mut body) = ([0.0; MOST_LANES], [0; MOST_LANES]);
    hits.t.store(&mut t);
    hits.body.store(&mut body);
    let is_hit = hits.hit.bits() & 1 == 1 && t[0] < f32::INFINITY;
    is_hit.then(|| HitRecord { t: t[0], body: body[0], leaving: hits.leaving.bits() & 1 == 1 })
}
