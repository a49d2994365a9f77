//! The canonical shapes: where a ray crosses them, and their normals.
//!
//! Sizes are part of the transform, so that each shape has one standard form of extent about 1, whatever the body's
//! size: the unit ball, the cube [-1, 1]³, the cylinder and the frustum of base radius 1 with 0 ≤ y ≤ 1, the
//! paraboloid's cap x² + z² ≤ y ≤ 1, the half-space y ≤ 0. All are convex: a line meets them in one [`ShapeSpan`] or not at all.

pub(crate) mod cone;
pub(crate) mod cube;
pub(crate) mod cylinder;
pub(crate) mod paraboloid;
pub(crate) mod plane;
pub(crate) mod slab;
pub(crate) mod solid;
pub(crate) mod sphere;

use crate::geometry::shape::solid::Solid;
use crate::simd::vector::Vector;
use crate::simd::{Float, Mask as _};

/// Which canonical shape, as it stands in the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u32)]
pub enum ShapeKind {
    /// The unit ball, evenly scaled: a sphere.
    Sphere = 0,
    /// The cube [-1, 1]³.
    Cube = 1,
    /// x² + z² ≤ 1, 0 ≤ y ≤ 1.
    Cylinder = 2,
    /// x² + z² ≤ (1 + (k - 1)·y)², 0 ≤ y ≤ 1, with 0 ≤ k ≤ 1 the ratio of top to base radius.
    Cone = 3,
    /// y ≤ 0.
    Plane = 4,
    /// The unit ball, stretched.
    Ellipsoid = 5,
    /// x² + z² ≤ y ≤ 1.
    Paraboloid = 6,
    /// What is joined of others within the cube [-1, 1]³; rays are asked of its parts.
    Joined = 7,
    /// What is joined of others and has no end.
    JoinedEndless = 8,
}

impl ShapeKind {
    /// Whether it has caps besides its curved side; surfaces are without them.
    pub(crate) fn has_caps(self) -> bool {
        matches!(self, Self::Cylinder | Self::Cone | Self::Paraboloid)
    }

    /// What the shape is asked for besides where rays meet it.
    pub(crate) fn solid(self) -> &'static dyn Solid {
        match self {
            Self::Sphere | Self::Ellipsoid => &sphere::UnitBall,
            Self::Cube | Self::Joined => &cube::UnitCube,
            Self::Cylinder => &cylinder::UnitCylinder,
            Self::Cone => &cone::Frustum,
            Self::Paraboloid => &paraboloid::ParaboloidCap,
            Self::Plane | Self::JoinedEndless => &plane::HalfSpace,
        }
    }
}

/// A part of a shape's surface with one formula for its normal: a small whole number, kept as a [`Float`] since rays side
/// by side may meet different faces.
pub type FaceId = f32;

/// The curved part of a cylinder, cone or paraboloid, and the only face of spheres and planes.
pub const SIDE: FaceId = 0.0;
/// The lower cap of a cylinder or cone.
pub const LOWER_CAP: FaceId = 1.0;
/// The upper cap of a cylinder, frustum or paraboloid.
pub const UPPER_CAP: FaceId = 2.0;

/// Where a line enters and leaves a convex shape.
///
/// When the line misses, `exit` is still the best parameter for a ray that is known to start inside: near a tangent,
/// rounding can make a chord of length almost zero look like a miss.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapeSpan<R: Float = f32> {
    /// Parameter at which the line enters; may be negative or -∞.
    pub enter: R,
    /// Parameter at which it leaves; may be +∞.
    pub exit: R,
    /// [`FaceId`] crossed at `enter`.
    pub enter_face: R,
    /// [`FaceId`] crossed at `exit`.
    pub exit_face: R,
    /// Whether the line meets the shape. False whenever a number is NaN.
    pub hit: R::Mask,
}

impl<R: Float> ShapeSpan<R> {
    /// The chord of a circle or ball of the squared radius `radius_squared`: `closest` is the parameter of the line's
    /// closest approach to the center, where it is √`offset_squared` away from it, and `inverse_dd` the inverse square
    /// of the direction's length.
    ///
    /// With o' the point of closest approach, the half chord is √((r² - o'·o') / (d·d)). The discriminant arises from
    /// lengths about r, not as a difference of large squares, and stays accurate when the origin is far away (Haines,
    /// Günther, Akenine-Möller 2019, Ray Tracing Gems, ch. 7).
    #[inline(always)]
    fn chord(closest: R, radius_squared: R, offset_squared: R, inverse_dd: R) -> Self {
        let zero = closest.like(0.0);
        let half_squared = (radius_squared - offset_squared) * inverse_dd;
        let hit = half_squared.ge(zero);
        let face = closest.like(SIDE);
        // Most rays miss most bodies, and roots are dear.
        let half = if hit.any() { half_squared.max(zero).sqrt() } else { zero };
        Self { enter: closest - half, exit: closest + half, enter_face: face, exit_face: face, hit }
    }

