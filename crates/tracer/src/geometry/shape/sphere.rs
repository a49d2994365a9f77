//! The unit ball x² + y² + z² ≤ 1.
//!
//! ```toml
//! [[bodies]]
//! shape = "sphere"
//! radius = 1.0
//! ```

use crate::geometry::shape::ShapeSpan;
use crate::simd::Float;
use crate::simd::vector::Vector;

/// The chord about the point of closest approach o' = o + t₀·d, t₀ = -(o·d)/(d·d).
#[inline(always)]
pub(crate) fn span<R: Float>(origin: Vector<R>, direction: Vector<R>) -> ShapeSpan<R> {
    let one = origin.x.like(1.0);
    let inverse_dd = one / direction.length_squared();
    let closest = -origin.dot(direction) * inverse_dd;
    let offset = origin.plus_times(direction, closest);
    ShapeSpan::chord(closest, one, offset.length_squared(), inverse_dd)
}

/// Where a line with a direction of length 1 crosses a sphere of any radius: nothing is divided. `origin` is relative to
/// the center.
#[inline(always)]
pub(crate) fn world_span<R: Float>(radius: f32, origin: Vector<R>, direction: Vector<R>) -> ShapeSpan<R> {
    let closest = -origin.dot(direction);
    let offset = origin.plus_times(direction, closest);
    let one = closest.like(1.0);
    ShapeSpan::chord(closest, closest.like(radius * radius), offset.length_squared(), one)
}

#[inline(always)]
pub(crate) fn pull_to_surface<R: Float>(point: Vector<R>) -> Vector<R> {
    point.normalize_or(Vector::splat(point.x, [0.0, 1.0, 0.0]))
}
