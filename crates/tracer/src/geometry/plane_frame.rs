//! The surface of a plane, in double precision.

use glam::DVec3;

use crate::geometry::body::RenderBody;
use crate::geometry::hull::BoundingHull;

/// More than the rounding of a scalar product of unit vectors, and, relatively, than that of a length.
pub(crate) const ROUNDING: f64 = 1e-6;

/// The surface of a plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlaneFrame {
    origin: DVec3,
    /// Of length 1.
    pub(crate) up: DVec3,
}

impl PlaneFrame {
    pub(crate) fn of(plane: &RenderBody) -> Self {
        let [origin, up] = [plane.origin, plane.body_from_world[1]].map(|v| DVec3::from(v.map(f64::from)));
        Self { origin, up }
    }

    /// A point of it, and its normal of length 1.
    pub(crate) fn point_and_normal(&self) -> (DVec3, DVec3) {
        (self.origin, self.up)
    }

    /// How far what reaches so far along `up` is above.
    pub(crate) fn height(&self, along: f64) -> f64 {
        along - self.up.dot(self.origin)
    }

    /// How far a point is above.
    pub(crate) fn height_of(&self, point: DVec3) -> f64 {
        self.height(self.up.dot(point))
    }

    /// How much of it is rounding where coordinates are so large.
    pub(crate) fn rounding(&self, extent: f64) -> f64 {
        ROUNDING * (extent + self.origin.abs().max_element())
    }

    pub(crate) fn is_below(&self, point: DVec3) -> bool {
        self.height_of(point) > 4.0 * self.rounding(point.abs().max_element())
    }

    /// Whether all of this stands on it or above.
    pub(crate) fn is_below_hull(&self, hull: &BoundingHull) -> bool {
        self.height(hull.lowest(self.up)) >= -self.rounding(hull.extent())
    }
}
