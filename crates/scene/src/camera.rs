//! The camera.

use glam::DVec3;

/// A camera that looks from `position` towards `target`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Eye point, meters. Default (0, 2.2, 8).
    pub position: DVec3,
    /// Point in the center of the picture, meters. Default (0, 1, 0).
    pub target: DVec3,
    /// Direction that points up in the picture. Default +Y.
    pub up: DVec3,
    /// Perspective or parallel. Default perspective, 27°.
    pub projection: Projection,
}

impl Default for Camera {
    fn default() -> Self {
        Self {
            position: DVec3::new(0.0, 2.2, 8.0),
            target: DVec3::new(0.0, 1.0, 0.0),
            up: DVec3::Y,
            projection: Projection::default(),
        }
    }
}

/// The projection from the world to the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Rays spread from the eye.
    Perspective {
        /// Vertical angle of view in degrees, between 0 and 180. Default 27.
        fov_degrees: f64,
    },
    /// Rays run parallel to the direction of view.
    Parallel {
        /// Height of the window in meters. Default 5.
        height: f64,
    },
}

impl Default for Projection {
    fn default() -> Self {
        Self::Perspective { fov_degrees: 27.0 }
    }
}
