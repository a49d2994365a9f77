//! The closed cone or frustum x² + z² ≤ r(y)², 0 ≤ y ≤ 1, with r(y) = 1 + (k - 1)·y and k the ratio of top to base
//! radius (0: a pointed cone).
//!
//! ```toml
//! [[bodies]]
//! shape = "cone"
//! radius = 0.5
//! top_radius = 0.2                # 0 by default
//! height = 1.0
//! ```

use std::f64::consts::PI;

use glam::{DAffine3, DMat3, DVec2, DVec3};

use crate::geometry::shape::solid::{
    CAP_LEVEL, PicturePlace, RevolutionRing, Solid, bounds_of_discs, hull_of_discs, steps,
    to_layer_of_cylinder,
};
use crate::geometry::shape::{LOWER_CAP, SIDE, ShapeSpan, UPPER_CAP, slab};
use crate::simd::vector::Vector;
use crate::simd::{Float, Mask as _};

/// The nappe's span cut by the layer between the caps.
///
/// The origin is first moved along the line to its closest approach to the top of the axis, so that the coefficients of
/// the quadratic are about 1 however far the ray comes from (Embree's `coneline_intersector` does the same with the
/// middle). Near a pointed cone's apex, where both roots fall together, they are small, and so is their rounding.
#[inline(always)]
pub(crate) fn span<R: Float>(ratio: R, origin: Vector<R>, direction: Vector<R>) -> ShapeSpan<R> {
    let top = Vector::splat(origin.x, [0.0, 1.0, 0.0]);
    let shift = (top - origin).dot(direction) / direction.length_squared();
    let near = origin.plus_times(direction, shift);
    let mut span = nappe(ratio - 1.0, near, direction);
    span.enter = span.enter + shift;
    span.exit = span.exit + shift;
    span.intersect(slab::closed(origin.y, direction.y, (0.0, LOWER_CAP), (1.0, UPPER_CAP)))
}

/// Where the line lies in the nappe x² + z² ≤ r(y)², r(y) = 1 + slope·y ≥ 0.
///
/// q(t) = A·t² + 2·B·t + C with the roots in their stable form, (-B ∓ √(B² - AC)) / A written so that nothing
/// cancels (Press et al. 2007, Numerical Recipes, eq. 5.6.4). For A > 0 the inside lies between the roots. For A < 0
/// the line is steeper than the cone and runs in both nappes outside the roots: the wanted half is the one in which
/// r grows. For A = 0 one root is infinite.
#[inline(always)]
fn nappe<R: Float>(slope: R, origin: Vector<R>, direction: Vector<R>) -> ShapeSpan<R> {
    let (zero, one, infinity) = (origin.x.like(0.0), origin.x.like(1.0), origin.x.like(f32::INFINITY));
    let radius = origin.y * slope + 1.0;
    let radius_change = direction.y * slope;
    // Not fused: A has to be exactly 0 along the surface.
    let a = direction.x * direction.x + direction.z * direction.z - radius_change * radius_change;
    let b = origin.x * direction.x + origin.z * direction.z - radius * radius_change;
    let c = origin.x * origin.x + origin.z * origin.z - radius * radius;
    let discriminant = b * b - a * c;
    let root = discriminant.max(zero).sqrt();
    let b_rises = b.gt(zero);
    let q = R::select(b_rises, -(b + root), root - b);
    let (is_line, is_between) = (a.eq(zero), a.gt(zero));
    // B = 0 and A·C = 0: the line touches at t = 0 only (A > 0), or runs along the surface or through the apex.
    let misses = is_between & discriminant.lt(zero);
    let is_flat = q.eq(zero) & !misses;
    let first = q / R::select(is_line, one, a);
    let second = c / R::select(q.eq(zero), one, q);
    let (low, high) = (first.min(second), first.max(second));
    // q(t) = 2·B·t + C.
    let on_line = (R::select(b_rises, -infinity, second), R::select(b_rises, second, infinity));
    let widens = radius_change.gt(zero);
    let outside = (R::select(widens, high, -infinity), R::select(widens, infinity, low));
    let pick = |between: R, on_line: R, outside: R| {
        R::select(is_between, between, R::select(is_line, on_line, outside))
    };
    let mut enter = pick(low, on_line.0, outside.0);
    let mut exit = pick(high, on_line.1, outside.1);
    let mut hit = enter.le(exit);
    // Beside the cone both ends are the closest approach: the root was taken as 0.
    enter = R::select(misses, first, enter);
    exit = R::select(misses, first, exit);
    hit = hit & !misses;
    if is_flat.any() {
        enter = R::select(is_flat, R::select(is_between, zero, -infinity), enter);
        exit = R::select(is_flat, R::select(is_between, zero, infinity), exit);
        hit = (hit & !is_flat) | (is_flat & (is_between | c.le(zero)));
    }
    let face = zero.like(SIDE);
    ShapeSpan { enter, exit, enter_face: face, exit_face: face, hit }
}

