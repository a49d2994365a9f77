//! Cylinders, cones and frusta: two discs across the Y axis and the straight lines between their rims.

use glam::{DVec3, dvec3};

use crate::shape::Solid;
use crate::shape::outline::rim;

pub(super) struct Frustum {
    /// The radius at y = 0.
    pub(super) bottom: f64,
    /// The radius at y = `height`.
    pub(super) top: f64,
    pub(super) height: f64,
}

/// The smallest ball around two circles about the Y axis, of the radius `bottom` at y = 0 and of `top` at y = `height`:
/// the y of its center, and its radius.
///
/// A center at y is as far from both circles where bottom² + y² = top² + (height − y)². Where that leaves the axis
/// between them, one circle's own ball holds both.
pub(super) fn ball_of_rims(bottom: f64, top: f64, height: f64) -> (f64, f64) {
    let y = (0.5 * (height + (top - bottom) * (top + bottom) / height)).clamp(0.0, height);
    (y, bottom.hypot(y).max(top.hypot(height - y)))
}

impl Solid for Frustum {
    fn extent(&self) -> [DVec3; 2] {
        let widest = self.bottom.max(self.top);
        [dvec3(-widest, 0.0, -widest), dvec3(widest, self.height, widest)]
    }

    /// That of the rims.
    fn support(&self, direction: DVec3) -> f64 {
        let across = direction.x.hypot(direction.z);
        (self.bottom * across).max(self.top * across + self.height * direction.y)
    }

    fn ball(&self, scale: DVec3) -> (DVec3, f64) {
        let wide = scale.x.max(scale.z);
        let (y, radius) = ball_of_rims(self.bottom * wide, self.top * wide, self.height * scale.y);
        (y / scale.y * DVec3::Y, radius)
    }

    /// Both rims, and the two lines between them beside which the eye looks past.
    fn outline(&self, eye: DVec3) -> Vec<Vec<DVec3>> {
        let Self { bottom, top, height } = *self;
        let mut lines = vec![rim(bottom, 0.0), rim(top, height)];
        // A plane through the eye touches the side where normal·(eye − point) = 0: with the slope s of the radius and
        // the radius r at the eye's height, x·cos φ + z·sin φ = r there.
        let slope = (top - bottom) / height;
        let (radius, distance) = (bottom + slope * eye.y, eye.x.hypot(eye.z));
        if radius.abs() < distance {
            let (middle, away) = (eye.z.atan2(eye.x), (radius / distance).acos());
            for angle in [middle - away, middle + away] {
                let side = dvec3(angle.cos(), 0.0, angle.sin());
                lines.push(vec![bottom * side, height * DVec3::Y + top * side]);
            }
        }
        lines
    }
}
