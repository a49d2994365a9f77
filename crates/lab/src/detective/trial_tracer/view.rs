//! The rays of a camera, rightly and wrongly.

use catoptric_scene::{Camera, Projection};
use glam::{DVec2, DVec3};

use super::shape::Switches;
use crate::detective::ray_fault::RayFault;

/// A camera with its faults.
pub(super) struct TrialView {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    ahead: DVec3,
    projection: Projection,
    has_even_angles: bool,
}

impl TrialView {
    pub(super) fn new(camera: &Camera, switches: &Switches) -> Self {
        let mut ahead = (camera.target - camera.position).normalize_or(DVec3::NEG_Z);
        let fault = switches.view;
        let upright = camera.up.normalize_or(DVec3::Y);
        if fault == Some(RayFault::NoTilt) {
            ahead = (ahead - ahead.dot(upright) * upright).normalize_or(ahead);
        }
        let across = ahead.cross(upright);
        let unit = across.normalize_or(DVec3::X);
        let right = match fault {
            Some(RayFault::RightNotUnit | RayFault::RightAloneNotUnit) => across,
            _ => unit,
        };
        let up = match fault {
            Some(RayFault::UpNotOrthogonal) => upright,
            Some(RayFault::RightNotUnit) => right.cross(ahead),
            _ => unit.cross(ahead),
        };
        let has_even_angles = fault == Some(RayFault::EvenAngles);
        Self { eye: camera.position, right, up, ahead, projection: camera.projection, has_even_angles }
    }

    /// Where the ray of a place in a picture begins, and its unit direction.
    pub(super) fn ray(&self, at: DVec2, size: DVec2) -> (DVec3, DVec3) {
        // Halves of the picture's height, to the right and up.
        let window = (2.0 * at - size) / size.y;
        match self.projection {
            Projection::Parallel { height } => {
                let moved = 0.5 * height * (window.x * self.right - window.y * self.up);
                (self.eye + moved, self.ahead)
            }
            Projection::Perspective { fov_degrees } => {
                let half = (0.5 * fov_degrees).to_radians();
                let (x, y) = if self.has_even_angles {
                    let across = (half.tan() * size.x / size.y).atan() * size.y / size.x;
                    ((window.x * across).tan(), (window.y * half).tan())
                } else {
                    (window.x * half.tan(), window.y * half.tan())
                };
                (self.eye, (x * self.right - y * self.up + self.ahead).normalize())
            }
        }
    }
}
