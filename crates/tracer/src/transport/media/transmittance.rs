//! What lies between points and a light.

use crate::geometry::bvh::Bvh;
use crate::geometry::bvh::packet::TraversalStack;
use crate::geometry::joined::JoinedBody;
use crate::geometry::query::coincident::SurfaceCrossing;
use crate::geometry::query::joined::{JoinedCrossing, JoinedWalks, PacketRows};
use crate::geometry::query::{BodyIntersection, BodyVisitor, HitRecord, RayQuery};
use crate::geometry::ray::POINT_ROUNDING;
use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float32 as _, MOST_LANES, Mask as _, Width};
use crate::transport::media::MediumStacks;
use crate::transport::media::absorption::MediumIntervals;
use crate::transport::media::shadow_crossings::ShadowCrossings;
use crate::transport::scene::RenderScene;

/// Where rays cross a body's surface before a light.
struct BodyCrossing<W: Width> {
    /// Those that enter it, and where.
    in_front: W::M,
    enter: W::R,
    /// Those that start within, and those of them that leave it.
    within: W::M,
    behind: W::M,
    /// Where either leave it, perhaps behind the light.
    exit: W::R,
}

impl<W: Width> RayQuery<'_, W> {
    /// What reaches the rays' starts from a light at `distance` along them: the product of the filters of all surfaces
    /// crossed and of what the media leave, in which the rays start as these lists say; 0 if any body between is opaque.
    /// Nothing is bent.
    #[inline(always)]
    pub(crate) fn transmittance(
        &self,
        scene: &RenderScene,
        distance: W::R,
        media: (&MediumStacks, W::W),
        (stack, intervals): (&mut TraversalStack, &mut MediumIntervals),
    ) -> Transmittance<W> {
        // A body that touches the light does not hide it.
        let distance = distance * (1.0 - POINT_ROUNDING);
        let mut passed = match self.hierarchy() {
            // As in `closest_hit_unresolved`.
            Some(bvh) if W::USES_HIERARCHY => pass_many(*self, scene, distance, intervals, (bvh, stack)),
            _ => {
                let mut visitor = TransmittanceVisitor::new(self, scene, distance, intervals);
                self.visit_few(&mut visitor);
                self.visit_planes(&mut visitor);
                visitor.passed
            }
        };
        if scene.absorbs && !intervals.is_empty() {
            let left = intervals.left_after(self.w, scene, media);
            passed.share = Some(passed.share.unwrap_or_else(|| all_of(self.w)).times(left));
        }
        if scene.geometry.has_cemented && !intervals.crossings.is_empty() {
            let left = self.left_at_contacts(scene, &mut intervals.crossings);
            passed.share = Some(passed.share.unwrap_or_else(|| all_of(self.w)).times(left).bounded());
        }
        passed
    }

    /// What the surfaces of clear bodies that may be cemented let through.
    #[cold]
    #[inline(never)]
    fn left_at_contacts(&self, scene: &RenderScene, crossings: &mut ShadowCrossings) -> Vector<W::R> {
        let rays = PacketRows::of(self);
        let [red, green, blue] = crossings.filters(scene, self.membership, |lane| rays.lane(lane));
        Vector::new(self.w.load(&red), self.w.load(&green), self.w.load(&blue))
    }

    /// Every surface that one ray crosses on the way to a light at `distance`: the body, where, and whether the ray
    /// leaves it; in no particular order.
    pub(crate) fn crossings(&self, distance: W::R, mut found: impl FnMut(HitRecord)) {
        let distance = distance * (1.0 - POINT_ROUNDING);
        let number = |t: W::R| {
            let mut first = [0.0; MOST_LANES];
            t.store(&mut first);
            first[0]
        };
        let mut test = |index: u32| {
            if self.geometry.body(index).is_shadowless() {
                return;
            }
            if self.geometry.body(index).is_joined() {
                for (_, mut walk) in self.walks(index, self.lanes).into_iter().flatten() {
                    while let Some(crossing) = walk.next()
                        && crossing.t < number(distance)
                    {
                        let leaving =
                            self.geometry.joined.turned(ScalarWidth, crossing.part, !crossing.enters);
                        found(HitRecord { t: crossing.t, body: crossing.part, leaving });
                    }
                }
                return;
            }
            let Some(crossed) = self.crossed(index, distance, self.lanes) else { return };
            let BodyCrossing { in_front, enter, behind, exit, .. } = crossed;
            if in_front.any() {
                found(HitRecord { t: number(enter), body: index, leaving: false });
            }
            if (behind | in_front & exit.lt(distance)).any() {
                found(HitRecord { t: number(exit), body: index, leaving: true });
            }
        };
        self.each_body(&mut TraversalStack::default(), &mut test);
    }

    /// Where rays cross the surface of one body before `distance`, if any may.
    #[inline(always)]
    fn crossed(&self, index: u32, distance: W::R, lanes: W::M) -> Option<BodyCrossing<W>> {
        let BodyIntersection { entering, enter, leaving, exit, .. } = self.intersect_body(index, lanes)?;
        let in_front = entering & enter.lt(distance);
        let behind = leaving & exit.lt(distance);
        Some(BodyCrossing { in_front, enter, within: leaving, behind, exit })
    }

    /// Notes the part of the way to a light at `distance` that lies within a transparent body.
    #[inline(always)]
    pub(crate) fn note_medium(
        &self,
        index: u32,
        distance: W::R,
        lanes: W::M,
        intervals: &mut MediumIntervals,
    ) {
        if self.geometry.body(index).is_joined() {
            return self.note_joined(index, distance, lanes, intervals);
        }
        if self.geometry.body(index).takes_light_within()
            && let Some(crossed) = self.crossed(index, distance, lanes)
        {
            let BodyCrossing { in_front, enter, within, exit, .. } = crossed;
            intervals.note::<W>(index, (in_front, enter), (within, exit.min(distance)));
        }
    }
}

