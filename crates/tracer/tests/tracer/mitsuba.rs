//! Physical materials: every scene of `tests/mitsuba` against Mitsuba's picture of it.
//!
//! A case is two files, `NAME.toml` and `NAME.exr`; adding a case is adding them.

use std::path::{Path, PathBuf};

use catoptric_picture::{Picture, write_exr};
use catoptric_scene::{Body, Color, Environment, Falloff, Light, Material, Scene};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};
use glam::DVec3;

/// Fewer scenes than this mean that the folder was not found whole.
const LEAST_SCENES: usize = 12;
const SAMPLES: u32 = 64;
/// Both pictures are noisy: they are compared by the means over squares of so many pixels a side.
const SQUARE: u32 = 8;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/mitsuba")
}

/// The mean difference that a picture may have, as a share of the mean light: what is really reached, rounded up.
const ALLOWED: f64 = 0.003;

fn scene_of(path: &Path) -> Result<Scene, String> {
    let loaded = catoptric_store::load(path).map_err(|error| error.to_string())?;
    if loaded.warnings.is_empty() { Ok(loaded.scene) } else { Err(loaded.warnings.to_string()) }
}

/// Renders a scene in the size of its reference picture.
fn trace(scene: &Scene, reference: &Picture) -> Result<Picture, String> {
    let render_scene = RenderScene::build(scene).map_err(|error| error.to_string())?;
    let settings = RenderSettings { width: reference.width(), height: reference.height(), samples: SAMPLES };
    let rendering =
        render(&render_scene, settings, &RenderControl::default()).map_err(|error| error.to_string())?;
    Ok(rendering.picture)
}

/// The sums of the light over squares.
fn squares(picture: &Picture) -> Vec<[f64; 3]> {
    let across = picture.width().div_ceil(SQUARE) as usize;
    let down = picture.height().div_ceil(SQUARE) as usize;
    let mut sums = vec![[0.0; 3]; across * down];
    for (y, row) in picture.rows().enumerate() {
        for (x, pixel) in row.iter().enumerate() {
            let sum = &mut sums[y / SQUARE as usize * across + x / SQUARE as usize];
            for (sum, light) in sum.iter_mut().zip(pixel) {
                *sum += f64::from(*light);
            }
        }
    }
    sums
}

/// The mean difference of squares as a share of the mean light.
fn difference(actual: &Picture, reference: &Picture) -> f64 {
    let (actual, reference) = (squares(actual), squares(reference));
    let whole: f64 = reference.iter().flatten().sum();
    let pairs = actual.iter().flatten().zip(reference.iter().flatten());
    pairs.map(|(actual, reference)| (actual - reference).abs()).sum::<f64>() / whole
}

/// What is wrong with a case, if anything.
fn check(path: &Path) -> Result<(), String> {
    let name = path.file_stem().unwrap().to_string_lossy();
    let fail = |what: String| Err(format!("{name}: {what}"));
    let reference = match catoptric_picture::read(&path.with_extension("exr")) {
        Ok(picture) => picture,
        Err(error) => return fail(error.to_string()),
    };
    let actual = match scene_of(path).and_then(|scene| trace(&scene, &reference)) {
        Ok(picture) => picture,
        Err(error) => return fail(error),
    };
    let off = difference(&actual, &reference);
    println!("{name}: off by {:.2} % of its light", 100.0 * off);
    // Not a number is not less either.
    if off < ALLOWED {
        return Ok(());
    }
    let left = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("mitsuba-{name}.exr"));
    write_exr(&left, &actual).unwrap();
    fail(format!("off by {:.2} % of its light; see {}", 100.0 * off, left.display()))
}

#[test]
fn pictures_agree_with_mitsuba() {
    let mut scenes: Vec<PathBuf> = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    scenes.sort();
    assert!(scenes.len() >= LEAST_SCENES, "only {} scenes in {}", scenes.len(), folder().display());
    let failures: Vec<String> = scenes.iter().filter_map(|scene| check(scene).err()).collect();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// The test itself can fail: glass of a slightly other index, and a metal a little rougher, are told apart.
#[test]
fn slightly_other_materials_are_noticed() {
    type Change = fn(&mut Material);
    let changes: [(&str, &str, Change); 2] = [
        ("glass-sphere", "glass", |glass| *glass.ior_mut().unwrap() = 1.45),
        ("rough-metal-03", "metal", |metal| *metal.roughness_mut().unwrap() = 0.35),
    ];
    for (name, material, change) in changes {
        let path = folder().join(name).with_extension("toml");
        let reference = catoptric_picture::read(&path.with_extension("exr")).unwrap();
        let mut scene = scene_of(&path).unwrap();
        let named = scene.materials.iter_mut().find(|named| named.name == material).unwrap();
        change(&mut named.material);
        let off = difference(&trace(&scene, &reference).unwrap(), &reference);
        assert!(off > ALLOWED, "{name}: {off}");
    }
}

/// A ball of frosted glass in the dark, lit by a point: only facets send light on, at the outside, and through to the
/// inside where the viewer's rays leave the glass.
#[test]
fn frosted_glass_shines_as_in_mitsuba() {
    const MITSUBA: f64 = 0.011_25;
    let mut scene = scene_of(&folder().join("rough-glass.toml")).unwrap();
    let is_glass = |body: &&Body| body.material.name() == Some("glass");
    let glass: Vec<Body> = scene.bodies.iter().filter(is_glass).cloned().collect();
    scene.bodies = glass.into();
    scene.environment =
        Environment { background: Color::BLACK, ambient: Color::BLACK, ..Environment::default() };
    let position = DVec3::new(2.5, 3.0, 4.0);
    let falloff = Falloff::InverseSquare;
    scene.lights = vec![Light { position, intensity: 12.0, falloff, ..Light::default() }];
    let size = Picture::new(128, 96).unwrap();
    let picture = trace(&scene, &size).unwrap();
    let mean =
        picture.pixels().iter().flatten().map(|part| f64::from(*part)).sum::<f64>() / (3.0 * 128.0 * 96.0);
    assert!((mean - MITSUBA).abs() < 0.02 * MITSUBA, "{mean}");
}
