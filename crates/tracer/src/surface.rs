//! How a surface answers light: directions of reflected and refracted rays, and the local terms.

use glam::Vec3A;

/// The direction of the reflected ray, D - 2(n̂·D)n̂ (Whitted 1980), for a unit normal; of the same length as D.
#[inline]
pub fn reflect(direction: Vec3A, normal: Vec3A) -> Vec3A {
    direction - 2.0 * normal.dot(direction) * normal
}

/// A vector whose length is 1 but for rounding, with that rounding mended: one step of Newton's iteration for 1/√(v·v)
/// from 1, without root or division.
#[inline]
pub(crate) fn mend_unit(vector: Vec3A) -> Vec3A {
    vector * (1.5 - 0.5 * vector.length_squared())
}

/// The direction of the refracted ray by Snell's law in vector form (Heckbert 1989, An Introduction to Ray Tracing,
/// ch. 4), or `None` at total internal reflection.
///
/// `direction` and `normal` are unit vectors with the normal facing the ray; `ratio` is the index of the medium the ray
/// comes from divided by that of the one it goes to. At equal indices the ray goes straight on.
#[inline]
pub fn refract(direction: Vec3A, normal: Vec3A, ratio: f32) -> Option<Vec3A> {
    if ratio == 1.0 {
        return Some(direction);
    }
    let cos_in = -direction.dot(normal);
    let cos_out_squared = 1.0 - ratio * ratio * (1.0 - cos_in * cos_in);
    if cos_out_squared < 0.0 {
        return None;
    }
    Some(mend_unit(ratio * direction + (ratio * cos_in - cos_out_squared.sqrt()) * normal))
}

/// The share (Ŝ·R̂)⁺ⁿ of Phong's highlight (Phong 1975), with R̂ the direction to the light mirrored about the normal
/// and Ŝ the direction to the viewer. All are unit vectors.
#[inline]
pub fn phong_highlight(to_viewer: Vec3A, to_light: Vec3A, normal: Vec3A, shininess: f32) -> f32 {
    /// e⁻³⁰ of the brightest light that a scene may have, 10⁶, is nothing in single precision.
    const INVISIBLE: f32 = 30.0;
    // Rounding may make the product of two unit vectors more than 1, and a power of it much more.
    let cos = (-to_viewer.dot(reflect(to_light, normal))).min(1.0);
    // ln x ≤ x - 1, so that the power is at most exp(-n·(1 - cos)): what is certain to vanish is not computed.
    if cos > 0.0 && shininess * (1.0 - cos) < INVISIBLE { cos.powf(shininess) } else { 0.0 }
}
