//! A handful of bodies as they are seen from one point: from the eye, or from a light.
//!
//! All rays from a point have the same start, so that a body lies in a cone of directions, which takes one scalar product
//! and one comparison, and behind a plane across the cone, which takes a product and a comparison more.

use glam::{DVec3, Vec3};

use super::hull::BoundingHull;
use super::level::PlaneFrame;
use super::{RenderScene, RenderBody};
use crate::lanes::Float32;
use crate::vector::Vector;

/// The bodies of a stage as they are seen from a point.
#[derive(Clone, Debug, Default)]
pub(crate) struct VisibleBodies {
    pub(super) point: DVec3,
    /// The bounded ones, the nearest first.
    pub(crate) bodies: Vec<BoundingCone>,
    /// The planes.
    pub(crate) planes: Vec<u32>,
}

/// The cone of directions in which a body may lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BoundingCone {
    /// The body's place in the stage.
    pub(crate) body: u32,
    /// From the point to the body, or the other way if rays go there, of length 1.
    axis: [f32; 3],
    /// Cosine of the angle between the axis and the cone.
    cos: f32,
    /// No part of the body is nearer, measured along the axis, meters; times -1.
    minus_depth: f32,
}

/// More than the rounding of a scalar product of unit vectors, and, relatively, than that of a length.
pub(super) const ROUNDING: f64 = 1e-6;

/// How far rounding may lead a ray from a point astray where it comes to a body, meters; `way` is that of
/// [`RenderScene::seen_past`].
fn margin(hull: &BoundingHull, point: DVec3, way: f64) -> f64 {
    4.0 * ROUNDING * (2.0 * hull.extent() + 3.0 * point.abs().max_element() + way)
}

impl RenderScene {
    /// The bodies as they are seen from a point, if they are a handful.
    pub(crate) fn seen_from(&self, point: [f32; 3]) -> Option<VisibleBodies> {
        self.seen_past(DVec3::from(point.map(f64::from)), 0.0)
    }

    /// The same for rays that start as far from the point as `way` at most, and are as far off as the rounding of such
    /// lengths makes them.
    pub(super) fn seen_past(&self, point: DVec3, way: f64) -> Option<VisibleBodies> {
        if self.bounded as usize > Self::FEW || self.has_doubles() {
            return None;
        }
        let sight = |(body, index): (&RenderBody, u32)| Some(BoundingCone::new(&body.hull()?, index, point, way));
        let mut bodies: Vec<BoundingCone> = self.bodies.iter().zip(0..).filter_map(sight).collect();
        bodies.sort_by(|a, b| b.minus_depth.total_cmp(&a.minus_depth));
        Some(VisibleBodies { point, bodies, planes: self.planes().collect() })
    }

    /// The same for rays that go to the point, whose directions are those from the bodies to it, without what cannot stand in
    /// their way: the only plane, where the point and all other bodies are above it.
    pub(crate) fn seen_from_light(&self, point: [f32; 3]) -> Option<VisibleBodies> {
        let mut sights = self.seen_from(point)?;
        if let [plane] = sights.planes[..] {
            let level = PlaneFrame::of(self.body(plane));
            let mut hulls = self.bodies.iter().filter_map(RenderBody::hull);
            if level.is_below(sights.point) && hulls.all(|hull| level.is_below_hull(&hull)) {
                sights.planes.clear();
            }
        }
        for sight in &mut sights.bodies {
            sight.axis = sight.axis.map(|part| -part);
        }
        Some(sights)
    }

    /// What may lie between the outer side of each bounded body and the point that all are seen from. The body itself does
    /// not: it is convex.
    pub(crate) fn seen_before(&self, all: &VisibleBodies) -> Vec<VisibleBodies> {
        let before = |index: u32| {
            let own = all.bodies.iter().find(|sight| sight.body == index);
            match (own, self.body(index).hull()) {
                (Some(own), Some(hull)) => all.before(self, own, &hull),
                _ => all.clone(),
            }
        };
        (0..self.bounded).map(before).collect()
    }

    /// What rays inside of each bounded body may meet before they have left it, if it is transparent: itself, and what
    /// reaches into it.
    pub(crate) fn seen_within(&self) -> Vec<Option<VisibleBodies>> {
        let within = |index: u32| {
            let body = self.body(index);
            body.hull().filter(|_| body.is_transparent()).map(|hull| self.reaching_into(&hull))
        };
        (0..self.bounded).map(within).collect()
    }

