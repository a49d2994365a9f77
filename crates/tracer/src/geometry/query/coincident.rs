//! Surfaces that coincide: of bodies that are entered, or left, at the same place the first in the scene counts.

use crate::geometry::Geometry;
use crate::geometry::bvh::packet::TraversalStack;
use crate::geometry::membership::BodyMembership;
use crate::geometry::query::candidates::Candidates;
use crate::geometry::query::closest::{ClosestHit, ClosestHits, GRAZING};
use crate::geometry::query::{BodyVisitor, JoinedHits, PacketHits, RayQuery};
use crate::geometry::ray::{POINT_ROUNDING, RayPacket, error_bound_at};
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Float32, MOST_LANES, Mask as _, Width, Word as _};

/// Where one ray crosses the surface of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SurfaceCrossing {
    pub(crate) t: f32,
    pub(crate) face: f32,
    /// Of a joined body, the part that makes the surface there.
    pub(crate) body: u32,
    /// Whether the ray leaves the body, or the whole.
    pub(crate) leaving: bool,
}

impl SurfaceCrossing {
    /// The nearest one, if there is any.
    pub(crate) fn of(nearest: &ClosestHit<ScalarWidth>, leaving: bool) -> Option<Self> {
        let ClosestHit { t, face, body, .. } = *nearest;
        (t < f32::INFINITY).then_some(Self { t, face, body, leaving })
    }
}

/// The first hits of rays, those that are contested found anew by the rule for surfaces that coincide: within the bound of
/// rounding, measured across the surfaces, the body that comes first in the scene counts. They are rare, and are looked at
/// ray by ray, so that the outcome depends neither on the width nor on the order in which bodies are met; and that what
/// they need is not in the way of all others.
#[cold]
#[inline(never)]
pub(crate) fn resolve_coincident<W: Width>(
    w: W,
    geometry: &Geometry,
    rays: &RayPacket<W>,
    inside: &BodyMembership,
    hits: PacketHits<W>,
) -> PacketHits<W> {
    let [mut ts, mut faces] = [[0.0; MOST_LANES]; 2];
    let [mut bodies, mut starts, mut contacts] = [[0; MOST_LANES]; 3];
    hits.t.store(&mut ts);
    hits.face.store(&mut faces);
    hits.body.store(&mut bodies);
    rays.start.store(&mut starts);
    hits.contact.store(&mut contacts);
    let (mut leaving, mut hit) = (hits.leaving.bits(), hits.hit.bits());
    let [origins, directions] = [rays.origin, rays.direction].map(rows);
    let mut stack = TraversalStack::default();
    let mut left = hits.contested.bits();
    while left != 0 {
        let lane = left.trailing_zeros() as usize % MOST_LANES;
        left &= left - 1;
        let vector = |rows: &[[f32; MOST_LANES]; 3]| Vector::new(rows[0][lane], rows[1][lane], rows[2][lane]);
        let rays =
            RayPacket { origin: vector(&origins), direction: vector(&directions), start: starts[lane] };
        let inside = inside.of_lane(lane);
        let first = RayQuery::new(ScalarWidth, geometry, &rays, true, &inside, Candidates::All)
            .first_resolved(&mut stack);
        (ts[lane], faces[lane], bodies[lane]) = (first.t, first.face, first.body);
        contacts[lane] = first.contact;
        let at = 1 << lane;
        leaving = leaving & !at | if first.leaving { at } else { 0 };
        hit = hit & !at | if first.hit { at } else { 0 };
    }
    PacketHits {
        t: w.load(&ts),
        body: w.load_words(&bodies),
        leaving: w.mask(leaving),
        face: w.load(&faces),
        hit: w.mask(hit),
        contested: w.mask(0),
        contact: w.load_words(&contacts),
    }
}

/// The components of vectors side by side.
fn rows<R: Float32>(vector: Vector<R>) -> [[f32; MOST_LANES]; 3] {
    let mut rows = [[0.0; MOST_LANES]; 3];
    vector.x.store(&mut rows[0]);
    vector.y.store(&mut rows[1]);
    vector.z.store(&mut rows[2]);
    rows
}

