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

use glam::{Vec3A, Vec3Swizzles};

use super::{Face, LOWER_CAP, SIDE, Span, UPPER_CAP, slab};

/// The nappe's span cut by the layer between the caps.
///
/// The origin is first moved along the line to its closest approach to the top of the axis, so that the coefficients of
/// the quadratic are about 1 however far the ray comes from (Embree's `coneline_intersector` does the same with the
/// middle). Near a pointed cone's apex, where both roots fall together, they are small, and so is their rounding.
#[inline]
pub(super) fn span(ratio: f32, origin: Vec3A, direction: Vec3A) -> Span {
    let shift = (Vec3A::Y - origin).dot(direction) / direction.length_squared();
    let near = origin + shift * direction;
    let mut span = nappe(ratio - 1.0, near, direction);
    span.enter += shift;
    span.exit += shift;
    span.intersect(slab::span(origin.y, direction.y, (0.0, LOWER_CAP), (1.0, UPPER_CAP)))
}

/// Where the line lies in the nappe x² + z² ≤ r(y)², r(y) = 1 + slope·y ≥ 0.
///
/// q(t) = A·t² + 2·B·t + C with the roots in their stable form, (-B ∓ √(B² - AC)) / A written so that nothing
/// cancels (Press et al. 2007, Numerical Recipes, eq. 5.6.4). For A > 0 the inside lies between the roots. For A < 0
/// the line is steeper than the cone and runs in both nappes outside the roots: the wanted half is the one in which
/// r grows. For A = 0 one root is infinite.
#[inline]
fn nappe(slope: f32, origin: Vec3A, direction: Vec3A) -> Span {
    let radius = 1.0 + slope * origin.y;
    let radius_change = slope * direction.y;
    let a = direction.xz().length_squared() - radius_change * radius_change;
    let b = origin.xz().dot(direction.xz()) - radius * radius_change;
    let c = origin.xz().length_squared() - radius * radius;
    let discriminant = b * b - a * c;
    if a > 0.0 && discriminant < 0.0 {
        return Span::miss(-b / a);
    }
    let root = discriminant.max(0.0).sqrt();
    let q = if b > 0.0 { -(b + root) } else { root - b };
    if q == 0.0 {
        // B = 0 and A·C = 0: the line touches at t = 0 only (A > 0), or runs along the surface or through the apex.
        return if a > 0.0 { Span::new(0.0, 0.0, SIDE) } else { Span::everywhere(SIDE, SIDE, c <= 0.0) };
    }
    let (first, second) = (q / a, c / q);
    let (low, high) = if first < second { (first, second) } else { (second, first) };
    if a > 0.0 {
        Span::new(low, high, SIDE)
    } else if a == 0.0 {
        // q(t) = 2·B·t + C.
        if b > 0.0 {
            Span::new(f32::NEG_INFINITY, second, SIDE)
        } else {
            Span::new(second, f32::INFINITY, SIDE)
        }
    } else if radius_change > 0.0 {
        Span::new(high, f32::INFINITY, SIDE)
    } else {
        Span::new(f32::NEG_INFINITY, low, SIDE)
    }
}

pub(super) fn pull_to_surface(ratio: f32, face: Face, point: Vec3A) -> Vec3A {
    match face {
        LOWER_CAP => Vec3A::new(point.x, 0.0, point.z),
        UPPER_CAP => Vec3A::new(point.x, 1.0, point.z),
        _ => {
            let y = point.y.clamp(0.0, 1.0);
            let around = point.xz().normalize_or_zero() * (1.0 + (ratio - 1.0) * y);
            Vec3A::new(around.x, y, around.y)
        }
    }
}

/// On the side, the gradient of x² + z² - r(y)²; at the apex, where it vanishes, the axis.
pub(super) fn normal(ratio: f32, face: Face, point: Vec3A) -> Vec3A {
    match face {
        LOWER_CAP => Vec3A::NEG_Y,
        UPPER_CAP => Vec3A::Y,
        _ => {
            let around = point.xz().normalize_or_zero();
            let normal = Vec3A::new(around.x, 1.0 - ratio, around.y);
            if normal == Vec3A::ZERO { Vec3A::Y } else { normal }
        }
    }
}

pub(super) fn contains(ratio: f32, point: Vec3A) -> bool {
    let radius = 1.0 + (ratio - 1.0) * point.y;
    (0.0..=1.0).contains(&point.y) && point.xz().length_squared() <= radius * radius
}
