//! The unit ball x² + y² + z² ≤ 1.
//!
//! ```toml
//! [[bodies]]
//! shape = "sphere"
//! radius = 1.0
//! ```

use glam::Vec3A;

use super::{SIDE, Span};

/// The line's closest approach to the center, plus and minus half the chord.
///
/// With o' the point of closest approach at t₀ = -(o·d)/(d·d), the half chord is √((1 - o'·o') / (d·d)). The
/// discriminant arises from lengths about 1, not as a difference of large squares, and stays accurate when the origin
/// is far away (Haines, Günther, Akenine-Möller 2019, Ray Tracing Gems, ch. 7).
#[inline]
pub(super) fn span(origin: Vec3A, direction: Vec3A) -> Span {
    let dd = direction.length_squared();
    let closest = -origin.dot(direction) / dd;
    let offset = origin + closest * direction;
    let half_squared = (1.0 - offset.length_squared()) / dd;
    if half_squared >= 0.0 {
        let half = half_squared.sqrt();
        Span::new(closest - half, closest + half, SIDE)
    } else {
        Span::miss(closest)
    }
}

pub(super) fn pull_to_surface(point: Vec3A) -> Vec3A {
    point.normalize_or(Vec3A::Y)
}

pub(super) fn normal(point: Vec3A) -> Vec3A {
    point
}
