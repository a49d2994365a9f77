//! What lies between points and a light.

use std::ops::Range;

use crate::geometry::Accelerator;
use crate::geometry::body::RenderBody;
use crate::geometry::bvh::Bvh;
use crate::geometry::bvh::packet::{BodyVisitor, TraversalStack};
use crate::geometry::query::{AllHitsVisitor, BodyIntersection, HitRecord, RayBodyLanes, RayQuery};
use crate::geometry::ray::{NO_BODY, POINT_ROUNDING};
use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float32 as _, MOST_LANES, Mask as _, Width};
use crate::transport::media::MediumStacks;
use crate::transport::media::absorption::MediumIntervals;
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

/// Working memory of a search for what lies before a light.
pub(crate) struct ShadowScratch<'m> {
    pub(crate) stack: &'m mut TraversalStack,
    pub(crate) intervals: &'m mut MediumIntervals,
    /// A body that has hidden this light before, and probably still does; any word will do.
    pub(crate) occluder: &'m mut u32,
}

impl<'a, W: Width> RayQuery<'a, W> {
    /// What reaches the rays' starts from a light at `distance` along them: the product of the filters of all surfaces
    /// crossed and of what the media leave, in which the rays start as these lists say; 0 if any body between is opaque.
    /// Nothing is bent.
    #[inline(always)]
    pub(crate) fn transmittance(
        &self,
        scene: &RenderScene,
        distance: W::R,
        media: (&MediumStacks, W::W),
        memory: ShadowScratch<'_>,
    ) -> Transmittance<W> {
        let ShadowScratch { stack, intervals, occluder } = memory;
        // A body that touches the light does not hide it.
        let distance = distance * (1.0 - POINT_ROUNDING);
        let mut passed = Transmittance { lanes: self.lanes, share: None, occluder: *occluder };
        if W::USES_HIERARCHY
            && let Accelerator::Many(_) = &self.geometry.hierarchy
            && let Some(body) = self.geometry.bodies.get(*occluder as usize)
            && !body.is_transparent()
        {
            self.filter(scene, *occluder, body, distance, passed.lanes, (&mut passed, None));
            if !passed.lanes.any() {
                return passed;
            }
        }
        match self.hierarchy() {
            Some(bvh) => passed = pass_many(*self, scene, distance, passed, intervals, (bvh, stack)),
            None => self.pass(
                scene,
                distance,
                &mut passed,
                intervals,
                #[inline(always)]
                |visitor| self.visit_few(visitor),
            ),
        }
        *occluder = passed.occluder;
        if scene.absorbs && !intervals.is_empty() {
            let left = intervals.left_after(self.w, scene, media);
            passed.share = Some(passed.share.unwrap_or_else(|| all_of(self.w)).times(left));
        }
        passed
    }

