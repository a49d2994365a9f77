//! Bounding boxes and spheres of bodies and their parts.

use catoptric_scene::bounds::around;
pub use catoptric_scene::bounds::{BoundingSphere, Bounds, are_apart, ball_around, ball_of_body, of_body};
use catoptric_scene::{Body, Scene, ScenePart};

use crate::part_path::PartPath;

/// A ball around a part of a joined body; `None` for what has no end, and where there is no such part.
pub fn ball_of_part(body: &Body, part: PartPath) -> Option<BoundingSphere> {
    let ball = ball_of_body(&part.as_body(body)?)?;
    let frame = part.frame_around(body);
    // No vector becomes longer than by √‖MᵀM‖∞, and some do by as much if the axes stay perpendicular.
    let [x, y, z] = (frame.matrix3.transpose() * frame.matrix3).to_cols_array_2d();
    let stretch = [x, y, z].map(|column| column.iter().map(|entry| entry.abs()).sum()).into_iter();
    let stretch = stretch.fold(0.0, f64::max).sqrt();
    Some(BoundingSphere { center: frame.transform_point3(ball.center), radius: stretch * ball.radius })
}

/// The box around bodies and lights; `None` when there are none but planes.
fn of_parts(scene: &Scene, parts: &[ScenePart]) -> Option<Bounds> {
    let bounds = parts.iter().filter_map(|part| match *part {
        ScenePart::Body(index) => of_body(scene.bodies.get(index)?),
        ScenePart::Light(index) => Some(Bounds::at(scene.lights.get(index)?.position)),
        _ => None,
    });
    bounds.reduce(Bounds::union)
}

/// A ball around bodies and lights; `None` when there are none but planes.
pub fn ball_of_parts(scene: &Scene, parts: &[ScenePart]) -> Option<BoundingSphere> {
    let balls = parts.iter().filter_map(|part| match *part {
        ScenePart::Body(index) => ball_of_body(scene.bodies.get(index)?),
        ScenePart::Light(index) => {
            Some(BoundingSphere { center: scene.lights.get(index)?.position, radius: 0.0 })
        }
        _ => None,
    });
    Some(around(of_parts(scene, parts)?, balls))
}

/// A ball around all bodies that are not hidden; `None` when there are none but planes.
pub fn ball_of_scene(scene: &Scene) -> Option<BoundingSphere> {
    ball_around(scene.bodies.iter().filter(|body| !body.hidden))
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{Anchor, BodyPart, Placement, Shape};
    use glam::DVec3;

    use super::*;

    fn body(shape: Shape, position: DVec3, rotation_degrees: DVec3, scale: DVec3) -> Body {
        let anchor = Anchor::Frame { position, rotation_degrees };
        Body { shape, placement: Placement { anchor, scale }, ..Body::default() }
    }

    fn assert_close(bounds: Bounds, min: [f64; 3], max: [f64; 3]) {
        let off =
            (bounds.min - DVec3::from_array(min)).length() + (bounds.max - DVec3::from_array(max)).length();
        assert!(off < 1e-12, "{bounds:?} is not {min:?} … {max:?}");
    }

    #[test]
    fn parts_are_held_where_all_frames_carry_them() {
        let placement = |position, scale| {
            let rotation_degrees = DVec3::new(10.0, 20.0, 30.0);
            Placement { anchor: Anchor::Frame { position, rotation_degrees }, scale: DVec3::splat(scale) }
        };
        let part = |shape, x, parts| BodyPart {
            shape,
            placement: placement(DVec3::X * x, 2.0),
            parts,
            ..BodyPart::default()
        };
        let inner = part(Shape::Union, 3.0, vec![part(Shape::SPHERE, 1.0, Vec::new())]);
        let parts = vec![part(Shape::SPHERE, 0.0, Vec::new()), inner, part(Shape::Plane, 0.0, Vec::new())];
        let whole =
            Body { shape: Shape::Union, placement: placement(DVec3::Y, 1.5), parts, ..Body::default() };
        let ball = |places: &[usize]| ball_of_part(&whole, PartPath::by(places.iter().copied()).unwrap());
        let found = ball(&[1, 0]).unwrap();
        let frame = PartPath::by([1, 0]).unwrap().frame(&whole);
        assert!(found.center.distance(frame.translation) < 1e-12 && (found.radius - 6.0).abs() < 1e-12);
        assert_eq!((ball(&[2]), ball(&[3]), ball(&[])), (None, None, None));
    }

    #[test]
    fn scenes_and_their_parts_are_held() {
        let at = |x| body(Shape::SPHERE, DVec3::X * x, DVec3::ZERO, DVec3::ONE);
        let mut scene = Scene { bodies: [at(0.0), at(4.0), at(50.0)].into(), ..Scene::default() };
        scene.bodies[2].hidden = true;
        scene.bodies.push(Body { shape: Shape::Plane, ..Body::default() });
        scene.lights.push(catoptric_scene::Light { position: DVec3::Y * 7.0, ..Default::default() });
        assert_eq!(ball_of_scene(&scene), Some(BoundingSphere { center: DVec3::X * 2.0, radius: 3.0 }));
        let parts = [ScenePart::Body(3), ScenePart::Body(2), ScenePart::Light(0), ScenePart::Camera];
        assert_close(of_parts(&scene, &parts).unwrap(), [0.0, -1.0, -1.0], [51.0, 7.0, 1.0]);
        assert_eq!(of_parts(&scene, &parts[..1]), None);
        assert_eq!(
            ball_of_parts(&scene, &parts[2..]),
            Some(BoundingSphere { center: DVec3::Y * 7.0, radius: 0.0 })
        );
    }
}
