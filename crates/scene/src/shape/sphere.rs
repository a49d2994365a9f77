//! The ball about the origin.

use glam::DVec3;

use crate::shape::Solid;
use crate::shape::outline::circle;

pub(super) struct Sphere {
    pub(super) radius: f64,
}

impl Solid for Sphere {
    fn extent(&self) -> [DVec3; 2] {
        [DVec3::splat(-self.radius), DVec3::splat(self.radius)]
    }

    fn support(&self, direction: DVec3) -> f64 {
        self.radius * direction.length()
    }

    fn ball(&self, scale: DVec3) -> (DVec3, f64) {
        (DVec3::ZERO, self.radius * scale.max_element())
    }

    /// The circle of the points at which rays from the eye touch the sphere.
    fn outline(&self, eye: DVec3) -> Vec<Vec<DVec3>> {
        let distance = eye.length();
        if distance <= self.radius {
            return Vec::new();
        }
        let axis = eye / distance;
        let cosine = self.radius / distance;
        let (right, up) = axis.any_orthonormal_pair();
        let reach = self.radius * (1.0 - cosine * cosine).sqrt();
        vec![circle(self.radius * cosine * axis, reach * right, reach * up)]
    }
}
