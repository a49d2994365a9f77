//! The cube [-1, 1]³.
//!
//! ```toml
//! [[bodies]]
//! shape = "cube"
//! size = 1.6                      # or [x, y, z]
//! ```

use crate::geometry::shape::{ShapeSpan, slab};
use crate::simd::Float;
use crate::simd::vector::Vector;

/// The common part of the three layers. Face 2·axis is the one at -1, face 2·axis + 1 the one at +1.
#[inline(always)]
pub(crate) fn span<R: Float>(origin: Vector<R>, direction: Vector<R>) -> ShapeSpan<R> {
    let x = slab::half_open(origin.x, direction.x, (-1.0, 0.0), (1.0, 1.0));
    let y = slab::half_open(origin.y, direction.y, (-1.0, 2.0), (1.0, 3.0));
    let z = slab::half_open(origin.z, direction.z, (-1.0, 4.0), (1.0, 5.0));
    x.intersect(y).intersect(z)
}

#[inline(always)]
pub(crate) fn pull_to_surface<R: Float>(face: R, point: Vector<R>) -> Vector<R> {
    let normal = normal(face);
    Vector::new(pulled(normal.x, point.x), pulled(normal.y, point.y), pulled(normal.z, point.z))
}

/// A coordinate on the face whose normal has this one.
#[inline(always)]
fn pulled<R: Float>(normal: R, point: R) -> R {
    let one = point.like(1.0);
    R::select(normal.eq(point.like(0.0)), point.max(-one).min(one), normal)
}

#[inline(always)]
pub(crate) fn normal<R: Float>(face: R) -> Vector<R> {
    let axis = (face * 0.5).floor();
    let sign = (face - axis * 2.0) * 2.0 - 1.0;
    Vector::new(along(axis, 0.0, sign), along(axis, 1.0, sign), along(axis, 2.0, sign))
}

/// `sign` where the face looks along axis `number`, else 0.
#[inline(always)]
fn along<R: Float>(axis: R, number: f32, sign: R) -> R {
    R::select(axis.eq(axis.like(number)), sign, axis.like(0.0))
}
