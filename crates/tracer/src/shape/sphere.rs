//! The unit ball x² + y² + z² ≤ 1.
//!
//! ```toml
//! [[bodies]]
//! shape = "sphere"
//! radius = 1.0
//! ```

use glam::Vec3A;

use super::Span;

/// The chord about the point of closest approach o' = o + t₀·d, t₀ = -(o·d)/(d·d).
#[inline]
pub(super) fn span(origin: Vec3A, direction: Vec3A) -> Span {
    let dd = direction.length_squared();
    let closest = -origin.dot(direction) / dd;
    let offset = origin + closest * direction;
    Span::chord(closest, offset.length_squared(), dd)
}

pub(super) fn pull_to_surface(point: Vec3A) -> Vec3A {
    point.normalize_or(Vec3A::Y)
}

pub(super) fn normal(point: Vec3A) -> Vec3A {
    point
}
