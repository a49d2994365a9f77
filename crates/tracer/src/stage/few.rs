//! Bounding spheres of a handful of bodies.
//!
//! Below some number of bodies this is quicker than any hierarchy: no order, no stack, one short loop.

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
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct BoundingSphere {
    center: [f32; 3],
    radius: f32,
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
    /// Whether a ray of length 1 comes no further from the center than the radius, which is widened by the rounding of a
    /// long way, before `reach`.
    #[inline(always)]
    pub(crate) fn is_met<R: Real>(&self, origin: Vector<R>, direction: Vector<R>, reach: R) -> R::Mask {
        let to_center = Vector::splat(reach, self.center) - origin;
        let along = to_center.dot(direction);
        let aside = to_center - direction * along;
        let wide = along.abs() * POINT_ROUNDING + self.radius;
        let near = aside.length_squared().le(wide * wide);
        near & (along + wide).ge(reach.like(0.0)) & (along - wide).le(reach)
    }
}
