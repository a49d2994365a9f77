//! Projection between the world and the panel, in double precision. Knows nothing of egui.

use catoptric_scene::{Camera, Projection};
use glam::{DVec2, DVec3};

/// A half-line: a pointer's ray, or an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct HalfLine {
    /// Where it starts.
    pub(crate) origin: DVec3,
    /// Where it goes; of length 1.
    pub(crate) direction: DVec3,
}

impl HalfLine {
    /// The point at a distance from the start.
    pub(crate) fn at(&self, distance: f64) -> DVec3 {
        self.origin + distance * self.direction
    }
}

/// Projects between the world and the picture of a camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Projector {
    position: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    window: ProjectorWindow,
    /// Width and height of the picture, points.
    size: DVec2,
}

/// The window of the projection.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ProjectorWindow {
    /// Seen from the eye through a window 1 high at this distance.
    Perspective { distance: f64 },
    /// Through a window this high.
    Parallel { height: f64 },
}

impl Projector {
    /// The projector of a camera; its axes are those of the tracer.
    pub(crate) fn new(camera: &Camera, size: DVec2) -> Self {
        let back = (camera.position - camera.target).normalize_or(DVec3::Z);
        let right = camera.up.cross(back).try_normalize().unwrap_or_else(|| back.any_orthonormal_vector());
        let window = match camera.projection {
            Projection::Perspective { fov_degrees } => {
                ProjectorWindow::Perspective { distance: 0.5 / (0.5 * fov_degrees.to_radians()).tan() }
            }
            Projection::Parallel { height } => ProjectorWindow::Parallel { height },
        };
        let size = size.max(DVec2::ONE);
        Self { position: camera.position, right, up: back.cross(right), forward: -back, window, size }
    }

    /// The view's directions: right, up, forward.
    pub(crate) fn axes(&self) -> [DVec3; 3] {
        [self.right, self.up, self.forward]
    }

    /// Where the eye is.
    pub(crate) fn position(&self) -> DVec3 {
        self.position
    }

    /// Whether all rays are parallel.
    pub(crate) fn is_parallel(&self) -> bool {
        matches!(self.window, ProjectorWindow::Parallel { .. })
    }

    /// Width and height of the picture, points.
    pub(crate) fn size(&self) -> DVec2 {
        self.size
    }

    /// Where a point lies in the picture, points from its upper left corner; `None` when it is not before the eye.
    pub(crate) fn project(&self, point: DVec3) -> Option<DVec2> {
        let offset = point - self.position;
        let depth = offset.dot(self.forward);
        let scale = match self.window {
            ProjectorWindow::Perspective { distance } => distance / depth,
            ProjectorWindow::Parallel { height } => 1.0 / height,
        };
        let at = scale * self.size.y * DVec2::new(offset.dot(self.right), -offset.dot(self.up));
        let at = at + 0.5 * self.size;
        // Far outside, lines to the point could not be drawn.
        (depth > 0.0 && at.is_finite() && at.abs().max_element() < 1e6).then_some(at)
    }

    /// A segment in the picture, without what is behind the eye or right before it.
    pub(crate) fn segment(&self, from: DVec3, to: DVec3) -> Option<[DVec2; 2]> {
        let [near, far] = [from, to].map(|point| self.depth(point));
        let least = 0.01 * near.max(far);
        let cut = |point: DVec3, depth: f64, other: DVec3, other_depth: f64| {
            if depth >= least { point } else { point.lerp(other, (least - depth) / (other_depth - depth)) }
        };
        if least <= 0.0 {
            return None;
        }
        let ends = [cut(from, near, to, far), cut(to, far, from, near)];
        Some([self.project(ends[0])?, self.project(ends[1])?])
    }

    /// The ray through a place in the picture.
    pub(crate) fn ray(&self, at: DVec2) -> HalfLine {
        let on_window = (at - 0.5 * self.size) / self.size.y;
        let offset = on_window.x * self.right - on_window.y * self.up;
        match self.window {
            ProjectorWindow::Perspective { distance } => HalfLine {
                origin: self.position,
                direction: (offset + distance * self.forward).normalize_or(self.forward),
            },
            ProjectorWindow::Parallel { height } => {
                HalfLine { origin: self.position + height * offset, direction: self.forward }
            }
        }
    }

