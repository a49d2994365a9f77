//! `catoptric compare` with a scene and pictures of other ray tracers: what is systematically different in them.

use std::ffi::OsStr;
use std::fs::File;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result};
use catoptric_lab::audit::{AuditSettings, audit};
use catoptric_lab::detective::{
    CheckedPicture, CodeCurve, Detective, DetectiveSettings, ObservedPicture, Verdict, checked_page,
};
use catoptric_lab::report::Language;
use catoptric_picture::{Development, Picture, PictureFormat, SampleDepth, ToneCurve};
use catoptric_scene::{Scene, visible};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};
use serde_json::{Value, json};

use super::CommandOutcome;
use super::compare::{METRICS, REPORT, picture_files};
use crate::arguments::{CompareArguments, Size};
use crate::backend::threads;
use crate::console::{json_text, print};
use crate::files::CommandFiles;
use crate::input::{self, NamedScene, SceneSource};
use crate::layers::LayerReader;
use crate::progress::Progress;

/// The worst pixels that a report audits, if no more are asked for.
const AUDITS: usize = 3;

/// A picture file.
struct PictureFile {
    path: PathBuf,
    picture: Picture,
    /// The format that its first bytes tell, of a plain file.
    format: Option<PictureFormat>,
}

impl PictureFile {
    /// Whether its numbers are light, not codes.
    fn is_light(&self) -> bool {
        self.format.is_some_and(|format| format.depths() == [SampleDepth::Linear])
    }
}

pub(super) fn run(scene: &Path, arguments: &CompareArguments) -> Result<CommandOutcome> {
    let mut files = CommandFiles::default();
    let pictures = read_pictures(arguments, &mut files)?;
    let input = input::scene(scene, &arguments.set, arguments.size, &mut files)?;
    if let Some(output) = &arguments.output {
        files.add_directory(output, [REPORT, METRICS].map(str::to_owned))?;
    }
    if !arguments.quiet {
        input.warn();
    }
    let pool = threads(arguments.threads.map_or(0, usize::from))?;
    let mut values = Vec::new();
    let mut checked = Vec::new();
    let mut are_right = true;
    for file in &pictures {
        let again = scene_for(&input, scene, file, arguments, &mut files)?;
        let own = again.as_ref().map_or(&input.loaded.scene, |again| &again.loaded.scene);
        let settings = settings(file, &input, arguments);
        let verdict = pool.install(|| check(own, file, settings, arguments.quiet))?;
        are_right &= verdict.is_right(arguments.allow);
        values.push(named(file, verdict.to_json(own, arguments.allow)));
        if !arguments.json {
            print(&text(file, &verdict, own, arguments)?)?;
        }
        if arguments.output.is_some() {
            checked.push(pool.install(|| with_audits(own, file, verdict, settings.curve, arguments))?);
        }
    }
    let found = json_text(&json!({ "right": are_right, "pictures": values }));
    if arguments.json {
        print(&found)?;
    }
    if let Some(output) = &arguments.output {
        // Where the scene lies is no matter to who reads the page.
        let name =
            Path::new(&input.name).file_name().map_or(input.name.as_str().into(), OsStr::to_string_lossy);
        let html = checked_page(&name, &checked, arguments.allow, arguments.language)?;
        files.write(&output.join(REPORT), html.as_bytes())?;
        files.write(&output.join(METRICS), found.as_bytes())?;
        if !arguments.quiet && !arguments.json {
            print(&format!("report: {}\n", output.join(REPORT).display()))?;
        }
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
    let curve = match arguments.development.tone_curve {
        _ if file.is_light() => CodeCurve::Linear,
        Some(ToneCurve::LinearCodes) => CodeCurve::Linear,
        Some(_) => CodeCurve::Srgb,
        None if input.foreign.is_some() => CodeCurve::Linear,
        None => CodeCurve::Srgb,
    };
    let usual = DetectiveSettings::of_format(file.format);
    DetectiveSettings {
        curve,
        expected_size: expected_size(input, arguments),
        tolerance: arguments.tolerance.unwrap_or(usual.tolerance),
        ..usual
    }
}

fn check(scene: &Scene, file: &PictureFile, settings: DetectiveSettings, quiet: bool) -> Result<Verdict> {
    let observed = if file.is_light() {
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
        if let Some(simplest) = &verdict.simplest {
            text += &format!("  {}\n", simplest.in_words(scene, arguments.language));
        }
        for line in verdict.lines(scene, arguments.language) {
            text += &format!("  {line}\n");
        }
    }
    let render_scene = RenderScene::build(scene)?;
    for audit in audits(scene, &render_scene, verdict, arguments.pixels)? {
        text += &format!("\n{audit}");
    }
    Ok(text)
}

/// The audits of the worst pixels of the first places, at most `most`.
fn audits(scene: &Scene, render_scene: &RenderScene, verdict: &Verdict, most: usize) -> Result<Vec<String>> {
    let settings = AuditSettings { picture: exact_settings(verdict), ..AuditSettings::default() };
    let control = RenderControl::default();
    let clusters = verdict.clusters.iter().take(most);
    clusters
        .map(|cluster| {
            let pixel = glam::UVec2::from(cluster.worst.pixel);
            let audit = audit(scene, render_scene, render_scene.camera(), pixel, &settings, &control)?;
            Ok(audit.to_text(Some(2)))
        })
        .collect()
}

/// How the exact picture is traced.
fn exact_settings(verdict: &Verdict) -> RenderSettings {
    let [width, height] = verdict.scene_size;
    RenderSettings { width, height, samples: 1 }
}

/// A picture and its verdict with all that the report shows.
fn with_audits(
    scene: &Scene,
    file: &PictureFile,
    verdict: Verdict,
    curve: CodeCurve,
    arguments: &CompareArguments,
) -> Result<CheckedPicture> {
    let render_scene = RenderScene::build(scene)?;
    let audits = match verdict.is_right(arguments.allow) {
        true => Vec::new(),
        false => audits(scene, &render_scene, &verdict, arguments.pixels.max(AUDITS))?,
    };
    let exact = render(&render_scene, exact_settings(&verdict), &RenderControl::default())?.picture;
    let tone_curve = if curve == CodeCurve::Linear { ToneCurve::LinearCodes } else { ToneCurve::None };
    let shown = Development { tone_curve, ..Development::default() };
    // Of codes, reading has made light by the sRGB curve.
    let own = if file.is_light() { shown } else { Development::default() };
    Ok(CheckedPicture {
        name: file.path.display().to_string(),
        picture: (file.picture.clone(), own),
        exact: (exact, shown),
        scene: scene.clone(),
        verdict,
        audits,
    })
}
