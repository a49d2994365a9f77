//! The half-space y ≤ 0 with the surface y = 0.
//!
//! ```toml
//! [[bodies]]
//! shape = "plane"
//! ```

use glam::{DAffine3, DMat3, DVec3};

use crate::geometry::shape::solid::{PicturePlace, RevolutionRing, Solid};
use crate::geometry::shape::{SIDE, ShapeSpan};
use crate::simd::Float;
use crate::simd::vector::Vector;

/// The span of a line that starts at y = `height` and rises by `rise` per unit of its parameter. A line parallel to
/// the surface never crosses it.
#[inline(always)]
pub(crate) fn span<R: Float>(height: R, rise: R) -> ShapeSpan<R> {
    let (zero, infinity) = (height.like(0.0), height.like(f32::INFINITY));
    let crossing = -height / rise;
    let (sinks, rises) = (rise.lt(zero), rise.gt(zero));
    let face = zero.like(SIDE);
    ShapeSpan {
        enter: R::select(sinks, crossing, -infinity),
        exit: R::select(sinks, infinity, crossing),
        enter_face: face,
        exit_face: face,
        hit: (sinks | rises) & crossing.eq(crossing),
    }
}

#[inline(always)]
pub(crate) fn pull_to_surface<R: Float>(point: Vector<R>) -> Vector<R> {
    Vector::new(point.x, point.y.like(0.0), point.z)
}

/// The half-space, which has no end.
pub(crate) struct HalfSpace;

impl Solid for HalfSpace {
    fn bounds(&self, _frame: &DAffine3, _ratio: f64) -> Option<[DVec3; 2]> {
        None
    }

    fn bounding_sphere(&self, _linear: &DMat3, _ratio: f64) -> (DVec3, f64) {
        (DVec3::ZERO, f64::INFINITY)
    }

    fn hull(&self, _frame: &DAffine3, _ratio: f64) -> Option<(Vec<DVec3>, f64)> {
        None
    }

    fn volume(&self, _ratio: f64) -> f64 {
        f64::INFINITY
    }

    fn middle(&self) -> Option<DVec3> {
        None
    }

    fn flatness(&self, _axes: DVec3) -> f64 {
        1.0
    }

    fn distance(&self, _ratio: f64, _axes: DVec3, at: DVec3) -> f64 {
        at.y.abs()
    }

    fn picture_place(&self, _ratio: f32, [x, _, z]: [f32; 3]) -> PicturePlace {
        PicturePlace { u: x, v: z.rem_euclid(1.0), repeats: [true, true] }
    }

    fn profile(&self, _ratio: f64, _fineness: u32) -> Option<Vec<Vec<RevolutionRing>>> {
        None
    }
}
