//! Bounding spheres of a handful of bodies.
//!
//! Below some number of bodies this is quicker than any hierarchy: no order, no stack, one short loop.

use bytemuck::{Pod, Zeroable};

use super::Bounds;
use crate::lanes::Real;
use crate::ray::POINT_ROUNDING;
use crate::vector::Vector;

/// The bounding spheres of the first bodies of a stage, in their order.
#[derive(Clone, Debug)]
pub(crate) struct FewBodies {
    pub(crate) spheres: Vec<BoundingSphere>,
}

/// A sphere around a body.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct BoundingSphere {
    pub(super) center: [f32; 3],
    pub(super) radius: f32,
}

impl FewBodies {
    pub(super) fn new(boxes: impl Iterator<Item = Bounds>) -> Self {
        let sphere = |bounds: Bounds| {
            let center = 0.5 * bounds.doubled_center();
            BoundingSphere { center: center.to_array(), radius: bounds.max.distance(center) }
        };
        Self { spheres: boxes.map(sphere).collect() }
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.spheres)
    }
}

impl BoundingSphere {
    /// All roundings of a test are less than this share of the squared distance.
    pub(crate) const ROUNDING: f32 = 32.0 * f32::EPSILON;

    /// Whether a ray of length 1 comes no further from the center than the radius, before `reach`.
    ///
    /// With m the way to the center and s = m·d, the ray passes at √(m·m - s²). All roundings of that together are
    /// less than `ROUNDING` of m·m.
    #[inline(always)]
    pub(crate) fn is_met<R: Real>(&self, origin: Vector<R>, direction: Vector<R>, reach: R) -> R::Mask {
        let to_center = Vector::splat(reach, self.center) - origin;
        let along = to_center.rough_dot(direction);
        let distance_squared = to_center.rough_dot(to_center);
        let within =
            along.roughly_times_plus(along, reach.like(self.radius * self.radius * (1.0 + Self::ROUNDING)));
        let near = within.ge(distance_squared * (1.0 - Self::ROUNDING));
        let radius = self.radius * (1.0 + Self::ROUNDING);
        let enter = along.roughly_times_plus(reach.like(1.0 - POINT_ROUNDING), reach.like(-radius));
        near & along.ge(reach.like(-radius)) & enter.le(reach)
    }
}
