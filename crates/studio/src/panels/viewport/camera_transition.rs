//! The eye follows a jump of the camera in a short, smooth way. Only the display moves; the document has the new
//! camera at once.

use catoptric_scene::{Camera, Projection};
use glam::{DMat3, DQuat, DVec2, DVec3};

use crate::base::projector::Projector;

/// How long it takes, seconds.
const DURATION: f64 = 0.16;

/// A transition of the eye from one camera to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CameraTransition {
    from: Camera,
    to: Camera,
    /// The time of the first frame, seconds.
    start: Option<f64>,
}

impl CameraTransition {
    /// On the way from one camera to another; `None` where nothing lies between them.
    pub(crate) fn new(from: Camera, to: Camera) -> Option<Self> {
        let is_alike = matches!(
            (from.projection, to.projection),
            (Projection::Perspective { .. }, Projection::Perspective { .. })
                | (Projection::Parallel { .. }, Projection::Parallel { .. })
        );
        (is_alike && from != to).then_some(Self { from, to, start: None })
    }

    /// The camera now; `None` when it has arrived, or the view has gone elsewhere.
    pub(crate) fn now(&mut self, camera: &Camera, time: f64) -> Option<Camera> {
        if *camera != self.to {
            return None;
        }
        let share = (time - *self.start.get_or_insert(time)) / DURATION;
        (share < 1.0).then(|| between(&self.from, &self.to, 1.0 - (1.0 - share.max(0.0)).powi(3)))
    }
}

/// A camera between two: turned evenly, with its distances in equal proportions.
fn between(from: &Camera, to: &Camera, share: f64) -> Camera {
    let orientation = |camera: &Camera| {
        let [right, up, forward] = Projector::new(camera, DVec2::ONE).axes();
        DQuat::from_mat3(&DMat3::from_cols(right, up, -forward))
    };
    let turn = orientation(from).slerp(orientation(to), share);
    let distance = |camera: &Camera| camera.position.distance(camera.target).max(1e-9);
    let proportion = |from: f64, to: f64| from * (to / from).powf(share);
    let target = from.target.lerp(to.target, share);
    let projection = match (from.projection, to.projection) {
        (Projection::Perspective { fov_degrees: from }, Projection::Perspective { fov_degrees: to }) => {
            Projection::Perspective { fov_degrees: proportion(from, to) }
        }
        (Projection::Parallel { height: from }, Projection::Parallel { height: to }) => {
            Projection::Parallel { height: proportion(from, to) }
        }
        (_, other) => other,
    };
    let position = target + proportion(distance(from), distance(to)) * (turn * DVec3::Z);
    Camera { position, target, up: turn * DVec3::Y, projection }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_begins_at_one_camera_and_ends_at_the_other() {
        let from = Camera::default();
        let to = Camera { position: DVec3::new(9.0, 3.0, 1.0), target: DVec3::X, ..from };
        let mut transition = CameraTransition::new(from, to).unwrap();
        let first = transition.now(&to, 10.0).unwrap();
        assert!(first.position.distance(from.position) < 1e-9 && first.target == from.target);
        let middle = transition.now(&to, 10.05).unwrap();
        assert!(middle.is_valid() && middle.position.distance(from.position) > 1.0);
        assert_eq!(transition.now(&to, 10.2), None);
        let end = between(&from, &to, 1.0);
        assert!(end.position.distance(to.position) < 1e-9);
    }

    #[test]
    fn another_move_ends_it_and_there_is_no_way_between_projections() {
        let from = Camera::default();
        let to = Camera { position: DVec3::new(9.0, 3.0, 1.0), ..from };
        let mut transition = CameraTransition::new(from, to).unwrap();
        assert_eq!(transition.now(&Camera { up: DVec3::X, ..to }, 0.0), None);
        let parallel = Camera { projection: Projection::Parallel { height: 2.0 }, ..from };
        assert_eq!(CameraTransition::new(from, parallel), None);
        assert_eq!(CameraTransition::new(from, from), None);
    }
}
