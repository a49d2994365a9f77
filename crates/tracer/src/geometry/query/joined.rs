//! Where rays cross the surface of a joined body, one crossing after the other.
//!
//! Crossings of parts that coincide within rounding count as one: what is cut away to a common face leaves no film, and
//! parts that touch have no seam between them. A ray that starts on the surface knows on which side of it it is; of parts
//! whose surfaces run through its start within rounding, that decides.

use std::cmp::Ordering;

use smallvec::SmallVec;

use crate::geometry::Geometry;
use crate::geometry::joined::{JoinTree, JoinedBody};
use crate::geometry::query::closest::GRAZING;
use crate::geometry::query::{JoinedHits, RayQuery};
use crate::geometry::ray::{POINT_ROUNDING, RayOrigin, RayPacket, error_bound_at};
use crate::geometry::shape::{SIDE, ShapeSpan};
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float32 as _, MOST_LANES, Mask as _, Width, Word as _};

/// Where a ray crosses the surface of a joined body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct JoinedCrossing {
    pub(crate) t: f32,
    /// The place in [`Geometry::bodies`] of the part that makes the surface there.
    pub(crate) part: u32,
    /// The face of the part's [`ShapeSpan`].
    pub(crate) face: f32,
    /// Whether the ray enters the whole, whatever it does to the part; of a surface, the part.
    pub(crate) enters: bool,
}

/// Where a ray crosses the surface of a part.
#[derive(Clone, Copy, Debug)]
struct PartCrossing {
    t: f32,
    /// Number of the part.
    part: u32,
    face: f32,
    enters: bool,
}

/// A ray on its way through a joined body.
pub(crate) struct JoinedWalk<'g> {
    geometry: &'g Geometry,
    body: &'g JoinedBody,
    ray: RayPacket<ScalarWidth>,
    origin_error_bound: f32,
    /// Those ahead, in order.
    crossings: SmallVec<[PartCrossing; 16]>,
    /// How many of them are behind.
    passed: usize,
    /// The parts that the ray is in, and whether it is in the whole.
    parts: u64,
    is_inside: bool,
}

/// Spans of a part along rays side by side.
struct SpanRows {
    enter: [f32; MOST_LANES],
    exit: [f32; MOST_LANES],
    enter_face: [f32; MOST_LANES],
    exit_face: [f32; MOST_LANES],
    hit: u32,
}

impl SpanRows {
    #[inline(always)]
    fn of<W: Width>(span: &ShapeSpan<W::R>) -> Self {
        let mut rows = Self {
            enter: [0.0; MOST_LANES],
            exit: [0.0; MOST_LANES],
            enter_face: [0.0; MOST_LANES],
            exit_face: [0.0; MOST_LANES],
            hit: span.hit.bits(),
        };
        span.enter.store(&mut rows.enter);
        span.exit.store(&mut rows.exit);
        span.enter_face.store(&mut rows.enter_face);
        span.exit_face.store(&mut rows.exit_face);
        rows
    }

    fn lane(&self, lane: usize) -> ShapeSpan<f32> {
        ShapeSpan {
            enter: self.enter[lane],
            exit: self.exit[lane],
            enter_face: self.enter_face[lane],
            exit_face: self.exit_face[lane],
            hit: self.hit >> lane & 1 == 1,
        }
    }
}

impl<'a, W: Width> RayQuery<'a, W> {
    /// The rays `lanes` that may come through the body at this place, if it is joined.
    pub(crate) fn walks(&self, index: u32, lanes: W::M) -> Option<JoinedWalks<'a>> {
        let body = self.geometry.joined(index)?;
        let is_known = self.geometry.body(index).is_transparent() && self.geometry.has_transparency;
        let within = is_known.then(|| self.membership.of(index));
        let walks = JoinedWalks {
            geometry: self.geometry,
            body,
            spans: self.spans_of_parts(body),
            rays: PacketRows::of(self),
            within,
            left: lanes.bits(),
        };
        Some(walks.possible())
    }

    /// Where rays first cross the surface of the joined body at this place.
    #[cold]
    #[inline(never)]
    pub(crate) fn first_of_joined(&self, index: u32, lanes: W::M) -> JoinedHits<W> {
        if let Some(body) = self.geometry.joined(index).filter(|body| body.tree.is_convex()) {
            return self.w.run(
                #[inline(always)]
                || self.first_of_convex(index, body, lanes),
            );
        }
        FirstCrossings::of(self.walks(index, lanes)).hits(self.w)
    }

    /// The lines in a part; those that run within a half-space along its surface never leave it.
    #[inline(always)]
    pub(crate) fn part_span(&self, part: u32) -> ShapeSpan<W::R> {
        let body = self.geometry.body(part);
        let mut span = self.geometry.span(self.w, (part, body), self.origin, self.direction);
        if let Some(within) = body.holds_parallel(self.origin, self.direction) {
            let infinity = self.w.real(f32::INFINITY);
            span.enter = W::R::select(within, -infinity, span.enter);
            span.exit = W::R::select(within, infinity, span.exit);
            span.hit = span.hit | within;
        }
        span
    }

    #[inline(never)]
    fn spans_of_parts(&self, body: &JoinedBody) -> SmallVec<[SpanRows; 4]> {
        let mut spans = SmallVec::new();
        let spans_of = &mut spans;
        self.w.run(
            #[inline(always)]
            move || {
                for part in body.parts() {
                    let span = self.part_span(part);
                    spans_of.push(SpanRows::of::<W>(&span));
                }
            },
        );
        spans
    }
}

