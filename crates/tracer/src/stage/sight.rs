//! A handful of bodies as they are seen from one point: from the eye, or from a light.
//!
//! All rays from a point have the same start, so that a sphere around a body is a cone of directions, which takes one
//! scalar product and one comparison.

use glam::DVec3;

use super::few::{BoundingSphere, FewBodies};
use crate::lanes::Real;
use crate::vector::Vector;

/// The cone of directions in which a body may lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sight {
    /// The body's place in the stage.
    pub(crate) body: u32,
    /// From the point to the middle of the body, of length 1.
    axis: [f32; 3],
    /// Cosine of the angle between the axis and the cone.
    cos: f32,
    /// No part of the body is nearer, meters.
    near: f32,
}

/// More than the rounding of a scalar product of unit vectors, and, relatively, than that of a length.
const ROUNDING: f64 = 1e-6;

impl FewBodies {
    /// The bodies as they are seen from a point, the nearest first.
    pub(crate) fn seen_from(&self, point: [f32; 3]) -> Vec<Sight> {
        let mut seen: Vec<Sight> =
            self.spheres.iter().zip(0..).map(|(sphere, body)| Sight::new(sphere, body, point)).collect();
        seen.sort_by(|a, b| a.near.total_cmp(&b.near));
        seen
    }
}

impl Sight {
    fn new(sphere: &BoundingSphere, body: u32, point: [f32; 3]) -> Self {
        let point = DVec3::from(point.map(f64::from));
        let center = DVec3::from(sphere.center.map(f64::from));
        let offset = center - point;
        let distance = offset.length();
        // Rays start near the point, but for rounding.
        let size = center.abs().max_element() + point.abs().max_element() + distance;
        let radius = f64::from(sphere.radius) * (1.0 + ROUNDING) + ROUNDING * size;
        let sin = radius / distance;
        let is_outside = sin < 1.0;
        let (axis, cos, near) = if is_outside {
            (offset / distance, (1.0 - sin * sin).sqrt() - ROUNDING, (distance - radius) * (1.0 - ROUNDING))
        } else {
            // From within it lies in every direction.
            (DVec3::X, -2.0, 0.0)
        };
        Self { body, axis: axis.as_vec3().to_array(), cos: cos as f32, near: near as f32 }
    }

    /// The same for rays that start so far on the way.
    pub(crate) fn nearer_by(self, way: f32) -> Self {
        Self { near: self.near - way * (1.0 + ROUNDING as f32), ..self }
    }

    /// Whether some ray of a cone may meet the body. `cos` and `sin` are those of the angle between the cone and its
    /// axis, less than a right angle.
    pub(crate) fn is_met_by_cone(&self, axis: Vector<f32>, cos: f32, sin: f32) -> bool {
        if self.cos <= 0.0 {
            return true;
        }
        let own_sin = (1.0 - self.cos * self.cos).max(0.0).sqrt();
        axis.dot(Vector::splat(0.0, self.axis)) >= self.cos * cos - own_sin * sin - 4.0 * ROUNDING as f32
    }

    /// Whether rays from the point in these directions, of length 1, may meet the body before `reach`.
    #[inline(always)]
    pub(crate) fn is_met<R: Real>(&self, direction: Vector<R>, reach: R) -> R::Mask {
        let [x, y, z] = self.axis;
        let along = direction.x * x + direction.y * y + direction.z * z;
        along.ge(reach.like(self.cos)) & reach.ge(reach.like(self.near))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn point(extent: f64) -> impl Strategy<Value = DVec3> {
        [-extent..extent, -extent..extent, -extent..extent].prop_map(DVec3::from)
    }

    fn vector(v: DVec3) -> Vector<f32> {
        v.as_vec3().into()
    }

    proptest! {
        /// What is in sight is never passed over, neither by a ray nor by a cone around it.
        #[test]
        fn no_body_is_missed(
            eye in point(50.0),
            center in point(50.0),
            radius in 0.01..20.0_f64,
            aim in point(1.0),
            aside in point(0.3),
        ) {
            let sphere = BoundingSphere { center: center.as_vec3().to_array(), radius: radius as f32 };
            let sight = Sight::new(&sphere, 0, eye.as_vec3().to_array());
            // Some point in the sphere.
            let target = center + 0.999 * radius * aim.clamp_length_max(1.0);
            let (direction, distance) = (target - eye).normalize_and_length();
            prop_assume!(distance > 1e-3);
            prop_assert!(sight.is_met(vector(direction), f32::INFINITY));
            prop_assert!(sight.is_met(vector(direction), distance as f32 * (1.0 + 1e-6)));
            let axis = (direction + aside).normalize();
            let cos = axis.dot(direction) as f32 - 1e-6;
            prop_assert!(sight.is_met_by_cone(vector(axis), cos, (1.0 - cos * cos).sqrt()));
        }
    }

    #[test]
    fn what_lies_elsewhere_or_behind_is_passed_over() {
        let sphere = BoundingSphere { center: [0.0, 0.0, -10.0], radius: 1.0 };
        let sight = Sight::new(&sphere, 0, [0.0; 3]);
        let at =
            |degrees: f64| vector(DVec3::new(degrees.to_radians().sin(), 0.0, -degrees.to_radians().cos()));
        // The sphere is seen under asin(1/10) = 5.74° from its center.
        assert!(sight.is_met(at(5.7), 20.0) && !sight.is_met(at(5.8), 20.0));
        assert!(!sight.is_met(at(0.0), 8.9) && sight.is_met(at(0.0), 9.1));
        assert!(sight.nearer_by(5.0).is_met(at(0.0), 4.1));
        let (sin, cos) = 10.0_f32.to_radians().sin_cos();
        assert!(sight.is_met_by_cone(at(15.0), cos, sin) && !sight.is_met_by_cone(at(16.0), cos, sin));
    }
}
