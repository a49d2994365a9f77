//! How a surface answers light: directions of reflected and refracted rays, and the local terms.

pub(crate) mod bsdf;
pub(crate) mod material;
pub(crate) mod microfacet;
pub(crate) mod model;

use crate::simd::vector::Vector;
use crate::simd::{Float32, Mask as _, Word as _};

/// No light of a pixel is more: differences and means of pixels are finite.
pub(crate) const MOST_OF_PIXEL: f32 = 1e36;

/// The direction of the reflected ray, D - 2(n̂·D)n̂ (Whitted 1980), for a unit normal; of the same length as D.
#[inline(always)]
pub fn reflect<R: Float32>(direction: Vector<R>, normal: Vector<R>) -> Vector<R> {
    direction.plus_times(normal, normal.dot(direction) * -2.0)
}

/// A vector whose length is 1 but for rounding, with that rounding mended: one step of Newton's iteration for 1/√(v·v)
/// from 1, without root or division.
#[inline(always)]
pub(crate) fn mend_unit<R: Float32>(vector: Vector<R>) -> Vector<R> {
    vector * line(vector.length_squared(), -0.5, 1.5)
}

/// The direction of the refracted ray by Snell's law in vector form (Heckbert 1989, An Introduction to Ray Tracing,
/// ch. 4), and whether there is one: there is none at total internal reflection.
///
/// `direction` and `normal` are unit vectors with the normal facing the ray; `ratio` is the index of the medium the ray
/// comes from divided by that of the one it goes to. At equal indices the ray goes straight on.
#[inline(always)]
pub fn refract<R: Float32>(direction: Vector<R>, normal: Vector<R>, ratio: R) -> (Vector<R>, R::Mask) {
    let (zero, one) = (ratio.like(0.0), ratio.like(1.0));
    let is_straight = ratio.eq(one);
    let cos_in = -direction.dot(normal);
    let cos_out_squared = one - ratio * ratio * (one - cos_in * cos_in);
    let cos_out = cos_out_squared.max(zero).sqrt();
    let bent = mend_unit((direction * ratio).plus_times(normal, ratio * cos_in - cos_out));
    (Vector::select(is_straight, direction, bent), is_straight | !cos_out_squared.lt(zero))
}

/// The share of unpolarized light that the smooth boundary of a clear body reflects (A. Fresnel 1823; Born, Wolf 1999,
/// eq. 1.5.32), 1 at total reflection and 0 at equal indices.
///
/// `cos` is that of the angle of incidence, 0 to 1; `ratio` is the index before the boundary divided by that behind it.
#[inline(always)]
pub(crate) fn fresnel<R: Float32>(cos: R, ratio: R) -> R {
    let (zero, one) = (cos.like(0.0), cos.like(1.0));
    let ([across, along], is_total) = fresnel_polarized(cos, ratio);
    let share = ((across + along) * 0.5).min(one);
    R::select(ratio.eq(one), zero, R::select(is_total, one, share))
}

/// The shares of [`fresnel`] of light that swings across (s) and along (p) the plane of incidence, and where reflection is
/// total instead. At equal indices they are not exactly 0.
#[inline(always)]
pub(crate) fn fresnel_polarized<R: Float32>(cos: R, ratio: R) -> ([R; 2], R::Mask) {
    let (zero, one) = (cos.like(0.0), cos.like(1.0));
    // 1 - ratio²·sin², without a difference of near numbers where the indices are nearly equal.
    let cos_out_squared = (one - ratio) * (one + ratio) + ratio * ratio * cos * cos;
    let cos_out = cos_out_squared.max(zero).sqrt();
    // Both cosines are 0 only where nothing passes.
    let least = cos.like(f32::MIN_POSITIVE);
    let across = (ratio * cos - cos_out) / (ratio * cos + cos_out).max(least);
    let along = (cos - ratio * cos_out) / (cos + ratio * cos_out).max(least);
    ([across * across, along * along], cos_out_squared.lt(zero) | cos.le(zero))
}

/// C. Schlick's estimate of it (1994, An Inexpensive BRDF Model for Physically-based Rendering, eq. 15), with the cosine on
/// the side of the smaller index; 1 at total reflection. As for [`fresnel`], but at equal indices.
#[inline(always)]
pub(crate) fn schlick<R: Float32>(cos: R, ratio: R) -> R {
    let (zero, one) = (cos.like(0.0), cos.like(1.0));
    let cos_out_squared = (one - ratio) * (one + ratio) + ratio * ratio * cos * cos;
    let cos = R::select(ratio.gt(one), cos_out_squared.max(zero).sqrt(), cos);
    let root = (ratio - one) / (ratio + one);
    let (straight, rest) = (root * root, (one - cos).max(zero));
    let square = rest * rest;
    straight + (one - straight) * (square * square * rest)
}

