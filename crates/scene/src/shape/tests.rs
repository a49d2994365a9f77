//! What all shapes answer, held against points of their surfaces.

use glam::dvec3;

use super::*;

fn shapes() -> [Shape; 8] {
    [
        Shape::Sphere { radius: 0.7 },
        Shape::Cube { size: dvec3(1.0, 2.0, 3.0) },
        Shape::Cylinder { radius: 0.5, height: 2.0 },
        Shape::CONE,
        Shape::Cone { radius: 1.0, top_radius: 0.25, height: 2.0 },
        Shape::Cone { radius: 0.2, top_radius: 1.5, height: 0.5 },
        Shape::PARABOLOID,
        Shape::Paraboloid { radius: 2.0, depth: ParaboloidDepth::FocalLength(1.5) },
    ]
}

/// Directions all around, evenly.
fn directions() -> impl Iterator<Item = DVec3> {
    (0..400).map(|step| {
        let (turn, height) = (2.4 * f64::from(step), f64::from(step) / 199.5 - 1.0);
        let (sine, cosine) = turn.sin_cos();
        let across = (1.0 - height * height).max(0.0).sqrt();
        dvec3(across * cosine, height, across * sine)
    })
}

#[test]
fn sizes_are_found_and_set_by_their_keys() {
    let mut cone = Shape::CONE;
    cone.set_number("top_radius", 0.2);
    cone.set_height(3.0);
    cone.set_vector("size", DVec3::ONE);
    assert_eq!(cone, Shape::Cone { radius: 0.5, top_radius: 0.2, height: 3.0 });
    assert_eq!(cone.scaled(2.0), Shape::Cone { radius: 1.0, top_radius: 0.4, height: 6.0 });
    assert_eq!((Shape::SPHERE.height(), Shape::Plane.number("radius")), (None, None));
    assert_eq!(Shape::CUBE.scaled(3.0).vector("size"), Some(DVec3::splat(3.0)));
    assert_eq!(ShapeKind::Cube.of_size(0.5, 2.0), Shape::Cube { size: dvec3(1.0, 2.0, 1.0) });
    for kind in ShapeKind::SIMPLE {
        assert_eq!((kind.shape().kind(), ShapeKind::of_key(kind.key())), (kind, Some(kind)));
    }
}

/// The extent is what the support function tells along the axes, and no point lies beyond the ball.
#[test]
fn extent_support_and_ball_agree() {
    for shape in shapes() {
        let [min, max] = shape.extent().unwrap();
        for axis in DVec3::AXES {
            assert!((shape.support(axis).unwrap() - max.dot(axis)).abs() < 1e-12, "{shape:?}");
            assert!((shape.support(-axis).unwrap() + min.dot(axis)).abs() < 1e-12, "{shape:?}");
        }
        for scale in [DVec3::ONE, dvec3(0.3, 2.0, 1.5)] {
            let (center, radius) = shape.ball(scale).unwrap();
            for direction in directions() {
                let reach = shape.support(scale * direction).unwrap() - (scale * center).dot(direction);
                assert!(reach < radius + 1e-12, "{shape:?} along {direction}");
            }
        }
    }
}

/// The plane through the eye and the tangent of the outline touches the shape: nothing lies beyond it.
#[test]
fn the_eye_looks_past_at_curved_outlines() {
    let eye = dvec3(3.0, 1.7, -2.0);
    for shape in shapes() {
        let mut touched = 0;
        for line in shape.outline(eye) {
            for pair in line.windows(2) {
                let [from, to] = [pair[0], pair[1]];
                let normal = (to - from).cross(from - eye).normalize_or_zero();
                for side in [normal, -normal] {
                    let beyond = shape.support(side).unwrap() - side.dot(eye);
                    touched += usize::from(beyond.abs() < 2e-3);
                }
            }
        }
        assert!(touched >= 2, "{shape:?}: {touched}");
    }
    assert!(Shape::SPHERE.outline(DVec3::ZERO).is_empty());
    assert_eq!(Shape::CUBE.outline(eye).len(), 12);
    assert!(Shape::Plane.outline(eye).is_empty() && Shape::Plane.extent().is_none());
}