    /// Distance of a point along the view.
    pub(crate) fn depth(&self, point: DVec3) -> f64 {
        (point - self.position).dot(self.forward)
    }

    /// How many meters one point of the picture spans at the depth of `point`; never 0.
    pub(crate) fn meters_per_point(&self, point: DVec3) -> f64 {
        let height = match self.window {
            ProjectorWindow::Perspective { distance } => self.depth(point).max(1e-9) / distance,
            ProjectorWindow::Parallel { height } => height,
        };
        (height / self.size.y).max(f64::MIN_POSITIVE)
    }

    /// The direction in which `point` is looked at; of length 1.
    pub(crate) fn towards(&self, point: DVec3) -> DVec3 {
        match self.window {
            ProjectorWindow::Perspective { .. } => (point - self.position).normalize_or(self.forward),
            ProjectorWindow::Parallel { .. } => self.forward,
        }
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::Scene;
    use catoptric_tracer::RenderScene;

    use super::*;

    fn cameras() -> [Camera; 3] {
        let tilted = Camera {
            position: DVec3::new(3.0, 4.0, -5.0),
            up: DVec3::new(0.2, 1.0, 0.1),
            ..Camera::default()
        };
        let parallel = Camera { projection: Projection::Parallel { height: 3.0 }, ..tilted };
        [Camera::default(), tilted, parallel]
    }

    #[test]
    fn it_sees_what_the_tracer_sees() {
        let size = DVec2::new(640.0, 360.0);
        let render_scene = RenderScene::build(&Scene::default()).unwrap();
        for camera in cameras() {
            let (projector, tracer) = (Projector::new(&camera, size), render_scene.camera_for(&camera));
            for point in [DVec3::ZERO, DVec3::new(0.4, 1.5, -0.8), camera.target] {
                let (expected, _) = tracer.project(point, size).unwrap();
                assert!((projector.project(point).unwrap() - expected).length() < 1e-9);
            }
            let at = DVec2::new(17.0, 300.0);
            let expected = tracer.ray(at, size);
            let ray = projector.ray(at);
            assert!(ray.direction.distance(expected.direction.as_dvec3()) < 1e-6);
        }
    }

    #[test]
    fn a_ray_leads_back_to_its_place() {
        for camera in cameras() {
            let projector = Projector::new(&camera, DVec2::new(800.0, 600.0));
            let at = DVec2::new(123.0, 456.0);
            assert!((projector.project(projector.ray(at).at(7.0)).unwrap() - at).length() < 1e-9);
        }
    }

    #[test]
    fn a_meter_has_its_size_in_the_picture() {
        for camera in cameras() {
            let projector = Projector::new(&camera, DVec2::new(800.0, 600.0));
            let [right, ..] = projector.axes();
            let step = 10.0 * projector.meters_per_point(camera.target);
            let ends =
                [camera.target, camera.target + step * right].map(|point| projector.project(point).unwrap());
            assert!((ends[1] - ends[0] - DVec2::new(10.0, 0.0)).length() < 1e-9);
        }
    }

    #[test]
    fn a_segment_ends_before_the_eye() {
        let projector = Projector::new(&Camera::default(), DVec2::new(800.0, 600.0));
        let target = Camera::default().target;
        let [from, to] = projector.segment(target, target + DVec3::new(1.0, 0.0, 20.0)).unwrap();
        assert_eq!(from, DVec2::new(400.0, 300.0));
        assert!(to.x > 1000.0);
        assert_eq!(projector.segment(DVec3::Z * 20.0, DVec3::Z * 30.0), None);
    }

    #[test]
    fn what_is_behind_has_no_place() {
        let projector = Projector::new(&Camera::default(), DVec2::new(800.0, 600.0));
        assert_eq!(projector.project(DVec3::new(0.0, 2.2, 9.0)), None);
        assert_eq!(projector.project(DVec3::new(0.0, 2.2, 8.0)), None);
    }
}