    /// What has some part in a hull, by sights that tell no more.
    fn reaching_into(&self, hull: &BoundingHull) -> VisibleBodies {
        let is_apart = |other: BoundingHull| hull.is_apart(&other, 8.0 * ROUNDING * (hull.extent() + other.extent()));
        let reaches_in = |&index: &u32| !self.body(index).hull().is_some_and(is_apart);
        let crosses = |&plane: &u32| !PlaneFrame::of(self.body(plane)).is_apart_from(hull);
        VisibleBodies {
            bodies: (0..self.bounded).filter(reaches_in).map(BoundingCone::of_anywhere).collect(),
            planes: self.planes().filter(crosses).collect(),
            ..VisibleBodies::default()
        }
    }
}

impl VisibleBodies {
    /// The same with one more body, that may lie in any direction.
    pub(crate) fn and(&self, body: u32) -> Self {
        let own = BoundingCone::of_anywhere(body);
        Self { bodies: [own].into_iter().chain(self.bodies.iter().copied()).collect(), ..self.clone() }
    }

    /// What may lie between the point and one of the bodies.
    fn before(&self, stage: &RenderScene, own: &BoundingCone, hull: &BoundingHull) -> Self {
        let sin = (1.0 - own.cos * own.cos).max(0.0).sqrt();
        let axis = Vector::splat(0.0, own.axis);
        let farthest = hull.farthest(self.point) + margin(hull, self.point, 0.0);
        let farthest = farthest as f32 * (1.0 + ROUNDING as f32);
        let may_be_before = |sight: &&BoundingCone| {
            let is_beside = own.cos > 0.0 && !sight.is_met_by_cone(axis, own.cos, sin);
            sight.body != own.body && !is_beside && sight.minus_depth + farthest >= 0.0
        };
        let may_divide = |&&plane: &&u32| {
            let level = PlaneFrame::of(stage.body(plane));
            !level.is_below(self.point) || !level.is_below_hull(hull)
        };
        Self {
            point: self.point,
            bodies: self.bodies.iter().filter(may_be_before).copied().collect(),
            planes: self.planes.iter().filter(may_divide).copied().collect(),
        }
    }

    /// Keeps of others what some ray may meet whose angle with `axis` has a cosine of at least `cos`, and that starts so far
    /// on the way from the point.
    pub(crate) fn keep(&mut self, stage: &RenderScene, all: &Self, (axis, cos): (Vector<f32>, f32), way: f32) {
        let sin = self.keep_bodies(all, (axis, cos), way);
        self.planes.clear();
        let axis = Vec3::from(axis).as_dvec3();
        let is_met = |&&plane: &&u32| {
            let level = PlaneFrame::of(stage.body(plane));
            let rise = level.up.dot(axis);
            let least_rise = rise * f64::from(cos) - (1.0 - rise * rise).max(0.0).sqrt() * f64::from(sin);
            !level.is_below(all.point) || least_rise < 4.0 * ROUNDING
        };
        self.planes.extend(all.planes.iter().filter(is_met));
    }

    /// Keeps of others the bodies that such a ray may meet. The sine of the angle.
    pub(super) fn keep_bodies(&mut self, all: &Self, (axis, cos): (Vector<f32>, f32), way: f32) -> f32 {
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        self.point = all.point;
        self.bodies.clear();
        let met = all.bodies.iter().filter(|sight| sight.is_met_by_cone(axis, cos, sin));
        self.bodies.extend(met.map(|sight| sight.nearer_by(way)));
        sin
    }
}

impl BoundingCone {
    fn new(hull: &BoundingHull, body: u32, point: DVec3, way: f64) -> Self {
        let margin = margin(hull, point, way);
        let Some((axis, cos)) = hull.cone_from(point, margin) else { return Self::of_anywhere(body) };
        let depth = hull.lowest(axis) - axis.dot(point) - margin;
        let cos = (cos - ROUNDING) as f32;
        Self { body, axis: axis.as_vec3().to_array(), cos, minus_depth: -depth as f32 }
    }

    /// Of a body that may lie in any direction, however near.
    fn of_anywhere(body: u32) -> Self {
        Self { body, axis: [1.0, 0.0, 0.0], cos: -2.0, minus_depth: f32::INFINITY }
    }