/// Rays side by side: origins, directions, and where they start.
pub(crate) struct PacketRows {
    numbers: [[f32; MOST_LANES]; 6],
    starts: [u32; MOST_LANES],
}

impl PacketRows {
    pub(crate) fn of<W: Width>(query: &RayQuery<'_, W>) -> Self {
        let mut rows = Self { numbers: [[0.0; MOST_LANES]; 6], starts: [0; MOST_LANES] };
        let (o, d) = (query.origin, query.direction);
        for (row, numbers) in rows.numbers.iter_mut().zip([o.x, o.y, o.z, d.x, d.y, d.z]) {
            numbers.store(row);
        }
        query.start.store(&mut rows.starts);
        rows
    }

    pub(crate) fn lane(&self, lane: usize) -> RayPacket<ScalarWidth> {
        let [x, y, z, along_x, along_y, along_z] = self.numbers.map(|row| row[lane]);
        RayPacket {
            origin: Vector::new(x, y, z),
            direction: Vector::new(along_x, along_y, along_z),
            start: self.starts[lane],
        }
    }
}

/// The rays, of those side by side, that may come through a joined body: with their lanes. In no width, so that it is
/// compiled once.
pub(crate) struct JoinedWalks<'g> {
    geometry: &'g Geometry,
    body: &'g JoinedBody,
    /// Of its parts.
    spans: SmallVec<[SpanRows; 4]>,
    rays: PacketRows,
    /// A bit for each ray that is known to start inside; the others do not.
    within: Option<u32>,
    /// A bit for each ray ahead.
    left: u32,
}

impl JoinedWalks<'_> {
    /// Without the rays that miss too many of the parts.
    fn possible(mut self) -> Self {
        let starts = self.rays.starts.map(RayOrigin::of_word);
        let met = |part: u32| {
            let is_on_it = |start: &RayOrigin| start.body == self.body.first + part && start.inwards;
            let on_it = starts
                .iter()
                .zip(0..)
                .fold(0, |bits, (start, lane)| bits | u32::from(is_on_it(start)) << lane);
            self.spans.get(part as usize).map_or(0, |span| span.hit) | on_it
        };
        self.left &= self.body.tree.possible(met);
        self
    }
}

impl<'g> Iterator for JoinedWalks<'g> {
    type Item = (usize, JoinedWalk<'g>);

    fn next(&mut self) -> Option<Self::Item> {
        if self.left == 0 {
            return None;
        }
        let lane = self.left.trailing_zeros() as usize % MOST_LANES;
        self.left &= self.left - 1;
        let spans: SmallVec<[ShapeSpan<f32>; 8]> = self.spans.iter().map(|span| span.lane(lane)).collect();
        let known = self.within.map(|within| within >> lane & 1 == 1);
        Some((lane, JoinedWalk::new(self.geometry, self.body, self.rays.lane(lane), &spans, known)))
    }
}

/// The first crossing of each ray, if any.
pub(crate) struct FirstCrossings {
    t: [f32; MOST_LANES],
    part: [u32; MOST_LANES],
    face: [f32; MOST_LANES],
    entering: u32,
    leaving: u32,
}

impl FirstCrossings {
    pub(crate) fn of(walks: Option<JoinedWalks<'_>>) -> Self {
        let [t, face] = [[0.0; MOST_LANES]; 2];
        let mut first = Self { t, part: [0; MOST_LANES], face, entering: 0, leaving: 0 };
        for (lane, mut walk) in walks.into_iter().flatten() {
            if let Some(JoinedCrossing { t, part, face, enters }) = walk.next() {
                (first.t[lane], first.part[lane], first.face[lane]) = (t, part, face);
                *(if enters { &mut first.entering } else { &mut first.leaving }) |= 1 << lane;
            }
        }
        first
    }

