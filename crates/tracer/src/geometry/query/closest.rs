//! The nearest hits so far.

use crate::geometry::Geometry;
use crate::geometry::query::{BodyIntersection, BodyVisitor, JoinedHits, PacketHits, RayQuery};
use crate::geometry::ray::{NO_START, POINT_ROUNDING};
use crate::simd::{Float as _, Float32, MOST_LANES, Mask as _, Width, Word as _};

/// Hits that coincide may lie so many times the bound of rounding apart along a ray: it is a bound across the surface, which
/// the ray may graze. Rounding is far less than its bound, so that more than a thousandfold is allowed for.
pub(crate) const GRAZING: f32 = 64.0;

/// The nearest hits so far of one direction through the surface.
#[derive(Clone, Copy)]
pub(crate) struct ClosestHit<W: Width> {
    pub(crate) t: W::R,
    pub(crate) body: W::W,
    pub(crate) face: W::R,
    /// The parameter of the hit after it.
    pub(crate) second: W::R,
}

/// The nearest hits so far: those that lead out of a body and those that lead in, each by themselves, so that the
/// outcome does not depend on the order in which bodies are tested.
pub(crate) struct ClosestHits<W: Width> {
    pub(crate) leaving: ClosestHit<W>,
    pub(crate) entering: ClosestHit<W>,
    /// No body beyond this parameter can change the outcome any more; finite.
    pub(crate) t_max: W::R,
    pub(crate) origin_error_bound: W::R,
    /// The [`margin`] of these rays, meters.
    pub(crate) margin: W::R,
}

/// How far apart hits that coincide may lie at the start of rays, [`GRAZING`] and the slacks of two bodies included.
#[inline(always)]
fn margin<R: Float32>(geometry: &Geometry, origin_error_bound: R) -> R {
    (origin_error_bound + 2.0 * geometry.largest_error_bound) * GRAZING
}

/// Up to where hits may coincide with one at `t`; `margin` is how far apart they may lie at the start of the rays.
#[inline(always)]
fn t_max_for<R: Float32>(t: R, margin: R) -> R {
    t.times_plus(t.like(1.0 + GRAZING * POINT_ROUNDING), margin)
}

impl<W: Width> ClosestHits<W> {
    #[inline(always)]
    pub(crate) fn new(w: W, geometry: &Geometry, origin_error_bound: W::R) -> Self {
        let infinity = w.real(f32::INFINITY);
        let nearest = ClosestHit { t: infinity, body: w.word(0), face: w.real(0.0), second: infinity };
        let margin = margin(geometry, origin_error_bound);
        let t_max = w.real(f32::MAX);
        Self { leaving: nearest, entering: nearest, t_max, origin_error_bound, margin }
    }

    /// How far apart by rounding two hits at about `t` can lie that should coincide, of bodies whose larger slack is
    /// this: each slack is twice its bound, so the larger one covers both.
    #[inline(always)]
    fn error_bound_at(&self, t: W::R, larger: W::R) -> W::R {
        t.times_plus(t.like(POINT_ROUNDING), self.origin_error_bound + larger)
    }

    /// Takes note of where rays first cross the surface of a joined body.
    #[inline(always)]
    fn offer_joined(&mut self, w: W, first: &JoinedHits<W>) {
        let JoinedHits { t, part, face, entering, leaving } = *first;
        self.entering.offer(w, part, (t, face), entering);
        self.leaving.offer(w, part, (t, face), leaving);
        self.t_max = self.t_max.min(t_max_for(self.entering.t.min(self.leaving.t), self.margin));
    }

