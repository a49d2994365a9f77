//! The parts of ray segments that bodies hide from the viewport's camera, found by tracing.

use catoptric_scene::{Camera, Scene};
use catoptric_tracer::{Ray, RenderControl, RenderScene};
use glam::{DVec2, DVec3};

use super::segments::RaySegment;
use crate::base::projector::Projector;

/// Points that are looked at along a way.
const SAMPLES: u32 = 24;
/// How often the border between seen and hidden is halved: to a thousandth of a way.
const HALVINGS: u32 = 5;
/// What lies nearer than this share of its distance before a point does not hide it: it lies on that body.
const NEAR: f64 = 2e-3;

/// A part of a segment, by shares of its length, and whether it is hidden.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SegmentPart {
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// Whether an opaque body stands before it.
    pub(crate) is_hidden: bool,
}

/// The whole of a way of which nothing is known yet.
pub(crate) const SEEN: [SegmentPart; 1] = [SegmentPart { from: 0.0, to: 1.0, is_hidden: false }];

/// The parts of each way, for `camera`.
pub(super) fn parts(
    ways: &[RaySegment],
    scene: &Scene,
    render_scene: &RenderScene,
    camera: &Camera,
    control: &RenderControl,
) -> Vec<Vec<SegmentPart>> {
    let look = VisibilityTest { scene, render_scene, projector: Projector::new(camera, DVec2::ONE) };
    ways.iter().map(|way| if control.is_cancelled() { SEEN.to_vec() } else { look.parts(way) }).collect()
}

struct VisibilityTest<'a> {
    scene: &'a Scene,
    render_scene: &'a RenderScene,
    projector: Projector,
}

impl VisibilityTest<'_> {
    fn parts(&self, way: &RaySegment) -> Vec<SegmentPart> {
        // The ends lie on bodies, where it is hard to tell.
        let share = |sample: u32| (f64::from(sample) + 0.5) / f64::from(SAMPLES);
        let mut parts: Vec<SegmentPart> = Vec::new();
        let (mut last, mut was_hidden, mut start) = (0.0, None, 0.0);
        for sample in 0..SAMPLES {
            let at = share(sample);
            let is_hidden = self.hides(way.from.lerp(way.to, at));
            if let Some(before) = was_hidden
                && before != is_hidden
            {
                let border = self.border(way, [last, at], before);
                parts.push(SegmentPart { from: start, to: border, is_hidden: before });
                start = border;
            }
            (last, was_hidden) = (at, Some(is_hidden));
        }
        parts.push(SegmentPart { from: start, to: 1.0, is_hidden: was_hidden.unwrap_or(false) });
        parts
    }

    fn border(&self, way: &RaySegment, [mut low, mut high]: [f64; 2], low_hidden: bool) -> f64 {
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if self.hides(way.from.lerp(way.to, middle)) == low_hidden {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }

    /// Whether an opaque body stands before a point. Through glass it is seen.
    fn hides(&self, point: DVec3) -> bool {
        let direction = self.projector.towards(point);
        let distance = match self.projector.is_parallel() {
            // Behind all that could stand before it.
            true => self.projector.depth(point),
            false => (point - self.projector.position()).length(),
        };
        let origin = point - distance * direction;
        let ray = Ray::from_point(origin.as_vec3(), direction.as_vec3());
        let hits = self.render_scene.hits_along(&ray);
        let before = distance * (1.0 - NEAR);
        hits.iter().take_while(|hit| f64::from(hit.hit.t) < before).any(|hit| !self.is_clear(hit.body))
    }

    fn is_clear(&self, body: usize) -> bool {
        let Some(body) = self.scene.bodies.get(body) else { return false };
        let mut materials = body.materials().filter_map(|choice| self.scene.material(choice));
        materials.any(|material| material.lets_through().most > 0.0)
    }
}