impl<W: Width> RayQuery<'_, W> {
    /// What passes a joined body on the way to a light: the product of the filters of all its surfaces.
    #[cold]
    #[inline(never)]
    fn pass_joined(
        &self,
        scene: &RenderScene,
        (index, distance): (u32, W::R),
        lanes: W::M,
    ) -> Transmittance<W> {
        if self.geometry.body(index).is_shadowless() {
            return Transmittance::all(lanes);
        }
        if let Some(body) = self.geometry.joined(index).filter(|body| body.tree.is_convex())
            && body
                .parts()
                .all(|part| self.geometry.body(part).material == self.geometry.body(index).material)
        {
            return self.w.run(
                #[inline(always)]
                || self.pass_convex(scene, body, (index, distance), lanes),
            );
        }
        self.pass_walked(scene, (index, distance), lanes)
    }

    fn pass_walked(
        &self,
        scene: &RenderScene,
        (index, distance): (u32, W::R),
        lanes: W::M,
    ) -> Transmittance<W> {
        let mut ends = [0.0; MOST_LANES];
        distance.store(&mut ends);
        let passed = JoinedFilters::of(scene, self.walks(index, lanes), &ends);
        let [red, green, blue] = passed.shares;
        let share = || Vector::new(self.w.load(&red), self.w.load(&green), self.w.load(&blue));
        Transmittance { lanes: lanes & !self.w.mask(passed.stopped), share: passed.is_filtered.then(share) }
    }

    /// What passes a joined body that may be cemented, but for its surfaces of clear parts: those are noted.
    #[cold]
    #[inline(never)]
    fn note_contacts(
        &self,
        (index, distance): (u32, W::R),
        lanes: W::M,
        crossings: &mut ShadowCrossings,
    ) -> Transmittance<W> {
        let mut ends = [0.0; MOST_LANES];
        distance.store(&mut ends);
        let mut stopped = 0;
        for (lane, mut walk) in self.walks(index, lanes).into_iter().flatten() {
            while let Some(crossing) = walk.next()
                && crossing.t < ends[lane]
            {
                if self.geometry.body(crossing.part).stops_light() {
                    stopped |= 1 << lane;
                    break;
                }
                let JoinedCrossing { t, part, face, enters } = crossing;
                crossings.note_one(lane, SurfaceCrossing { t, face, body: part, leaving: !enters });
            }
        }
        Transmittance { lanes: lanes & !self.w.mask(stopped), share: None }
    }

    /// [`Self::pass_joined`] for an intersection of simple parts, or a surface within one, of one material.
    #[inline(always)]
    fn pass_convex(
        &self,
        scene: &RenderScene,
        body: &JoinedBody,
        (index, distance): (u32, W::R),
        lanes: W::M,
    ) -> Transmittance<W> {
        let span = self.convex_span(index, body, lanes);
        let [entered, left] = span.crossed_before(distance);
        let doubtful = span.doubtful();
        let whole = self.geometry.body(index);
        let mut passed = Transmittance { lanes, share: None };
        if whole.stops_light() {
            passed.lanes = lanes & !(entered | left);
        } else if (entered | left).any() {
            let filter = scene.material(whole).filter;
            let one = all_of(self.w);
            let once = Vector::select(entered, one.times_all(filter), one);
            passed.share = Some(Vector::select(left, once.times_all(filter), once));
        }
        if doubtful.any() {
            let walked = self.pass_walked(scene, (index, distance), doubtful);
            passed.lanes = passed.lanes & (walked.lanes | !doubtful);
            if let Some(share) = walked.share {
                let own = passed.share.unwrap_or_else(|| all_of(self.w));
                passed.share = Some(Vector::select(doubtful, share, own));
            }
        }
        passed
    }

    /// Notes the parts of the way to a light that lie within a transparent joined body.
    #[cold]
    #[inline(never)]
    fn note_joined(&self, index: u32, distance: W::R, lanes: W::M, intervals: &mut MediumIntervals) {
        if self.geometry.body(index).takes_light_within() && !self.geometry.is_surface(index) {
            let mut ends = [0.0; MOST_LANES];
            distance.store(&mut ends);
            note_walks(self.walks(index, lanes), index, &ends, intervals);
        }
    }
}

