//! From a place in the picture to its primary ray.

use std::sync::Arc;

use catoptric_scene::{Camera, Projection};
use glam::{DVec2, DVec3, Vec3};

use crate::geometry::bounds::Bounds;
use crate::geometry::ray::{POINT_ROUNDING, Ray};
use crate::geometry::visible_bodies::RayCone;
use crate::simd::Float32;
use crate::simd::vector::Vector;

/// The camera's frame, in double precision: near the horizon of a plane the smallest error of a primary ray's
/// direction moves the hit point far, and one frame is small.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderCamera {
    /// The origin of the space of the rays in the world, and the eye in that space, meters.
    origin: DVec3,
    position: DVec3,
    /// Unit vectors to the right, up, and against the view.
    u: DVec3,
    v: DVec3,
    w: DVec3,
    window: ImagePlane,
    surroundings: SceneExtent,
}

/// Where a ray can meet something at all: a sphere around the bounded bodies, and the planes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SceneExtent {
    center: DVec3,
    /// Of the sphere: negative and infinite without bounded bodies, infinite where they may be anywhere.
    radius: f64,
    planes: Arc<[ExtentPlane]>,
}

/// The surface of a plane in the space of the rays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ExtentPlane {
    pub(crate) point: DVec3,
    /// Of length 1, out of the half-space.
    pub(crate) normal: DVec3,
    /// Whether light is absorbed within: there, every ray has to start where it does.
    pub(crate) absorbs: bool,
}

impl ExtentPlane {
    /// How far a point lies above the surface.
    fn height_of(&self, point: DVec3) -> f64 {
        (point - self.point).dot(self.normal)
    }
}

impl SceneExtent {
    /// Around bodies with these bounds, `None` if they are unknown, and planes.
    pub(crate) fn new(bounds: Option<Bounds>, planes: impl Iterator<Item = ExtentPlane>) -> Self {
        let (center, radius) = match bounds {
            None => (DVec3::ZERO, f64::INFINITY),
            Some(bounds) if bounds == Bounds::EMPTY => (DVec3::ZERO, f64::NEG_INFINITY),
            Some(bounds) => {
                (0.5 * bounds.doubled_center().as_dvec3(), 0.5 * f64::from(bounds.min.distance(bounds.max)))
            }
        };
        Self { center, radius, planes: planes.collect() }
    }

    /// How far a ray from `origin` along the unit vector `direction` can surely go without meeting anything, seen through a
    /// window; 0 or more.
    fn free_way(&self, origin: DVec3, direction: DVec3, window: ImagePlane) -> f64 {
        /// So many times the height of the picture are no trouble: 1 % of the way is more where a view is wide.
        const NEAR_HEIGHTS: f64 = 10.0;
        let way = (self.center - origin).dot(direction) - (1.0 + MARGIN) * self.radius;
        if way <= 0.0 || self.planes.iter().any(|plane| plane.absorbs && plane.height_of(origin) < 0.0) {
            return 0.0;
        }
        let crossings = self.planes.iter().map(|plane| {
            let (height, rise) = ((plane.point - origin).dot(plane.normal), direction.dot(plane.normal));
            let crossing = height / rise;
            // From far away 1 % of the way is too far for single precision. There the ray starts before the plane by what is
            // near in the picture, and by the rounding of the plane's slope out there.
            let reach = (origin + crossing * direction).abs().max_element();
            let rounding = 2.0 * f64::from(POINT_ROUNDING) * reach / rise.abs();
            let near = crossing - NEAR_HEIGHTS * window.height_at(crossing) - rounding;
            ((1.0 - MARGIN) * height / rise).max(near)
        });
        let way = crossings.filter(|&crossing| crossing >= 0.0).fold(way, f64::min);
        if way.is_finite() { way } else { 0.0 }
    }
}

/// Keeps well away from what rounding of the sphere or a plane could put in the way, as a share of its size or of the way.
const MARGIN: f64 = 0.01;

impl SceneExtent {
    /// How far rays from `origin` can go between directions of length 1, the corners of a convex part of all, one after the
    /// other, without meeting a plane that is nearer there than at the corners by more than is kept away from it.
    fn way_between(&self, origin: DVec3, corners: [DVec3; 4]) -> f64 {
        let ways = self.planes.iter().filter_map(|plane| {
            let height = plane.height_of(origin);
            let toward = plane.normal * -height.signum();
            let steepest = corners.into_iter().map(|corner| corner.dot(toward)).fold(0.0, f64::max);
            let between = steepest_between(corners, toward);
            ((1.0 - MARGIN) * between > steepest).then(|| (1.0 - MARGIN) * height.abs() / between)
        });
        ways.fold(f64::INFINITY, f64::min)
    }

