//! Axis-aligned bounding boxes.

use glam::{DAffine3, DMat3, DVec3, Vec3};

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

    /// The box without end.
    pub(crate) const EVERYWHERE: Self = Self { min: Vec3::NEG_INFINITY, max: Vec3::INFINITY };

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

    /// The largest box that lies in both; one that holds nothing has a least coordinate above the greatest.
    pub(crate) fn common(self, other: Self) -> Self {
        Self { min: self.min.max(other.min), max: self.max.min(other.max) }
    }

    /// Whether it ends on all sides.
    pub(crate) fn is_finite(&self) -> bool {
        self.min.is_finite() && self.max.is_finite()
    }

    /// The transform of the cube [-1, 1]³ to it.
    pub(crate) fn frame(&self) -> DAffine3 {
        let [min, max] = [self.min, self.max].map(Vec3::as_dvec3);
        DAffine3 { matrix3: DMat3::from_diagonal(0.5 * (max - min)), translation: 0.5 * (min + max) }
    }

    /// Whether it holds nothing.
    pub(crate) fn is_empty(&self) -> bool {
        !self.min.cmple(self.max).all()
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
