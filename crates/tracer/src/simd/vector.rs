//! Vectors of three numbers in any width.

use std::ops::{Add, Mul, Neg, Sub};

use glam::{Vec3, Vec3A};

use crate::simd::Float;

/// No light that a surface sends on and no weight of a ray is more. Sums of products of both are finite, so that no
/// picture has an infinity in it, nor what an infinity times 0 would be.
pub(crate) const MOST_LIGHT: f32 = 1e16;

/// A point or direction, or a color, for each of the numbers side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector<R> {
    /// The first component.
    pub x: R,
    /// The second component.
    pub y: R,
    /// The third component.
    pub z: R,
}

impl<R: Float> Vector<R> {
    #[inline(always)]
    pub(crate) fn new(x: R, y: R, z: R) -> Self {
        Self { x, y, z }
    }

    /// One vector for all lanes.
    #[inline(always)]
    pub(crate) fn splat(like: R, [x, y, z]: [f32; 3]) -> Self {
        Self::new(like.like(x), like.like(y), like.like(z))
    }

    #[inline(always)]
    pub(crate) fn map(self, act: impl Fn(R) -> R) -> Self {
        Self::new(act(self.x), act(self.y), act(self.z))
    }

    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> R {
        self.z.times_plus(other.z, self.y.times_plus(other.y, self.x * other.x))
    }

    /// The sum with `direction` times `t`.
    #[inline(always)]
    pub(crate) fn plus_times(self, direction: Self, t: R) -> Self {
        Self::new(
            direction.x.times_plus(t, self.x),
            direction.y.times_plus(t, self.y),
            direction.z.times_plus(t, self.z),
        )
    }

    #[inline(always)]
    pub(crate) fn length_squared(self) -> R {
        self.dot(self)
    }

    /// Component by component.
    #[inline(always)]
    pub(crate) fn times(self, other: Self) -> Self {
        Self::new(self.x * other.x, self.y * other.y, self.z * other.z)
    }

    /// The same for all, component by component.
    #[inline(always)]
    pub(crate) fn times_all(self, [x, y, z]: [f32; 3]) -> Self {
        Self::new(self.x * x, self.y * y, self.z * z)
    }

    #[inline(always)]
    pub(crate) fn plus_all(self, [x, y, z]: [f32; 3]) -> Self {
        Self::new(self.x + x, self.y + y, self.z + z)
    }

    /// The vector of length 1, or `otherwise` where it has no direction.
    #[inline(always)]
    pub(crate) fn normalize_or(self, otherwise: Self) -> Self {
        let length = self.length_squared().sqrt();
        let has_direction = length.gt(length.like(0.0)) & length.lt(length.like(f32::INFINITY));
        Self::select(has_direction, self * (length.like(1.0) / length), otherwise)
    }

    #[inline(always)]
    pub(crate) fn select(mask: R::Mask, yes: Self, no: Self) -> Self {
        let select = |yes, no| R::select(mask, yes, no);
        Self::new(select(yes.x, no.x), select(yes.y, no.y), select(yes.z, no.z))
    }

    #[inline(always)]
    pub(crate) fn largest(self) -> R {
        self.x.max(self.y).max(self.z)
    }

    /// Light or a weight, brought within [`MOST_LIGHT`].
    #[inline(always)]
    pub(crate) fn bounded(self) -> Self {
        self.map(|part| part.min(part.like(MOST_LIGHT)).max(part.like(-MOST_LIGHT)))
    }

    /// Whether all components are 0.
    #[inline(always)]
    pub(crate) fn is_zero(self) -> R::Mask {
        let zero = self.x.like(0.0);
        self.x.eq(zero) & self.y.eq(zero) & self.z.eq(zero)
    }
}

impl From<Vec3> for Vector<f32> {
    fn from(Vec3 { x, y, z }: Vec3) -> Self {
        Self { x, y, z }
    }
}

impl From<Vec3A> for Vector<f32> {
    fn from(vector: Vec3A) -> Self {
        Vec3::from(vector).into()
    }
}

impl From<Vector<f32>> for Vec3 {
    fn from(Vector { x, y, z }: Vector<f32>) -> Self {
        Self { x, y, z }
    }
}

impl From<Vector<f32>> for [f32; 3] {
    fn from(Vector { x, y, z }: Vector<f32>) -> Self {
        [x, y, z]
    }
}

impl From<Vector<f32>> for Vec3A {
    fn from(vector: Vector<f32>) -> Self {
        Vec3::from(vector).into()
    }
}

impl<R: Float> Add for Vector<R> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<R: Float> Sub for Vector<R> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<R: Float> Mul<R> for Vector<R> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: R) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl<R: Float> Neg for Vector<R> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}
