//! The reference pictures: every scene of `tests/reference` against POV-Ray's picture of it.
//!
//! A case is two files, `NAME.toml` and `NAME.exr`; adding a case is adding them.

use std::path::{Path, PathBuf};

use catoptric_picture::{
    BitDepth, Development, Difference, HeatMap, Picture, heat_map, write_exr, write_png,
};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};

/// Fewer scenes than this mean that the folder was not found whole.
const LEAST_SCENES: usize = 40;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/reference")
}

/// The share of pixels that may differ from POV-Ray's by more than 1/255: what is really reached, rounded up. Those
/// pixels lie on edges, which rounding gives to either side; tiny balls have the most edge.
fn allowed_share(name: &str) -> f64 {
    if name == "sphereflake" { 0.001 } else { 0.0005 }
}

/// Renders a scene in the size of its reference picture.
fn trace(scene: &Path, reference: &Picture) -> Result<Picture, String> {
    let loaded = catoptric_store::load(scene).map_err(|error| error.to_string())?;
    if !loaded.warnings.is_empty() {
        return Err(format!("the reader warns: {}", loaded.warnings));
    }
    let render_scene = RenderScene::build(&loaded.scene).map_err(|error| error.to_string())?;
    let settings = RenderSettings { width: reference.width(), height: reference.height(), samples: 1 };
    let rendering =
        render(&render_scene, settings, &RenderControl::default()).map_err(|error| error.to_string())?;
    Ok(rendering.picture)
}

/// Leaves the picture and the map of differences for the eye, and says where.
fn leave_evidence(name: &str, actual: &Picture, reference: &Picture) -> String {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("reference");
    std::fs::create_dir_all(&folder).unwrap();
    let file = |ending: &str| folder.join(format!("{name}{ending}"));
    write_exr(&file(".exr"), actual).unwrap();
    let png = |ending: &str, picture: &Picture| {
        let developed = Development::default().develop(picture, BitDepth::Eight).unwrap();
        write_png(&file(ending), &developed).unwrap();
    };
    png(".png", actual);
    png(".heat.png", &heat_map(actual, reference, &HeatMap::default()).unwrap());
    format!("see {} and {}", file(".exr").display(), file(".heat.png").display())
}

/// What is wrong with a case, if anything.
fn check(scene: &Path) -> Result<(), String> {
    let name = scene.file_stem().unwrap().to_string_lossy();
    let fail = |what: String| Err(format!("{name}: {what}"));
    let reference = match catoptric_picture::read(&scene.with_extension("exr")) {
        Ok(picture) => picture,
        Err(error) => return fail(error.to_string()),
    };
    let actual = match trace(scene, &reference) {
        Ok(picture) => picture,
        Err(error) => return fail(error),
    };
    let difference = Difference::between(&actual, &reference).unwrap();
    let Difference { above, share_above, max, not_a_number, .. } = difference;
    println!("{name}: {above} pixels ({:.4} %) are off, the worst by {max:.3}", 100.0 * share_above);
    if not_a_number == 0 && share_above <= allowed_share(&name) {
        return Ok(());
    }
    let evidence = leave_evidence(&name, &actual, &reference);
    fail(format!("{:.3} % of the pixels are off; {evidence}", 100.0 * share_above))
}

#[test]
fn pictures_agree_with_pov_ray() {
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

/// The test itself can fail: a picture with one wrong pixel too many is told apart, and its evidence is left.
#[test]
fn a_wrong_picture_is_noticed() {
    let scene = folder().join("lambert-sphere.toml");
    let reference = catoptric_picture::read(&scene.with_extension("exr")).unwrap();
    let mut actual = trace(&scene, &reference).unwrap();
    let wrong = (allowed_share("lambert-sphere") * actual.pixels().len() as f64) as usize + 1;
    for pixel in actual.pixels_mut().iter_mut().take(wrong) {
        pixel[1] += 0.1;
    }
    let difference = Difference::between(&actual, &reference).unwrap();
    assert!(difference.share_above > allowed_share("lambert-sphere"));
    let evidence = leave_evidence("a-wrong-picture", &actual, &reference);
    assert!(evidence.contains("a-wrong-picture.heat.png"));
}
