//! Rough surfaces: facets that are too small to be seen, each smooth.
//!
//! The slopes are spread by T. S. Trowbridge and K. P. Reitz (1975), "GGX"; facets hide each other by B. G. Smith (1967).
//! The formulas are those of B. Walter, S. Marschner, H. Li, K. Torrance 2007, Microfacet models for refraction through
//! rough surfaces. A facet sends light on once: what meets a second one is lost.

use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float32, Width};
use crate::transport::sampling::Sample2D;

/// A facet that is seen along `-direction`, chosen as often as it is seen (J. Dupuy, A. Benyoub 2023, Sampling visible GGX
/// normals with spherical caps): its unit normal. `normal` faces the viewer; `alpha` is the width of the slopes.
#[inline(always)]
pub(crate) fn sample_visible_normal<W: Width>(
    direction: Vector<W::R>,
    normal: Vector<W::R>,
    alpha: W::R,
    sample: &Sample2D<W>,
) -> Vector<W::R> {
    let [zero, one] = [0.0, 1.0].map(|value| alpha.like(value));
    let (right, up) = frame(normal);
    let to_viewer = -direction;
    // The facets stretched to a half-sphere.
    let view = Vector::new(right.dot(to_viewer) * alpha, up.dot(to_viewer) * alpha, normal.dot(to_viewer));
    let view = view.normalize_or(Vector::new(zero, zero, one));
    let z = (one - sample.second) * (one + view.z) - view.z;
    let across = (one - z * z).max(zero).sqrt();
    let cap = Vector::new(across * sample.cos, across * sample.sin, z) + view;
    let facet = right * (cap.x * alpha) + up * (cap.y * alpha) + normal * cap.z.max(zero);
    facet.normalize_or(normal)
}

/// The share of facets that is seen under an angle to the normal of this cosine, G₁ (Walter et al., eq. 34).
#[inline(always)]
pub(crate) fn smith_g1<R: Float32>(cos: R, alpha: R) -> R {
    let one = cos.like(1.0);
    let square = (cos * cos).max(cos.like(f32::MIN_POSITIVE));
    let slope = (one - square).max(cos.like(0.0)) / square;
    cos.like(2.0) / (one + (one + alpha * alpha * slope).sqrt())
}

/// What facets send on to the viewer of light from a direction, but for what each reflects: π·D·G/(4·(n̂·Ŝ)) (Walter et al.,
/// eq. 20), with `half` the normal of the facets that do.
#[inline(always)]
pub(crate) fn reflected_density<R: Float32>(
    to_viewer: Vector<R>,
    to_light: Vector<R>,
    normal: Vector<R>,
    half: Vector<R>,
    alpha: R,
) -> R {
    let least = alpha.like(1e-6);
    let (cos_viewer, cos_light) = (normal.dot(to_viewer).max(least), normal.dot(to_light).max(least));
    let seen = smith_g1(cos_viewer, alpha) * smith_g1(cos_light, alpha);
    ggx_density(normal, half, alpha) * seen / (cos_viewer * 4.0)
}

/// What facets send through to a viewer inside of light from outside (Walter et al., eq. 21, times π and the cosine, of
/// radiance by the square of the index): that share but for the part that is reflected, and the cosine under which the
/// viewer sees the facet. `ratio` is the index on the viewer's side divided by that on the light's.
#[inline(always)]
pub(crate) fn transmitted_density<R: Float32>(
    to_viewer: Vector<R>,
    to_light: Vector<R>,
    normal: Vector<R>,
    ratio: R,
    alpha: R,
) -> (R, R) {
    let [zero, one, least] = [0.0, 1.0, 1e-6].map(|value| alpha.like(value));
    let half = (to_viewer * ratio + to_light).normalize_or(normal);
    let half = half * one.copysign(normal.dot(half));
    let (viewer, light) = (half.dot(to_viewer), -half.dot(to_light));
    let (cos_viewer, cos_light) = (normal.dot(to_viewer).max(least), (-normal.dot(to_light)).max(least));
    let seen = smith_g1(cos_viewer, alpha) * smith_g1(cos_light, alpha);
    let width = ratio * viewer - light;
    let sent =
        ggx_density(normal, half, alpha) * seen * viewer * light / (cos_viewer * (width * width).max(least));
    let is_met = viewer.gt(zero) & light.gt(zero);
    (R::select(is_met, sent, zero), viewer.min(one).max(zero))
}

/// The probability density, for each steradian, of the directions in which facets send on rays of a viewer when they are
/// chosen by [`sample_visible_normal`]: that of visible normals G₁·D·(half·Ŝ)/(n̂·Ŝ) (Dupuy, Benyoub 2023, eq. 2) by how
/// densely directions lie to normals (Walter et al., eq. 14 and 17). `beyond` is the ratio of indices of rays that pass,
/// the viewer's side divided by the other; `None` of those that are reflected.
#[inline(always)]
pub(crate) fn facet_pdf<R: Float32>(
    to_viewer: Vector<R>,
    direction: Vector<R>,
    normal: Vector<R>,
    alpha: R,
    beyond: Option<R>,
) -> R {
    let [zero, one, least] = [0.0, 1.0, 1e-6].map(|value| alpha.like(value));
    let half = match beyond {
        None => (to_viewer + direction).normalize_or(normal),
        Some(ratio) => (to_viewer * ratio + direction).normalize_or(normal),
    };
    let half = half * one.copysign(normal.dot(half));
    let (viewer, sent) = (half.dot(to_viewer), half.dot(direction));
    let spread = match beyond {
        None => one * 0.25,
        Some(ratio) => {
            let width = ratio * viewer + sent;
            viewer * -sent / (width * width).max(least * least)
        }
    };
    let cos = normal.dot(to_viewer).max(least);
    let density =
        ggx_density(normal, half, alpha) * smith_g1(cos, alpha) * spread / (cos * std::f32::consts::PI);
    R::select(viewer.gt(zero), density.max(zero), zero)
}

/// π times the density of facets with this normal (Walter et al., eq. 33).
#[inline(always)]
fn ggx_density<R: Float32>(normal: Vector<R>, half: Vector<R>, alpha: R) -> R {
    let cos = normal.dot(half);
    // sin² + α²·cos², without a difference of squares near 1.
    let across = half - normal * cos;
    let square = alpha * alpha;
    let spread = across.length_squared() + square * cos * cos;
    square / (spread * spread)
}

/// Two unit vectors across a third (T. Duff et al. 2017, Building an orthonormal basis, revisited).
#[inline(always)]
pub(crate) fn frame<R: Float32>(axis: Vector<R>) -> (Vector<R>, Vector<R>) {
    let one = axis.x.like(1.0);
    // Not by the sign of a zero, which graphics cards need not keep.
    let sign = R::select(axis.z.lt(axis.z.like(0.0)), -one, one);
    let a = -(one / (sign + axis.z));
    let b = axis.x * axis.y * a;
    let right = Vector::new(one + sign * axis.x * axis.x * a, sign * b, -(sign * axis.x));
    (right, Vector::new(b, sign + axis.y * axis.y * a, -axis.y))
}