    /// Takes from what has `passed` what planes and the bounded bodies hide and filter that `visit` shows.
    #[inline(always)]
    fn pass(
        &self,
        scene: &RenderScene,
        distance: W::R,
        passed: &mut Transmittance<W>,
        intervals: &mut MediumIntervals,
        visit: impl FnOnce(&mut TransmittanceVisitor<'_, 'a, W>),
    ) {
        let t_max = W::R::select(passed.lanes, distance, self.w.real(f32::NEG_INFINITY));
        let mut shadow = TransmittanceVisitor { query: self, scene, passed, intervals, distance, t_max };
        visit(&mut shadow);
        self.visit_planes(&mut shadow);
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
            let body = self.geometry.body(index);
            let Some(crossed) = self.crossed(index, body, distance, self.lanes) else { return };
            let BodyCrossing { in_front, enter, behind, exit, .. } = crossed;
            if in_front.any() {
                found(HitRecord { t: number(enter), body: index, leaving: false });
            }
            if (behind | in_front & exit.lt(distance)).any() {
                found(HitRecord { t: number(exit), body: index, leaving: true });
            }
        };
        self.visit(&mut TraversalStack::default(), &mut AllHitsVisitor(self.w, &mut test));
        self.geometry.planes().for_each(&mut test);
    }

    /// Where rays cross the surface of one body before `distance`, if any may.
    #[inline(always)]
    fn crossed(&self, index: u32, body: &RenderBody, distance: W::R, lanes: W::M) -> Option<BodyCrossing<W>> {
        let RayBodyLanes { lanes, inside } = self.relation(index, body, lanes);
        if !lanes.any() {
            return None;
        }
        let BodyIntersection { entering, enter, leaving, exit, .. } =
            self.intersection((index, body), lanes, inside)?;
        let in_front = entering & enter.lt(distance);
        let behind = leaving & exit.lt(distance);
        Some(BodyCrossing { in_front, enter, within: leaving, behind, exit })
    }

    /// What the surface of one body lets through on the way to a light at `distance`; notes the part of the way within it,
    /// if anything absorbs and that is wanted.
    #[inline(always)]
    pub(crate) fn filter(
        &self,
        scene: &RenderScene,
        index: u32,
        body: &RenderBody,
        distance: W::R,
        lanes: W::M,
        (passed, intervals): (&mut Transmittance<W>, Option<&mut MediumIntervals>),
    ) {
        let Some(BodyCrossing { in_front, enter, within, behind, exit }) =
            self.crossed(index, body, distance, lanes)
        else {
            return;
        };
        let crossed = in_front | behind;
        if !body.is_transparent() {
            if crossed.any() {
                passed.lanes = passed.lanes & !crossed;
                passed.occluder = index;
            }
            return;
        }
        if scene.absorbs
            && let Some(intervals) = intervals
        {
            intervals.note::<W>(index, (in_front, enter), (within, exit.min(distance)));
        }
        if !crossed.any() {
            return;
        }
        let both = in_front & exit.lt(distance);
        let material = scene.material(body);
        let all = passed.share.unwrap_or_else(|| all_of(self.w));
        let once = all.times_all(material.filter);
        let mut share = Vector::select(crossed, once, all);
        share = Vector::select(both, once.times_all(material.filter), share);
        passed.share = Some(share.bounded());
    }

    /// Notes the part of the way to a light at `distance` that lies within a transparent body.
    #[inline(always)]
    pub(crate) fn note_medium(
        &self,
        index: u32,
        body: &RenderBody,
        distance: W::R,
        lanes: W::M,
        intervals: &mut MediumIntervals,
    ) {
        if body.is_transparent()
            && let Some(crossed) = self.crossed(index, body, distance, lanes)
        {
            let BodyCrossing { in_front, enter, within, exit, .. } = crossed;
            intervals.note::<W>(index, (in_front, enter), (within, exit.min(distance)));
        }
    }
}

/// What passes many bodies of what has `passed`: in a function of its own, as `closest_hit_of_many`.
#[inline(never)]
fn pass_many<W: Width>(
    query: RayQuery<'_, W>,
    scene: &RenderScene,
    distance: W::R,
    passed: Transmittance<W>,
    intervals: &mut MediumIntervals,
    (bvh, stack): (&Bvh, &mut TraversalStack),
) -> Transmittance<W> {
    query.w.run(
        #[inline(always)]
        || {
            let mut passed = passed;
            query.pass(
                scene,
                distance,
                &mut passed,
                intervals,
                #[inline(always)]
                |visitor| query.visit_many(bvh, stack, visitor),
            );
            passed
        },
    )
}

/// Looks for what shades.
struct TransmittanceVisitor<'f, 'a, W: Width> {
    query: &'f RayQuery<'a, W>,
    scene: &'f RenderScene,
    passed: &'f mut Transmittance<W>,
    intervals: &'f mut MediumIntervals,
    distance: W::R,
    /// The distance for those that get any light, else none at all.
    t_max: W::R,
}

impl<W: Width> BodyVisitor<W> for TransmittanceVisitor<'_, '_, W> {
    const NEAREST_FIRST: bool = false;

    #[inline(always)]
    fn t_max(&self) -> W::R {
        self.t_max
    }

    #[inline(always)]
    fn leaf(&mut self, bodies: Range<u32>, lanes: W::M) {
        for index in bodies {
            let body = self.query.geometry.body(index);
            let lanes = lanes & self.passed.lanes;
            let noted = (&mut *self.passed, Some(&mut *self.intervals));
            self.query.filter(self.scene, index, body, self.distance, lanes, noted);
        }
        self.t_max = W::R::select(self.passed.lanes, self.t_max, self.query.w.real(f32::NEG_INFINITY));
    }
}

/// What reaches rays' starts from a light.
pub(crate) struct Transmittance<W: Width> {
    /// Those that get any.
    pub(crate) lanes: W::M,
    /// The product of the filters of all surfaces crossed; all of the light as long as nothing transparent was.
    pub(crate) share: Option<Vector<W::R>>,
    /// The opaque body that was met last.
    pub(crate) occluder: u32,
}

impl<W: Width> Transmittance<W> {
    /// All of the light.
    #[inline(always)]
    pub(crate) fn all(lanes: W::M) -> Self {
        Self { lanes, share: None, occluder: NO_BODY }
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