/// What the surfaces of a joined body take of light. In no width, as [`JoinedWalks`].
struct JoinedFilters {
    shares: [[f32; MOST_LANES]; 3],
    /// A bit for each ray of which nothing is left.
    stopped: u32,
    is_filtered: bool,
}

impl JoinedFilters {
    /// Before the `ends` of the rays.
    fn of(scene: &RenderScene, walks: Option<JoinedWalks<'_>>, ends: &[f32; MOST_LANES]) -> Self {
        let mut passed = Self { shares: [[1.0; MOST_LANES]; 3], stopped: 0, is_filtered: false };
        for (lane, mut walk) in walks.into_iter().flatten() {
            while let Some(crossing) = walk.next()
                && crossing.t < ends[lane]
            {
                let part = scene.geometry.body(crossing.part);
                if part.stops_light() {
                    passed.stopped |= 1 << lane;
                    break;
                }
                passed.is_filtered = true;
                for (shares, filter) in passed.shares.iter_mut().zip(scene.material(part).filter) {
                    shares[lane] *= filter;
                }
            }
        }
        passed
    }
}

/// Notes the parts of ways through a joined body, up to their `ends`, that lie within it.
fn note_walks(
    walks: Option<JoinedWalks<'_>>,
    index: u32,
    ends: &[f32; MOST_LANES],
    intervals: &mut MediumIntervals,
) {
    for (lane, mut walk) in walks.into_iter().flatten() {
        let mut interval = walk.is_inside().then_some((0.0, true));
        let end = ends[lane];
        while let Some(crossing) = walk.next()
            && crossing.t < end
        {
            if let Some((enter, is_within)) = interval {
                intervals.note_one(index, lane as u32, enter..crossing.t, is_within);
            }
            interval = crossing.enters.then_some((crossing.t, false));
        }
        if let Some((enter, is_within)) = interval {
            intervals.note_one(index, lane as u32, enter..end, is_within);
        }
    }
}

/// What passes many bodies: in a function of its own, as `closest_hit_of_many`.
#[inline(never)]
fn pass_many<W: Width>(
    query: RayQuery<'_, W>,
    scene: &RenderScene,
    distance: W::R,
    intervals: &mut MediumIntervals,
    (bvh, stack): (&Bvh, &mut TraversalStack),
) -> Transmittance<W> {
    query.w.run(
        #[inline(always)]
        || {
            let mut visitor = TransmittanceVisitor::new(&query, scene, distance, intervals);
            query.visit_many(bvh, stack, &mut visitor);
            query.visit_planes(&mut visitor);
            visitor.passed
        },
    )
}

/// Looks for what lies between rays' starts and a light.
pub(crate) struct TransmittanceVisitor<'s, W: Width> {
    scene: &'s RenderScene,
    distance: W::R,
    /// The distance for those that get any light, else none at all.
    t_max: W::R,
    pub(crate) passed: Transmittance<W>,
    /// Takes note of the parts of the ways within transparent bodies, if that is wanted and anything absorbs.
    intervals: Option<&'s mut MediumIntervals>,
}

impl<'s, W: Width> TransmittanceVisitor<'s, W> {
    /// For a light at `distance` along the rays of `query`.
    #[inline(always)]
    fn new(
        query: &RayQuery<'_, W>,
        scene: &'s RenderScene,
        distance: W::R,
        intervals: &'s mut MediumIntervals,
    ) -> Self {
        Self::resumed(query.w, scene, distance, Transmittance::all(query.lanes), Some(intervals))
    }

