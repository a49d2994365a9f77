//! Moves of the camera. All are pure, and for a valid camera and any numbers give a valid camera: a move that cannot
//! be made leaves the camera as it is.

mod range;

use std::f64::consts::FRAC_PI_2;

use catoptric_scene::bounds::BoundingSphere;
use catoptric_scene::format::keys;
use catoptric_scene::format::spec::{KeySpec, Limits};
use catoptric_scene::{Camera, Projection};
use glam::{DMat3, DQuat, DVec3};

pub use range::{CachedCameraRange, CameraRange};

/// How near to the pole the view can be turned, radians. Nearer than that, the picture would spin under the pointer.
const NEAREST_POLE: f64 = 0.002;

/// The side of the scene to look from, with Y up and the front towards +Z.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ViewSide {
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

impl ViewSide {
    /// All sides.
    pub const ALL: [Self; 6] = [Self::Front, Self::Back, Self::Left, Self::Right, Self::Top, Self::Bottom];

    /// The direction to look from, and the one that points up in the picture.
    const fn place_and_up(self) -> (DVec3, DVec3) {
        match self {
            Self::Front => (DVec3::Z, DVec3::Y),
            Self::Back => (DVec3::NEG_Z, DVec3::Y),
            Self::Left => (DVec3::NEG_X, DVec3::Y),
            Self::Right => (DVec3::X, DVec3::Y),
            Self::Top => (DVec3::Y, DVec3::NEG_Z),
            Self::Bottom => (DVec3::NEG_Y, DVec3::Z),
        }
    }
}

/// The camera's right, upward (across the view) and forward directions, of length 1.
fn axes(camera: &Camera) -> DMat3 {
    let forward = direction(camera.target - camera.position);
    let right = forward.cross(direction(camera.up)).normalize_or(DVec3::X);
    DMat3::from_cols(right, right.cross(forward), forward)
}

/// A vector at length 1; scaled first, so that no square overflows or vanishes.
fn direction(vector: DVec3) -> DVec3 {
    (vector / vector.abs().max_element()).normalize_or(DVec3::NEG_Z)
}

/// `camera` after a move, or as it was when that is no camera.
fn moved(camera: &Camera, to: Camera) -> Camera {
    if to.is_valid() { to } else { *camera }
}

/// Turns a vector about `up`, by `yaw` counterclockwise, and then towards `up` by `pitch`, no nearer to it than the
/// pole allows. Radians.
fn turned(vector: DVec3, ahead: DVec3, up: DVec3, yaw: f64, pitch: f64) -> DVec3 {
    let length = vector.length();
    let elevation = (vector.dot(up) / length).clamp(-1.0, 1.0).asin();
    let limit = FRAC_PI_2 - NEAREST_POLE;
    let elevation = (elevation + pitch).clamp(-limit, limit);
    let ahead = DQuat::from_axis_angle(up, yaw) * ahead;
    length * (ahead * elevation.cos() + up * elevation.sin())
}

/// The direction that a turntable turns about, and the horizontal part of `offset` (from the target to the camera).
///
/// A camera that looks straight up or down, as [`look_along`] leaves it, has a horizontal upward direction; it turns
/// about the world's Y as all others do, and the top of its picture becomes what is ahead.
fn turntable(camera: &Camera, offset: DVec3) -> (DVec3, DVec3) {
    let (up, away) = (direction(camera.up), direction(offset));
    let is_from_pole = away.cross(DVec3::Y).length() < 1e-6 && up.dot(DVec3::Y).abs() < 1e-6;
    if is_from_pole {
        return (DVec3::Y, -up * away.y.signum());
    }
    (up, away.reject_from_normalized(up).normalize_or(DVec3::Z))
}

/// Turns the camera about its target: to the right by `yaw_radians` about its upward direction, and up by
/// `pitch_radians`, never past the pole.
pub fn orbit(camera: &Camera, yaw_radians: f64, pitch_radians: f64) -> Camera {
    if yaw_radians == 0.0 && pitch_radians == 0.0 {
        return *camera;
    }
    let offset = camera.position - camera.target;
    let (up, ahead) = turntable(camera, offset);
    let offset = turned(offset, ahead, up, yaw_radians, pitch_radians);
    moved(camera, Camera { position: camera.target + offset, up: kept_up(camera, up), ..*camera })
}

/// `up`, as the camera has it where the direction is the same.
fn kept_up(camera: &Camera, up: DVec3) -> DVec3 {
    if direction(camera.up) == up { camera.up } else { up }
}

/// Moves camera and target along the picture, meters.
pub fn pan(camera: &Camera, right_meters: f64, up_meters: f64) -> Camera {
    let step = axes(camera) * DVec3::new(right_meters, up_meters, 0.0);
    moved(camera, Camera { position: camera.position + step, target: camera.target + step, ..*camera })
}

