//! `catoptric compare` with a scene and pictures of other ray tracers: what is systematically different in them.

use std::path::Path;

use anyhow::{Context as _, Result};
use catoptric_lab::audit::{AuditSettings, audit};
use catoptric_lab::detective::{CheckedPicture, Detective, DetectiveSettings, Verdict, checked_page};
use catoptric_lab::report::Language;
use catoptric_scene::{Scene, visible};
use catoptric_tracer::{RenderControl, RenderScene, render};
use serde_json::{Value, json};

use super::CommandOutcome;
use super::checking::{CheckKey, ExactScene, PictureFile, exact_settings};
use super::compare::{METRICS, REPORT, picture_files};
use crate::arguments::CompareArguments;
use crate::backend::threads;
use crate::console::{json_text, print};
use crate::files::CommandFiles;
use crate::layers::LayerReader;
use crate::progress::Progress;

/// The worst pixels that a report audits, if no more are asked for.
const AUDITS: usize = 3;

pub(super) fn run(scene: &Path, arguments: &CompareArguments) -> Result<CommandOutcome> {
    let mut files = CommandFiles::default();
    let pictures = read_pictures(arguments, &mut files)?;
    let exact = ExactScene::read(scene, arguments, &mut files)?;
    if let Some(output) = &arguments.output {
        files.add_directory(output, [REPORT, METRICS].map(str::to_owned))?;
    }
    if !arguments.quiet {
        exact.warn();
    }
    let pool = threads(arguments.threads.map_or(0, usize::from))?;
    let mut values = Vec::new();
    let mut checked = Vec::new();
    let mut are_right = true;
    let pictures: Vec<(CheckKey, PictureFile)> =
        pictures.into_iter().map(|file| Ok((exact.key(file.head)?, file))).collect::<Result<_>>()?;
    // A scene is prepared once for pictures that follow each other and need the same.
    for group in pictures.chunk_by(|(one, _), (other, _)| one == other) {
        let Some((key, first)) = group.first() else { continue };
        let own = exact.scene(key, &mut files)?;
        let name = |file: &PictureFile| file.path.display().to_string();
        let detective = pool.install(|| Detective::new(&own, key.settings)).with_context(|| name(first))?;
        for (_, file) in group {
            let verdict =
                pool.install(|| check(&detective, file, arguments.quiet)).with_context(|| name(file))?;
            are_right &= verdict.is_right(arguments.allow);
            values.push(named(file, verdict.to_json(&own, arguments.allow)));
            if !arguments.json {
                print(&text(file, &verdict, &own, arguments)?)?;
            }
            if arguments.output.is_some() {
                let audited = || with_audits(&own, file, verdict, &key.settings, arguments);
                checked.push(pool.install(audited)?);
            }
        }
    }
    let found = json_text(&json!({ "right": are_right, "pictures": values }));
    if arguments.json {
        print(&found)?;
    }
    if let Some(output) = &arguments.output {
        let html = checked_page(&exact.name(), &checked, arguments.allow, arguments.language)?;
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
        pictures.push(PictureFile::read(path, &mut layers)?);
    }
    layers.finish()?;
    Ok(pictures)
}

fn check(detective: &Detective<'_>, file: &PictureFile, quiet: bool) -> Result<Verdict> {
    let name = file.path.display().to_string();
    Ok(Progress::new(quiet)
        .of_writing(&name, || detective.check(&file.observed(), &RenderControl::default()))?)
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

/// A picture and its verdict with all that the report shows.
fn with_audits(
    scene: &Scene,
    file: &PictureFile,
    verdict: Verdict,
    settings: &DetectiveSettings,
    arguments: &CompareArguments,
) -> Result<CheckedPicture> {
    let render_scene = RenderScene::build(scene)?;
    let audits = match verdict.is_right(arguments.allow) {
        true => Vec::new(),
        false => audits(scene, &render_scene, &verdict, arguments.pixels.max(AUDITS))?,
    };
    let exact = render(&render_scene, exact_settings(&verdict), &RenderControl::default())?.picture;
    Ok(CheckedPicture {
        name: file.path.display().to_string(),
        picture: (file.picture.clone(), file.development(settings)),
        exact: (exact, settings.development()),
        scene: scene.clone(),
        verdict,
        audits,
    })
}
