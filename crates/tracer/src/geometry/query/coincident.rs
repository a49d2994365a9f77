//! Surfaces that coincide: of bodies that are entered, or left, at the same place the first in the scene counts.

use crate::geometry::Geometry;
use crate::geometry::bvh::packet::TraversalStack;
use crate::geometry::membership::BodyMembership;
use crate::geometry::query::candidates::Candidates;
use crate::geometry::query::closest::{ClosestHits, GRAZING};
use crate::geometry::query::{BodyVisitor, JoinedHits, PacketHits, RayQuery};
use crate::geometry::ray::{POINT_ROUNDING, RayPacket, error_bound_at};
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Float32, MOST_LANES, Mask as _, Width, Word as _};

/// Where one ray crosses the surface of a body.
#[derive(Clone, Copy, Debug, PartialEq)]
struct SurfaceCrossing {
    t: f32,
    face: f32,
    body: u32,
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
    let [mut bodies, mut starts] = [[0; MOST_LANES]; 2];
    hits.t.store(&mut ts);
    hits.face.store(&mut faces);
    hits.body.store(&mut bodies);
    rays.start.store(&mut starts);
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
            if nearest.t < f32::INFINITY {
                let first = SurfaceCrossing { t: nearest.t, face: nearest.face, body: nearest.body };
                let counts = self.first_of_coincident(first, leaving, stack);
                (nearest.t, nearest.face, nearest.body) = (counts.t, counts.face, counts.body);
            }
        }
        best.first(ScalarWidth, self.geometry, false)
    }

    /// Of the bodies that are entered, or left, where the nearest one is, the one that comes first in the scene.
    fn first_of_coincident(
        &self,
        nearest: SurfaceCrossing,
        leaving: bool,
        stack: &mut TraversalStack,
    ) -> SurfaceCrossing {
        let slack_there = error_bound_at(self.origin) + nearest.t * POINT_ROUNDING;
        let error_bound = |body: u32| self.geometry.body(body).error_bound;
        let t_max = nearest.t + GRAZING * (slack_there + self.geometry.largest_error_bound);
        let mut visitor = CrossingVisitor { leaving, t_max, crossings: Vec::new() };
        self.visit(stack, &mut visitor);
        self.visit_planes(&mut visitor);
        let crossings = visitor.crossings;
        // Of equal ones the first in the scene, so that the order of visits does not matter.
        let order = |one: &SurfaceCrossing, other: &SurfaceCrossing| {
            one.t.total_cmp(&other.t).then_with(|| self.geometry.scene_order(one.body, other.body))
        };
        let nearest = crossings.iter().copied().min_by(order).unwrap_or(nearest);
        let own_slack = error_bound(nearest.body);
        let own_cosine = self.cosine(nearest.body, leaving);
        let coincides = |crossing: &SurfaceCrossing| {
            let across = (crossing.t - nearest.t) * own_cosine.max(self.cosine(crossing.body, leaving));
            across <= slack_there + own_slack.max(error_bound(crossing.body))
        };
        let others = crossings.into_iter().filter(|other| other.body != nearest.body && coincides(other));
        others.fold(nearest, |first, other| {
            if self.geometry.scene_order(other.body, first.body).is_lt() { other } else { first }
        })
    }

    /// |cos| of the angle between the ray and the normal where it enters or leaves a body.
    fn cosine(&self, body: u32, leaving: bool) -> f32 {
        // Of what is cut away, leaving is entering.
        let leaving = self.geometry.joined.turned(ScalarWidth, body, leaving);
        let cosines = self.geometry.span_and_cosines(ScalarWidth, body, self.origin, self.direction).1;
        cosines[usize::from(leaving)]
    }
}

/// Writes down where a ray enters bodies, or leaves them.
struct CrossingVisitor {
    leaving: bool,
    t_max: f32,
    crossings: Vec<SurfaceCrossing>,
}

impl BodyVisitor<ScalarWidth> for CrossingVisitor {
    const NEAREST_FIRST: bool = false;

    fn t_max(&self) -> f32 {
        self.t_max
    }

    fn body(&mut self, query: &RayQuery<'_, ScalarWidth>, index: u32, is_near: bool) {
        if query.geometry.body(index).is_joined() {
            let JoinedHits { t, part, face, entering, leaving } = query.first_of_joined(index, is_near);
            let is_met = if self.leaving { leaving } else { entering };
            if is_met && t <= self.t_max {
                self.crossings.push(SurfaceCrossing { t, face, body: part });
            }
            return;
        }
        let Some(meeting) = query.intersect_body(index, is_near) else { return };
        let (is_met, t, face) = if self.leaving {
            (meeting.leaving, meeting.exit, meeting.exit_face)
        } else {
            (meeting.entering, meeting.enter, meeting.enter_face)
        };
        if is_met && t <= self.t_max {
            self.crossings.push(SurfaceCrossing { t, face, body: index });
        }
    }
}
