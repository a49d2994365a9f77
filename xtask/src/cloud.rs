//! A cloud of bodies of all four shapes, for measuring what many bodies cost.

use std::path::PathBuf;

use anyhow::Result;
use catoptric_scene::{
    Anchor, Body, Camera, Color, Material, MaterialChoice, NamedMaterial, Placement, Projection, Scene,
    Shape, save, write,
};
use clap::Args;
use glam::DVec3;

#[derive(Debug, Args)]
pub(crate) struct CloudArguments {
    /// Number of bodies
    #[arg(long, default_value_t = 1_000_000)]
    bodies: usize,
    /// The scene file to write
    #[arg(short, long, default_value = "target/cloud.toml")]
    output: PathBuf,
}

pub(crate) fn run(arguments: &CloudArguments) -> Result<()> {
    Ok(save(&arguments.output, &write(&cloud(arguments.bodies)))?)
}

const MATERIALS: u64 = 16;

/// Bodies in a cube of edge 10, on average a fixed part of the mean distance to the next one in size.
fn cloud(bodies: usize) -> Scene {
    let mut random = Random(1);
    let materials = (0..MATERIALS).map(|number| NamedMaterial {
        name: format!("m{number}"),
        material: Material {
            color: random.vector(0.2, 0.8).to_array().into(),
            diffuse: 0.6,
            specular: 0.5,
            shininess: 60.0,
            reflection: Some(0.3),
            ..Material::default()
        },
    });
    let materials: Vec<NamedMaterial> = materials.collect();
    let spacing = 10.0 / (bodies.max(1) as f64).cbrt();
    Scene {
        camera: Camera {
            position: DVec3::new(9.0, 7.0, 14.0),
            target: DVec3::ZERO,
            projection: Projection::Perspective { fov_degrees: 38.0 },
            ..Camera::default()
        },
        tracing: catoptric_scene::Tracing { generations: 4, threshold: 0.0 },
        environment: catoptric_scene::Environment {
            background: Color::new(0.2, 0.35, 0.6),
            ambient: Color::WHITE,
        },
        lights: vec![catoptric_scene::Light::default()],
        bodies: (0..bodies).map(|_| random.body(spacing)).collect(),
        materials,
    }
}

/// A sequence of numbers that look random, the same on every machine (splitmix64: Steele, Lea, Flood 2014, Fast
/// splittable pseudorandom number generators).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }

    fn number(&mut self, low: f64, high: f64) -> f64 {
        let part = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        // Few digits keep the file short.
        ((low + (high - low) * part) * 1e6).round() / 1e6
    }

    fn vector(&mut self, low: f64, high: f64) -> DVec3 {
        DVec3::new(self.number(low, high), self.number(low, high), self.number(low, high))
    }

    fn body(&mut self, spacing: f64) -> Body {
        let size = spacing * self.number(0.1, 0.25);
        let shape = match self.next() % 4 {
            0 => Shape::Sphere { radius: size },
            1 => Shape::Cube { size: DVec3::splat(1.5 * size) },
            2 => Shape::Cylinder { radius: 0.5 * size, height: 1.5 * size },
            _ => Shape::Cone { radius: 0.6 * size, top_radius: 0.0, height: 1.2 * size },
        };
        let position = self.vector(-5.0, 5.0);
        let rotation_degrees = self.vector(-180.0, 180.0);
        Body {
            shape,
            placement: Placement { anchor: Anchor::Frame { position, rotation_degrees }, scale: DVec3::ONE },
            material: MaterialChoice::Named(format!("m{}", self.next() % MATERIALS)),
            ..Body::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cloud_is_a_valid_scene_and_always_the_same() {
        let scene = cloud(100);
        assert!(scene.check().is_empty(), "{:?}", scene.check());
        assert_eq!(scene, cloud(100));
        assert_eq!(scene.bodies.len(), 100);
    }
}
