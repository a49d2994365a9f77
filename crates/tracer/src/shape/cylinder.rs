//! The closed cylinder x² + z² ≤ 1, 0 ≤ y ≤ 1.
//!
//! ```toml
//! [[bodies]]
//! shape = "cylinder"
//! radius = 0.5
//! height = 1.0
//! ```

use glam::{Vec2, Vec3A, Vec3Swizzles};

use super::{LOWER_CAP, SIDE, Span, UPPER_CAP, slab};

/// The circle's chord in the xz-plane (as for the sphere), cut by the layer between the caps.
#[inline]
pub(super) fn span(origin: Vec3A, direction: Vec3A) -> Span {
    side(origin.xz(), direction.xz()).intersect(slab::span(
        origin.y,
        direction.y,
        (0.0, LOWER_CAP),
        (1.0, UPPER_CAP),
    ))
}

/// Where the line lies in the unbounded cylinder. A line along the axis lies in it everywhere or nowhere.
#[inline]
fn side(origin: Vec2, direction: Vec2) -> Span {
    let dd = direction.length_squared();
    if dd < f32::MIN_POSITIVE {
        let hit = origin.length_squared() <= 1.0;
        return Span::everywhere(SIDE, SIDE, hit);
    }
    let closest = -origin.dot(direction) / dd;
    let offset = origin + closest * direction;
    Span::chord(closest, offset.length_squared(), dd)
}
