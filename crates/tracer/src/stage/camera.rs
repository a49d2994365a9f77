//! From a place in the picture to its primary ray.

use std::sync::Arc;

use catoptric_scene::{Body, Camera, Projection};
use glam::{DVec2, DVec3, Vec3A};

use super::Bounds;
use crate::ray::Ray;

/// The camera's frame, in double precision: near the horizon of a plane the smallest error of a primary ray's
/// direction moves the hit point far, and one frame is small.
#[derive(Clone, Debug, PartialEq)]
pub struct StageCamera {
    position: DVec3,
    /// Unit vectors to the right, up, and against the view.
    u: DVec3,
    v: DVec3,
    w: DVec3,
    window: Window,
    surroundings: Surroundings,
}

/// Where a ray can meet something at all: a sphere around the bounded bodies, and the planes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Surroundings {
    center: DVec3,
    radius: f64,
    /// A point and a normal of each plane.
    planes: Arc<[(DVec3, DVec3)]>,
}

impl Surroundings {
    /// Around bodies with these bounds, and planes.
    pub(super) fn new<'a>(bounds: Bounds, planes: impl Iterator<Item = &'a Body>) -> Self {
        let (center, radius) = if bounds == Bounds::EMPTY {
            (DVec3::ZERO, f64::INFINITY)
        } else {
            (0.5 * bounds.doubled_center().as_dvec3(), 0.5 * f64::from(bounds.min.distance(bounds.max)))
        };
        let plane = |body: &Body| {
            let frame = body.placement.world_from_body();
            let normal = frame.matrix3.inverse().transpose() * DVec3::Y;
            (frame.translation, normal.normalize_or(DVec3::Y))
        };
        Self { center, radius, planes: planes.map(plane).collect() }
    }

    /// How far a ray from `origin` along the unit vector `direction` can surely go without meeting anything; 0 or
    /// more.
    fn free_way(&self, origin: DVec3, direction: DVec3) -> f64 {
        /// Keeps well away from what rounding of the sphere or a plane could put in the way.
        const MARGIN: f64 = 0.01;
        let way = (self.center - origin).dot(direction) - (1.0 + MARGIN) * self.radius;
        if way <= 0.0 {
            return 0.0;
        }
        let crossings = self
            .planes
            .iter()
            .map(|(point, normal)| (1.0 - MARGIN) * (*point - origin).dot(*normal) / direction.dot(*normal));
        crossings.filter(|&crossing| crossing >= 0.0).fold(way, f64::min)
    }
}

/// Where primary rays start and point.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Window {
    /// From the eye through a window 1 high at this distance.
    Perspective { distance: f64 },
    /// From a window this high, along the view.
    Parallel { height: f64 },
}

impl StageCamera {
    pub(super) fn new(camera: &Camera, surroundings: Surroundings) -> Self {
        let w = (camera.position - camera.target).normalize_or(DVec3::Z);
        let u = camera.up.cross(w).try_normalize().unwrap_or_else(|| w.any_orthonormal_vector());
        let window = match camera.projection {
            Projection::Perspective { fov_degrees } => {
                Window::Perspective { distance: 0.5 / (0.5 * fov_degrees.to_radians()).tan() }
            }
            Projection::Parallel { height } => Window::Parallel { height },
        };
        Self { position: camera.position, u, v: w.cross(u), w, window, surroundings }
    }

    /// The ray through the point (x, y) of a picture of `size` pixels, x to the right and y down from the upper left
    /// corner: the center of the first pixel is (0.5, 0.5).
    ///
    /// When the eye is away from the bodies, the ray starts closer to them, where nothing has been passed yet: in
    /// single precision a long way would blur what it meets.
    pub fn ray(&self, at: DVec2, size: DVec2) -> Ray {
        let on_window = (at - 0.5 * size) / size.y;
        let offset = on_window.x * self.u - on_window.y * self.v;
        let (origin, direction) = match self.window {
            Window::Perspective { distance } => (self.position, offset - distance * self.w),
            Window::Parallel { height } => (self.position + height * offset, -self.w),
        };
        let direction = direction.normalize();
        let start = origin + self.surroundings.free_way(origin, direction) * direction;
        Ray::from_point(start.as_vec3a(), direction.as_vec3a())
    }

    /// Where a point of the world lies in a picture of `size` pixels, and its depth, the distance along the view: the
    /// inverse of [`Self::ray`]. `None` for a point that is not before the eye.
    pub fn project(&self, point: DVec3, size: DVec2) -> Option<(DVec2, f64)> {
        let offset = point - self.position;
        let depth = -offset.dot(self.w);
        let scale = match self.window {
            Window::Perspective { distance } => distance / depth,
            Window::Parallel { height } => 1.0 / height,
        };
        let on_window = scale * DVec2::new(offset.dot(self.u), -offset.dot(self.v));
        let at = on_window * size.y + 0.5 * size;
        (depth > 0.0 && at.is_finite()).then_some((at, depth))
    }

    /// The unit vectors of the view: to the right, up, and forward.
    pub fn axes(&self) -> [DVec3; 3] {
        [self.u, self.v, -self.w]
    }

    /// The same surroundings seen by another camera.
    pub(super) fn replaced_by(&self, camera: &Camera) -> Self {
        Self::new(camera, self.surroundings.clone())
    }

    /// The eye, if all rays start there.
    pub fn eye(&self) -> Option<Vec3A> {
        matches!(self.window, Window::Perspective { .. }).then(|| self.position.as_vec3a())
    }
}
