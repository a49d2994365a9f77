//! Rays and where they start.

use glam::Vec3A;

use crate::simd::scalar::ScalarWidth;
use crate::simd::vector::Vector;
use crate::simd::{Float32, Width};

/// Stands for "no body" wherever a body's index is kept.
pub const NO_BODY: u32 = u32::MAX;

/// Relative rounding error granted to a point that went through a few transforms.
///
/// A transform of a point is three products and three sums, γ₄ ≈ 4u with u = ε/2 (Higham 2002, Accuracy and Stability of
/// Numerical Algorithms, sec. 3.1); the hit point goes through two of them and the other body's own two more. That makes
/// 16u = 8ε, and this is twice the bound.
pub(crate) const POINT_ROUNDING: f32 = 16.0 * f32::EPSILON;

/// A half-line in world space.
///
/// Vectors that go through the tracer are `Vec3A`, which is kept and moved as one piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Start, meters.
    pub origin: Vec3A,
    /// Unit direction, so that the ray parameter t is the distance in meters.
    pub direction: Vec3A,
    /// What is known about the start.
    pub start: RayOrigin,
}

impl Ray {
    /// A ray from a free point in space, such as the eye.
    pub fn from_point(origin: impl Into<Vec3A>, direction: impl Into<Vec3A>) -> Self {
        Self { origin: origin.into(), direction: direction.into(), start: RayOrigin::FREE }
    }

    /// The point at parameter `t`.
    pub fn at(&self, t: f32) -> Vec3A {
        self.origin + self.direction * t
    }

    /// The ray by itself, as rays side by side are written.
    pub(crate) fn alone(&self) -> RayPacket<ScalarWidth> {
        RayPacket { origin: self.origin.into(), direction: self.direction.into(), start: self.start.word() }
    }
}

/// Rays side by side.
#[derive(Clone, Copy)]
pub(crate) struct RayPacket<W: Width> {
    pub origin: Vector<W::R>,
    /// Of length 1.
    pub direction: Vector<W::R>,
    /// [`RayOrigin::word`] of each.
    pub start: W::W,
}

/// The bit of a start's word that says that the ray heads into the body.
pub(crate) const INWARDS: u32 = 1 << 31;
/// The start's word without a body, and the bits of the body in all others.
pub(crate) const NO_START: u32 = !INWARDS;

impl<W: Width> RayPacket<W> {
    /// Gives them other origins and directions.
    #[inline(always)]
    pub(crate) fn set(&mut self, (origin, direction): (Vector<W::R>, Vector<W::R>)) {
        (self.origin, self.direction) = (origin, direction);
    }

    /// How far the starts may lie from their true places by rounding, meters.
    #[inline(always)]
    pub(crate) fn error_bound(&self) -> W::R {
        error_bound_at(self.origin)
    }
}

/// How far points may lie from their true places by rounding, meters.
#[inline(always)]
pub(crate) fn error_bound_at<R: Float32>(point: Vector<R>) -> R {
    point.map(R::abs).largest() * POINT_ROUNDING
}

impl RayPacket<ScalarWidth> {
    pub(crate) fn ray(&self) -> Ray {
        Ray {
            origin: self.origin.into(),
            direction: self.direction.into(),
            start: RayOrigin::of_word(self.start),
        }
    }
}

/// What is known about a ray's start: the surface it lies on and the side it heads to.
///
/// All bodies are convex. A ray that leaves a body's surface outwards can therefore never meet that body again, and
/// one that heads inwards meets it exactly once more, at the far root. Remembering body and side settles every
/// question of self-intersection without an epsilon, at any scale and any angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RayOrigin {
    /// The body whose surface the ray starts on, or [`NO_BODY`].
    pub body: u32,
    /// Whether the ray heads into that body.
    pub inwards: bool,
}

impl RayOrigin {
    /// On no surface.
    pub const FREE: Self = Self { body: NO_BODY, inwards: false };

    /// Body and side in one word.
    pub(crate) fn word(self) -> u32 {
        (self.body & NO_START) | if self.inwards { INWARDS } else { 0 }
    }

    pub(crate) fn of_word(word: u32) -> Self {
        let body = word & NO_START;
        Self { body: if body == NO_START { NO_BODY } else { body }, inwards: word & INWARDS != 0 }
    }
}
