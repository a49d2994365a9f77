//! Where rays cross an intersection of simple parts, or a surface within one.
//!
//! An intersection of convex parts is convex: a ray is in it from the last of the parts' entries to the first of their
//! exits, which is found for rays side by side. So it is with a surface: where it is met has to lie between these. Rays for
//! which rounding may decide are left to the walk.

use crate::geometry::joined::JoinedBody;
use crate::geometry::query::closest::GRAZING;
use crate::geometry::query::joined::FirstCrossings;
use crate::geometry::query::{JoinedHits, RayQuery};
use crate::geometry::ray::{INWARDS, POINT_ROUNDING};
use crate::geometry::shape::SIDE;
use crate::simd::{Float as _, Mask as _, Width, Word as _};

/// Where rays cross the surface of an intersection, or a surface within it.
pub(crate) struct ConvexSpan<W: Width> {
    enter: ConvexCrossing<W>,
    exit: ConvexCrossing<W>,
    /// Those that enter ahead, and those that leave ahead, whether they have entered before or not.
    entering: W::M,
    leaving: W::M,
    /// Those that have to be walked: they are in neither.
    doubtful: W::M,
}

/// Where rays cross the surface of the part that decides.
struct ConvexCrossing<W: Width> {
    t: W::R,
    part: W::W,
    face: W::R,
    /// Where they cross that of the part that decides without it.
    second: W::R,
}

impl<W: Width> ConvexCrossing<W> {
    fn new(w: W, t: f32) -> Self {
        Self { t: w.real(t), part: w.word(0), face: w.real(0.0), second: w.real(t) }
    }

    /// Takes note of another part's crossing, where that `decides`.
    #[inline(always)]
    fn offer(&mut self, w: W, part: u32, (t, face): (W::R, W::R), decides: W::M) {
        self.t = W::R::select(decides, t, self.t);
        self.part = W::W::select(decides, w.word(part), self.part);
        self.face = W::R::select(decides, face, self.face);
    }
}

impl<W: Width> ConvexSpan<W> {
    /// The rays that enter the body, and where, if that is before `end`; and those that leave it before.
    #[inline(always)]
    pub(crate) fn crossed_before(&self, end: W::R) -> [W::M; 2] {
        [self.entering & self.enter.t.lt(end), self.leaving & self.exit.t.lt(end)]
    }

    pub(crate) fn doubtful(&self) -> W::M {
        self.doubtful
    }
}

