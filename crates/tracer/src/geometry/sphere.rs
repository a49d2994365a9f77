//! Bounding spheres of bodies.
//!
//! Below some number of bodies to test them all is quicker than any hierarchy: no order, no stack, one short loop. Among
//! many they tell which bodies of a leaf need not be looked at.

use bytemuck::{Pod, Zeroable};
use glam::DAffine3;

use crate::geometry::ray::POINT_ROUNDING;
use crate::geometry::shape::ShapeKind;
use crate::geometry::shape::solid::is_oblique;
use crate::simd::Float32;
use crate::simd::vector::Vector;

/// A sphere around a body.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct BoundingSphere {
    pub(crate) center: [f32; 3],
    pub(crate) radius: f32,
}

impl BoundingSphere {
    /// The smallest sphere around the canonical shape that `transform` carries to the world, widened by the rounding of
    /// single precision; that of a plane is infinite. A larger one where the frame is oblique.
    pub(crate) fn of_canonical(transform: &DAffine3, kind: ShapeKind, ratio: f64) -> Self {
        let linear = DAffine3::from_mat3(transform.matrix3);
        let (offset, radius) = match kind.solid().bounds(&linear, ratio) {
            Some([min, max]) if is_oblique(&transform.matrix3) => {
                (0.5 * (min + max), 0.5 * min.distance(max))
            }
            _ => kind.solid().bounding_sphere(&transform.matrix3, ratio),
        };
        let center = transform.translation + offset;
        let radius = radius + f64::from(POINT_ROUNDING) * (center.abs().max_element() + radius);
        Self { center: center.as_vec3().to_array(), radius: radius as f32 }
    }

    /// All roundings of a test are less than this share of the squared distance.
    pub(crate) const ROUNDING: f32 = 32.0 * f32::EPSILON;

    /// Whether a ray of length 1 comes no further from the center than the radius, before `t_max`.
    ///
    /// With m the way to the center and s = m·d, the ray passes at √(m·m - s²). All roundings of that together are
    /// less than `ROUNDING` of m·m.
    #[inline(always)]
    pub(crate) fn is_met<R: Float32>(&self, origin: Vector<R>, direction: Vector<R>, t_max: R) -> R::Mask {
        let to_center = Vector::splat(t_max, self.center) - origin;
        let along = to_center.dot(direction);
        let distance_squared = to_center.dot(to_center);
        let within = along.times_plus(along, t_max.like(self.radius * self.radius * (1.0 + Self::ROUNDING)));
        let near = within.ge(distance_squared * (1.0 - Self::ROUNDING));
        let radius = self.radius * (1.0 + Self::ROUNDING);
        let enter = along.times_plus(t_max.like(1.0 - POINT_ROUNDING), t_max.like(-radius));
        near & along.ge(t_max.like(-radius)) & enter.le(t_max)
    }
}
