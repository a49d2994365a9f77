//! The place, size and rotation of a new body.

use catoptric_scene::{Anchor, Body, Placement, Scene, Shape, ShapeKind};
use glam::DVec3;

use crate::bounds;

/// The place, size and rotation of a new body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewBodyPlacement {
    /// The point under the middle of the body that it rests on, meters.
    pub foot: DVec3,
    /// How large the body is, as a multiple of its shape's default sizes; more than 0.
    pub size: f64,
    /// The turns about X, Y and Z, degrees.
    pub rotation_degrees: DVec3,
}

impl NewBodyPlacement {
    /// A place for a body of default size that is not turned.
    pub const fn at(foot: DVec3) -> Self {
        Self { foot, size: 1.0, rotation_degrees: DVec3::ZERO }
    }

    /// A body of this shape here, without a name, in the default material.
    pub fn body(&self, shape: ShapeKind) -> Body {
        let anchor = Anchor::Frame { position: self.foot, rotation_degrees: self.rotation_degrees };
        let placement = Placement { anchor, ..Placement::default() };
        let shape = shape.body_shape().scaled(self.size);
        let mut body = Body { placement, ..Body::of_shape(shape) };
        if let Some(bounds) = bounds::of_body(&body) {
            body.placement = body.placement.moved_by(DVec3::Y * (self.foot.y - bounds.min.y));
        }
        body
    }

    /// Whether a body here is found to be apart from all others that are shown. Planes do not count, nor do bodies of
    /// `rooms` (places in [`Scene::bodies`]), which surround the view.
    pub fn is_free(&self, shape: ShapeKind, scene: &Scene, rooms: &[usize]) -> bool {
        let body = self.body(shape);
        let others = scene.bodies.iter().enumerate();
        let mut others = others.filter(|(index, other)| !other.hidden && !rooms.contains(index));
        shape == ShapeKind::Plane
            || others.all(|(_, other)| other.shape == Shape::Plane || bounds::are_apart(&body, other))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bodies_rest_on_their_foot_at_their_size() {
        let foot = DVec3::new(1.0, 0.3, -2.0);
        for (shape, height) in [
            (ShapeKind::Sphere, 2.0),
            (ShapeKind::Cube, 1.0),
            (ShapeKind::Cylinder, 1.0),
            (ShapeKind::Cone, 1.0),
            (ShapeKind::Paraboloid, 1.0),
        ] {
            let placement = NewBodyPlacement { size: 0.05, ..NewBodyPlacement::at(foot) };
            let bounds = bounds::of_body(&placement.body(shape)).unwrap();
            assert!((bounds.min.y - 0.3).abs() < 1e-12, "{shape:?}: {bounds:?}");
            assert!((bounds.size().y - 0.05 * height).abs() < 1e-12, "{shape:?}: {bounds:?}");
            assert!((bounds.center() - foot).with_y(0.0).length() < 1e-12);
        }
        assert_eq!(NewBodyPlacement::at(foot).body(ShapeKind::Plane).placement, Placement::at(foot));
    }

    #[test]
    fn bodies_may_touch_but_not_overlap() {
        let below = NewBodyPlacement::at(DVec3::Y * 0.1).body(ShapeKind::Cube);
        let mut scene = Scene { bodies: [below].into(), ..Scene::default() };
        let on_top = NewBodyPlacement::at(DVec3::Y * 1.1);
        assert!(on_top.is_free(ShapeKind::Sphere, &scene, &[]));
        assert!(!NewBodyPlacement::at(DVec3::Y).is_free(ShapeKind::Sphere, &scene, &[]));
        assert!(NewBodyPlacement::at(DVec3::Y).is_free(ShapeKind::Sphere, &scene, &[0]));
        scene.bodies[0].hidden = true;
        assert!(NewBodyPlacement::at(DVec3::Y).is_free(ShapeKind::Sphere, &scene, &[]));
        assert!(NewBodyPlacement::at(DVec3::Y).is_free(ShapeKind::Plane, &scene, &[]));
    }
}