impl<W: Width> RayQuery<'_, W> {
    /// Where rays first cross the body at this place, which is [convex](crate::geometry::joined::JoinTree::is_convex).
    #[inline(always)]
    pub(crate) fn first_of_convex(&self, index: u32, body: &JoinedBody, lanes: W::M) -> JoinedHits<W> {
        let ConvexSpan { enter, exit, entering, leaving, doubtful } = self.convex_span(index, body, lanes);
        let hits = JoinedHits {
            t: W::R::select(entering, enter.t, exit.t),
            part: W::W::select(entering, enter.part, exit.part),
            face: W::R::select(entering, enter.face, exit.face),
            entering,
            leaving: leaving & !entering,
        };
        if !doubtful.any() {
            return hits;
        }
        let walked = FirstCrossings::of(self.walks(index, doubtful)).hits(self.w);
        JoinedHits {
            t: W::R::select(doubtful, walked.t, hits.t),
            part: W::W::select(doubtful, walked.part, hits.part),
            face: W::R::select(doubtful, walked.face, hits.face),
            entering: hits.entering | walked.entering,
            leaving: hits.leaving | walked.leaving,
        }
    }

    /// Where rays `lanes` cross the body at this place.
    #[inline(always)]
    pub(crate) fn convex_span(&self, index: u32, body: &JoinedBody, lanes: W::M) -> ConvexSpan<W> {
        match body.tree.is_surface() {
            true => self.surface_span(body, lanes),
            false => self.intersection_span(index, body, lanes),
        }
    }

    /// Where they cross the surface of the first part within all others.
    #[inline(always)]
    fn surface_span(&self, body: &JoinedBody, lanes: W::M) -> ConvexSpan<W> {
        let (w, first) = (self.w, body.first);
        let infinity = w.real(f32::INFINITY);
        let (mut low, mut high) = (-infinity, infinity);
        let mut in_others = lanes;
        for part in body.parts().skip(1) {
            let span = self.part_span(part);
            low = low.max(span.enter);
            high = high.min(span.exit);
            in_others = in_others & span.hit;
        }
        let span = self.part_span(first);
        let surface = self.geometry.body(first);
        let own = self.start.and(!INWARDS).is(first);
        let from_inside = own & self.start.has(INWARDS);
        let at_start = (self.origin_error_bound() + surface.error_bound) * GRAZING;
        let has_caps = surface.canonical().kind.has_caps();
        let side = body.tree.visible_side();
        let shown = |t: W::R, face: W::R| {
            let shown = in_others & t.ge(low) & t.le(high);
            if has_caps { shown & face.eq(w.real(SIDE)) } else { shown }
        };
        let (enter, exit) = (span.enter, span.exit);
        // It is met once more from within, and never from outside.
        let own_exit = exit.max(w.real(0.0));
        let exit = W::R::select(from_inside, own_exit, exit);
        let [outer, inner] =
            [true, false].map(|from_outside| w.mask(u32::from(side.is_met(from_outside)) * u32::MAX));
        let entered = outer & span.hit & !own & shown(enter, span.enter_face);
        let left = inner & (span.hit & !own | from_inside) & shown(exit, span.exit_face);
        let is_near = |t: W::R| t.abs().le(at_start);
        let doubtful = entered & is_near(enter) | left & !own & is_near(exit);
        let crossing = |t, face| ConvexCrossing { t, part: w.word(first), face, second: t };
        ConvexSpan {
            enter: crossing(enter, span.enter_face),
            exit: crossing(exit, span.exit_face),
            entering: entered & enter.gt(at_start) & !doubtful,
            leaving: left & (own | exit.gt(at_start)) & !doubtful,
            doubtful,
        }
    }

    /// Where they cross the surface of the intersection of all parts.
    #[inline(always)]
    fn intersection_span(&self, index: u32, body: &JoinedBody, lanes: W::M) -> ConvexSpan<W> {
        let w = self.w;
        let infinity = w.real(f32::INFINITY);
        let mut enter = ConvexCrossing::new(w, f32::NEG_INFINITY);
        let mut exit = ConvexCrossing::new(w, f32::INFINITY);
        let mut hit = lanes;
        let mut from_own = w.mask(0);
        let starts = self.start.and(!INWARDS);
        for part in body.parts() {
            let mut span = self.part_span(part);
            let own = starts.is(part) & lanes;
            if own.any() {
                // It is met once more from within, and never from outside.
                let inwards = self.start.has(INWARDS);
                span.enter = W::R::select(own, -infinity, span.enter);
                span.exit = W::R::select(own, span.exit.max(w.real(0.0)), span.exit);
                span.hit = (span.hit & !own) | (own & inwards);
                from_own = from_own | own;
            }
            hit = hit & span.hit;
            let later = span.enter.gt(enter.t);
            enter.second = enter.second.max(enter.t.min(span.enter));
            enter.offer(w, part, (span.enter, span.enter_face), later);
            let earlier = span.exit.lt(exit.t);
            exit.second = exit.second.min(exit.t.max(span.exit));
            exit.offer(w, part, (span.exit, span.exit_face), earlier);
        }
        hit = hit & enter.t.le(exit.t);
        let larger = self.origin_error_bound() + self.geometry.body(index).error_bound;
        let at_start = larger * GRAZING;
        let near = |t: W::R| t.times_plus(w.real(GRAZING * POINT_ROUNDING), at_start);
        let (ahead, behind) = (enter.t.gt(at_start), exit.t.lt(-at_start));
        let (entering, within) = (hit & ahead, hit & enter.t.lt(-at_start) & exit.t.gt(at_start));
        let mut doubtful = (hit & !behind & !(entering | within))
            | (entering & (enter.t - enter.second).le(near(enter.t)))
            | ((entering | within) & (exit.second - exit.t).le(near(exit.t)))
            | (entering & (exit.t - enter.t).le(near(exit.t)))
            | (entering & from_own);
        let whole = self.geometry.body(index);
        if whole.is_transparent() && self.geometry.has_transparency {
            let known = w.mask(self.membership.of(index));
            doubtful = doubtful | (entering & known) | (within & !known & !from_own);
        }
        let leaving = (entering | within) & !doubtful;
        ConvexSpan { enter, exit, entering: entering & !doubtful, leaving, doubtful }
    }
}
