//! Changes of a body's shape or anchor without a jump: sizes and the middle are kept.

use catoptric_scene::{Anchor, Body, BodyShape, ShapeKind};
use glam::{DVec3, EulerRot};

use crate::base::widgets::number::tidy;

/// Gives a body another shape. Radius and height are carried over where both shapes have them, and stand for each
/// other where not; the middle of the body stays, and a plane lies where the lowest part of the body was. A body of
/// parts keeps them, so that it becomes no simple shape, nor the other way round.
pub(super) fn reshape(body: &mut Body, kind: ShapeKind) {
    let old = body.body_shape().kind();
    if old == kind || old.is_compound() != kind.is_compound() {
        return;
    }
    if kind.is_compound() {
        return body.set_shape(kind.body_shape());
    }
    to_frame(body);
    let before = body.form().extent();
    // A plane has no sizes to carry over, and what is flat lacks one.
    let (radius, height) = before.map_or((0.5, 1.0), |[min, max]| {
        let size = max - min;
        let or_largest = |length: f64| if length > 0.0 { length } else { size.max_element() };
        (0.5 * or_largest(size.x), or_largest(size.y))
    });
    body.set_shape(BodyShape::of_size(kind, radius, height));
    let bottom = |[min, _]: [DVec3; 2]| min.y;
    let middle = |[min, max]: [DVec3; 2]| 0.5 * (min.y + max.y);
    let rise = match (before, body.form().extent()) {
        // What replaces a plane stands on it, and a plane lies under what it replaces.
        (None, new) => -new.map_or(0.0, bottom),
        (Some(old), None) => bottom(old),
        (Some(old), Some(new)) => middle(old) - middle(new),
    };
    let up = body.placement.world_from_body().matrix3 * (rise * DVec3::Y);
    if let Anchor::Frame { position, .. } = &mut body.placement.anchor {
        *position = (*position + up).map(tidy);
    }
}

/// Sets the height of a body that has one; one that is placed by two points keeps its base and direction.
pub(super) fn set_height(body: &mut Body, value: f64) {
    body.change_shape(|shape| shape.set_number("height", value));
    if let Anchor::Axis { base, top } = &mut body.placement.anchor {
        let direction = (*top - *base).try_normalize().unwrap_or(DVec3::Y);
        *top = (*base + value * direction).map(tidy);
    }
}

/// Sets the focal length of a lens or a mirror, and with it the height of a paraboloid.
pub(super) fn set_focal_length(body: &mut Body, value: f64) {
    if body.shape.focal_length().is_none() && body.parametric.is_none() {
        return;
    }
    body.change_shape(|shape| shape.set_number("focal_length", value));
    if let (Anchor::Axis { .. }, Some(height)) = (body.placement.anchor, body.shape.height()) {
        set_height(body, height);
    }
}

/// Places a body by position and rotation instead of two points; it stays where it is.
pub(super) fn to_frame(body: &mut Body) {
    let Anchor::Axis { base, .. } = body.placement.anchor else { return };
    if let Some(own) = body.height() {
        body.shape.set_height(tidy(own));
    }
    let turn = body.placement.rotation();
    // R = Rz · Ry · Rx, as the model has it.
    let (z, y, x) = turn.to_euler(EulerRot::ZYX);
    let rotation_degrees = DVec3::new(x, y, z).map(|angle| round_angle(angle.to_degrees()));
    body.placement.anchor = Anchor::Frame { position: base, rotation_degrees };
}

/// Places the body by the ends of its axis. `None` where that would turn a body that is not round about the axis: two
/// points cannot express such a turn.
pub(super) fn to_axis(body: &Body) -> Option<Body> {
    let Anchor::Frame { position: base, .. } = body.placement.anchor else { return Some(body.clone()) };
    let height = body.height()?;
    let turn = body.placement.rotation();
    let mut placed = body.clone();
    placed.placement.anchor = Anchor::Axis { base, top: (base + turn * (height * DVec3::Y)).map(tidy) };
    let scale = body.placement.scale;
    let is_round = scale.x == scale.z;
    (is_round || placed.placement.rotation().abs_diff_eq(turn, 1e-9)).then_some(placed)
}

/// An angle without the noise of its computation.
fn round_angle(degrees: f64) -> f64 {
    let near = (degrees * 1e9).round() / 1e9;
    if near == 0.0 { 0.0 } else { near }
}

#[cfg(test)]
mod tests {
    use super::*;
    use catoptric_scene::{BodyPart, ParaboloidDepth, Placement, Shape};

    fn cone(anchor: Anchor) -> Body {
        Body {
            shape: Shape::Cone { radius: 0.5, top_radius: 0.1, height: 2.0 },
            placement: Placement { anchor, scale: DVec3::new(1.5, 2.0, 1.5) },
            ..Body::default()
        }
    }

