//! The five canonical shapes: where a ray crosses them, and their normals.
//!
//! Sizes are part of the transform, so that each shape has one standard form of extent about 1, whatever the body's
//! size: the unit ball, the cube [-1, 1]³, the cylinder and the frustum of base radius 1 with 0 ≤ y ≤ 1, the
//! half-space y ≤ 0. All are convex: a line meets them in one [`Span`] or not at all.

mod cone;
mod cube;
mod cylinder;
mod plane;
mod slab;
mod sphere;

use glam::Vec3A;

/// Which canonical shape, as it stands in the stage.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u32)]
pub enum ShapeKind {
    /// The unit ball.
    Sphere = 0,
    /// The cube [-1, 1]³.
    Cube = 1,
    /// x² + z² ≤ 1, 0 ≤ y ≤ 1.
    Cylinder = 2,
    /// x² + z² ≤ (1 + (k - 1)·y)², 0 ≤ y ≤ 1, with 0 ≤ k ≤ 1 the ratio of top to base radius.
    Cone = 3,
    /// y ≤ 0.
    Plane = 4,
}

/// A part of a shape's surface with one formula for its normal.
pub type Face = u32;

/// The curved part of a cylinder or cone, and the only face of spheres and planes.
pub const SIDE: Face = 0;
/// The lower cap of a cylinder or cone.
pub const LOWER_CAP: Face = 1;
/// The upper cap of a cylinder or frustum.
pub const UPPER_CAP: Face = 2;

/// Where a line enters and leaves a convex shape.
///
/// When the line misses, `exit` is still the best parameter for a ray that is known to start inside: near a tangent,
/// rounding can make a chord of length almost zero look like a miss.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Parameter at which the line enters; may be negative or -∞.
    pub enter: f32,
    /// Parameter at which it leaves; may be +∞.
    pub exit: f32,
    /// Face crossed at `enter`.
    pub enter_face: Face,
    /// Face crossed at `exit`.
    pub exit_face: Face,
    /// Whether the line meets the shape. False whenever a number is NaN.
    pub hit: bool,
}

impl Span {
    /// The span from `enter` to `exit` through one face; a hit if it is not empty.
    fn new(enter: f32, exit: f32, face: Face) -> Self {
        Self { enter, exit, enter_face: face, exit_face: face, hit: enter <= exit }
    }

    /// The chord of a unit circle or ball: `closest` is the parameter of the line's closest approach to the center,
    /// where it is √`offset_squared` away from it, and `dd` the square of the direction's length.
    ///
    /// With o' the point of closest approach, the half chord is √((1 - o'·o') / (d·d)). The discriminant arises from lengths about 1, not as a difference of
    /// large squares, and stays accurate when the origin is far away (Haines, Günther, Akenine-Möller 2019, Ray Tracing
    /// Gems, ch. 7).
    #[inline(always)]
    fn chord(closest: f32, offset_squared: f32, dd: f32) -> Self {
        let half_squared = (1.0 - offset_squared) / dd;
        if half_squared >= 0.0 {
            let half = half_squared.sqrt();
            Self::new(closest - half, closest + half, SIDE)
        } else {
            Self::miss(closest)
        }
    }

    /// All of the line, if it lies in an unbounded shape at all.
    fn everywhere(enter_face: Face, exit_face: Face, hit: bool) -> Self {
        Self { enter: f32::NEG_INFINITY, exit: f32::INFINITY, enter_face, exit_face, hit }
    }

    /// A miss that came closest at `t`.
    fn miss(t: f32) -> Self {
        Self { enter: t, exit: t, enter_face: SIDE, exit_face: SIDE, hit: false }
    }

    /// The part that lies in both spans; a later entry and an earlier exit win together with their faces.
    fn intersect(self, other: Self) -> Self {
        let (enter, enter_face) = if other.enter > self.enter {
            (other.enter, other.enter_face)
        } else {
            (self.enter, self.enter_face)
        };
        let (exit, exit_face) =
            if other.exit < self.exit { (other.exit, other.exit_face) } else { (self.exit, self.exit_face) };
        Self { enter, exit, enter_face, exit_face, hit: self.hit && other.hit && enter <= exit }
    }
}

/// A canonical shape with the one parameter that a transform cannot express.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Canonical {
    /// Which shape.
    pub kind: ShapeKind,
    /// Ratio k of top to base radius, 0 to 1; cones only.
    pub cone_ratio: f32,
}

impl Canonical {
    /// Where the line `origin + t·direction` (in the shape's frame, direction of any length) crosses the shape.
    #[inline(always)]
    pub fn span(&self, origin: Vec3A, direction: Vec3A) -> Span {
        match self.kind {
            ShapeKind::Sphere => sphere::span(origin, direction),
            ShapeKind::Cube => cube::span(origin, direction),
            ShapeKind::Cylinder => cylinder::span(origin, direction),
            ShapeKind::Cone => cone::span(self.cone_ratio, origin, direction),
            ShapeKind::Plane => plane::span(origin.y, direction.y),
        }
    }

    /// The point of `face` nearest to `point`, which lies on it but for rounding.
    pub fn pull_to_surface(&self, face: Face, point: Vec3A) -> Vec3A {
        match self.kind {
            ShapeKind::Sphere => sphere::pull_to_surface(point),
            ShapeKind::Cube => cube::pull_to_surface(face, point),
            ShapeKind::Cylinder => cone::pull_to_surface(1.0, face, point),
            ShapeKind::Cone => cone::pull_to_surface(self.cone_ratio, face, point),
            ShapeKind::Plane => plane::pull_to_surface(point),
        }
    }

    /// Outward normal of `face` at `point` on it, of any length above 0.
    pub fn normal(&self, face: Face, point: Vec3A) -> Vec3A {
        match self.kind {
            ShapeKind::Sphere => sphere::normal(point),
            ShapeKind::Cube => cube::normal(face),
            ShapeKind::Cylinder => cone::normal(1.0, face, point),
            ShapeKind::Cone => cone::normal(self.cone_ratio, face, point),
            ShapeKind::Plane => Vec3A::Y,
        }
    }

    /// Whether `point` lies in the shape or on its surface.
    pub fn contains(&self, point: Vec3A) -> bool {
        match self.kind {
            ShapeKind::Sphere => point.length_squared() <= 1.0,
            ShapeKind::Cube => point.abs().max_element() <= 1.0,
            ShapeKind::Cylinder => cone::contains(1.0, point),
            ShapeKind::Cone => cone::contains(self.cone_ratio, point),
            ShapeKind::Plane => point.y <= 0.0,
        }
    }
}

#[cfg(test)]
mod tests;