    /// For rays to a light at `distance`, of which so much has `passed` other bodies.
    #[inline(always)]
    pub(crate) fn resumed(
        w: W,
        scene: &'s RenderScene,
        distance: W::R,
        passed: Transmittance<W>,
        intervals: Option<&'s mut MediumIntervals>,
    ) -> Self {
        let is_noted = scene.absorbs || scene.geometry.has_cemented;
        let intervals = if is_noted { intervals } else { None };
        let t_max = W::R::select(passed.lanes, distance, w.real(f32::NEG_INFINITY));
        Self { scene, distance, t_max, passed, intervals }
    }
}

impl<W: Width> BodyVisitor<W> for TransmittanceVisitor<'_, W> {
    const NEAREST_FIRST: bool = false;

    #[inline(always)]
    fn t_max(&self) -> W::R {
        self.t_max
    }

    #[inline(always)]
    fn body(&mut self, query: &RayQuery<'_, W>, index: u32, lanes: W::M) {
        if query.geometry.body(index).is_joined() {
            let lanes = lanes & self.passed.lanes;
            let body = query.geometry.body(index);
            let is_cemented =
                query.geometry.has_cemented && body.is_cementable() && body.takes_light_within();
            let passed = match &mut self.intervals {
                Some(intervals) if is_cemented => {
                    query.note_contacts((index, self.distance), lanes, &mut intervals.crossings)
                }
                _ => query.pass_joined(self.scene, (index, self.distance), lanes),
            };
            if let Some(intervals) = self.intervals.as_mut().filter(|_| self.scene.absorbs) {
                query.note_joined(index, self.distance, passed.lanes, intervals);
            }
            self.passed.lanes = self.passed.lanes & (passed.lanes | !lanes);
            self.t_max = W::R::select(self.passed.lanes, self.t_max, query.w.real(f32::NEG_INFINITY));
            if let Some(share) = passed.share {
                let all = self.passed.share.unwrap_or_else(|| all_of(query.w));
                self.passed.share = Some(Vector::select(passed.lanes, all.times(share), all).bounded());
            }
            return;
        }
        let Some(BodyCrossing { in_front, enter, within, behind, exit }) =
            query.crossed(index, self.distance, lanes & self.passed.lanes)
        else {
            return;
        };
        let crossed = in_front | behind;
        let body = query.geometry.body(index);
        if body.stops_light() {
            self.passed.lanes = self.passed.lanes & !crossed;
            self.t_max = W::R::select(self.passed.lanes, self.t_max, query.w.real(f32::NEG_INFINITY));
            return;
        }
        if body.is_shadowless() {
            return;
        }
        let both = in_front & exit.lt(self.distance);
        if let Some(intervals) = &mut self.intervals {
            if self.scene.absorbs {
                intervals.note::<W>(index, (in_front, enter), (within, exit.min(self.distance)));
            }
            if query.geometry.has_cemented && body.is_cementable() {
                intervals.crossings.note::<W>(index, enter, false, in_front);
                intervals.crossings.note::<W>(index, exit, true, behind | both);
                return;
            }
        }
        if !crossed.any() {
            return;
        }
        let material = self.scene.material(body);
        let all = self.passed.share.unwrap_or_else(|| all_of(query.w));
        let once = all.times_all(material.filter);
        let mut share = Vector::select(crossed, once, all);
        share = Vector::select(both, once.times_all(material.filter), share);
        self.passed.share = Some(share.bounded());
    }
}

/// What reaches rays' starts from a light.
pub(crate) struct Transmittance<W: Width> {
    /// Those that get any.
    pub(crate) lanes: W::M,
    /// The product of the filters of all surfaces crossed; all of the light as long as nothing transparent was.
    pub(crate) share: Option<Vector<W::R>>,
}

impl<W: Width> Transmittance<W> {
    /// All of the light.
    #[inline(always)]
    pub(crate) fn all(lanes: W::M) -> Self {
        Self { lanes, share: None }
    }

    /// The share of all rays.
    #[inline(always)]
    pub(crate) fn shares(&self, w: W) -> Vector<W::R> {
        let share = self.share.unwrap_or_else(|| all_of(w));
        Vector::select(self.lanes, share, Vector::splat(w.real(0.0), [0.0; 3]))
    }
}

/// All of the light.
#[inline(always)]
pub(crate) fn all_of<W: Width>(w: W) -> Vector<W::R> {
    Vector::splat(w.real(0.0), [1.0; 3])
}