    /// Whether a plane lies between some of the points.
    fn divide(&self, points: [DVec3; 4]) -> bool {
        self.planes.iter().any(|plane| {
            let sides = points.map(|point| plane.height_of(point) > 0.0);
            sides.iter().any(|side| *side != sides[0])
        })
    }
}

/// The largest product of a vector of length 1 with directions on the sides between corners or within; 0 if it is largest at a
/// corner.
fn steepest_between(corners: [DVec3; 4], toward: DVec3) -> f64 {
    let [a, b, c, d] = corners;
    let mut is_within = true;
    let mut most = 0.0;
    for (from, to) in [(a, b), (b, c), (c, d), (d, a)] {
        // A side is a part of a great circle, on which the nearest direction is where the vector falls on its plane.
        let across = from.cross(to);
        let out = across.dot(toward);
        is_within &= out * across.dot(a + b + c + d) > 0.0;
        let nearest = toward - across * (out / across.length_squared());
        if from.cross(nearest).dot(across) > 0.0 && nearest.cross(to).dot(across) > 0.0 {
            most = nearest.length().max(most);
        }
    }
    if is_within { 1.0 } else { most }
}

/// Where primary rays start and point.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ImagePlane {
    /// From the eye through a window 1 high at this distance.
    Perspective { distance: f64 },
    /// From a window this high, along the view.
    Parallel { height: f64 },
}

impl ImagePlane {
    /// The height of the picture at a distance, meters.
    fn height_at(self, way: f64) -> f64 {
        match self {
            Self::Perspective { distance } => way / distance,
            Self::Parallel { height } => height,
        }
    }
}

impl RenderCamera {
    /// A camera of the world in the space of rays with this origin, where the surroundings are known.
    pub(crate) fn new(camera: &Camera, surroundings: SceneExtent, origin: DVec3) -> Self {
        let w = (camera.position - camera.target).normalize_or(DVec3::Z);
        let u = camera.up.cross(w).try_normalize().unwrap_or_else(|| w.any_orthonormal_vector());
        let window = match camera.projection {
            Projection::Perspective { fov_degrees } => {
                ImagePlane::Perspective { distance: 0.5 / (0.5 * fov_degrees.to_radians()).tan() }
            }
            Projection::Parallel { height } => ImagePlane::Parallel { height },
        };
        Self { origin, position: camera.position - origin, u, v: w.cross(u), w, window, surroundings }
    }

    /// The ray through the point (x, y) of a picture of `size` pixels, in the space of the rays, x to the right and y down from the upper left
    /// corner: the center of the first pixel is (0.5, 0.5).
    ///
    /// When the eye is away from the bodies, the ray starts closer to them, where nothing has been passed yet: in
    /// single precision a long way would blur what it meets.
    pub fn ray(&self, at: DVec2, size: DVec2) -> Ray {
        let (origin, direction) = self.line(at, size);
        let start = origin + self.surroundings.free_way(origin, direction, self.window) * direction;
        Ray::from_point(start.as_vec3a(), direction.as_vec3a())
    }

    /// Where the ray through a point of the picture starts, and its unit direction.
    fn line(&self, at: DVec2, size: DVec2) -> (DVec3, DVec3) {
        let on_window = (at - 0.5 * size) / size.y;
        let offset = on_window.x * self.u - on_window.y * self.v;
        match self.window {
            ImagePlane::Perspective { distance } => (self.position, (offset - distance * self.w).normalize()),
            ImagePlane::Parallel { height } => (self.position + height * offset, -self.w),
        }
    }

    /// Prepares the rays near the point `at` of a picture of `size` pixels: within `reach` pixels of it.
    pub(crate) fn near(&self, at: DVec2, reach: DVec2, size: DVec2) -> CameraRays {
        let (origin, direction) = self.line(at, size);
        let way = self.free_way(at, reach, size);
        let (across, down) = (self.u / size.y, -self.v / size.y);
        let steps = match self.window {
            ImagePlane::Perspective { distance } => {
                let on_window = (at - 0.5 * size) / size.y;
                let through = on_window.x * self.u - on_window.y * self.v - distance * self.w;
                RayDifferentials::OfDirection(
                    [across, down].map(|step| (step * through.length_recip()).as_vec3().to_array()),
                )
            }
            ImagePlane::Parallel { height } => {
                RayDifferentials::OfOrigin([across, down].map(|step| (height * step).as_vec3().to_array()))
            }
        };
        CameraRays {
            start: TwoFloatVector::new(origin + way * direction),
            direction: TwoFloatVector::new(direction),
            way: way as f32,
            steps,
        }
    }