    /// The part that lies in both spans; a later entry and an earlier exit win together with their faces.
    #[inline(always)]
    fn intersect(self, other: Self) -> Self {
        let (later, earlier) = (other.enter.gt(self.enter), other.exit.lt(self.exit));
        let enter = R::select(later, other.enter, self.enter);
        let exit = R::select(earlier, other.exit, self.exit);
        Self {
            enter,
            exit,
            enter_face: R::select(later, other.enter_face, self.enter_face),
            exit_face: R::select(earlier, other.exit_face, self.exit_face),
            hit: self.hit & other.hit & enter.le(exit),
        }
    }
}

/// A canonical shape with the one parameter that a transform cannot express, in the precision of its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CanonicalShape<T = f32> {
    /// Which shape.
    pub kind: ShapeKind,
    /// Ratio k of top to base radius, 0 to 1; cones only.
    pub cone_ratio: T,
}

impl CanonicalShape {
    /// The shape for numbers side by side.
    #[inline(always)]
    pub(crate) fn like<R: Float>(&self, number: R) -> CanonicalShape<R> {
        CanonicalShape { kind: self.kind, cone_ratio: number.like(self.cone_ratio) }
    }
}

impl<R: Float> CanonicalShape<R> {
    /// Where the line `origin + t·direction` (in the shape's frame, direction of any length) crosses the shape.
    #[inline(always)]
    pub fn span(&self, origin: Vector<R>, direction: Vector<R>) -> ShapeSpan<R> {
        match self.kind {
            ShapeKind::Sphere | ShapeKind::Ellipsoid => sphere::span(origin, direction),
            ShapeKind::Cube | ShapeKind::Joined => cube::span(origin, direction),
            ShapeKind::Cylinder => cylinder::span(origin, direction),
            ShapeKind::Cone => cone::span(self.cone_ratio, origin, direction),
            ShapeKind::Paraboloid => paraboloid::span(origin, direction),
            ShapeKind::Plane | ShapeKind::JoinedEndless => plane::span(origin.y, direction.y),
        }
    }

    /// The point of `face` nearest to `point`, which lies on it but for rounding.
    #[inline(always)]
    pub fn pull_to_surface(&self, face: R, point: Vector<R>) -> Vector<R> {
        match self.kind {
            ShapeKind::Sphere | ShapeKind::Ellipsoid => sphere::pull_to_surface(point),
            ShapeKind::Cube | ShapeKind::Joined => cube::pull_to_surface(face, point),
            ShapeKind::Cylinder => cone::pull_to_surface(face.like(1.0), face, point),
            ShapeKind::Cone => cone::pull_to_surface(self.cone_ratio, face, point),
            ShapeKind::Paraboloid => paraboloid::pull_to_surface(face, point),
            ShapeKind::Plane | ShapeKind::JoinedEndless => plane::pull_to_surface(point),
        }
    }

    /// Outward normal of `face` at `point` on it, of any length above 0.
    #[inline(always)]
    pub fn normal(&self, face: R, point: Vector<R>) -> Vector<R> {
        match self.kind {
            ShapeKind::Sphere | ShapeKind::Ellipsoid => point,
            ShapeKind::Cube | ShapeKind::Joined => cube::normal(face),
            ShapeKind::Cylinder => cone::normal(face.like(1.0), face, point),
            ShapeKind::Cone => cone::normal(self.cone_ratio, face, point),
            ShapeKind::Paraboloid => paraboloid::normal(face, point),
            ShapeKind::Plane | ShapeKind::JoinedEndless => Vector::splat(face, [0.0, 1.0, 0.0]),
        }
    }

    /// Whether `point` lies in the shape or on its surface.
    #[inline(always)]
    pub fn contains(&self, point: Vector<R>) -> R::Mask {
        let (zero, one) = (point.y.like(0.0), point.y.like(1.0));
        match self.kind {
            ShapeKind::Sphere | ShapeKind::Ellipsoid => point.length_squared().le(one),
            ShapeKind::Cube | ShapeKind::Joined => point.map(R::abs).largest().le(one),
            ShapeKind::Cylinder => cone::contains(one, point),
            ShapeKind::Cone => cone::contains(self.cone_ratio, point),
            ShapeKind::Paraboloid => paraboloid::contains(point),
            ShapeKind::Plane | ShapeKind::JoinedEndless => point.y.le(zero),
        }
    }
}

#[cfg(test)]
mod tests;