/// Brings the camera closer (a factor under 1) to its target or farther from it; a parallel window gets smaller or
/// larger. Factors that are not positive do nothing.
pub fn dolly(camera: &Camera, factor: f64) -> Camera {
    if factor.is_nan() || factor <= 0.0 {
        return *camera;
    }
    match camera.projection {
        Projection::Perspective { .. } => {
            let offset = camera.position - camera.target;
            moved(camera, Camera { position: camera.target + offset * factor, ..*camera })
        }
        Projection::Parallel { height } => {
            moved(camera, Camera { projection: parallel(height * factor), ..*camera })
        }
    }
}

/// Moves the camera as [`dolly`] does; `point` keeps its place in the picture.
pub fn zoom_towards(camera: &Camera, point: DVec3, factor: f64) -> Camera {
    if factor.is_nan() || factor <= 0.0 {
        return *camera;
    }
    match camera.projection {
        Projection::Perspective { .. } => {
            // Everything that moves is scaled about the point, so that its direction is the same.
            let position = point + (camera.position - point) * factor;
            let target = point + (camera.target - point) * factor;
            moved(camera, Camera { position, target, ..*camera })
        }
        Projection::Parallel { height } => {
            let to = dolly(camera, factor);
            let Projection::Parallel { height: reached } = to.projection else { return *camera };
            let forward = axes(camera).z_axis;
            let aside = (point - camera.target).reject_from_normalized(forward) * (1.0 - reached / height);
            moved(camera, Camera { position: to.position + aside, target: to.target + aside, ..to })
        }
    }
}

/// Moves the camera with its target by a step along its own right, upward and forward direction, meters, and turns it
/// in place: to the right by `yaw_radians`, and up by `pitch_radians`, never past the pole.
pub fn fly(camera: &Camera, step_right_up_forward: DVec3, yaw_radians: f64, pitch_radians: f64) -> Camera {
    let position = camera.position + axes(camera) * step_right_up_forward;
    let view = camera.target - camera.position;
    if yaw_radians == 0.0 && pitch_radians == 0.0 {
        return moved(camera, Camera { position, target: position + view, ..*camera });
    }
    let (up, behind) = turntable(camera, -view);
    let view = turned(view, -behind, up, -yaw_radians, pitch_radians);
    moved(camera, Camera { position, target: position + view, up: kept_up(camera, up), ..*camera })
}

/// Makes a ball fill the picture, whose width is `aspect` times its height; the direction of view stays.
pub fn frame(camera: &Camera, center: DVec3, radius: f64, aspect: f64) -> Camera {
    let framed = camera.framing(&BoundingSphere { center, radius }, aspect);
    let projection = match framed.projection {
        Projection::Parallel { height } => parallel(height),
        perspective @ Projection::Perspective { .. } => perspective,
    };
    moved(camera, Camera { projection, ..framed })
}

/// Looks at `center` from a side, at the same distance.
pub fn look_along(camera: &Camera, axis: ViewSide, center: DVec3) -> Camera {
    let (from, up) = axis.place_and_up();
    let distance = camera.position.distance(camera.target);
    moved(camera, Camera { position: center + from * distance, target: center, up, ..*camera })
}

/// Changes between perspective and parallel; what is at the target keeps its size in the picture. A perspective has the
/// default angle of view then, and the camera moves to suit it.
pub fn toggle_projection(camera: &Camera) -> Camera {
    let distance = camera.position.distance(camera.target);
    match camera.projection {
        Projection::Perspective { fov_degrees } => {
            let height = 2.0 * distance * (0.5 * fov_degrees).to_radians().tan();
            moved(camera, Camera { projection: parallel(height), ..*camera })
        }
        Projection::Parallel { height } => {
            let projection = Projection::default();
            let Projection::Perspective { fov_degrees } = projection else { return *camera };
            let distance = 0.5 * height / (0.5 * fov_degrees).to_radians().tan();
            let position = camera.target - axes(camera).z_axis * distance;
            let to = moved(camera, Camera { position, projection, ..*camera });
            // Where that is too near or too far, the size gives way.
            if to == *camera { moved(camera, Camera { projection, ..*camera }) } else { to }
        }
    }
}

/// A parallel projection with a window of this height, or the nearest that is allowed.
fn parallel(height: f64) -> Projection {
    let limits = keys::CAMERA.key("height").and_then(KeySpec::limits).unwrap_or(Limits::LENGTH);
    Projection::Parallel { height: height.clamp(limits.min, limits.max) }
}

#[cfg(test)]
mod tests;
