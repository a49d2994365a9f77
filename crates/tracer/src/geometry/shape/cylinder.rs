//! The closed cylinder x² + z² ≤ 1, 0 ≤ y ≤ 1.
//!
//! ```toml
//! [[bodies]]
//! shape = "cylinder"
//! radius = 0.5
//! height = 1.0
//! ```

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
