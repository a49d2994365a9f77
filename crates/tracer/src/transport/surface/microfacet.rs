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
    // A point of the cap has the height z = lift - view.z. Its distance from the axis is √((1 - z)·(1 + z)), where neither
    // factor is a difference of near numbers: 1 - z = second·(1 + view.z), and 1 - view.z² is known from x and y.
    let from_pole = (one + view.z).max(zero);
    let lift = (one - sample.second) * from_pole;
    let flat = view.x.times_plus(view.x, view.y * view.y);
    let across = (sample.second * from_pole.times_plus(lift, flat)).sqrt();
    let cap = Vector::new(across.times_plus(sample.cos, view.x), across.times_plus(sample.sin, view.y), lift);
    let facet = right * (cap.x * alpha) + up * (cap.y * alpha) + normal * cap.z;
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

/// A pole and two vectors across it, all of length 1: the frame that [`frame`] carries to other axes.
const POLE_FRAME: [[f32; 3]; 3] = {
    const PART: f32 = 1.0 / 15.0;
    [
        [2.0 * PART, 10.0 * PART, 11.0 * PART],
        [14.0 * PART, -5.0 * PART, 2.0 * PART],
        [5.0 * PART, 10.0 * PART, -10.0 * PART],
    ]
};

/// Two unit vectors across a third: those of a fixed pole, mirrored so that the pole comes to lie opposite the axis (A. S.
/// Householder 1958, Unitary triangularization of a nonsymmetric matrix).
///
/// They turn continuously with the axis, else the samples of a pixel would be two sets, each turned another way, and not
/// one that is spread evenly. No frames can do so everywhere: these are torn at the direction opposite the pole. It is
/// along no axis, and of the normals and the directions to lights those are seldom seen that point down and away from the
/// viewer. Within an angle ε of it, rounding tilts the frame by up to about 10⁻⁷/ε.
#[inline(always)]
pub(crate) fn frame<R: Float32>(axis: Vector<R>) -> (Vector<R>, Vector<R>) {
    let [pole, right, up] = POLE_FRAME;
    let half = axis.plus_all(pole);
    let scale = half.x.like(-2.0) / half.length_squared().max(half.x.like(f32::MIN_POSITIVE));
    let mirrored = |side: [f32; 3]| {
        let side = Vector::splat(half.x, side);
        side.plus_times(half, half.dot(side) * scale)
    };
    (mirrored(right), mirrored(up))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::scalar::ScalarWidth;

    /// The directions of a sphere, spread evenly, but for those near the one where frames are torn.
    fn axes() -> impl Iterator<Item = Vector<f32>> {
        const COUNT: u16 = 5000;
        let pole = Vector::new(POLE_FRAME[0][0], POLE_FRAME[0][1], POLE_FRAME[0][2]);
        (0..COUNT)
            .map(|index| {
                let z = 1.0 - (2.0 * f32::from(index) + 1.0) / f32::from(COUNT);
                let (sin, cos) = (f32::from(index) * 2.399_963_2).sin_cos();
                let across = (1.0 - z * z).sqrt();
                Vector::new(across * cos, across * sin, z)
            })
            .filter(move |axis| axis.dot(pole) > -0.98)
    }

    #[test]
    fn frames_are_square_and_turn_with_their_axes() {
        const STEP: f32 = 1e-3;
        for axis in axes() {
            let (right, up) = frame(axis);
            for (found, exact) in [
                (right.length_squared(), 1.0),
                (up.length_squared(), 1.0),
                (right.dot(up), 0.0),
                (right.dot(axis), 0.0),
                (up.dot(axis), 0.0),
            ] {
                assert!((found - exact).abs() < 3e-6, "{axis:?}: {found}, not {exact}");
            }
            for aside in [right, up] {
                let (other, _) = frame((axis + aside * STEP).normalize_or(axis));
                // A tenth of a turn about the direction opposite the pole, where it is nearest.
                let turned = (other - right).length_squared().sqrt();
                assert!(turned < 12.0 * STEP, "{axis:?}: turned by {turned}");
            }
        }
        // Not even there does a frame have no length.
        let [x, y, z] = POLE_FRAME[0].map(|part| -part);
        let (right, up) = frame(Vector::new(x, y, z));
        assert!((right.length_squared() - 1.0).abs() < 1e-6 && (up.length_squared() - 1.0).abs() < 1e-6);
    }

    /// Seen straight on, a facet has the slope α·√(u/(1 - u)) (Walter et al., eq. 35), of whatever size.
    #[test]
    fn slopes_of_facets_are_exact_however_small() {
        let normal = Vector::new(0.0, 0.0, 1.0);
        let (right, up) = frame(normal);
        let tilt = f64::from(right.z).abs().max(f64::from(up.z).abs()).max(f64::from(f32::EPSILON) / 2.0);
        for alpha in [0.5, 1e-2, 1e-4, 1e-7, 1e-12] {
            for second in [1e-6_f32, 1e-4, 0.01, 0.3, 0.9, 0.999, 0.999_99, 1.0 - 2.0_f32.powi(-24)] {
                let sample = Sample2D::<ScalarWidth> { cos: 0.6, sin: 0.8, second };
                let facet = sample_visible_normal(-normal, normal, alpha, &sample);
                let found = f64::from(facet.x).hypot(f64::from(facet.y)) / f64::from(facet.z);
                let u = f64::from(second);
                let exact = f64::from(alpha) * (u / (1.0 - u)).sqrt();
                // Rounding tilts the sides of the frame, together by up to 1.5 times the larger tilt δ. This
                // changes a slope s by the share δ·s, and moves the view from the middle of a cap that is 2·√u across.
                let bound = 2e-6 + 1.5 * tilt * (exact + f64::from(alpha) / u.sqrt());
                assert!((found / exact - 1.0).abs() < bound, "{alpha}, {second}: {found:e}, not {exact:e}");
            }
        }
    }
}
