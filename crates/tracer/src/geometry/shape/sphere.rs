//! The unit ball x² + y² + z² ≤ 1.
//!
//! ```toml
//! [[bodies]]
//! shape = "sphere"
//! radius = 1.0
//! ```

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DAffine3, DMat3, DVec2, DVec3};

use crate::geometry::shape::ShapeSpan;
use crate::geometry::shape::solid::{PicturePlace, RevolutionRing, Solid, is_oblique, to_ellipsoid};
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

/// The unit ball, of whatever scale.
pub(crate) struct UnitBall;

impl Solid for UnitBall {
    fn bounds(&self, frame: &DAffine3, _ratio: f64) -> Option<[DVec3; 2]> {
        let DMat3 { x_axis: x, y_axis: y, z_axis: z } = frame.matrix3;
        let reach = (x * x + y * y + z * z).map(f64::sqrt);
        Some([frame.translation - reach, frame.translation + reach])
    }

    fn bounding_sphere(&self, linear: &DMat3, _ratio: f64) -> (DVec3, f64) {
        (DVec3::ZERO, longest_axis(linear))
    }

    fn hull(&self, frame: &DAffine3, _ratio: f64) -> Option<(Vec<DVec3>, f64)> {
        Some((vec![frame.translation], longest_axis(&frame.matrix3)))
    }

    fn volume(&self, _ratio: f64) -> f64 {
        4.0 / 3.0 * PI
    }

    fn middle(&self) -> Option<DVec3> {
        Some(DVec3::ZERO)
    }

    fn flatness(&self, axes: DVec3) -> f64 {
        axes.max_element() / axes.min_element()
    }

    fn distance(&self, _ratio: f64, axes: DVec3, at: DVec3) -> f64 {
        to_ellipsoid(at, axes).abs()
    }

    fn picture_place(&self, _ratio: f32, [x, y, z]: [f32; 3]) -> PicturePlace {
        PicturePlace::around([x, y, z], 0.5 - y.atan2((x * x + z * z).sqrt()) / std::f32::consts::PI)
    }

    /// From pole to pole in 2·`fineness` parts.
    fn profile(&self, _ratio: f64, fineness: u32) -> Option<Vec<Vec<RevolutionRing>>> {
        let ring = |step: u32| {
            let quarter = f64::from(step) / f64::from(fineness);
            // The poles exactly, as the equator.
            let (sin, cos) = match quarter {
                0.0 => (0.0, 1.0),
                1.0 => (1.0, 0.0),
                2.0 => (0.0, -1.0),
                _ => (FRAC_PI_2 * quarter).sin_cos(),
            };
            RevolutionRing { y: -cos, radius: sin, normal: DVec2::new(sin, -cos) }
        };
        Some(vec![(0..=2 * fineness).map(ring).collect()])
    }
}

/// The longest axis of an ellipsoid, or more where the frame is oblique.
fn longest_axis(linear: &DMat3) -> f64 {
    let squares = [linear.x_axis, linear.y_axis, linear.z_axis].map(DVec3::length_squared);
    let longest =
        if is_oblique(linear) { squares.iter().sum() } else { squares.into_iter().fold(0.0, f64::max) };
    longest.sqrt()
}
