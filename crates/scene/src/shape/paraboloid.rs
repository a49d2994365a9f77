//! The cap of a paraboloid of revolution about the Y axis, from its vertex at the origin up to a disc.
//!
//! With the rim radius r, the height h and the focal length f = r²/(4h) it is x² + z² ≤ 4·f·y, y ≤ h. What comes along
//! the axis is mirrored to the focus (0, f, 0) from everywhere.

use glam::{DVec3, dvec3};

use crate::shape::Solid;
use crate::shape::frustum::ball_of_rims;
use crate::shape::outline::{CORNERS, rim};

/// What says how deep a paraboloid is. Default a height of 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParaboloidDepth {
    /// The distance from the vertex to the plane of the rim, meters.
    Height(f64),
    /// The distance from the vertex to the focus, meters: the height is r²/(4f).
    FocalLength(f64),
}

impl ParaboloidDepth {
    /// The height for this radius of the rim, meters.
    pub const fn height(self, radius: f64) -> f64 {
        match self {
            Self::Height(height) => height,
            Self::FocalLength(length) => quarter(radius, length),
        }
    }

    /// The focal length for this radius of the rim, meters.
    pub const fn focal_length(self, radius: f64) -> f64 {
        match self {
            Self::Height(height) => quarter(radius, height),
            Self::FocalLength(length) => length,
        }
    }
}

/// r²/(4a): of the height a the focal length, and the other way around.
const fn quarter(radius: f64, a: f64) -> f64 {
    0.25 * radius * (radius / a)
}

pub(super) struct Paraboloid {
    /// The radius of the rim.
    pub(super) radius: f64,
    pub(super) height: f64,
}

impl Paraboloid {
    /// The points where the eye looks past, along the circle on which a plane through the eye touches the surface.
    ///
    /// In units of the radius and the height the surface is y = x² + z². The tangent plane at (x, z) holds the eye where
    /// x² + z² - 2(x·e_x + z·e_z) + e_y = 0: a circle about the eye, seen from above, of the squared radius
    /// e_x² + e_z² - e_y. Only what is no farther than 1 from the axis belongs to the cap.
    fn silhouette(&self, eye: DVec3) -> Option<Vec<DVec3>> {
        let eye = eye / self.scale();
        let distance = eye.x.hypot(eye.z);
        let across = (distance * distance - eye.y).sqrt();
        // Not a number for an eye within the paraboloid.
        let nearest = (distance - across).abs();
        if !across.is_finite() || nearest >= 1.0 || across == 0.0 {
            return None;
        }
        // The angle at the eye's foot, from the way to the axis, up to where the circle leaves the cap.
        let cosine = (distance * distance + across * across - 1.0) / (2.0 * distance * across);
        let widest = if cosine > -1.0 { cosine.min(1.0).acos() } else { std::f64::consts::PI };
        let toward_axis = eye.z.atan2(eye.x) + std::f64::consts::PI;
        let point = |step: u32| {
            let angle = toward_axis + widest * (2.0 * f64::from(step) / f64::from(CORNERS) - 1.0);
            let (x, z) = (eye.x + across * angle.cos(), eye.z + across * angle.sin());
            dvec3(x, x * x + z * z, z) * self.scale()
        };
        Some((0..=CORNERS).map(point).collect())
    }

    fn scale(&self) -> DVec3 {
        dvec3(self.radius, self.height, self.radius)
    }
}

impl Solid for Paraboloid {
    fn extent(&self) -> [DVec3; 2] {
        let Self { radius, height } = *self;
        [dvec3(-radius, 0.0, -radius), dvec3(radius, height, radius)]
    }

    /// At the distance s·r from the axis the side reaches a·s + b·s², with a and b the parts of the direction across and
    /// along the axis times r and h: most at s = -a/(2b), or at the rim.
    fn support(&self, direction: DVec3) -> f64 {
        let (a, b) = (self.radius * direction.x.hypot(direction.z), self.height * direction.y);
        if b < -0.5 * a { -0.25 * a * (a / b) } else { a + b }
    }

    /// That around the vertex and the rim: the squared distance of the side from a point on the axis is convex in y.
    fn ball(&self, scale: DVec3) -> (DVec3, f64) {
        let wide = scale.x.max(scale.z);
        let (y, radius) = ball_of_rims(0.0, self.radius * wide, self.height * scale.y);
        (y / scale.y * DVec3::Y, radius)
    }

    /// The rim, and the line beside which the eye looks past.
    fn outline(&self, eye: DVec3) -> Vec<Vec<DVec3>> {
        std::iter::once(rim(self.radius, self.height)).chain(self.silhouette(eye)).collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::{Shape, ShapeKind};

    use super::*;

    #[test]
    fn height_and_focal_length_stand_for_each_other() {
        let mut dish = Shape::Paraboloid { radius: 2.0, depth: ParaboloidDepth::Height(0.5) };
        assert_eq!((dish.height(), dish.focal_length()), (Some(0.5), Some(2.0)));
        dish.set_number("focal_length", 4.0);
        assert_eq!(
            (dish.height(), dish.number("focal_length"), dish.number("height")),
            (Some(0.25), Some(4.0), None)
        );
        // A wider mirror of the focal length that was given.
        dish.set_number("radius", 4.0);
        assert_eq!((dish.height(), dish.focal_length()), (Some(1.0), Some(4.0)));
        assert_eq!((dish.scaled(2.0).height(), dish.scaled(2.0).focal_length()), (Some(2.0), Some(8.0)));
        dish.set_height(2.0);
        assert_eq!((dish.number("height"), dish.focal_length()), (Some(2.0), Some(2.0)));
        assert_eq!(ShapeKind::Cone.shape().focal_length(), None);
    }

    #[test]
    fn the_outline_touches_the_surface_and_ends_at_the_rim() {
        let dish = Paraboloid { radius: 2.0, height: 1.5 };
        for eye in [dvec3(5.0, 0.4, -3.0), dvec3(0.3, -0.5, 0.1), dvec3(-9.0, 4.0, 0.0)] {
            let lines = dish.outline(eye);
            let side = lines.get(1).unwrap();
            for point in side {
                let level = (point.x * point.x + point.z * point.z) / 4.0 - point.y / 1.5;
                let normal = dvec3(point.x / 2.0, -1.0 / 1.5, point.z / 2.0);
                assert!(level.abs() < 1e-12 && normal.dot(eye - *point).abs() < 1e-11, "{point} from {eye}");
                assert!(point.y < 1.5 + 1e-9);
            }
            // Near the vertex, below it, the eye sees a closed line; from beside the line ends at the rim.
            let [first, last] = [side[0], side[side.len() - 1]];
            assert!(
                first.distance(last) < 1e-9 || ((first.y - 1.5).abs() < 1e-9 && (last.y - 1.5).abs() < 1e-9)
            );
        }
        // From within, from straight above and from far below there is nothing to look past but the rim.
        for eye in [dvec3(0.1, 1.0, 0.0), DVec3::Y * 9.0, dvec3(0.3, -9.0, 0.1)] {
            assert_eq!(dish.outline(eye).len(), 1, "{eye}");
        }
    }
}