    /// The same for rays that start so far on the way.
    fn nearer_by(self, way: f32) -> Self {
        Self { minus_depth: self.minus_depth + way * (1.0 + ROUNDING as f32), ..self }
    }

    /// Whether some ray of a cone may meet the body. `cos` and `sin` are those of the angle between the cone and its
    /// axis, less than a right angle.
    fn is_met_by_cone(&self, axis: Vector<f32>, cos: f32, sin: f32) -> bool {
        if self.cos <= 0.0 {
            return true;
        }
        let own_sin = (1.0 - self.cos * self.cos).max(0.0).sqrt();
        axis.dot(Vector::splat(0.0, self.axis)) >= self.cos * cos - own_sin * sin - 4.0 * ROUNDING as f32
    }

    /// Whether rays from the point in these directions, of length 1, may meet the body before `reach`, finite.
    #[inline(always)]
    pub(crate) fn is_met<R: Float32>(&self, direction: Vector<R>, reach: R) -> R::Mask {
        let along = direction.dot(Vector::splat(reach, self.axis));
        let within = along - self.cos;
        let behind = along.times_plus(reach, reach.like(self.minus_depth));
        within.min(behind).ge(reach.like(0.0))
    }
}

#[cfg(test)]
pub(super) mod tests {
    use std::f64::consts::PI;

    use catoptric_scene::{Anchor, Body, Light, Placement, Scene, Shape};
    use proptest::prelude::*;

    use super::super::space::RenderSpace;
    use super::*;

    pub(in crate::stage) fn point(extent: f64) -> impl Strategy<Value = DVec3> {
        [-extent..extent, -extent..extent, -extent..extent].prop_map(DVec3::from)
    }

    fn size() -> impl Strategy<Value = f64> {
        prop_oneof![0.01..20.0_f64, 0.001..0.1]
    }

    /// Some body, and where in its own frame some point of it lies.
    pub(in crate::stage) fn body() -> impl Strategy<Value = (Body, DVec3)> {
        let shape = (0..4_usize, size(), size(), 0.0..2.0_f64, 0.0..1.0_f64, -PI..PI, -1.0..1.0_f64);
        let shape = shape.prop_map(|(kind, radius, height, ratio, out, around, up)| {
            let (sin, cos) = around.sin_cos();
            let out = if out > 0.9 { 1.0 } else { out };
            let up = if up.abs() > 0.9 { up.signum() } else { up };
            let share = 0.5 + 0.5 * up;
            let level = |radius: f64| DVec3::new(radius * out * cos, share * height, radius * out * sin);
            match kind {
                0 => {
                    let side = (1.0 - up * up).sqrt();
                    (Shape::Sphere { radius }, radius * out * DVec3::new(side * cos, up, side * sin))
                }
                1 => {
                    let size = DVec3::new(radius, height, ratio + 0.01);
                    (Shape::Cube { size }, 0.5 * size * DVec3::new(cos.signum(), up, sin))
                }
                2 => (Shape::Cylinder { radius, height }, level(radius)),
                _ => {
                    let top_radius = if ratio < 0.5 { 0.0 } else { ratio * radius };
                    let here = radius + share * (top_radius - radius);
                    (Shape::Cone { radius, top_radius, height }, level(here))
                }
            }
        });
        let scale = [0.2..3.0_f64, 0.2..3.0, 0.2..3.0].prop_map(DVec3::from);
        (shape, point(50.0), point(180.0), scale).prop_map(
            |((shape, within), position, rotation_degrees, scale)| {
                let anchor = Anchor::Frame { position, rotation_degrees };
                (Body { shape, placement: Placement { anchor, scale }, ..Body::default() }, within)
            },
        )
    }

    /// The body, moved so that a point of its own frame lies there.
    pub(in crate::stage) fn moved((mut body, within): (Body, DVec3), to: DVec3) -> Body {
        let from = body.placement.world_from_body().transform_point3(within);
        if let Anchor::Frame { position, .. } = &mut body.placement.anchor {
            *position += to - from;
        }
        body
    }

    fn vector(v: DVec3) -> Vector<f32> {
        v.as_vec3().into()
    }

