//! The half-space y ≤ 0 with the surface y = 0.
//!
//! ```toml
//! [[bodies]]
//! shape = "plane"
//! ```

use glam::Vec3A;

use super::{SIDE, Span};

/// The span of a line that starts at y = `height` and rises by `rise` per unit of its parameter. A line parallel to
/// the surface never crosses it.
#[inline]
pub(super) fn span(height: f32, rise: f32) -> Span {
    let crossing = -height / rise;
    if rise < 0.0 {
        Span::new(crossing, f32::INFINITY, SIDE)
    } else if rise > 0.0 {
        Span::new(f32::NEG_INFINITY, crossing, SIDE)
    } else {
        Span::everywhere(SIDE, SIDE, false)
    }
}

pub(super) fn pull_to_surface(point: Vec3A) -> Vec3A {
    Vec3A::new(point.x, 0.0, point.z)
}
