//! Three of the Standard Procedural Databases (Haines 1987) as their NFF files: spheres, open cones, triangles and
//! polygons take the published numbers of rays.
//!
//! By the databases' rules: 513 × 513 rays at the corners of a 512 × 512 picture, five generations, every surface that
//! reflects or lets light pass sends a ray, no shadow ray where the normal faces away. The spacing of rays is not stated;
//! 511 to the height fits the counts of all scenes best.

use std::fs::File;
use std::io::Read as _;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use catoptric_exchange::{ForeignFormat, ImportOptions};
use catoptric_scene::{Scene, Tracing};
use catoptric_tracer::{RayCounts, RenderScene, WhittedIntegrator};
use flate2::read::GzDecoder;
use glam::DVec2;
use rayon::prelude::*;

use crate::common::good;

fn scene(name: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/spd").join(format!("{name}.nff.gz"));
    let mut text = String::new();
    GzDecoder::new(File::open(path).unwrap()).read_to_string(&mut text).unwrap();
    let mut scene = good(ForeignFormat::Nff, &text, &ImportOptions::default()).scene;
    scene.tracing = Tracing { generations: 5, threshold: 0.0 };
    scene
}

/// The primary rays that meet something, and all rays by their kinds.
fn counted(scene: &Scene) -> (u64, RayCounts) {
    let scene = RenderScene::build(scene).unwrap();
    let cancel = AtomicBool::new(false);
    let row = |row: u32| {
        let mut tracer = WhittedIntegrator::new(&scene, &cancel);
        let mut hits = 0;
        for column in 0..513 {
            let at = DVec2::new(f64::from(column), f64::from(row)) - 0.5;
            tracer.trace(at, DVec2::splat(511.0));
            hits += u64::from(scene.closest_hit(&scene.camera().ray(at, DVec2::splat(511.0))).is_some());
        }
        (hits, tracer.counts())
    };
    let none = || (0, RayCounts::default());
    (0..513).into_par_iter().map(row).reduce(none, |(a, one), (b, other)| (a + b, one + other))
}

#[track_caller]
fn assert_published(name: &str, bodies: usize, [met, reflected, refracted, shadow]: [u64; 4]) {
    let scene = scene(name);
    assert_eq!(scene.bodies.len(), bodies, "{name}");
    let (found, counts) = counted(&scene);
    for (kind, found, published) in [
        ("meet something", found, met),
        ("are reflected", counts.reflected, reflected),
        ("are refracted", counts.refracted, refracted),
        ("go to lights", counts.shadow, shadow),
    ] {
        let apart = found.abs_diff(published) as f64 / published.max(1) as f64;
        assert!(apart < 0.002, "{name}: {found} rays {kind}, not {published}");
    }
}

#[test]
fn balls_take_the_published_rays() {
    assert_published("balls", 7382, [263_169, 175_095, 0, 954_368]);
}

/// Open cones with a ball at each joint.
#[test]
fn the_tree_takes_the_published_rays() {
    assert_published("tree", 8191, [169_836, 0, 0, 1_097_419]);
}

/// Triangles below four balls of glass.
#[test]
fn the_mountain_takes_the_published_rays() {
    assert_published("mount", 8196, [173_125, 354_769, 354_769, 412_922]);
}