    /// Points of the surface in the world, seen without what a turn about the axis does.
    fn axis_ends(body: &Body) -> [DVec3; 2] {
        let height = body.height().unwrap();
        [0.0, height].map(|y| body.placement.world_from_body().transform_point3(y * DVec3::Y))
    }

    #[test]
    fn either_way_of_placing_leaves_the_body_where_it_is() {
        for rotation in [DVec3::ZERO, DVec3::new(30.0, 40.0, -170.0), DVec3::X * 180.0, DVec3::Z * 90.0] {
            let frame = Anchor::Frame { position: DVec3::new(1.0, -2.0, 3.0), rotation_degrees: rotation };
            let before = cone(frame);
            let placed = to_axis(&before).unwrap();
            assert!(matches!(placed.placement.anchor, Anchor::Axis { .. }));
            let mut back = placed.clone();
            to_frame(&mut back);
            for other in [&placed, &back] {
                for (a, b) in axis_ends(&before).into_iter().zip(axis_ends(other)) {
                    assert!(a.abs_diff_eq(b, 1e-8), "{rotation}: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn a_body_that_is_not_round_is_not_turned_about_its_axis() {
        let turned = Anchor::Frame { position: DVec3::ZERO, rotation_degrees: DVec3::new(0.0, 30.0, 0.0) };
        let mut body = cone(turned);
        body.placement.scale.z = 1.0;
        assert_eq!(to_axis(&body), None);
        body.placement.anchor = Anchor::Frame { position: DVec3::ZERO, rotation_degrees: DVec3::ZERO };
        assert!(to_axis(&body).is_some());
    }

    #[test]
    fn another_shape_keeps_sizes_and_the_middle() {
        let mut body = Body {
            shape: Shape::Sphere { radius: 0.75 },
            placement: Placement::at(DVec3::new(1.0, 0.75, 2.0)),
            ..Body::default()
        };
        reshape(&mut body, ShapeKind::Cylinder);
        assert_eq!(body.shape, Shape::Cylinder { radius: 0.75, height: 1.5 });
        assert_eq!(body.placement, Placement::at(DVec3::new(1.0, 0.0, 2.0)));
        reshape(&mut body, ShapeKind::Cone);
        assert_eq!(body.shape, Shape::Cone { radius: 0.75, top_radius: 0.0, height: 1.5 });
        reshape(&mut body, ShapeKind::Cube);
        assert_eq!(body.shape, Shape::Cube { size: DVec3::splat(1.5) });
        assert_eq!(body.placement, Placement::at(DVec3::new(1.0, 0.75, 2.0)));
        reshape(&mut body, ShapeKind::Plane);
        assert_eq!(body.placement, Placement::at(DVec3::new(1.0, 0.0, 2.0)));
        reshape(&mut body, ShapeKind::Sphere);
        assert_eq!(body.shape, Shape::Sphere { radius: 0.5 });
        assert_eq!(body.placement, Placement::at(DVec3::new(1.0, 0.5, 2.0)));
    }

    #[test]
    fn a_focal_length_sets_the_height_of_either_way_of_placing() {
        let shape = Shape::Paraboloid { radius: 2.0, depth: ParaboloidDepth::Height(1.0) };
        let mut free = Body { shape, ..Body::default() };
        let mut between = free.clone();
        between.placement.anchor = Anchor::Axis { base: DVec3::Y, top: DVec3::Y * 2.0 };
        for body in [&mut free, &mut between] {
            set_focal_length(body, 0.5);
            assert_eq!((body.height(), body.sized_shape().focal_length()), (Some(2.0), Some(0.5)));
        }
        assert_eq!(between.placement.anchor, Anchor::Axis { base: DVec3::Y, top: DVec3::Y * 3.0 });
        let rod = Body { shape: Shape::CYLINDER, ..between.clone() };
        let mut other = rod.clone();
        set_focal_length(&mut other, 0.5);
        assert_eq!(other, rod);
    }

    #[test]
    fn every_shape_can_become_every_other() {
        for from in ShapeKind::ALL {
            for to in ShapeKind::ALL {
                let parts = if from.is_compound() { vec![BodyPart::default()] } else { Vec::new() };
                let mut body = Body { parts, ..Body::default() };
                body.set_shape(from.body_shape());
                reshape(&mut body, to);
                // Parts are joined and taken apart elsewhere.
                let becomes = if from.is_compound() == to.is_compound() { to } else { from };
                assert_eq!(body.body_shape().kind(), becomes);
                let scene = catoptric_scene::Scene { bodies: [body].into(), ..Default::default() };
                assert_eq!(scene.check(), []);
            }
        }
    }
}