/// A vector in the xz-plane made of length 1, or 0 if it has none.
#[inline(always)]
fn around<R: Float>(point: Vector<R>) -> Vector<R> {
    let zero = point.y.like(0.0);
    Vector::new(point.x, zero, point.z).normalize_or(Vector::new(zero, zero, zero))
}

#[inline(always)]
pub(crate) fn pull_to_surface<R: Float>(ratio: R, face: R, point: Vector<R>) -> Vector<R> {
    let (zero, one) = (face.like(0.0), face.like(1.0));
    let is_side = face.eq(face.like(SIDE));
    let y = point.y.max(zero).min(one);
    let side = around(point) * (y * (ratio - 1.0) + 1.0);
    let cap = R::select(face.eq(face.like(LOWER_CAP)), zero, one);
    Vector::new(
        R::select(is_side, side.x, point.x),
        R::select(is_side, y, cap),
        R::select(is_side, side.z, point.z),
    )
}

/// On the side, the gradient of x² + z² - r(y)²; at the apex, where it vanishes, the axis.
#[inline(always)]
pub(crate) fn normal<R: Float>(ratio: R, face: R, point: Vector<R>) -> Vector<R> {
    let (zero, one) = (face.like(0.0), face.like(1.0));
    let is_side = face.eq(face.like(SIDE));
    let around = around(point);
    let up = Vector::new(zero, one, zero);
    let side = Vector::new(around.x, one - ratio, around.z);
    let side = Vector::select(side.is_zero(), up, side);
    let cap = Vector::select(face.eq(face.like(LOWER_CAP)), -up, up);
    Vector::select(is_side, side, cap)
}

#[inline(always)]
pub(crate) fn contains<R: Float>(ratio: R, point: Vector<R>) -> R::Mask {
    let (zero, one) = (ratio.like(0.0), ratio.like(1.0));
    let radius = one + (ratio - one) * point.y;
    let is_between_caps = zero.le(point.y) & point.y.le(one);
    is_between_caps & (point.x * point.x + point.z * point.z).le(radius * radius)
}

/// The closed cone or frustum.
pub(crate) struct Frustum;

impl Solid for Frustum {
    fn bounds(&self, frame: &DAffine3, ratio: f64) -> Option<[DVec3; 2]> {
        Some(bounds_of_discs(frame, [1.0, ratio]))
    }

    /// Of a frustum of height h between discs of radius r and k·r, k ≤ 1, it has its center at the height s on the axis
    /// where it meets the rims of both, s² + r² = (h - s)² + (k·r)², or in the middle of the larger disc.
    fn bounding_sphere(&self, linear: &DMat3, ratio: f64) -> (DVec3, f64) {
        let larger = linear.x_axis.length_squared().max(linear.z_axis.length_squared());
        let height = linear.y_axis.length_squared();
        let share = (0.5 - 0.5 * (1.0 - ratio * ratio) * larger / height).max(0.0);
        (share * linear.y_axis, (larger + share * share * height).sqrt())
    }

    fn hull(&self, frame: &DAffine3, ratio: f64) -> Option<(Vec<DVec3>, f64)> {
        Some((hull_of_discs(frame, &[(0.0, 1.0), (1.0, ratio)]), 0.0))
    }

    fn volume(&self, ratio: f64) -> f64 {
        PI * (1.0 + ratio + ratio * ratio) / 3.0
    }

    fn middle(&self) -> Option<DVec3> {
        Some(0.5 * DVec3::Y)
    }

    fn flatness(&self, axes: DVec3) -> f64 {
        axes.max_element() / axes.min_element()
    }

    fn distance(&self, ratio: f64, axes: DVec3, at: DVec3) -> f64 {
        let height = at.y.clamp(0.0, axes.y);
        to_layer_of_cylinder(axes, 1.0 + (ratio - 1.0) * height / axes.y, at)
    }

    fn picture_place(&self, ratio: f32, [x, y, z]: [f32; 3]) -> PicturePlace {
        if y >= 1.0 - CAP_LEVEL {
            let radius = ratio.max(CAP_LEVEL);
            PicturePlace::flat(x / radius, z / radius)
        } else if y <= CAP_LEVEL {
            PicturePlace::flat(x, -z)
        } else {
            PicturePlace::around([x, y, z], 1.0 - y)
        }
    }

    /// Side, base and top.
    fn profile(&self, ratio: f64, fineness: u32) -> Option<Vec<Vec<RevolutionRing>>> {
        let ring = |y: f64| {
            let normal = DVec2::new(1.0, 1.0 - ratio);
            RevolutionRing { y, radius: 1.0 + (ratio - 1.0) * y, normal }
        };
        let mut side: Vec<RevolutionRing> = steps(fineness).map(ring).collect();
        // The end exactly as the cap's.
        side.last_mut().into_iter().for_each(|top| top.radius = ratio);
        let mut curves = vec![side, RevolutionRing::disc(0.0, 1.0, -1.0, fineness)];
        if ratio > 0.0 {
            curves.push(RevolutionRing::disc(1.0, ratio, 1.0, fineness));
        }
        Some(curves)
    }
}
