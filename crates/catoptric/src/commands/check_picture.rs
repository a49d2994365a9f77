//! `catoptric compare` with a scene and pictures of other ray tracers: what is systematically different in them.

use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use catoptric_lab::audit::{AuditSettings, audit};
use catoptric_lab::detective::{CodeCurve, Detective, DetectiveSettings, ObservedPicture, Verdict};
use catoptric_lab::report::Language;
use catoptric_picture::{Picture, PictureFormat, SampleDepth, ToneCurve};
use catoptric_scene::{Scene, visible};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};
use serde_json::{Value, json};

use super::CommandOutcome;
use super::compare::picture_files;
use crate::arguments::{CompareArguments, Size};
use crate::backend::threads;
use crate::console::{json_text, print};
use crate::files::CommandFiles;
use crate::input::{self, NamedScene, SceneSource};
use crate::layers::LayerReader;
use crate::progress::Progress;

/// A picture file.
struct PictureFile {
    path: PathBuf,
    picture: Picture,
    /// The format that its first bytes tell, of a plain file.
    format: Option<PictureFormat>,
}

pub(super) fn run(scene: &Path, arguments: &CompareArguments) -> Result<CommandOutcome> {
    if arguments.output.is_some() {
        bail!("-o takes a report of methods, and no method is named; leave it out, or add --methods whitted");
    }
    let mut files = CommandFiles::default();
    let pictures = read_pictures(arguments, &mut files)?;
    let input = input::scene(scene, &arguments.set, arguments.size, &mut files)?;
    if !arguments.quiet {
        input.warn();
    }
    let pool = threads(arguments.threads.map_or(0, usize::from))?;
    let mut values = Vec::new();
    let mut are_right = true;
    for file in &pictures {
        let again = scene_for(&input, scene, file, arguments, &mut files)?;
        let own = again.as_ref().map_or(&input.loaded.scene, |again| &again.loaded.scene);
        let settings = settings(file, &input, arguments);
        let verdict = pool.install(|| check(own, file, settings, arguments.quiet))?;
        are_right &= verdict.is_right(arguments.allow);
        if arguments.json {
            values.push(named(file, verdict.to_json(own, arguments.allow)));
        } else {
            print(&text(file, &verdict, own, arguments)?)?;
        }
    }
    if arguments.json {
        print(&json_text(&json!({ "right": are_right, "pictures": values })))?;
    }
    Ok(if are_right { CommandOutcome::Done } else { CommandOutcome::Failed })
}

fn read_pictures(arguments: &CompareArguments, files: &mut CommandFiles) -> Result<Vec<PictureFile>> {
    let mut layers = LayerReader::new(arguments.layer.as_deref());
    let mut pictures = Vec::new();
    for path in picture_files(arguments) {
        files.add_input(&path)?;
        let picture = layers.read(&path)?;
        let format = format_of(&path);
        pictures.push(PictureFile { path, picture, format });
    }
    layers.finish()?;
    Ok(pictures)
}

fn format_of(path: &Path) -> Option<PictureFormat> {
    let mut start = [0; 32];
    let count = if path.is_file() { File::open(path).ok()?.read(&mut start).ok()? } else { 0 };
    PictureFormat::of_content(start.get(..count)?)
}

/// The size that the picture should have.
fn expected_size(input: &NamedScene, arguments: &CompareArguments) -> Option<[u32; 2]> {
    arguments.size.map(Into::into).or(input.foreign?.size)
}

/// The scene read anew for the size of the picture, to which a horizontal angle of view belongs; `None` if it is the
/// one that is expected.
fn scene_for(
    input: &NamedScene,
    path: &Path,
    file: &PictureFile,
    arguments: &CompareArguments,
    files: &mut CommandFiles,
) -> Result<Option<NamedScene>> {
    let own = [file.picture.width(), file.picture.height()];
    let expected = expected_size(input, arguments);
    // A picture that was transposed has the sides exchanged.
    let is_expected = expected == Some(own) || expected == Some([own[1], own[0]]);
    if input.foreign.is_none() || is_expected || matches!(input::source(path)?, SceneSource::Example(_)) {
        return Ok(None);
    }
    let size = Size { width: own[0], height: own[1] };
    input::scene(path, &arguments.set, Some(size), files).map(Some)
}

fn settings(file: &PictureFile, input: &NamedScene, arguments: &CompareArguments) -> DetectiveSettings {
    let is_light = file.format.is_some_and(|format| format.depths() == [SampleDepth::Linear]);
    let curve = match arguments.development.tone_curve {
        _ if is_light => CodeCurve::Linear,
        Some(ToneCurve::LinearCodes) => CodeCurve::Linear,
        Some(_) => CodeCurve::Srgb,
        None if input.foreign.is_some() => CodeCurve::Linear,
        None => CodeCurve::Srgb,
    };
    let usual = if file.format == Some(PictureFormat::Jpeg) { 8.0 / 255.0 } else { 2.0 / 255.0 };
    DetectiveSettings {
        curve,
        expected_size: expected_size(input, arguments),
        tolerance: arguments.tolerance.unwrap_or(usual),
        ..DetectiveSettings::default()
    }
}

fn check(scene: &Scene, file: &PictureFile, settings: DetectiveSettings, quiet: bool) -> Result<Verdict> {
    let is_light = file.format.is_some_and(|format| format.depths() == [SampleDepth::Linear]);
    let observed = if is_light {
        ObservedPicture::of_light(&file.picture)
    } else {
        ObservedPicture::of_codes(&file.picture)
    };
    let name = || file.path.display().to_string();
    Progress::new(quiet)
        .of_writing(&name(), || {
            let detective = Detective::new(scene, settings)?;
            detective.check(&observed, &RenderControl::default())
        })
        .with_context(name)
}

fn named(file: &PictureFile, verdict: Value) -> Value {
    let mut value = json!({ "name": file.path.display().to_string() });
    if let (Some(map), Value::Object(verdict)) = (value.as_object_mut(), verdict) {
        map.extend(verdict);
    }
    value
}

/// The sentence, the places of the rest, and the audits that are asked for.
fn text(
    file: &PictureFile,
    verdict: &Verdict,
    scene: &Scene,
    arguments: &CompareArguments,
) -> Result<String> {
    let is_right = verdict.is_right(arguments.allow);
    let word = match (arguments.language, is_right) {
        (Language::English, true) => "right",
        (Language::English, false) => "different",
        (Language::Russian, true) => "верно",
        (Language::Russian, false) => "отличается",
    };
    let name = file.path.display().to_string();
    let mut text = format!("{}: {word}: {}\n", visible(&name), verdict.sentence(scene, arguments.language));
    if !is_right {
        for line in verdict.lines(scene, arguments.language) {
            text += &format!("  {line}\n");
        }
    }
    let picture = RenderSettings { width: verdict.scene_size[0], height: verdict.scene_size[1], samples: 1 };
    let settings = AuditSettings { picture, ..AuditSettings::default() };
    let render_scene = RenderScene::build(scene)?;
    for cluster in verdict.clusters.iter().take(arguments.pixels) {
        let pixel = glam::UVec2::from(cluster.worst.pixel);
        let control = RenderControl::default();
        let audit = audit(scene, &render_scene, render_scene.camera(), pixel, &settings, &control)?;
        text += &format!("\n{}", audit.to_text(Some(2)));
    }
    Ok(text)
}
