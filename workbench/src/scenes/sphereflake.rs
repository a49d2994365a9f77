//! Haines's sphereflake (E. Haines, A Proposal for Standard Graphics Environments, IEEE Computer Graphics and
//! Applications 7(11), 1987: "balls"): the reference scene `sphereflake` with any number of levels.

use std::f64::consts::PI;

use catoptric_scene::{
    Body, Camera, Color, Environment, Light, Material, MaterialChoice, NamedMaterial, Phong, Placement,
    Projection, Scene, Shape, Tracing,
};
use glam::{DMat3, DVec3};

const BALL: &str = "ball";

/// A sphere with nine on it, a third as large, which have nine on them, and so on for a number of levels.
pub(crate) fn sphereflake(levels: u32) -> Scene {
    let light = |position, intensity| Light { position, intensity, ..Light::default() };
    let ground = Material::Phong(Phong {
        pattern: Color::new(1.0, 0.75, 0.33).into(),
        ambient: 0.1,
        diffuse: 0.8,
        ..Phong::default()
    });
    let ball = Material::Phong(Phong {
        pattern: Color::new(1.0, 0.9, 0.7).into(),
        ambient: 0.1,
        diffuse: 0.4,
        specular: 0.3,
        shininess: 30.0,
        reflection: Some(0.5),
        ..Phong::default()
    });
    let mut bodies = vec![Body {
        name: "ground".to_owned(),
        shape: Shape::Plane,
        placement: Placement::at(DVec3::new(0.0, -0.9, 0.0)),
        material: MaterialChoice::Inline(Box::new(ground)),
        ..Body::default()
    }];
    add(&mut bodies, DVec3::ZERO, DVec3::Y, 1.0, levels);
    Scene {
        camera: Camera {
            position: DVec3::new(2.1, 1.7, 3.2),
            target: DVec3::new(0.0, 0.1, 0.0),
            projection: Projection::Perspective { fov_degrees: 38.0 },
            ..Camera::default()
        },
        environment: Environment {
            background: Color::new(0.08, 0.36, 0.6),
            ambient: Color::gray(0.2),
            ..Environment::default()
        },
        tracing: Tracing { generations: 5, threshold: 0.0 },
        materials: vec![NamedMaterial { name: BALL.to_owned(), material: ball }],
        lights: vec![light(DVec3::new(4.0, 3.0, 2.0), 0.6), light(DVec3::new(1.0, 4.0, 4.0), 0.5)],
        bodies: bodies.into(),
    }
}

/// Adds a sphere that stands out along `axis`, and those on it.
fn add(bodies: &mut Vec<Body>, center: DVec3, axis: DVec3, radius: f64, levels: u32) {
    if levels == 0 {
        return;
    }
    // Nine digits keep the file short.
    let [x, y, z] = center.to_array().map(|value| (value * 1e9).round() / 1e9);
    bodies.push(Body {
        shape: Shape::Sphere { radius: (radius * 1e9).round() / 1e9 },
        placement: Placement::at(DVec3::new(x, y, z)),
        material: MaterialChoice::Named(BALL.to_owned()),
        ..Body::default()
    });
    // The other axes are those of the reference: one lies across the world's X, or Y where X is too near.
    let helper = if axis.x.abs() > 0.9 { DVec3::Y } else { DVec3::X };
    let across = helper.cross(axis).normalize_or_zero();
    let world_from_sphere = DMat3::from_cols(axis.cross(across), axis, across);
    for direction in directions() {
        let direction = world_from_sphere * direction;
        let place = center + direction * (radius * 4.0 / 3.0);
        add(bodies, place, direction, radius / 3.0, levels - 1);
    }
}

/// Where the nine stand on a sphere that stands out along +Y: six on the equator, three between them and the pole.
fn directions() -> impl Iterator<Item = DVec3> {
    let turned = |sixths: f64| {
        let (sin, cos) = (sixths * PI / 3.0).sin_cos();
        DVec3::new(-sin, 0.0, -cos)
    };
    let equator = (0..6).map(move |number| turned(f64::from(number)));
    let upper = (0..3).map(move |number| {
        turned(0.5 + 2.0 * f64::from(number)) * (1.0 / 3.0_f64).sqrt() + DVec3::Y * (2.0 / 3.0_f64).sqrt()
    });
    equator.chain(upper)
}

#[cfg(test)]
mod tests {
    use catoptric_store::load;

    use super::*;
    use xtask::root;

    #[test]
    fn four_levels_are_the_reference() {
        let reference = load(root().join("tests/reference/sphereflake.toml")).unwrap().scene;
        let ours = sphereflake(4);
        assert_eq!(
            (ours.camera, ours.environment, ours.tracing),
            (reference.camera, reference.environment, reference.tracing)
        );
        assert_eq!((&ours.lights, &ours.materials), (&reference.lights, &reference.materials));
        assert_eq!(ours.bodies[0], reference.bodies[0]);
        assert_eq!(ours.bodies.len(), reference.bodies.len());
        for (ours, theirs) in ours.bodies.iter().zip(&reference.bodies) {
            // The reference's angles have few digits.
            assert!(ours.placement.origin().distance(theirs.placement.origin()) < 1e-4);
            assert_eq!(ours.material, theirs.material);
            if let (Shape::Sphere { radius: a }, Shape::Sphere { radius: b }) = (ours.shape, theirs.shape) {
                assert!((a - b).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn five_levels_have_7381_spheres() {
        let scene = sphereflake(5);
        assert!(scene.check().is_empty(), "{:?}", scene.check());
        assert_eq!(scene.bodies.len(), 1 + 7381);
    }
}
