//! The cube [-1, 1]³.
//!
//! ```toml
//! [[bodies]]
//! shape = "cube"
//! size = 1.6                      # or [x, y, z]
//! ```

use glam::Vec3A;

use super::{Face, Span};

/// A component of the direction below this counts as this: the line lies between a pair of faces everywhere or
/// nowhere, and 0/0 does not arise.
const TINY: f32 = 1e-30;

/// The latest of the three entries and the earliest of the three exits between pairs of faces (Kay, Kajiya 1986, Ray
/// tracing complex scenes). Face 2·axis is the one at -1, face 2·axis + 1 the one at +1.
#[inline(always)]
pub(super) fn span(origin: Vec3A, direction: Vec3A) -> Span {
    let tiny = Vec3A::splat(TINY).copysign(direction);
    let inverse = Vec3A::select(direction.abs().cmplt(Vec3A::splat(TINY)), tiny, direction).recip();
    let low = (Vec3A::NEG_ONE - origin) * inverse;
    let high = (Vec3A::ONE - origin) * inverse;
    let (near, far) = (low.min(high), low.max(high));
    let (enter, exit) = (near.max_element(), far.min_element());
    let face = |is_it: glam::BVec3A, from_low: bool| {
        let bits = is_it.bitmask();
        let axis = if bits & 1 != 0 {
            0
        } else if bits & 2 != 0 {
            1
        } else {
            2
        };
        2 * axis as Face + Face::from((inverse[axis] < 0.0) == from_low)
    };
    Span {
        enter,
        exit,
        enter_face: face(near.cmpeq(Vec3A::splat(enter)), true),
        exit_face: face(far.cmpeq(Vec3A::splat(exit)), false),
        // Each entry by itself: the largest of them may hide that another is not a number.
        hit: near.cmple(Vec3A::splat(exit)).all(),
    }
}

pub(super) fn pull_to_surface(face: Face, point: Vec3A) -> Vec3A {
    let normal = normal(face);
    let clamped = point.clamp(Vec3A::NEG_ONE, Vec3A::ONE);
    Vec3A::select(normal.cmpne(Vec3A::ZERO), normal, clamped)
}

pub(super) fn normal(face: Face) -> Vec3A {
    let axis = match face / 2 {
        0 => Vec3A::X,
        1 => Vec3A::Y,
        _ => Vec3A::Z,
    };
    if face.is_multiple_of(2) { -axis } else { axis }
}
