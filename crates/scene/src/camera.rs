//! The camera.

use glam::DVec3;

use crate::bounds::BoundingSphere;

/// Room around a ball that fills the picture, as a part of its radius.
const MARGIN: f64 = 0.1;

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

impl Camera {
    /// The camera moved so that a ball fills the picture, whose width is `aspect` times its height; the direction of view
    /// stays. A point is given the room that it has now. The result may be beyond what a scene can have.
    ///
    /// With the half angle α of the narrower side, the ball's outline touches the sides at the distance r / sin α.
    pub fn framing(&self, ball: &BoundingSphere, aspect: f64) -> Self {
        let narrow = if aspect > 0.0 { aspect.min(1.0) } else { 1.0 };
        let distance = self.position.distance(self.target);
        let radius = if ball.radius > 0.0 { ball.radius } else { distance * 0.1 } * (1.0 + MARGIN);
        let (distance, projection) = match self.projection {
            Projection::Perspective { fov_degrees } => {
                let half = (0.5 * fov_degrees).to_radians();
                (radius / (half.tan() * narrow).atan().sin(), self.projection)
            }
            Projection::Parallel { .. } => {
                (distance.max(2.0 * radius), Projection::Parallel { height: 2.0 * radius / narrow })
            }
        };
        let view = self.target - self.position;
        // Scaled first, so that no square overflows or vanishes.
        let forward = (view / view.abs().max_element()).normalize_or(DVec3::NEG_Z);
        Self { position: ball.center - forward * distance, target: ball.center, projection, ..*self }
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
