//! The half-space y ≤ 0 with the surface y = 0.
//!
//! ```toml
//! [[bodies]]
//! shape = "plane"
//! ```

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
