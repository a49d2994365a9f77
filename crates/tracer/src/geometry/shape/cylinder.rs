//! The closed cylinder x² + z² ≤ 1, 0 ≤ y ≤ 1.
//!
//! ```toml
//! [[bodies]]
//! shape = "cylinder"
//! radius = 0.5
//! height = 1.0
//! ```

use glam::{DAffine3, DMat3, DVec3};

use crate::geometry::shape::cone::Frustum;
use crate::geometry::shape::solid::{PicturePlace, RevolutionRing, Solid};
use crate::geometry::shape::{LOWER_CAP, SIDE, ShapeSpan, UPPER_CAP, slab};
use crate::simd::Float;
use crate::simd::vector::Vector;

/// The circle's chord in the xz-plane (as for the sphere), cut by the layer between the caps.
#[inline(always)]
pub(crate) fn span<R: Float>(origin: Vector<R>, direction: Vector<R>) -> ShapeSpan<R> {
    let caps = slab::closed(origin.y, direction.y, (0.0, LOWER_CAP), (1.0, UPPER_CAP));
    side([origin.x, origin.z], [direction.x, direction.z]).intersect(caps)
}

/// Where the line lies in the unbounded cylinder. A line along the axis lies in it everywhere or nowhere.
#[inline(always)]
fn side<R: Float>(origin: [R; 2], direction: [R; 2]) -> ShapeSpan<R> {
    let one = origin[0].like(1.0);
    let dd = dot(direction, direction);
    let is_along = dd.lt(one.like(f32::MIN_POSITIVE));
    let inverse_dd = one / R::select(is_along, one, dd);
    let closest = -dot(origin, direction) * inverse_dd;
    let offset = [direction[0].times_plus(closest, origin[0]), direction[1].times_plus(closest, origin[1])];
    let chord = ShapeSpan::chord(closest, one, dot(offset, offset), inverse_dd);
    ShapeSpan {
        enter: R::select(is_along, one.like(f32::NEG_INFINITY), chord.enter),
        exit: R::select(is_along, one.like(f32::INFINITY), chord.exit),
        enter_face: one.like(SIDE),
        exit_face: one.like(SIDE),
        hit: chord.hit,
    }
}

#[inline(always)]
fn dot<R: Float>(a: [R; 2], b: [R; 2]) -> R {
    a[1].times_plus(b[1], a[0] * b[0])
}

/// The closed cylinder: a frustum of the ratio 1, but that its curved surface does not depend on the height.
pub(crate) struct UnitCylinder;

impl Solid for UnitCylinder {
    fn bounds(&self, frame: &DAffine3, _ratio: f64) -> Option<[DVec3; 2]> {
        Frustum.bounds(frame, 1.0)
    }

    fn bounding_sphere(&self, linear: &DMat3, _ratio: f64) -> (DVec3, f64) {
        Frustum.bounding_sphere(linear, 1.0)
    }

    fn hull(&self, frame: &DAffine3, _ratio: f64) -> Option<(Vec<DVec3>, f64)> {
        Frustum.hull(frame, 1.0)
    }

    fn volume(&self, _ratio: f64) -> f64 {
        Frustum.volume(1.0)
    }

    fn middle(&self) -> Option<DVec3> {
        Frustum.middle()
    }

    fn flatness(&self, axes: DVec3) -> f64 {
        axes.x.max(axes.z) / axes.x.min(axes.z)
    }

    fn distance(&self, _ratio: f64, axes: DVec3, at: DVec3) -> f64 {
        Frustum.distance(1.0, axes, at)
    }

    fn picture_place(&self, _ratio: f32, point: [f32; 3]) -> PicturePlace {
        Frustum.picture_place(1.0, point)
    }

    fn profile(&self, _ratio: f64, fineness: u32) -> Option<Vec<Vec<RevolutionRing>>> {
        Frustum.profile(1.0, fineness)
    }
}