/// The share (Ŝ·R̂)⁺ⁿ of Phong's highlight (Phong 1975), with R̂ the direction to the light mirrored about the normal
/// and Ŝ the direction to the viewer. All are unit vectors.
#[inline(always)]
pub fn phong_highlight<R: Float32>(
    to_viewer: Vector<R>,
    to_light: Vector<R>,
    normal: Vector<R>,
    shininess: R,
) -> R {
    /// e⁻³⁰ of the brightest light that a scene may have, 10⁶, is nothing in single precision.
    const INVISIBLE: f32 = 30.0;
    let (zero, one) = (shininess.like(0.0), shininess.like(1.0));
    let cos = highlight_cosine(to_viewer, to_light, normal);
    // ln x ≤ x - 1, so that the power is at most exp(-n·(1 - cos)): what is certain to vanish is not computed.
    let is_visible = cos.gt(zero) & (shininess * (one - cos)).lt(shininess.like(INVISIBLE));
    if !is_visible.any() {
        return zero;
    }
    let mut share = power(cos, shininess);
    let is_narrow = is_visible & shininess.gt(shininess.like(NARROW_HIGHLIGHT));
    if is_narrow.any() {
        let narrow = narrow_highlight(to_viewer, to_light, normal, shininess);
        share = R::select(is_narrow, narrow, share);
    }
    R::select(is_visible, share, zero)
}

/// Beyond this exponent a cosine in single precision, off by some 2⋅10⁻⁷, would change a highlight by more than 0.1 %.
pub(crate) const NARROW_HIGHLIGHT: f32 = 4096.0;

/// [`phong_highlight`] of large exponents: the cosine is 1 - s with s = |R̂ - Ŝ|²/2, and its logarithm -(s + s²/2 + s³/3),
/// in which what is left out is below the last digit where anything is seen.
#[inline(always)]
fn narrow_highlight<R: Float32>(
    to_viewer: Vector<R>,
    to_light: Vector<R>,
    normal: Vector<R>,
    shininess: R,
) -> R {
    let apart = (-(to_light + to_viewer)).plus_times(normal, normal.dot(to_light) * 2.0);
    let s = apart.length_squared() * 0.5;
    let logarithm = -(s * s.times_plus(line(s, 1.0 / 3.0, 0.5), s.like(1.0)));
    exponential(logarithm * shininess)
}

/// Ŝ·R̂ of [`phong_highlight`].
#[inline(always)]
pub(crate) fn highlight_cosine<R: Float32>(
    to_viewer: Vector<R>,
    to_light: Vector<R>,
    normal: Vector<R>,
) -> R {
    // Ŝ·(2(n̂·L̂)n̂ - L̂), the parts of which do not wait for each other. Rounding may make the product of two unit vectors
    // more than 1, and a power of it much more.
    let cos = (normal.dot(to_light) * 2.0).times_plus(normal.dot(to_viewer), -to_light.dot(to_viewer));
    cos.min(cos.like(1.0))
}

/// x to the power n, for 0 < x ≤ 1 and n ≥ 0: exp(n·ln x), as accurate as single precision allows for results above
/// e⁻⁸⁷; below, it is 0.
///
/// The polynomials are those of `logf` and `expf` in the Cephes library (Moshier 1992).
#[inline(always)]
fn power<R: Float32>(x: R, n: R) -> R {
    exponential(logarithm(x) * n)
}

/// ln x for normal x > 0: x = 2ᵉ·m with √½ ≤ m < √2, and a polynomial in m - 1.
#[inline(always)]
fn logarithm<R: Float32>(x: R) -> R {
    const SQRT_HALF: u32 = 0x3f35_04f3;
    const P: [f32; 9] = [
        7.037_683_6e-2,
        -1.151_461e-1,
        1.167_699_9e-1,
        -1.242_014_1e-1,
        1.424_932_3e-1,
        -1.666_805_7e-1,
        2.000_071_5e-1,
        -2.499_999_4e-1,
        3.333_333e-1,
    ];
    // The bits counted from those of √½: the exponent steps where the mantissa passes √2.
    let word = x.to_word();
    let from = word.plus(word.like(SQRT_HALF.wrapping_neg()));
    // As a number between 0 and 255, made by the bits of 2²³ + e, with 127 added so that it is not negative.
    let shifted = from.plus(word.like(127 << 23)).shifted_right(23);
    let exponent = R::of_word(shifted.or(word.like(0x4b00_0000))) - (8_388_608.0 + 127.0);
    let mantissa = from.and(0x007f_ffff).plus(word.like(SQRT_HALF));
    let f = R::of_word(mantissa) - 1.0;
    let square = f * f;
    // Estrin's scheme: the parts do not wait for each other.
    let [a, b, c, d, e, g, h, i, k] = P;
    let fourth = square * square;
    let low = line(f, g, h).times_plus(square, line(f, i, k));
    let high = line(f, b, c).times_plus(square, line(f, d, e));
    let sum = fourth.times_plus(f.like(a), high).times_plus(fourth, low);
    let tail = exponent.times_plus(f.like(-2.121_944_4e-4), square * -0.5);
    let tail = (sum * f).times_plus(square, tail);
    exponent.times_plus(f.like(0.693_359_4), tail + f)
}

