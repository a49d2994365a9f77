//! The cap x² + z² ≤ y ≤ 1 of a paraboloid of revolution. Its focus in this frame is (0, 1/4, 0).
//!
//! ```toml
//! [[bodies]]
//! shape = "paraboloid"
//! radius = 0.5                    # of the rim
//! height = 1.0                    # or focal_length = 0.0625
//! ```

use std::f64::consts::FRAC_PI_2;

use glam::{DAffine3, DMat3, DVec2, DVec3};

use crate::geometry::shape::solid::{
    CAP_LEVEL, PicturePlace, RevolutionRing, Solid, hull_of_discs, steps, to_box,
};
use crate::geometry::shape::{SIDE, ShapeSpan, UPPER_CAP, slab};
use crate::simd::Float;
use crate::simd::vector::Vector;

/// The part of the line in the unbounded paraboloid that lies below the cap.
///
/// The origin is first moved along the line to its closest approach to the middle of the cap, so that the coefficients
/// of the quadratic are about 1 however far the ray comes from.
#[inline(always)]
pub(crate) fn span<R: Float>(origin: Vector<R>, direction: Vector<R>) -> ShapeSpan<R> {
    let top = Vector::splat(origin.x, [0.0, 1.0, 0.0]);
    let shift = (top - origin).dot(direction) / direction.length_squared();
    let near = origin.plus_times(direction, shift);
    let mut span = side(near, direction);
    span.enter = span.enter + shift;
    span.exit = span.exit + shift;
    // The layer has no lower end: the side is closed there.
    span.intersect(slab::closed(origin.y, direction.y, (f32::NEG_INFINITY, SIDE), (1.0, UPPER_CAP)))
}

/// Where the line lies in x² + z² ≤ y.
///
/// q(t) = A·t² + 2·B·t + C with the roots in their stable form, (-B ∓ √(B² - AC)) / A written so that nothing cancels
/// (Press et al. 2007, Numerical Recipes, eq. 5.6.4). A ≥ 0: the inside lies between the roots, or, along the axis,
/// where A = 0, above the one that is left. There B is half of the direction's fall, and not 0.
#[inline(always)]
fn side<R: Float>(origin: Vector<R>, direction: Vector<R>) -> ShapeSpan<R> {
    let (zero, one, infinity) = (origin.x.like(0.0), origin.x.like(1.0), origin.x.like(f32::INFINITY));
    let a = direction.x * direction.x + direction.z * direction.z;
    let b = origin.x * direction.x + origin.z * direction.z - direction.y * 0.5;
    let c = origin.x * origin.x + origin.z * origin.z - origin.y;
    let discriminant = b * b - a * c;
    let root = discriminant.max(zero).sqrt();
    let b_rises = b.gt(zero);
    let q = R::select(b_rises, -(b + root), root - b);
    let (is_along, misses) = (a.eq(zero), discriminant.lt(zero));
    let first = q / R::select(is_along, one, a);
    // B = 0 and A·C = 0: the line touches at t = 0.
    let second = c / R::select(q.eq(zero), one, q);
    let enter = R::select(is_along, R::select(b_rises, -infinity, second), first.min(second));
    let exit = R::select(is_along, R::select(b_rises, second, infinity), first.max(second));
    let face = zero.like(SIDE);
    ShapeSpan {
        // Beside the paraboloid both ends are the closest approach: the root was taken as 0.
        enter: R::select(misses, first, enter),
        exit: R::select(misses, first, exit),
        enter_face: face,
        exit_face: face,
        hit: enter.le(exit) & !misses,
    }
}

/// Points of the side are moved along the axis, and those beyond the rim to the rim: the surface is nowhere steeper than
/// 2, and level at the vertex.
#[inline(always)]
pub(crate) fn pull_to_surface<R: Float>(face: R, point: Vector<R>) -> Vector<R> {
    let one = face.like(1.0);
    let is_side = face.eq(face.like(SIDE));
    let around = point.x * point.x + point.z * point.z;
    let shrink = one / around.max(one).sqrt();
    Vector::new(
        R::select(is_side, point.x * shrink, point.x),
        R::select(is_side, around.min(one), one),
        R::select(is_side, point.z * shrink, point.z),
    )
}