    pub(crate) fn hits<W: Width>(&self, w: W) -> JoinedHits<W> {
        JoinedHits {
            t: w.load(&self.t),
            part: w.load_words(&self.part),
            face: w.load(&self.face),
            entering: w.mask(self.entering),
            leaving: w.mask(self.leaving),
        }
    }
}

impl<'g> JoinedWalk<'g> {
    /// `spans` are those of the parts; `known` tells whether the ray starts inside, if that is known.
    fn new(
        geometry: &'g Geometry,
        body: &'g JoinedBody,
        ray: RayPacket<ScalarWidth>,
        spans: &[ShapeSpan<f32>],
        known: Option<bool>,
    ) -> Self {
        let mut walk = Self {
            geometry,
            body,
            ray,
            origin_error_bound: error_bound_at(ray.origin),
            crossings: SmallVec::new(),
            passed: 0,
            parts: 0,
            is_inside: false,
        };
        if body.tree.is_surface() {
            walk.meet_surface(spans);
            return walk;
        }
        let start = RayOrigin::of_word(ray.start);
        let own = body.parts().contains(&start.body).then(|| start.body - body.first);
        let known = match own {
            Some(part) => Some(start.inwards ^ body.tree.is_inverted(part)),
            None => known,
        };
        // Crossings at the start itself, within rounding.
        let mut at_start: SmallVec<[PartCrossing; 4]> = SmallVec::new();
        for (part, span) in (0..).zip(spans) {
            let enter = PartCrossing { t: span.enter, part, face: span.enter_face, enters: true };
            let exit = PartCrossing { t: span.exit, part, face: span.exit_face, enters: false };
            if own == Some(part) {
                // It is met once more from within, and never from outside.
                if start.inwards {
                    walk.parts |= 1 << part;
                    walk.crossings.push(PartCrossing { t: exit.t.max(0.0), ..exit });
                }
                continue;
            }
            if !span.hit {
                continue;
            }
            for crossing in [enter, exit] {
                if walk.is_at_start(&crossing) {
                    at_start.push(crossing);
                } else if crossing.t > 0.0 {
                    walk.crossings.push(crossing);
                } else {
                    walk.parts ^= 1 << part;
                }
            }
        }
        walk.settle_start(&at_start, known, own.is_some());
        walk.crossings.sort_unstable_by(in_order);
        walk
    }

    /// Finds where the ray crosses the first part's surface as far as that lies in the others. At the start it is met by
    /// what enters the part, as the surface of any other body, unless the ray comes from an opaque one: it is going back.
    fn meet_surface(&mut self, spans: &[ShapeSpan<f32>]) {
        let start = RayOrigin::of_word(self.ray.start);
        let is_own = start.body == self.body.first;
        let Some(span) = spans.first().filter(|span| span.hit || is_own && start.inwards) else { return };
        let enter = PartCrossing { t: span.enter, part: 0, face: span.enter_face, enters: true };
        let exit = PartCrossing { t: span.exit, part: 0, face: span.exit_face, enters: false };
        let has_caps = self.geometry.body(self.body.first).canonical().kind.has_caps();
        let side = self.body.tree.visible_side();
        let bodies = &self.geometry.bodies;
        let goes_back = bodies.get(start.body as usize).is_some_and(|start| !start.is_transparent());
        for crossing in [enter, exit].into_iter().filter(|crossing| side.is_met(crossing.enters)) {
            let is_ahead = match is_own {
                true => start.inwards && !crossing.enters,
                false if self.is_at_start(&crossing) => crossing.enters && !goes_back,
                false => crossing.t > 0.0,
            };
            let t = crossing.t.max(0.0);
            let is_in = |span: &ShapeSpan<f32>| span.hit && (span.enter..=span.exit).contains(&t);
            let around = (0..).zip(spans).fold(0, |bits, (part, span)| bits | u64::from(is_in(span)) << part);
            let is_cap = has_caps && crossing.face != SIDE;
            if is_ahead && !is_cap && self.body.tree.shows(around) {
                self.crossings.push(PartCrossing { t, ..crossing });
            }
        }
    }

    /// The next crossing of a surface, which does not lead into anything.
    fn next_of_surface(&mut self) -> Option<JoinedCrossing> {
        let PartCrossing { t, part, face, enters } = *self.crossings.get(self.passed)?;
        self.passed += 1;
        Some(JoinedCrossing { t, part: self.body.first + part, face, enters })
    }

    /// Whether the ray is in the whole where it is.
    pub(crate) fn is_inside(&self) -> bool {
        self.is_inside
    }

