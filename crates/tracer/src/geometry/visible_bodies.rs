//! A handful of bodies as they are seen from one point: from the eye, or from a light.
//!
//! All rays from a point have the same start, so that a body lies in a cone of directions, which takes one scalar product
//! and one comparison, and behind a plane across the cone, which takes a product and a comparison more.

use glam::{DVec3, Vec3};

use crate::geometry::Geometry;
use crate::geometry::body::RenderBody;
use crate::geometry::hull::BoundingHull;
use crate::geometry::plane_frame::{PlaneFrame, ROUNDING};
use crate::simd::Float32;
use crate::simd::vector::Vector;

/// The bodies of a scene as they are seen from a point.
#[derive(Clone, Debug, Default)]
pub(crate) struct VisibleBodies {
    pub(crate) point: DVec3,
    /// The bounded ones, the nearest first.
    pub(crate) bodies: Vec<BoundingCone>,
    /// The planes.
    pub(crate) planes: Vec<u32>,
}

/// The cone of directions in which a body may lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BoundingCone {
    /// The body's place in the scene.
    pub(crate) body: u32,
    /// From the point to the body, or the other way if rays go there, of length 1.
    axis: [f32; 3],
    /// Cosine of the angle between the axis and the cone.
    cos: f32,
    /// No part of the body is nearer, measured along the axis, meters; times -1.
    minus_depth: f32,
}

/// Directions around one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RayCone {
    /// Of length 1.
    pub(crate) axis: Vector<f32>,
    /// Cosine and sine of the angle between the axis and the cone, less than a right angle.
    pub(crate) cos: f32,
    pub(crate) sin: f32,
}

/// How far rounding may lead a ray from a point astray where it comes to a body, meters.
fn margin(hull: &BoundingHull, point: DVec3) -> f64 {
    4.0 * ROUNDING * (2.0 * hull.extent() + 3.0 * point.abs().max_element())
}

impl Geometry {
    /// The bodies as they are seen from a point, if they are few.
    pub(crate) fn visible_from(&self, point: [f32; 3]) -> Option<VisibleBodies> {
        if self.bounded as usize > Self::FEW || self.has_doubles() {
            return None;
        }
        let point = DVec3::from(point.map(f64::from));
        let sight = |(body, index): (&RenderBody, u32)| Some(BoundingCone::new(&body.hull()?, index, point));
        let whole = self.bodies.iter().zip(self.whole());
        let mut bodies: Vec<BoundingCone> = whole.filter_map(sight).collect();
        bodies.sort_by(|a, b| b.minus_depth.total_cmp(&a.minus_depth));
        Some(VisibleBodies { point, bodies, planes: self.planes().collect() })
    }

    /// What may stand in the way of rays to a point, if there are few bodies. The only plane cannot where the point and all
    /// other bodies are above it.
    pub(crate) fn candidates_to_light(&self, point: [f32; 3]) -> Option<VisibleBodies> {
        let mut sights = self.visible_from(point)?;
        if let [plane] = sights.planes[..]
            && !self.body(plane).is_joined()
        {
            let level = PlaneFrame::of(self.body(plane));
            let mut hulls = self.bodies.iter().take(self.bounded as usize).filter_map(RenderBody::hull);
            if level.is_below(sights.point) && hulls.all(|hull| level.is_below_hull(&hull)) {
                sights.planes.clear();
            }
        }
        for sight in &mut sights.bodies {
            sight.axis = sight.axis.map(|part| -part);
        }
        Some(sights)
    }
}

impl VisibleBodies {
    /// Keeps of others what some ray of a cone may meet that starts so far on the way from the point.
    pub(crate) fn keep(&mut self, geometry: &Geometry, all: &Self, cone: RayCone, way: f32) {
        self.bodies.clear();
        let met = all.bodies.iter().filter(|sight| sight.is_met_by_cone(cone));
        self.bodies.extend(met.map(|sight| sight.nearer_by(way)));
        self.point = all.point;
        self.planes.clear();
        let (axis, [cos, sin]) = (Vec3::from(cone.axis).as_dvec3(), [cone.cos, cone.sin].map(f64::from));
        let is_met = |&&plane: &&u32| {
            if geometry.body(plane).is_joined() {
                return true;
            }
            let level = PlaneFrame::of(geometry.body(plane));
            let rise = level.up.dot(axis);
            let least_rise = rise * cos - (1.0 - rise * rise).max(0.0).sqrt() * sin;
            !level.is_below(all.point) || least_rise < 4.0 * ROUNDING
        };
        self.planes.extend(all.planes.iter().filter(is_met));
    }
}

impl BoundingCone {
    fn new(hull: &BoundingHull, body: u32, point: DVec3) -> Self {
        let margin = margin(hull, point);
        let Some((axis, cos)) = hull.cone_from(point, margin) else { return Self::of_anywhere(body) };
        let depth = hull.lowest(axis) - axis.dot(point) - margin;
        let cos = (cos - ROUNDING) as f32;
        Self { body, axis: axis.as_vec3().to_array(), cos, minus_depth: -depth as f32 }
    }

    /// Of a body that may lie in any direction, however near.
    fn of_anywhere(body: u32) -> Self {
        Self { body, axis: [1.0, 0.0, 0.0], cos: -2.0, minus_depth: f32::INFINITY }
    }

    /// The cone for rays that start so far on the way.
    fn nearer_by(self, way: f32) -> Self {
        Self { minus_depth: self.minus_depth + way * (1.0 + ROUNDING as f32), ..self }
    }

