//! What a ray meets: the nearest body, and what lies between a point and a light.

use std::cmp::Ordering;

use glam::Vec3A;

use crate::medium::{Media, MediaArena};
use crate::ray::{POINT_ROUNDING, Ray};
use crate::shape::Span;
use crate::stage::{Hierarchy, Pending, Stage, StageBody};

/// Where a ray meets a body: the cheap record kept during the search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Parameter along the ray, 0 or more, finite.
    pub t: f32,
    /// The body's place in the stage.
    pub body: u32,
    /// Whether the ray meets the body's surface from within.
    pub leaving: bool,
}

/// What a ray in flight knows about a body before testing it.
enum Relation {
    /// It has just left this convex body and cannot meet it again.
    Left,
    /// It is inside: it meets the far side only.
    Inside,
    /// Nothing.
    Unknown,
}

/// A ray and the media it runs in.
#[derive(Clone, Copy)]
pub(crate) struct Flight<'a> {
    pub stage: &'a Stage,
    pub arena: &'a MediaArena,
    pub ray: Ray,
    pub media: Media,
}

impl Flight<'_> {
    #[inline(always)]
    fn relation(&self, index: u32, body: &StageBody) -> Relation {
        if index == self.ray.start.body {
            if self.ray.start.inwards { Relation::Inside } else { Relation::Left }
        } else if body.is_transparent() && !self.media.is_air() && self.arena.contains(self.media, index) {
            Relation::Inside
        } else {
            Relation::Unknown
        }
    }

    /// The nearest body that the ray meets.
    pub(crate) fn nearest(&self, pending: &mut Vec<Pending>) -> Option<Hit> {
        let mut best = Best::new(self.ray.slack());
        for index in self.stage.planes() {
            self.test(index, &mut best);
        }
        match &self.stage.hierarchy {
            Hierarchy::Few(few) => few.visit(&self.ray, best.reach, |index| {
                self.test(index, &mut best);
                best.reach
            }),
            Hierarchy::Many(bvh) => bvh.traverse(&self.ray, best.reach, pending, |leaf| {
                leaf.for_each(|index| self.test(index, &mut best));
                best.reach
            }),
        }
        best.hit
    }

    #[inline(always)]
    fn test(&self, index: u32, best: &mut Best) {
        let body = self.stage.body(index);
        let relation = self.relation(index, body);
        if matches!(relation, Relation::Left) {
            return;
        }
        let span = body.span(self.ray.origin, self.ray.direction);
        let (t, leaving) = match relation {
            Relation::Inside => (exit_of(&span), true),
            _ => match crossing_from_unknown(&span, best.start_slack + body.slack) {
                Some(crossing) => crossing,
                None => return,
            },
        };
        best.offer(self.stage, Hit { t, body: index, leaving }, body.slack);
    }

    /// What reaches the ray's start from a light at distance `distance` along it: the product of the filters of all
    /// surfaces crossed, 0 if any body between is opaque. Nothing is bent.
    pub(crate) fn transmittance(&self, distance: f32, pending: &mut Vec<Pending>) -> Vec3A {
        // A body that touches the light does not hide it.
        let distance = distance * (1.0 - POINT_ROUNDING);
        let start_slack = self.ray.slack();
        let mut passed = Vec3A::ONE;
        for index in self.stage.planes() {
            passed *= self.filter(index, start_slack, distance);
        }
        if passed == Vec3A::ZERO {
            return passed;
        }
        let mut cross = |index: u32| {
            passed *= self.filter(index, start_slack, distance);
            if passed == Vec3A::ZERO { f32::NEG_INFINITY } else { distance }
        };
        match &self.stage.hierarchy {
            Hierarchy::Few(few) => few.visit(&self.ray, distance, cross),
            Hierarchy::Many(bvh) => {
                bvh.traverse(&self.ray, distance, pending, |leaf| {
                    leaf.fold(distance, |reach, index| reach.min(cross(index)))
                });
            }
        }
        passed
    }

    /// What one body lets through on the way to a light at `distance`.
    #[inline(always)]
    fn filter(&self, index: u32, start_slack: f32, distance: f32) -> Vec3A {
        let body = self.stage.body(index);
        let relation = self.relation(index, body);
        if matches!(relation, Relation::Left) {
            return Vec3A::ONE;
        }
        let span = body.span(self.ray.origin, self.ray.direction);
        let crossings = match relation {
            Relation::Inside => u32::from(exit_of(&span) < distance),
            _ => match crossing_from_unknown(&span, start_slack + body.slack) {
                Some((t, leaving)) if t < distance => 1 + u32::from(!leaving && span.exit < distance),
                _ => 0,
            },
        };
        match crossings {
            0 => Vec3A::ONE,
            _ if !body.is_transparent() => Vec3A::ZERO,
            1 => self.stage.material(body).filter,
            _ => self.stage.material(body).filter * self.stage.material(body).filter,
        }
    }
}

/// Where a ray that is known to start inside leaves. Rounding may put the far side just behind the start.
#[inline]
fn exit_of(span: &Span) -> f32 {
    if span.exit < 0.0 { 0.0 } else { span.exit }
}

/// The first crossing at or after the start of a ray about which nothing is known, and whether it leads out.
///
/// Bodies often touch: a box stands on a floor, two panes share a face. A start within `slack` of a surface, the
/// bound of rounding, counts as outside: heading in it meets the surface at once, heading out it does not. So neither
/// side of a contact can be slipped through or shade itself.
#[inline]
fn crossing_from_unknown(span: &Span, slack: f32) -> Option<(f32, bool)> {
    if !span.hit {
        None
    } else if span.enter >= -slack {
        Some((span.enter.max(0.0), false))
    } else if span.exit > slack {
        Some((span.exit, true))
    } else {
        None
    }
}

/// The nearest hit so far.
struct Best {
    hit: Option<Hit>,
    /// No body beyond this parameter can change the hit any more.
    reach: f32,
    start_slack: f32,
}

impl Best {
    fn new(start_slack: f32) -> Self {
        Self { hit: None, reach: f32::INFINITY, start_slack }
    }

    /// Takes `new` if it comes first. Of hits that coincide within rounding, one that leads out of a body comes before
    /// one that leads in: bodies that touch have a film of air between them. Of equal ones the body that comes first
    /// in the scene.
    #[inline]
    fn offer(&mut self, stage: &Stage, new: Hit, body_slack: f32) {
        if !(new.t <= self.reach && new.t < f32::INFINITY) {
            return;
        }
        let slack = self.start_slack + body_slack + POINT_ROUNDING * new.t;
        let first = match &self.hit {
            None => true,
            Some(old) if old.leaving == new.leaving => match new.t.total_cmp(&old.t) {
                Ordering::Less => true,
                Ordering::Equal => stage.scene_order(new.body, old.body).is_lt(),
                Ordering::Greater => false,
            },
            Some(old) if old.leaving => new.t < old.t - slack,
            Some(old) => new.t <= old.t + slack,
        };
        if first {
            self.hit = Some(new);
            self.reach = new.t + slack;
        }
    }
}
