//! What many bodies cost: preparing a cloud of them, one picture, and following edits of one body.
//!
//! `cargo run --release -p catoptric-tracer --example many -- [BODIES] [RUNS] [THREADS]`

#![allow(clippy::print_stdout, reason = "this is a program")]

use std::error::Error;
use std::time::Instant;

use catoptric_scene::{
    Anchor, Body, Camera, Color, Light, Material, MaterialChoice, NamedMaterial, Placement, Projection,
    Scene, Shape,
};
use catoptric_tracer::{Control, RenderSettings, Stage, render};
use glam::DVec3;

fn main() -> Result<(), Box<dyn Error>> {
    let numbers: Vec<usize> = std::env::args().skip(1).map(|text| text.parse()).collect::<Result<_, _>>()?;
    let at = |place: usize, otherwise: usize| numbers.get(place).copied().unwrap_or(otherwise);
    let (bodies, runs, threads) = (at(0, 1_000_000), at(1, 5), at(2, 0));
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?;
    let scene = cloud(bodies);
    let mut stage = None;
    let prepare = best_of(runs, || stage = Some(Stage::prepare(&scene)));
    let stage = stage.ok_or("no run")??;
    println!(
        "{bodies} bodies: prepared in {prepare:.1} ms, {:.1} bytes a body",
        stage.bytes() as f64 / bodies as f64
    );
    let settings = RenderSettings { width: 1280, height: 720, samples: 1 };
    let trace = best_of(runs, || drop(render(&stage, settings, &Control::default())));
    println!("traced in {trace:.1} ms");
    follow(scene, stage, runs)
}

/// Moves a body back and forth as a hand does, then holds the stage that followed against a new one.
fn follow(mut scene: Scene, mut stage: Stage, runs: usize) -> Result<(), Box<dyn Error>> {
    let middle = scene.bodies.len() / 2;
    for (what, step) in [("a bit", 1e-3), ("far", 1.0)] {
        let (mut took, mut anew) = (Vec::new(), 0);
        for run in 0..runs.max(4) {
            // Telling what changed is the part of whoever edits.
            let before = scene.clone();
            let offset = DVec3::new(step, step * run as f64, -step);
            let placement = &mut scene.bodies[middle].placement;
            *placement = placement.moved_by(offset);
            let start = Instant::now();
            match stage.edit(&before, &scene, &[middle]) {
                Some(edit) => stage.apply(edit, &scene),
                None => {
                    stage = Stage::prepare(&scene)?;
                    anew += 1;
                }
            }
            took.push(1e3 * start.elapsed().as_secs_f64());
        }
        took.sort_by(f64::total_cmp);
        let (median, most) = (took[took.len() / 2], took[took.len() - 1]);
        println!("moved {what}: median {median:.3} ms, at most {most:.3} ms, {anew} times prepared anew");
    }
    let fresh = Stage::prepare(&scene)?;
    let settings = RenderSettings { width: 640, height: 360, samples: 1 };
    let traced = |stage: &Stage| {
        let mut picture = None;
        let time = best_of(runs, || picture = render(stage, settings, &Control::default()).ok());
        (time, picture.map(|rendering| rendering.picture))
    };
    let ((time, one), (fresh_time, other)) = (traced(&stage), traced(&fresh));
    let is_same = one.is_some() && one == other;
    println!("then traced in {time:.1} ms, a new stage in {fresh_time:.1} ms");
    println!("the picture is {} a new stage's", if is_same { "that of" } else { "NOT that of" });
    Ok(())
}

/// The least milliseconds that some work takes.
fn best_of(runs: usize, mut work: impl FnMut()) -> f64 {
    let times = (0..runs).map(|_| {
        let start = Instant::now();
        work();
        1e3 * start.elapsed().as_secs_f64()
    });
    times.fold(f64::INFINITY, f64::min)
}

/// The scene that `cargo xtask cloud` writes.
fn cloud(bodies: usize) -> Scene {
    let mut random = Random(1);
    let named = (0..16).map(|number| NamedMaterial {
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
    let materials: Vec<NamedMaterial> = named.collect();
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
        lights: vec![Light::default()],
        bodies: (0..bodies).map(|_| random.body(spacing)).collect(),
        materials,
    }
}

/// Splitmix64 (Steele, Lea, Flood 2014, Fast splittable pseudorandom number generators).
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
            material: MaterialChoice::Named(format!("m{}", self.next() % 16)),
            ..Body::default()
        }
    }
}