/// a·x + b.
#[inline(always)]
fn line<R: Float32>(x: R, a: f32, b: f32) -> R {
    x.times_plus(x.like(a), x.like(b))
}

/// eˣ for x ≤ 0, also for -∞: x = n·ln 2 + r with |r| ≤ ½·ln 2, and a polynomial in r.
#[inline(always)]
pub(crate) fn exponential<R: Float32>(x: R) -> R {
    const LEAST: f32 = -87.0;
    const ROUND: f32 = 12_582_912.0;
    const P: [f32; 6] = [1.987_569_1e-4, 1.398_199_9e-3, 8.333_452e-3, 4.166_579_6e-2, 1.666_666_5e-1, 0.5];
    let zero = x.like(0.0);
    let is_nothing = x.lt(x.like(LEAST));
    let x = x.max(x.like(LEAST));
    // 1.5·2²³ leaves no room for a fraction: the sum is rounded to a whole number, which stands in its low bits.
    let rounded = line(x, std::f32::consts::LOG2_E, ROUND);
    let n = rounded - ROUND;
    let r = n.times_plus(x.like(2.121_944_4e-4), n.times_plus(x.like(-0.693_359_4), x));
    let [a, b, c, d, e, g] = P;
    let square = r * r;
    let high = line(r, a, b).times_plus(square, line(r, c, d));
    let sum = high.times_plus(square, line(r, e, g));
    let value = sum.times_plus(square, r) + 1.0;
    let scale = R::of_word(rounded.to_word().plus(zero.to_word().like(127)).shifted_left(23));
    R::select(is_nothing, zero, value * scale)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reflectances_are_those_of_double_precision() {
        use catoptric_optics::fresnel::{dielectric, schlick as schlick_in_double};
        for eta in [0.4_f32, 1.0 / 1.5, 0.999, 1.0, 1.001, 1.333, 1.5, 2.417, 10.0] {
            for step in 0..=2000_u16 {
                let cos = f32::from(step) / 2000.0;
                let exact = dielectric(f64::from(cos), 1.0 / f64::from(1.0 / eta)).mean();
                let estimate = schlick_in_double(f64::from(cos), 1.0 / f64::from(1.0 / eta));
                assert!((f64::from(schlick(cos, 1.0 / eta)) - estimate).abs() < 1e-5, "{eta} {cos}");
                let error = (f64::from(fresnel(cos, 1.0 / eta)) - exact).abs();
                // Where total reflection begins, the curve is as steep as numbers are far apart.
                let critical = (1.0 - f64::from(eta).min(1.0).powi(2)).sqrt();
                let is_steep = eta < 1.0 && (f64::from(cos) - critical).abs() < 1e-4;
                assert!(
                    error < if is_steep { 2e-3 } else { 1e-5 },
                    "{cos} into {eta}: {error:e} off {exact}"
                );
            }
        }
        let inside = fresnel(41.0_f32.to_radians().cos(), 1.5);
        assert!((inside - 0.379_751_3).abs() < 1e-5, "{inside}");
        assert_eq!((fresnel(0.3_f32, 1.0), fresnel(0.0_f32, 1.5), fresnel(0.0_f32, 1.0)), (0.0, 1.0, 0.0));
    }

    #[test]
    fn powers_are_those_of_double_precision() {
        for n in [0.0_f32, 0.5, 1.0, 2.0, 3.7, 60.0, 1000.0, 1e4, 1e6] {
            for step in 1..2000_u16 {
                let x =
                    if step < 1000 { f32::from(step) / 1000.0 } else { 1.0 - 1e-7 * f32::from(step - 1000) };
                let exact = f64::from(x).powf(f64::from(n));
                let error = (f64::from(power(x, n)) - exact).abs();
                let digits = 1.5e-7 * (2.0 + f64::from(n) * -f64::from(x).ln());
                assert!(error <= digits * exact + 1e-37, "{x}^{n}: {error:e} off {exact:e}");
            }
        }
    }
}
