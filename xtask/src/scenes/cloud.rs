//! A cloud of bodies of four shapes, for measuring what many bodies cost: the reference scene `cloud` for any number.

use std::path::PathBuf;

use anyhow::Result;
use catoptric_scene::{
    Anchor, Body, Camera, Color, Environment, Light, Material, MaterialChoice, NamedMaterial, Placement,
    Projection, Scene, Shape, Tracing, save, write,
};
use clap::Args;
use glam::DVec3;

use super::random::Random;

#[derive(Debug, Args)]
pub(crate) struct CloudArguments {
    /// Number of bodies
    #[arg(long, default_value_t = 1_000_000)]
    bodies: usize,
    /// The scene file to write
    #[arg(short, long, default_value = "target/cloud.toml")]
    output: PathBuf,
}

pub(crate) fn write_cloud(arguments: &CloudArguments) -> Result<()> {
    Ok(save(&arguments.output, &write(&cloud(arguments.bodies)))?)
}

const MATERIALS: u64 = 16;
/// Edge of the cube that holds the bodies' origins, meters.
const EDGE: f64 = 10.0;

/// Spheres, cubes, cylinders and cones in equal parts. Their sizes are 0.3 to 0.6 of the edge of the cube that each has
/// to itself on average, so that the cloud stays as dense for any number.
pub(crate) fn cloud(bodies: usize) -> Scene {
    let mut random = Random(1);
    let materials = (0..MATERIALS).map(|number| NamedMaterial {
        name: format!("m{number}"),
        material: Material {
            color: random.vector(0.2, 1.0).to_array().into(),
            diffuse: 0.6,
            specular: 0.5,
            shininess: 60.0,
            reflection: Some(0.3),
            ..Material::default()
        },
    });
    let materials: Vec<NamedMaterial> = materials.collect();
    let spacing = EDGE / (bodies.max(1) as f64).cbrt();
    Scene {
        camera: Camera {
            position: DVec3::new(9.0, 7.0, 14.0),
            target: DVec3::ZERO,
            projection: Projection::Perspective { fov_degrees: 38.0 },
            ..Camera::default()
        },
        tracing: Tracing { generations: 4, threshold: 0.0 },
        environment: Environment { background: Color::new(0.2, 0.35, 0.6), ambient: Color::WHITE },
        lights: vec![
            Light { position: DVec3::new(8.0, 14.0, 10.0), ..Light::default() },
            Light {
                name: "fill".to_owned(),
                position: DVec3::new(6.0, 5.0, 3.0),
                color: Color::new(1.0, 0.9, 0.8),
                intensity: 0.5,
                ..Light::default()
            },
        ],
        bodies: (0..bodies).map(|number| body(number, spacing, &mut random)).collect(),
        materials,
    }
}

fn body(number: usize, spacing: f64, random: &mut Random) -> Body {
    let size = spacing * random.number(0.3, 0.6);
    let shape = match number % 4 {
        0 => Shape::Sphere { radius: size / 2.0 },
        1 => Shape::Cube { size: DVec3::splat(size) },
        2 => Shape::Cylinder { radius: size / 3.0, height: size },
        _ => Shape::Cone { radius: size / 2.0, top_radius: 0.0, height: size },
    };
    let position = random.vector(-EDGE / 2.0, EDGE / 2.0);
    let rotation_degrees = random.vector(-180.0, 180.0);
    Body {
        shape,
        placement: Placement { anchor: Anchor::Frame { position, rotation_degrees }, scale: DVec3::ONE },
        material: MaterialChoice::Named(format!("m{}", random.below(MATERIALS))),
        ..Body::default()
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{ShapeKind, load};

    use super::*;
    use crate::root;

    #[test]
    fn a_cloud_is_a_valid_scene_and_always_the_same() {
        let scene = cloud(100);
        assert!(scene.check().is_empty(), "{:?}", scene.check());
        assert_eq!(scene, cloud(100));
        assert_eq!(scene.bodies.len(), 100);
        let spheres = scene.bodies.iter().filter(|body| body.shape.kind() == ShapeKind::Sphere);
        assert_eq!(spheres.count(), 25);
        // Known numbers: a figure of one day must mean the same scene on another.
        assert_eq!(scene.bodies[0].placement.origin(), DVec3::new(4.126902, -1.981437, -3.684151));
    }

    /// A shape's kind, its largest size, and the ratio of its two sizes.
    fn sizes(body: &Body) -> (ShapeKind, f64, f64) {
        let (size, ratio) = match body.shape {
            Shape::Sphere { radius } => (2.0 * radius, 1.0),
            Shape::Cube { size } => (size.x, size.x / size.y),
            Shape::Cylinder { radius, height } | Shape::Cone { radius, height, .. } => {
                (height, height / radius)
            }
            Shape::Plane => (0.0, 0.0),
        };
        (body.shape.kind(), size, ratio)
    }

    #[test]
    fn a_cloud_is_of_the_kind_of_the_reference() {
        let reference = load(root().join("tests/reference/cloud.toml")).unwrap().scene;
        let ours = cloud(reference.bodies.len());
        assert_eq!(
            (ours.camera, ours.environment, ours.tracing),
            (reference.camera, reference.environment, reference.tracing)
        );
        assert_eq!(ours.lights, reference.lights);
        for (ours, theirs) in ours.bodies.iter().zip(&reference.bodies) {
            let (ours, theirs) = (sizes(ours), sizes(theirs));
            assert_eq!(ours.0, theirs.0);
            assert!((ours.2 - theirs.2).abs() < 1e-4, "{ours:?} {theirs:?}");
        }
        let extremes = |scene: &Scene| {
            let sizes = scene.bodies.iter().map(|body| sizes(body).1);
            sizes.fold((f64::MAX, 0.0_f64), |(low, high), size| (low.min(size), high.max(size)))
        };
        let (ours, theirs) = (extremes(&ours), extremes(&reference));
        assert!((ours.0 - theirs.0).abs() < 0.01 && (ours.1 - theirs.1).abs() < 0.01, "{ours:?} {theirs:?}");
    }
}
