//! Triangles by their corners, seen from both sides.

use catoptric_scene::{
    Anchor, BodyShape, ParametricShape, Placement, Triangle, VisibleSide, rotation_degrees,
};
use glam::{DQuat, DVec3};

/// The triangle of these corners of the world, at the first of them.
pub(crate) fn triangle_at([a, b, c]: [DVec3; 3]) -> (BodyShape, Placement) {
    let shape = Triangle { a: DVec3::ZERO, b: b - a, c: c - a, side: VisibleSide::Both };
    (BodyShape::Parametric(ParametricShape::Triangle(shape)), Placement::at(a))
}

/// The triangle of these corners of the world, about its middle, with its plane y = 0 of its own frame, which is turned
/// along the shortest arc.
pub(crate) fn level_triangle_at(corners: [DVec3; 3]) -> (BodyShape, Placement) {
    let [a, b, c] = corners;
    let position = (a + b + c) / 3.0;
    let normal = (b - a).cross(c - a).normalize_or(DVec3::Y);
    let turn = DQuat::from_rotation_arc(DVec3::Y, normal);
    let own = |corner: DVec3| {
        let own = turn.inverse() * (corner - position);
        DVec3::new(own.x, 0.0, own.z)
    };
    let shape = Triangle { a: own(a), b: own(b), c: own(c), side: VisibleSide::Both };
    let anchor = Anchor::Frame { position, rotation_degrees: rotation_degrees(turn) };
    let placement = Placement { anchor, scale: DVec3::ONE };
    (BodyShape::Parametric(ParametricShape::Triangle(shape)), placement)
}