impl RayQuery<'_, ScalarWidth> {
    /// The first hit of the ray, of bodies that are entered where it is, or left, the first in the scene.
    fn first_resolved(&self, stack: &mut TraversalStack) -> PacketHits<ScalarWidth> {
        let mut best = ClosestHits::new(ScalarWidth, self.geometry, self.origin_error_bound());
        self.visit(stack, &mut best);
        self.visit_planes(&mut best);
        for (nearest, leaving) in [(&mut best.entering, false), (&mut best.leaving, true)] {
            if let Some(first) = SurfaceCrossing::of(nearest, leaving) {
                let counts = self.first_of_coincident(first, stack);
                (nearest.t, nearest.face, nearest.body) = (counts.t, counts.face, counts.body);
            }
        }
        let cemented = if self.geometry.has_cemented { self.cemented_hit(&best, stack) } else { None };
        cemented.unwrap_or_else(|| best.first(ScalarWidth, self.geometry, false))
    }

    /// Of the bodies that are entered, or left, where the nearest one is, the one that comes first in the scene.
    fn first_of_coincident(&self, nearest: SurfaceCrossing, stack: &mut TraversalStack) -> SurfaceCrossing {
        let mut crossings = self.crossings_near(nearest.t, stack);
        crossings.retain(|crossing| crossing.leaving == nearest.leaving);
        // Of equal ones the first in the scene, so that the order of visits does not matter.
        let order = |one: &SurfaceCrossing, other: &SurfaceCrossing| {
            one.t.total_cmp(&other.t).then_with(|| self.geometry.scene_order(one.body, other.body))
        };
        let nearest = crossings.iter().copied().min_by(order).unwrap_or(nearest);
        let own_cosine = self.cosine(&nearest);
        let coincides = |other: &SurfaceCrossing| self.coincide((&nearest, own_cosine), other);
        let others = crossings.into_iter().filter(|other| other.body != nearest.body && coincides(other));
        others.fold(nearest, |first, other| {
            if self.geometry.scene_order(other.body, first.body).is_lt() { other } else { first }
        })
    }

    /// The first crossings of bodies that may coincide with one at `t`, and those before.
    pub(crate) fn crossings_near(&self, t: f32, stack: &mut TraversalStack) -> Vec<SurfaceCrossing> {
        let mut visitor = CrossingVisitor { t_max: t + self.most_apart(t), crossings: Vec::new() };
        self.visit(stack, &mut visitor);
        self.visit_planes(&mut visitor);
        visitor.crossings
    }

    /// Whether two crossings are one within the bound of rounding, measured across the surfaces; with the first one's
    /// [cosine](Self::cosine).
    pub(crate) fn coincide(&self, (one, cosine): (&SurfaceCrossing, f32), other: &SurfaceCrossing) -> bool {
        let error_bound = |crossing: &SurfaceCrossing| self.geometry.body(crossing.body).error_bound;
        let across = (other.t - one.t).abs() * cosine.max(self.cosine(other));
        across <= self.slack_at(one.t) + error_bound(one).max(error_bound(other))
    }

    /// How far from one at `t` crossings may lie along the ray that coincide with it, meters.
    pub(crate) fn most_apart(&self, t: f32) -> f32 {
        GRAZING * (self.slack_at(t) + self.geometry.largest_error_bound)
    }

    /// How far points at `t` along the ray may lie from their true places by rounding, meters.
    fn slack_at(&self, t: f32) -> f32 {
        error_bound_at(self.origin) + t * POINT_ROUNDING
    }

    /// |cos| of the angle between the ray and the normal where it crosses a surface.
    pub(crate) fn cosine(&self, crossing: &SurfaceCrossing) -> f32 {
        // Of what is cut away, leaving is entering.
        let leaving = self.geometry.joined.turned(ScalarWidth, crossing.body, crossing.leaving);
        let cosines =
            self.geometry.span_and_cosines(ScalarWidth, crossing.body, self.origin, self.direction).1;
        cosines[usize::from(leaving)]
    }
}

/// Writes down where a ray first enters bodies, or leaves them.
struct CrossingVisitor {
    t_max: f32,
    crossings: Vec<SurfaceCrossing>,
}

impl CrossingVisitor {
    fn note(&mut self, is_met: bool, crossing: SurfaceCrossing) {
        if is_met && crossing.t <= self.t_max {
            self.crossings.push(crossing);
        }
    }
}

impl BodyVisitor<ScalarWidth> for CrossingVisitor {
    const NEAREST_FIRST: bool = false;

    fn t_max(&self) -> f32 {
        self.t_max
    }

    fn body(&mut self, query: &RayQuery<'_, ScalarWidth>, index: u32, is_near: bool) {
        if query.geometry.body(index).is_joined() {
            let JoinedHits { t, part, face, entering, leaving } = query.first_of_joined(index, is_near);
            return self.note(entering | leaving, SurfaceCrossing { t, face, body: part, leaving });
        }
        let Some(met) = query.intersect_body(index, is_near) else { return };
        let entry = SurfaceCrossing { t: met.enter, face: met.enter_face, body: index, leaving: false };
        self.note(met.entering, entry);
        let exit = SurfaceCrossing { t: met.exit, face: met.exit_face, body: index, leaving: true };
        self.note(met.leaving, exit);
    }
}