/// On the side, the gradient of x² + z² - y.
#[inline(always)]
pub(crate) fn normal<R: Float>(face: R, point: Vector<R>) -> Vector<R> {
    let (zero, one) = (face.like(0.0), face.like(1.0));
    let side = Vector::new(point.x * 2.0, -one, point.z * 2.0);
    Vector::select(face.eq(face.like(SIDE)), side, Vector::new(zero, one, zero))
}

#[inline(always)]
pub(crate) fn contains<R: Float>(point: Vector<R>) -> R::Mask {
    (point.x * point.x + point.z * point.z).le(point.y) & point.y.le(point.y.like(1.0))
}

/// The cap, of whatever scale.
pub(crate) struct ParaboloidCap;

impl Solid for ParaboloidCap {
    /// With a and b the parts of a row of the transform across and along the Y axis, the side reaches a·s + b·s² at the
    /// distance s from that axis: most at s = -a/(2b), or at the rim.
    fn bounds(&self, frame: &DAffine3, _ratio: f64) -> Option<[DVec3; 2]> {
        let DMat3 { x_axis: x, y_axis: along, z_axis: z } = frame.matrix3;
        let across = (x * x + z * z).map(f64::sqrt);
        let reach = |along: DVec3| {
            let reach = |a: f64, b: f64| if b < -0.5 * a { -0.25 * a * (a / b) } else { a + b };
            DVec3::new(reach(across.x, along.x), reach(across.y, along.y), reach(across.z, along.z))
        };
        Some([frame.translation - reach(-along), frame.translation + reach(along)])
    }

    /// As of a cone that stands on its apex: through the rim and the vertex, or about the middle of the cap. The squared
    /// distance of the side from a point on the axis is convex in y, and so largest at one of the ends.
    fn bounding_sphere(&self, linear: &DMat3, _ratio: f64) -> (DVec3, f64) {
        let larger = linear.x_axis.length_squared().max(linear.z_axis.length_squared());
        let height = linear.y_axis.length_squared();
        let share = (0.5 + 0.5 * larger / height).min(1.0);
        let to_rim = larger + (1.0 - share) * (1.0 - share) * height;
        (share * linear.y_axis, to_rim.max(share * share * height).sqrt())
    }

    /// The frustum between the tangent plane at the vertex and the tangents at the rim, which meet at half the radius.
    fn hull(&self, frame: &DAffine3, _ratio: f64) -> Option<(Vec<DVec3>, f64)> {
        Some((hull_of_discs(frame, &[(0.0, 0.5), (1.0, 1.0)]), 0.0))
    }

    fn volume(&self, _ratio: f64) -> f64 {
        FRAC_PI_2
    }

    fn middle(&self) -> Option<DVec3> {
        Some(0.5 * DVec3::Y)
    }

    fn flatness(&self, axes: DVec3) -> f64 {
        axes.max_element() / axes.min_element()
    }

    /// To first order beside the side: its level x² + z² - y, in units of the axes, by the slope of this (Taubin 1991,
    /// Estimation of planar curves, surfaces, and nonplanar space curves, eq. 5).
    fn distance(&self, _ratio: f64, axes: DVec3, at: DVec3) -> f64 {
        let unit = at / axes;
        let level = unit.x * unit.x + unit.z * unit.z - unit.y;
        let slope = (DVec3::new(2.0 * unit.x, -1.0, 2.0 * unit.z) / axes).length();
        to_box(DVec3::new(level / slope, at.y - axes.y, f64::NEG_INFINITY)).abs()
    }

    fn picture_place(&self, _ratio: f32, [x, y, z]: [f32; 3]) -> PicturePlace {
        if y >= 1.0 - CAP_LEVEL {
            PicturePlace::flat(x, z)
        } else {
            PicturePlace::around([x, y, z], 1.0 - y.max(0.0).sqrt())
        }
    }

    /// Side and cap, in rings as far apart.
    fn profile(&self, _ratio: f64, fineness: u32) -> Option<Vec<Vec<RevolutionRing>>> {
        let ring = |radius: f64| RevolutionRing {
            y: radius * radius,
            radius,
            normal: DVec2::new(2.0 * radius, -1.0),
        };
        Some(vec![steps(fineness).map(ring).collect(), RevolutionRing::disc(1.0, 1.0, 1.0, fineness)])
    }
}