    /// How far all rays within `reach` pixels of `at` can surely go without meeting anything.
    fn free_way(&self, at: DVec2, reach: DVec2, size: DVec2) -> f64 {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(DVec2::from);
        let lines = corners.map(|corner| self.line(at + corner * reach, size));
        if self.surroundings.divide(lines.map(|line| line.0)) {
            return 0.0;
        }
        let ways =
            lines.map(|(origin, direction)| self.surroundings.free_way(origin, direction, self.window));
        let way = ways.into_iter().fold(f64::INFINITY, f64::min);
        match self.window {
            ImagePlane::Perspective { .. } => {
                way.min(self.surroundings.way_between(self.position, lines.map(|line| line.1)))
            }
            ImagePlane::Parallel { .. } => way,
        }
    }

    /// Where a point of the world lies in a picture of `size` pixels, and its depth, the distance along the view: the
    /// inverse of [`Self::ray`]. `None` for a point that is not before the eye.
    pub fn project(&self, point: DVec3, size: DVec2) -> Option<(DVec2, f64)> {
        let offset = point - self.origin - self.position;
        let depth = -offset.dot(self.w);
        let scale = match self.window {
            ImagePlane::Perspective { distance } => distance / depth,
            ImagePlane::Parallel { height } => 1.0 / height,
        };
        let on_window = scale * DVec2::new(offset.dot(self.u), -offset.dot(self.v));
        let at = on_window * size.y + 0.5 * size;
        (depth > 0.0 && at.is_finite()).then_some((at, depth))
    }

    /// What lengths across the view are multiplied with to get parts of the picture's height: for a perspective at a
    /// depth of 1.
    pub(crate) fn magnification(&self) -> f64 {
        match self.window {
            ImagePlane::Perspective { distance } => distance,
            ImagePlane::Parallel { height } => height.recip(),
        }
    }

    /// How far a point lies in front of the eye, along the middle of the view, meters.
    pub(crate) fn depth(&self, point: DVec3) -> f64 {
        -(point - self.position).dot(self.w)
    }

    /// The unit direction from a point towards the viewer.
    pub(crate) fn toward_viewer(&self, point: DVec3) -> DVec3 {
        match self.window {
            ImagePlane::Perspective { .. } => (self.position - point).normalize_or(self.w),
            ImagePlane::Parallel { .. } => self.w,
        }
    }

    /// The eye, or the middle of the window of a parallel projection, meters.
    pub(crate) fn position(&self) -> DVec3 {
        self.position
    }

    /// The height of the window of a parallel projection, meters.
    pub(crate) fn parallel_height(&self) -> Option<f64> {
        match self.window {
            ImagePlane::Perspective { .. } => None,
            ImagePlane::Parallel { height } => Some(height),
        }
    }

    /// The unit vectors of the view: to the right, up, and forward.
    pub fn axes(&self) -> [DVec3; 3] {
        [self.u, self.v, -self.w]
    }

    /// A view of the same surroundings through another camera.
    pub(crate) fn replaced_by(&self, camera: &Camera) -> Self {
        Self::new(camera, self.surroundings.clone(), self.origin)
    }

    /// A point of the space of the rays in the world, meters.
    pub fn world_from_render(&self, point: impl Into<Vec3>) -> DVec3 {
        self.origin + point.into().as_dvec3()
    }

    /// The eye in the space of the rays, if all rays start there.
    pub fn eye(&self) -> Option<Vector<f32>> {
        matches!(self.window, ImagePlane::Perspective { .. }).then(|| self.position.as_vec3().into())
    }
}

/// Depth as a number that changes evenly along straight lines on the screen, and grows with the depth: for a perspective
/// -1/depth, for a parallel projection the depth itself.
///
/// Of a perspective, x and y of the screen are linear in 1/w and t/w along a ray (Blinn 1992, Hyperbolic Interpolation).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ScreenDepth {
    pub(crate) eye: [f32; 3],
    /// Unit vector along the view.
    pub(crate) forward: [f32; 3],
    pub(crate) is_parallel: bool,
}

impl ScreenDepth {
    /// The number of the background, behind all others.
    pub(crate) const NOTHING: f32 = f32::INFINITY;

    pub(crate) fn new(camera: &RenderCamera) -> Self {
        Self {
            eye: camera.position.as_vec3().to_array(),
            forward: (-camera.w).as_vec3().to_array(),
            is_parallel: camera.parallel_height().is_some(),
        }
    }

    /// The numbers of points that are before the eye.
    #[inline(always)]
    pub(crate) fn of_point<R: Float32>(&self, position: Vector<R>) -> R {
        let like = position.x;
        let depth = (position - Vector::splat(like, self.eye)).dot(Vector::splat(like, self.forward));
        // Rounding may put a point behind the eye.
        if self.is_parallel { depth } else { like.like(-1.0) / depth.max(like.like(f32::MIN_POSITIVE)) }
    }

