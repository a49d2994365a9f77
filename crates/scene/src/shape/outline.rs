//! Circles of outlines.

use std::f64::consts::TAU;

use glam::DVec3;

/// Corners of a circle.
pub(super) const CORNERS: u32 = 64;

/// A closed circle.
pub(super) fn circle(center: DVec3, right: DVec3, up: DVec3) -> Vec<DVec3> {
    let corner = |corner: u32| {
        let (sine, cosine) = (TAU * f64::from(corner) / f64::from(CORNERS)).sin_cos();
        center + cosine * right + sine * up
    };
    (0..=CORNERS).map(corner).collect()
}

/// A circle about the Y axis.
pub(super) fn rim(radius: f64, y: f64) -> Vec<DVec3> {
    circle(y * DVec3::Y, radius * DVec3::X, radius * DVec3::Z)
}