    /// The first hits of `lanes`, before those that are contested are settled. Of hits that coincide within rounding, the
    /// one that leads out comes before the one that leads in: bodies that touch have a film of air between them.
    #[inline(always)]
    pub(crate) fn first(&self, w: W, geometry: &Geometry, lanes: W::M) -> PacketHits<W> {
        let infinity = w.real(f32::INFINITY);
        let ClosestHit { t, body, face, .. } = self.entering;
        let leaves = self.leaving.t.lt(infinity);
        let mut hits: PacketHits<W> = PacketHits {
            t,
            body,
            leaving: leaves & !leaves,
            face,
            hit: t.lt(infinity) | leaves,
            contested: lanes & self.entering.is_contested(w, self.margin),
            contact: w.word(NO_START),
        };
        if leaves.any() {
            hits.contested = hits.contested | lanes & self.leaving.is_contested(w, self.margin);
            let out = self.leaving.t;
            if geometry.has_cemented {
                let touches = out.le(t_max_for(t, self.margin)) & t.le(t_max_for(out, self.margin));
                hits.contested = hits.contested | lanes & leaves & touches;
            }
            let surely = leaves & out.le(t + self.error_bound_at(t, w.real(0.0)));
            let perhaps = leaves & out.le(t + self.error_bound_at(t, w.real(geometry.largest_error_bound)));
            hits.leaving = surely;
            if (perhaps & !surely).any() {
                let larger = larger_error_bound(w, geometry, body, self.leaving.body);
                hits.leaving = leaves & out.le(t + self.error_bound_at(t, larger));
            }
            hits.t = W::R::select(hits.leaving, self.leaving.t, t);
            hits.face = W::R::select(hits.leaving, self.leaving.face, face);
            hits.body = W::W::select(hits.leaving, self.leaving.body, body);
        }
        // Up to here rays leave or enter bodies; from here on the surfaces of parts.
        hits.leaving = geometry.joined.turned(w, hits.body, hits.leaving);
        hits
    }
}

impl<W: Width> BodyVisitor<W> for ClosestHits<W> {
    const NEAREST_FIRST: bool = true;

    #[inline(always)]
    fn t_max(&self) -> W::R {
        self.t_max
    }

    #[inline(always)]
    fn body(&mut self, query: &RayQuery<'_, W>, index: u32, lanes: W::M) {
        if query.geometry.body(index).is_joined() {
            return self.offer_joined(query.w, &query.first_of_joined(index, lanes));
        }
        let Some(meeting) = query.intersect_body(index, lanes) else { return };
        let BodyIntersection { entering, enter, enter_face, leaving, exit, exit_face } = meeting;
        if entering.any() {
            self.entering.offer(query.w, query.w.word(index), (enter, enter_face), entering);
            self.t_max = self.t_max.min(t_max_for(self.entering.t, self.margin));
        }
        if leaving.any() {
            self.leaving.offer(query.w, query.w.word(index), (exit, exit_face), leaving);
            self.t_max = self.t_max.min(t_max_for(self.leaving.t, self.margin));
        }
    }
}

impl<W: Width> ClosestHit<W> {
    /// Takes note of hits. Which of equal ones counts is left to
    /// [`resolve_coincident`](crate::geometry::query::coincident::resolve_coincident).
    #[inline(always)]
    fn offer(&mut self, w: W, body: W::W, (t, face): (W::R, W::R), lanes: W::M) {
        let t = W::R::select(lanes, t, w.real(f32::INFINITY));
        self.second = self.second.min(t.max(self.t));
        let is_nearer = t.lt(self.t);
        self.t = self.t.min(t);
        self.body = W::W::select(is_nearer, body, self.body);
        self.face = W::R::select(is_nearer, face, self.face);
    }

    /// The rays whose two nearest hits may coincide.
    #[inline(always)]
    fn is_contested(&self, w: W, margin: W::R) -> W::M {
        self.second.le(t_max_for(self.t, margin)) & self.second.lt(w.real(f32::INFINITY))
    }
}

/// The larger slack of two bodies.
#[cold]
#[inline(never)]
fn larger_error_bound<W: Width>(w: W, geometry: &Geometry, one: W::W, other: W::W) -> W::R {
    let (mut ones, mut others) = ([0; MOST_LANES], [0; MOST_LANES]);
    one.store(&mut ones);
    other.store(&mut others);
    let mut slacks = [0.0; MOST_LANES];
    for (error_bound, (&one, &other)) in slacks.iter_mut().zip(ones.iter().zip(&others)) {
        *error_bound = geometry.body(one).error_bound.max(geometry.body(other).error_bound);
    }
    w.load(&slacks)
}
