//! Bounding spheres of a handful of bodies, four tested at a time.
//!
//! Below some number of bodies this is quicker than any hierarchy: no order, no stack, one short loop.

use bytemuck::{Pod, Zeroable};
use glam::{Vec3A, Vec4};

use super::Bounds;
use crate::ray::{POINT_ROUNDING, Ray};

/// The bounding spheres of four bodies; an unused one has a negative radius and is never met.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C, align(16))]
struct Four {
    x: [f32; 4],
    y: [f32; 4],
    z: [f32; 4],
    radius: [f32; 4],
}

/// The bounding spheres of the first bodies of a stage, in their order.
#[derive(Clone, Debug)]
pub(crate) struct FewBodies {
    fours: Vec<Four>,
}

impl FewBodies {
    pub(super) fn new(boxes: impl Iterator<Item = Bounds>) -> Self {
        let mut fours = Vec::new();
        for (index, bounds) in boxes.enumerate() {
            let slot = index % 4;
            if slot == 0 {
                fours.push(Four { x: [0.0; 4], y: [0.0; 4], z: [0.0; 4], radius: [-1.0; 4] });
            }
            if let Some(four) = fours.last_mut() {
                let center = 0.5 * bounds.doubled_center();
                (four.x[slot], four.y[slot], four.z[slot]) = center.into();
                four.radius[slot] = bounds.max.distance(center);
            }
        }
        Self { fours }
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.fours)
    }

    /// Calls `body` for the bodies whose spheres the ray meets. `body` returns the parameter beyond which nothing is
    /// wanted any more.
    #[inline]
    pub(crate) fn visit(&self, ray: &Ray, mut reach: f32, mut body: impl FnMut(u32) -> f32) {
        let mut first = 0;
        for four in &self.fours {
            let mut met = four.met(ray.origin, ray.direction, reach);
            while met != 0 {
                reach = body(first + met.trailing_zeros());
                met &= met - 1;
            }
            first += 4;
        }
    }
}

impl Four {
    /// A bit for each sphere that the ray meets before `reach`: those no further from the line than their radius,
    /// which is widened by the rounding of a long way.
    #[inline]
    fn met(&self, origin: Vec3A, direction: Vec3A, reach: f32) -> u32 {
        let x = Vec4::from_array(self.x) - Vec4::splat(origin.x);
        let y = Vec4::from_array(self.y) - Vec4::splat(origin.y);
        let z = Vec4::from_array(self.z) - Vec4::splat(origin.z);
        let along = x * direction.x + y * direction.y + z * direction.z;
        let (x, y, z) = (x - along * direction.x, y - along * direction.y, z - along * direction.z);
        let radius = Vec4::from_array(self.radius);
        let wide = radius + along.abs() * POINT_ROUNDING;
        let near = (x * x + y * y + z * z).cmple(wide * wide);
        let ahead = (along + wide).cmpge(Vec4::ZERO) & (along - wide).cmple(Vec4::splat(reach));
        (near & ahead & radius.cmpge(Vec4::ZERO)).bitmask()
    }
}