    proptest! {
        /// What is in sight is never passed over, neither by a ray nor by a cone around it, nor is a body by the sphere
        /// around it.
        #[test]
        fn no_body_is_missed((body, within) in body(), eye in point(50.0), aside in point(0.3)) {
            let target = body.placement.world_from_body().transform_point3(within);
            let stage_body = RenderBody::prepare(&body, &RenderSpace::default()).body;
            let eye = vector(eye);
            let sight = BoundingCone::new(&stage_body.hull().unwrap(), 0, Vec3::from(eye).as_dvec3(), 0.0);
            let (direction, distance) = (target - Vec3::from(eye).as_dvec3()).normalize_and_length();
            prop_assume!(distance > 1e-2);
            prop_assert!(sight.is_met(vector(direction), f32::MAX));
            let reach = distance as f32 * (1.0 + 1e-6);
            prop_assert!(sight.is_met(vector(direction), reach));
            let way = 0.5 * distance as f32;
            prop_assert!(sight.nearer_by(way).is_met(vector(direction), reach - way * (1.0 - 1e-6)));
            let sphere = stage_body.bounding_sphere();
            prop_assert!(sphere.is_met(eye, vector(direction), reach));
            let axis = (direction + aside).normalize();
            let cos = axis.dot(direction) as f32 - 1e-6;
            prop_assert!(sight.is_met_by_cone(vector(axis), cos, (1.0 - cos * cos).sqrt()));
        }

        /// Nothing is passed over that stands between a point of a body and a light.
        #[test]
        fn nothing_before_a_body_is_missed(
            (body, within) in body(),
            other in body(),
            light in point(50.0),
            share in 0.0..1.0_f64,
        ) {
            let target = body.placement.world_from_body().transform_point3(within);
            let other = moved(other, light.lerp(target, share));
            let scene = Scene { bodies: [body, other].into(), ..Scene::default() };
            let stage = RenderScene::prepare(&scene).unwrap();
            // Of bodies in double precision nothing is known beforehand.
            prop_assume!(!stage.has_doubles());
            let all = stage.seen_from(light.as_vec3().to_array()).unwrap();
            let place = |of: usize| (0..2).find(|&place| stage.scene_index(place) == Some(of)).unwrap();
            let before = &stage.seen_before(&all)[place(0) as usize];
            prop_assert!(before.bodies.iter().map(|sight| sight.body).eq([place(1)]));
        }

        /// The sphere around a body is no larger than it needs to be: near its surface, on no side can it be moved away.
        #[test]
        fn spheres_are_tight((body, _) in body()) {
            let body = RenderBody::prepare(&body, &RenderSpace::default()).body;
            let (sphere, hull) = (body.bounding_sphere(), body.hull().unwrap());
            let center = DVec3::from(sphere.center.map(f64::from));
            // The corners of hulls lie outside of discs, in the same directions.
            let radius = f64::from(sphere.radius) * 0.96 - 1e-3;
            for axis in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z] {
                let is_there = hull.points.iter().any(|&at| {
                    let offset = at - center;
                    hull.radius > 0.0 || offset.length() >= radius && offset.dot(axis) >= -radius * 1e-3 - 1e-3
                });
                prop_assert!(is_there, "{axis}");
            }
        }
    }

    #[test]
    fn what_lies_elsewhere_or_behind_is_passed_over() {
        let ball = BoundingHull { points: vec![DVec3::new(0.0, 0.0, -10.0)], radius: 1.0 };
        let sight = BoundingCone::new(&ball, 0, DVec3::ZERO, 0.0);
        let at =
            |degrees: f64| vector(DVec3::new(degrees.to_radians().sin(), 0.0, -degrees.to_radians().cos()));
        // The sphere is seen under asin(1/10) = 5.74° from its center.
        assert!(sight.is_met(at(5.7), 20.0) && !sight.is_met(at(5.8), 20.0));
        assert!(!sight.is_met(at(0.0), 8.9) && sight.is_met(at(0.0), 9.1));
        assert!(sight.nearer_by(5.0).is_met(at(0.0), 4.1));
        let (sin, cos) = 10.0_f32.to_radians().sin_cos();
        assert!(sight.is_met_by_cone(at(15.0), cos, sin) && !sight.is_met_by_cone(at(16.0), cos, sin));
        // A wall of 8 m × 3 m, 3 m away: its corners are seen under atan(√(4² + 1.5²)/3) = 54.9°.
        let placement = Placement {
            anchor: Anchor::Frame { position: DVec3::new(0.0, 0.0, -3.05), rotation_degrees: DVec3::ZERO },
            ..Placement::default()
        };
        let wall = Shape::Cube { size: DVec3::new(8.0, 3.0, 0.1) };
        let wall = Body { shape: wall, placement, ..Body::default() };
        let wall = RenderBody::prepare(&wall, &RenderSpace::default()).body;
        let sight = BoundingCone::new(&wall.hull().unwrap(), 0, DVec3::ZERO, 0.0);
        assert!(sight.is_met(at(53.0), 20.0) && !sight.is_met(at(58.0), 20.0));
        assert!(!sight.is_met(at(0.0), 2.9) && sight.is_met(at(0.0), 3.1));
        assert!(!sight.is_met(at(45.0), 4.1) && sight.is_met(at(45.0), 4.4));
    }

    /// What stands beside the way from a body to a light, or behind the body, does not shade it.
    #[test]
    fn what_stands_aside_or_behind_shades_nothing() {
        let ball = |x: f64, z: f64| {
            let anchor = Anchor::Frame { position: DVec3::new(x, 0.0, z), rotation_degrees: DVec3::ZERO };
            let placement = Placement { anchor, ..Placement::default() };
            Body { shape: Shape::Sphere { radius: 1.0 }, placement, ..Body::default() }
        };
        let shades = |x: f64, z: f64| {
            let scene = Scene { bodies: [ball(0.0, -10.0), ball(x, z)].into(), ..Scene::default() };
            let stage = RenderScene::prepare(&scene).unwrap();
            let own = (0..2).find(|&place| stage.scene_index(place) == Some(0)).unwrap();
            let all = stage.seen_from([0.0; 3]).unwrap();
            !stage.seen_before(&all)[own as usize].bodies.is_empty()
        };
        // Ahead of the ball both are seen under asin(1/10) and asin(1/5) from their middles, 17.28° together.
        assert_eq!([1.48, 1.50].map(|x| shades(x, -4.77)), [true, false]);
        assert_eq!([-9.0, -11.9, -12.1].map(|z| shades(0.5, z)), [true, true, false]);
    }

    /// A floor is left out of the way to a light where all stands above it, and ahead of rays that go up.
    #[test]
    fn floors_in_no_way_are_left_out() {
        let at = |y: f64| Body {
            placement: Placement {
                anchor: Anchor::Frame { position: DVec3::new(0.0, y, -5.0), rotation_degrees: DVec3::ZERO },
                ..Placement::default()
            },
            ..Body::default()
        };
        let floor = Body { shape: Shape::Plane, ..Body::default() };
        let stage = |bodies: Vec<Body>| {
            RenderScene::prepare(&Scene {
                bodies: bodies.into(),
                lights: vec![Light::default()],
                ..Scene::default()
            })
            .unwrap()
        };
        let planes = |bodies: Vec<Body>, height: f32| {
            stage(bodies).seen_from_light([3.0, height, 0.0]).unwrap().planes.len()
        };
        let Shape::Sphere { radius } = Body::default().shape else {
            unreachable!("a body is a sphere at first")
        };
        assert_eq!(planes(vec![floor.clone(), at(radius)], 2.0), 0, "a sphere that stands on it");
        assert_eq!(planes(vec![floor.clone(), at(radius - 0.01)], 2.0), 1, "a sphere that is sunk in");
        assert_eq!(planes(vec![floor.clone(), at(radius)], -2.0), 1, "a light below");
        assert_eq!(planes(vec![floor.clone(), at(radius), floor.clone()], 2.0), 2, "two planes");
        let stage = stage(vec![floor, at(1.0)]);
        let ahead = |eye: [f32; 3], degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let mut ahead = VisibleBodies::default();
            let cone = (vector(DVec3::new(0.0, sin, -cos)), 10.0_f32.to_radians().cos());
            ahead.keep(&stage, &stage.seen_from(eye).unwrap(), cone, 0.0);
            ahead.planes.len()
        };
        assert_eq!([9.0, 11.0].map(|degrees| ahead([0.0, 1.0, 0.0], degrees)), [1, 0]);
        assert_eq!(ahead([0.0, -1.0, 0.0], 11.0), 1, "an eye below");
    }
}
