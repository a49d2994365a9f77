//! What a ray meets: the nearest body, and what lies between a point and a light.

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
        best.first(self.stage)
    }

    /// The first meeting with every body that the ray meets, in no particular order.
    pub(crate) fn each(&self, pending: &mut Vec<Pending>, mut found: impl FnMut(Hit)) {
        let start_slack = self.ray.slack();
        let mut test = |index: u32| {
            if let Some(hit) = self.meeting(index, self.stage.body(index), start_slack)
                && hit.t < f32::INFINITY
            {
                found(hit);
            }
        };
        self.stage.planes().for_each(&mut test);
        match &self.stage.hierarchy {
            Hierarchy::Few(few) => few.visit(&self.ray, f32::INFINITY, |index| {
                test(index);
                f32::INFINITY
            }),
            Hierarchy::Many(bvh) => bvh.traverse(&self.ray, f32::INFINITY, pending, |leaf| {
                leaf.for_each(&mut test);
                f32::INFINITY
            }),
        }
    }

    #[inline(always)]
    fn test(&self, index: u32, best: &mut Best) {
        let body = self.stage.body(index);
        if let Some(hit) = self.meeting(index, body, best.start_slack) {
            best.offer(self.stage, hit, body.slack);
        }
    }

    /// Where the ray meets one body first.
    #[inline(always)]
    fn meeting(&self, index: u32, body: &StageBody, start_slack: f32) -> Option<Hit> {
        let relation = self.relation(index, body);
        if matches!(relation, Relation::Left) {
            return None;
        }
        let span = body.span(self.ray.origin, self.ray.direction);
        let (t, leaving) = match relation {
            Relation::Inside => (exit_of(&span), true),
            _ => self.crossing(body, &span, start_slack + body.slack)?,
        };
        Some(Hit { t, body: index, leaving })
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

    /// The first crossing at or after the start of a ray about which nothing is known, and whether it leads out.
    #[inline(always)]
    fn crossing(&self, body: &StageBody, span: &Span, slack: f32) -> Option<(f32, bool)> {
        if !(span.hit && span.exit > 0.0) {
            None
        } else if span.enter > 0.0 {
            Some((span.enter, false))
        } else {
            self.crossing_from_within(body, slack)
        }
    }

    /// The same for a start that lies within a body by the numbers, but perhaps only by their rounding.
    ///
    /// Bodies often touch: a box stands on a floor, two panes share a face. A start that is no deeper than `slack`, the
    /// bound of rounding, counts as outside: heading in it meets the surface at once, heading out it does not. So
    /// neither side of a contact can be slipped through or shade itself. Depths are measured across the surface: along
    /// the ray they grow without bound when it grazes. In a body thinner than rounding the nearer surface counts.
    #[cold]
    fn crossing_from_within(&self, body: &StageBody, slack: f32) -> Option<(f32, bool)> {
        let Ray { origin, direction, .. } = self.ray;
        let span = body.span(origin, direction);
        let behind_entry = -span.enter * body.cosine(origin, direction, span.enter, span.enter_face);
        let before_exit = span.exit * body.cosine(origin, direction, span.exit, span.exit_face);
        if behind_entry <= slack && behind_entry <= before_exit {
            Some((0.0, false))
        } else if before_exit <= slack {
            None
        } else {
            Some((span.exit, true))
        }
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
            _ => match self.crossing(body, &span, start_slack + body.slack) {
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

/// The nearest hits so far: the one that leads out of a body and the one that leads in, each by itself, so that the
/// outcome does not depend on the order in which bodies are tested.
struct Best {
    leaving: Option<Hit>,
    entering: Option<Hit>,
    /// No body beyond this parameter can change the outcome any more.
    reach: f32,
    start_slack: f32,
}

impl Best {
    fn new(start_slack: f32) -> Self {
        Self { leaving: None, entering: None, reach: f32::INFINITY, start_slack }
    }

    /// Takes note of a hit; of equal ones the body that comes first in the scene counts.
    #[inline]
    fn offer(&mut self, stage: &Stage, new: Hit, body_slack: f32) {
        if !(new.t <= self.reach && new.t < f32::INFINITY) {
            return;
        }
        let place = if new.leaving { &mut self.leaving } else { &mut self.entering };
        let first = match place {
            None => true,
            Some(old) if new.t == old.t => stage.scene_order(new.body, old.body).is_lt(),
            Some(old) => new.t < old.t,
        };
        if first {
            *place = Some(new);
            let reach = if new.leaving {
                new.t
            } else {
                new.t + self.slack_at(new.t, body_slack, stage.largest_slack)
            };
            self.reach = self.reach.min(reach);
        }
    }

    /// How far apart by rounding two hits at about `t` can lie that should coincide. Each slack is twice its bound, so
    /// the larger one covers both bodies.
    fn slack_at(&self, t: f32, one: f32, other: f32) -> f32 {
        self.start_slack + one.max(other) + POINT_ROUNDING * t
    }

    /// The first hit. Of hits that coincide within rounding, the one that leads out comes before the one that leads in:
    /// bodies that touch have a film of air between them.
    fn first(&self, stage: &Stage) -> Option<Hit> {
        let (Some(leaving), Some(entering)) = (self.leaving, self.entering) else {
            return self.leaving.or(self.entering);
        };
        let [one, other] = [leaving, entering].map(|hit| stage.body(hit.body).slack);
        let slack = self.slack_at(entering.t, one, other);
        Some(if leaving.t <= entering.t + slack { leaving } else { entering })
    }
}
