//! The cloud of bodies as a scene file: the reference scene `cloud` for any number.

use std::path::PathBuf;

use anyhow::Result;
use catoptric_lab::cloud::cloud;
use catoptric_scene::write;
use catoptric_store::save;
use clap::Args;

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

#[cfg(test)]
mod tests {
    use catoptric_scene::{Body, Scene, Shape, ShapeKind};
    use catoptric_store::load;
    use glam::DVec3;

    use super::*;
    use xtask::root;

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
            _ => (0.0, 0.0),
        };
        (body.shape.kind(), size, ratio)
    }

    #[test]
    fn a_cloud_is_of_the_kind_of_the_reference() {
        let reference = load(root().join("tests/reference/cloud.toml")).unwrap().scene;
        let ours = cloud(reference.bodies.len());
        assert_eq!(
            (ours.camera, ours.environment.clone(), ours.tracing),
            (reference.camera, reference.environment.clone(), reference.tracing)
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
