//! The layer between two parallel planes.

use crate::geometry::shape::{FaceId, ShapeSpan};
use crate::simd::{Float, Mask as _};

/// A direction's component below this counts as this: the line lies in the layer everywhere or nowhere, and 0/0 does
/// not arise.
pub(crate) const TINY: f32 = 1e-30;

/// Where the line `origin + t·direction` (one coordinate) lies between `low` and `high` (Kay, Kajiya 1986, Ray tracing
/// complex scenes).
///
/// A line along the layer lies in it everywhere or nowhere. Of the two planes themselves one belongs to the layer, so
/// that a stack of layers has no gap.
#[inline(always)]
pub(crate) fn half_open<R: Float>(
    origin: R,
    direction: R,
    low: (f32, FaceId),
    high: (f32, FaceId),
) -> ShapeSpan<R> {
    let tiny = direction.like(TINY);
    let is_along = direction.abs().lt(tiny);
    let inverse = origin.like(1.0) / R::select(is_along, tiny.copysign(direction), direction);
    let at_low = (origin.like(low.0) - origin) * inverse;
    let at_high = (origin.like(high.0) - origin) * inverse;
    let rises = inverse.gt(inverse.like(0.0));
    let (low_face, high_face) = (origin.like(low.1), origin.like(high.1));
    let enter = R::select(rises, at_low, at_high);
    let exit = R::select(rises, at_high, at_low);
    ShapeSpan {
        enter,
        exit,
        enter_face: R::select(rises, low_face, high_face),
        exit_face: R::select(rises, high_face, low_face),
        hit: enter.le(exit),
    }
}

/// Where a line crosses a slab between two planes, both of which belong to it.
#[inline(always)]
pub(crate) fn closed<R: Float>(
    origin: R,
    direction: R,
    low: (f32, FaceId),
    high: (f32, FaceId),
) -> ShapeSpan<R> {
    let mut span = half_open(origin, direction, low, high);
    let is_along = direction.abs().lt(direction.like(TINY));
    if is_along.any() {
        let within = is_along & origin.ge(origin.like(low.0)) & origin.le(origin.like(high.0));
        span.enter = R::select(within, origin.like(f32::NEG_INFINITY), span.enter);
        span.exit = R::select(within, origin.like(f32::INFINITY), span.exit);
        span.hit = span.hit & (within | !is_along);
    }
    span
}