    /// Whether some ray of a cone may meet the body.
    fn is_met_by_cone(&self, RayCone { axis, cos, sin }: RayCone) -> bool {
        if self.cos <= 0.0 {
            return true;
        }
        let own_sin = ((1.0 - self.cos) * (1.0 + self.cos)).max(0.0).sqrt();
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
pub(crate) mod tests {
    use std::f64::consts::PI;

    use catoptric_scene::{Anchor, Body, Light, ParaboloidDepth, Placement, Scene, Shape};
    use proptest::prelude::*;

    use super::*;
    use crate::geometry::space::RenderSpace;
    use crate::transport::scene::RenderScene;

    pub(crate) fn point(extent: f64) -> impl Strategy<Value = DVec3> {
        [-extent..extent, -extent..extent, -extent..extent].prop_map(DVec3::from)
    }

    fn size() -> impl Strategy<Value = f64> {
        prop_oneof![0.01..20.0_f64, 0.001..0.1]
    }

    /// Some body, and where in its own frame some point of it lies.
    pub(crate) fn body() -> impl Strategy<Value = (Body, DVec3)> {
        let shape = (0..5_usize, size(), size(), 0.0..2.0_f64, 0.0..1.0_f64, -PI..PI, -1.0..1.0_f64);
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
                3 => {
                    let depth = ParaboloidDepth::Height(height);
                    (Shape::Paraboloid { radius, depth }, level(radius * share.sqrt()))
                }
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
            let sight = BoundingCone::new(&stage_body.hull().unwrap(), 0, Vec3::from(eye).as_dvec3());
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
            let (cos, sin) = (axis.dot(direction) as f32, axis.cross(direction).length() as f32);
            let cone = RayCone { axis: vector(axis), cos, sin };
            prop_assert!(sight.is_met_by_cone(cone));
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
        let sight = BoundingCone::new(&ball, 0, DVec3::ZERO);
        let at =
            |degrees: f64| vector(DVec3::new(degrees.to_radians().sin(), 0.0, -degrees.to_radians().cos()));
        // The sphere is seen under asin(1/10) = 5.74° from its center.
        assert!(sight.is_met(at(5.7), 20.0) && !sight.is_met(at(5.8), 20.0));
        assert!(!sight.is_met(at(0.0), 8.9) && sight.is_met(at(0.0), 9.1));
        assert!(sight.nearer_by(5.0).is_met(at(0.0), 4.1));
        let (sin, cos) = 10.0_f32.to_radians().sin_cos();
        let cone = |degrees: f64| RayCone { axis: at(degrees), cos, sin };
        assert!(sight.is_met_by_cone(cone(15.0)) && !sight.is_met_by_cone(cone(16.0)));
        // A wall of 8 m × 3 m, 3 m away: its corners are seen under atan(√(4² + 1.5²)/3) = 54.9°.
        let placement = Placement {
            anchor: Anchor::Frame { position: DVec3::new(0.0, 0.0, -3.05), rotation_degrees: DVec3::ZERO },
            ..Placement::default()
        };
        let wall = Shape::Cube { size: DVec3::new(8.0, 3.0, 0.1) };
        let wall = Body { shape: wall, placement, ..Body::default() };
        let wall = RenderBody::prepare(&wall, &RenderSpace::default()).body;
        let sight = BoundingCone::new(&wall.hull().unwrap(), 0, DVec3::ZERO);
        assert!(sight.is_met(at(53.0), 20.0) && !sight.is_met(at(58.0), 20.0));
        assert!(!sight.is_met(at(0.0), 2.9) && sight.is_met(at(0.0), 3.1));
        assert!(!sight.is_met(at(45.0), 4.1) && sight.is_met(at(45.0), 4.4));
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
        let scene = |bodies: Vec<Body>| {
            RenderScene::build(&Scene {
                bodies: bodies.into(),
                lights: vec![Light::default()],
                ..Scene::default()
            })
            .unwrap()
        };
        let planes = |bodies: Vec<Body>, height: f32| {
            scene(bodies).geometry.candidates_to_light([3.0, height, 0.0]).unwrap().planes.len()
        };
        let Shape::Sphere { radius } = Body::default().shape else {
            unreachable!("a body is a sphere at first")
        };
        assert_eq!(planes(vec![floor.clone(), at(radius)], 2.0), 0, "a sphere that stands on it");
        assert_eq!(planes(vec![floor.clone(), at(radius - 0.01)], 2.0), 1, "a sphere that is sunk in");
        assert_eq!(planes(vec![floor.clone(), at(radius)], -2.0), 1, "a light below");
        assert_eq!(planes(vec![floor.clone(), at(radius), floor.clone()], 2.0), 2, "two planes");
        let scene = scene(vec![floor, at(1.0)]);
        let ahead = |eye: [f32; 3], degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let mut ahead = VisibleBodies::default();
            let axis = vector(DVec3::new(0.0, sin, -cos));
            let (sin, cos) = 10.0_f32.to_radians().sin_cos();
            let cone = RayCone { axis, cos, sin };
            ahead.keep(&scene.geometry, &scene.geometry.visible_from(eye).unwrap(), cone, 0.0);
            ahead.planes.len()
        };
        assert_eq!([9.0, 11.0].map(|degrees| ahead([0.0, 1.0, 0.0], degrees)), [1, 0]);
        assert_eq!(ahead([0.0, -1.0, 0.0], 11.0), 1, "an eye below");
    }
}
