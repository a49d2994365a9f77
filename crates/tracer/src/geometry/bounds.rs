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

    /// The tight box of the canonical shape that `transform` carries to the world, widened by the rounding of single precision; `None` for a plane.
    ///
    /// With m_i the rows of the transform's linear part, an ellipsoid reaches |m_i| from its center along axis i, a
    /// box the sum of |m_ij|, and a disc across the frame's Y axis √(m_ix² + m_iz²) from its own center.
    pub(crate) fn of_canonical(transform: &DAffine3, kind: ShapeKind, ratio: f64) -> Option<Self> {
        let (x, y, z) = (transform.matrix3.x_axis, transform.matrix3.y_axis, transform.matrix3.z_axis);
        let origin = transform.translation;
        let disc = (x * x + z * z).map(f64::sqrt);
        let (min, max) = match kind {
            ShapeKind::Sphere | ShapeKind::Ellipsoid => {
                let reach = (x * x + y * y + z * z).map(f64::sqrt);
                (origin - reach, origin + reach)
            }
            ShapeKind::Cube => {
                let reach = x.abs() + y.abs() + z.abs();
                (origin - reach, origin + reach)
            }
            ShapeKind::Cylinder | ShapeKind::Cone => {
                let (top, top_disc) = (origin + y, ratio * disc);
                ((origin - disc).min(top - top_disc), (origin + disc).max(top + top_disc))
            }
            ShapeKind::Plane => return None,
        };
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
