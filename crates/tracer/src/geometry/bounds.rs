//! Axis-aligned bounding boxes.

use glam::{DAffine3, DVec3, Vec3};

use crate::geometry::ray::POINT_ROUNDING;
use crate::geometry::shape::ShapeKind;

/// An axis-aligned box, meters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounds {
    /// Least coordinates.
    pub min: Vec3,
    /// Greatest coordinates.
    pub max: Vec3,
}

impl Bounds {
    /// The box that contains nothing.
    pub(crate) const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// The tight box of the canonical shape that `transform` carries to the world, widened by the rounding of single
    /// precision; `None` for a plane.
    pub(crate) fn of_canonical(transform: &DAffine3, kind: ShapeKind, ratio: f64) -> Option<Self> {
        let [min, max] = kind.solid().bounds(transform, ratio)?;
        let widen = f64::from(POINT_ROUNDING) * (min.abs().max(max.abs()).max_element());
        Some(Self { min: (min - DVec3::splat(widen)).as_vec3(), max: (max + DVec3::splat(widen)).as_vec3() })
    }

    /// The smallest box that contains both.
    pub(crate) fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Twice the middle point.
    pub(crate) fn doubled_center(&self) -> Vec3 {
        self.min + self.max
    }

    /// Half the surface area.
    pub(crate) fn half_area(&self) -> f32 {
        let size = (self.max - self.min).max(Vec3::ZERO);
        size.x * size.y + size.y * size.z + size.z * size.x
    }
}