    /// Decides which of the crossings at the ray's start are behind it and which ahead.
    ///
    /// From a surface of the body all are behind, else those that lead out of it: a ray that starts outside, where other
    /// bodies touch this one, meets it at once. If the ray is not on the side that it is known to be on then, it is the
    /// other way round.
    fn settle_start(&mut self, at_start: &[PartCrossing], known: Option<bool>, is_own: bool) {
        let tree = &self.body.tree;
        let is_behind = |crossing: &PartCrossing| is_own || !enters_whole(tree, crossing);
        let parts_if = |is_turned: bool| {
            let behind = at_start.iter().filter(|crossing| is_behind(crossing) ^ is_turned);
            behind.fold(self.parts, |parts, crossing| parts ^ 1 << crossing.part)
        };
        let is_right = |parts: u64| known.is_none_or(|known| tree.holds(parts) == known);
        let is_turned = !at_start.is_empty() && !is_right(parts_if(false)) && is_right(parts_if(true));
        self.parts = parts_if(is_turned);
        self.is_inside = known.unwrap_or_else(|| tree.holds(self.parts));
        let ahead = at_start.iter().filter(|crossing| !(is_behind(crossing) ^ is_turned));
        self.crossings.extend(ahead.map(|crossing| PartCrossing { t: 0.0, ..*crossing }));
    }

    /// Whether a crossing may lie at the start but for rounding, measured across the surface.
    fn is_at_start(&self, crossing: &PartCrossing) -> bool {
        let bound = self.origin_error_bound + self.error_bound(crossing.part);
        let distance = crossing.t.abs();
        distance <= bound * GRAZING && distance * self.cosine(crossing) <= bound
    }

    /// The next crossing of the surface of the whole.
    pub(crate) fn next(&mut self) -> Option<JoinedCrossing> {
        if self.body.tree.is_surface() {
            return self.next_of_surface();
        }
        loop {
            let first = *self.crossings.get(self.passed)?;
            let end = self.end_of_coincident(first);
            let group = self.crossings.get(self.passed..end).unwrap_or_default();
            let tree = &self.body.tree;
            let flip = |parts: u64, crossing: &PartCrossing| parts ^ 1 << crossing.part;
            let parts = group.iter().fold(self.parts, flip);
            let is_inside = tree.holds(parts);
            if is_inside == self.is_inside {
                (self.parts, self.passed) = (parts, end);
                continue;
            }
            // Of those that lead there, since the whole grows with each part or shrinks with it, the first in the scene makes
            // the surface: of those without which the ray would not be through, or which alone bring it through. A ray that
            // comes the other way finds the same.
            let leads_there = |crossing: &&PartCrossing| enters_whole(tree, crossing) == is_inside;
            let decides = |crossing: &&PartCrossing| {
                tree.holds(flip(parts, crossing)) != is_inside
                    || tree.holds(flip(self.parts, crossing)) == is_inside
            };
            let leading = || group.iter().filter(leads_there);
            let surface = leading()
                .filter(decides)
                .min_by_key(|crossing| crossing.part)
                .or_else(|| leading().min_by_key(|crossing| crossing.part))
                .map_or(first, |crossing| *crossing);
            (self.parts, self.passed, self.is_inside) = (parts, end, is_inside);
            let part = self.body.first + surface.part;
            return Some(JoinedCrossing { t: surface.t, part, face: surface.face, enters: is_inside });
        }
    }

    /// Where those end that coincide with the next one.
    fn end_of_coincident(&self, first: PartCrossing) -> usize {
        let mut end = self.passed + 1;
        let mut own_cosine = None;
        while let Some(other) = self.crossings.get(end) {
            let larger = self.error_bound(first.part).max(self.error_bound(other.part));
            let bound = self.origin_error_bound + first.t * POINT_ROUNDING + larger;
            let apart = other.t - first.t;
            if apart > bound * GRAZING {
                break;
            }
            let own = *own_cosine.get_or_insert_with(|| self.cosine(&first));
            if apart * own.max(self.cosine(other)) > bound {
                break;
            }
            end += 1;
        }
        end
    }

    fn error_bound(&self, part: u32) -> f32 {
        self.geometry.body(self.body.first + part).error_bound
    }

    /// |cos| of the angle between the ray and the normal.
    fn cosine(&self, crossing: &PartCrossing) -> f32 {
        let RayPacket { origin, direction, .. } = self.ray;
        let part = self.body.first + crossing.part;
        let [enter, exit] = self.geometry.span_and_cosines(ScalarWidth, part, origin, direction).1;
        if crossing.enters { enter } else { exit }
    }
}

/// Whether a ray that crosses a part's surface so can only come into the whole by it, not out of it.
fn enters_whole(tree: &JoinTree, crossing: &PartCrossing) -> bool {
    crossing.enters ^ tree.is_inverted(crossing.part)
}

/// The nearer first; of equal ones those that lead in, so that no part is left before it is entered.
fn in_order(a: &PartCrossing, b: &PartCrossing) -> Ordering {
    a.t.total_cmp(&b.t).then(b.enters.cmp(&a.enters)).then(a.part.cmp(&b.part))
}
