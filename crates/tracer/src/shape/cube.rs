//! The cube [-1, 1]³.
//!
//! ```toml
//! [[bodies]]
//! shape = "cube"
//! size = 1.6                      # or [x, y, z]
//! ```

use super::{Span, slab};
use crate::lanes::Real;
use crate::vector::Vector;

/// The common part of the three layers. Face 2·axis is the one at -1, face 2·axis + 1 the one at +1.
#[inline(always)]
pub(super) fn span<R: Real>(origin: Vector<R>, direction: Vector<R>) -> Span<R> {
    let x = slab::half_open(origin.x, direction.x, (-1.0, 0.0), (1.0, 1.0));
    let y = slab::half_open(origin.y, direction.y, (-1.0, 2.0), (1.0, 3.0));
    let z = slab::half_open(origin.z, direction.z, (-1.0, 4.0), (1.0, 5.0));
    x.intersect(y).intersect(z)
}

#[inline(always)]
pub(super) fn pull_to_surface<R: Real>(face: R, point: Vector<R>) -> Vector<R> {
    let normal = normal(face);
    let one = face.like(1.0);
    let pull = |along: R, point: R| R::select(along.eq(face.like(0.0)), point.max(-one).min(one), along);
    Vector::new(pull(normal.x, point.x), pull(normal.y, point.y), pull(normal.z, point.z))
}

#[inline(always)]
pub(super) fn normal<R: Real>(face: R) -> Vector<R> {
    let axis = (face * 0.5).floor();
    let sign = (face - axis * 2.0) * 2.0 - 1.0;
    let along = |number: f32| R::select(axis.eq(face.like(number)), sign, face.like(0.0));
    Vector::new(along(0.0), along(1.0), along(2.0))
}