    /// The depth, meters.
    #[inline(always)]
    pub(crate) fn meters<R: Float32>(&self, number: R) -> R {
        if self.is_parallel { number } else { number.like(-1.0) / number }
    }

    /// The difference of two depths, meters, from both numbers and their difference.
    #[inline(always)]
    pub(crate) fn difference<R: Float32>(&self, numbers: [R; 2], difference: R) -> R {
        if self.is_parallel {
            return difference;
        }
        let [a, b] = numbers;
        difference / (a * b).max(a.like(f32::MIN_POSITIVE))
    }
}

/// The rays through a small part of the picture: one, computed in double precision, and the small difference of the
/// others from it in single. So all are as exact as that one, but for the last digit.
pub(crate) struct CameraRays {
    pub(crate) start: TwoFloatVector,
    pub(crate) direction: TwoFloatVector,
    /// How far the starts lie along the rays from the eye.
    pub(crate) way: f32,
    pub(crate) steps: RayDifferentials,
}

/// What changes from pixel to pixel, across and down.
pub(crate) enum RayDifferentials {
    /// The direction, in units of the length of the middle ray up to the window.
    OfDirection([[f32; 3]; 2]),
    OfOrigin([[f32; 3]; 2]),
}

/// A vector in twice the precision of single.
pub(crate) struct TwoFloatVector {
    pub(crate) near: [f32; 3],
    pub(crate) rest: [f32; 3],
}

impl TwoFloatVector {
    fn new(vector: DVec3) -> Self {
        let near = vector.as_vec3();
        Self { near: near.to_array(), rest: (vector - near.as_dvec3()).as_vec3().to_array() }
    }

    /// The sum with small vectors.
    #[inline(always)]
    fn plus<R: Float32>(&self, small: Vector<R>) -> Vector<R> {
        small.plus_all(self.rest).plus_all(self.near)
    }

    /// The sum with small vectors times `t`.
    #[inline(always)]
    fn plus_times<R: Float32>(&self, small: Vector<R>, t: R) -> Vector<R> {
        Vector::splat(t, self.rest).plus_times(small, t).plus_all(self.near)
    }
}

impl CameraRays {
    /// How far the starts lie along the rays from the eye, meters.
    pub(crate) fn way(&self) -> f32 {
        self.way
    }

    /// A cone around the middle ray that has in it all rays within `reach` pixels of it.
    pub(crate) fn cone(&self, [x, y]: [f32; 2]) -> RayCone {
        // Of a narrow cone, a cosine in single precision keeps no digit: what is known is the chord, 2·sin(angle/2).
        let corners = [(x, y), (-x, y), (x, -y), (-x, -y)];
        let chords = corners.map(|(x, y)| self.small(x, y).length_squared());
        let square = chords.into_iter().fold(0.0, f32::max);
        let axis = Vector::splat(0.0, self.direction.near);
        RayCone { axis, cos: 1.0 - 0.5 * square, sin: (square * (1.0 - 0.25 * square).max(0.0)).sqrt() }
    }

    /// The origins and directions of the rays through the points so many pixels right of and below the middle.
    #[inline(always)]
    pub(crate) fn rays<R: Float32>(&self, x: R, y: R) -> (Vector<R>, Vector<R>) {
        match &self.steps {
            RayDifferentials::OfDirection(_) => {
                let small = self.small(x, y);
                (self.start.plus_times(small, x.like(self.way)), self.direction.plus(small))
            }
            RayDifferentials::OfOrigin([across, down]) => {
                (self.start.plus(spread(x, y, *across, *down)), self.direction.plus(self.small(x, y)))
            }
        }
    }

    /// How much the direction of a ray differs from that of the middle one.
    #[inline(always)]
    fn small<R: Float32>(&self, x: R, y: R) -> Vector<R> {
        match &self.steps {
            RayDifferentials::OfDirection([across, down]) => {
                // D = direction + δ, and 1/|D| = 1 + c.
                let middle = Vector::splat(x, self.direction.near);
                let delta = spread(x, y, *across, *down);
                let more = delta.dot(middle + middle + delta);
                let root = (more + 1.0).sqrt();
                let c = -more / (root * (root + 1.0));
                (delta * (c + 1.0)).plus_times(middle, c)
            }
            RayDifferentials::OfOrigin(_) => Vector::splat(x, [0.0; 3]),
        }
    }
}

#[inline(always)]
fn spread<R: Float32>(x: R, y: R, across: [f32; 3], down: [f32; 3]) -> Vector<R> {
    Vector::new(x, x, x).times_all(across).plus_times(Vector::splat(x, down), y)
}
