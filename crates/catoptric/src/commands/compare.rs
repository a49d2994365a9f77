//! `catoptric compare`

use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use catoptric_lab::Machine;
use catoptric_lab::compare::{CompareJob, Contender, MethodComparison, compare, draw_all, reason_picture};
use catoptric_lab::report::{PageSettings, page};
use catoptric_picture::{BitDepth, Development, HeatMap, Picture, ToneCurve, encode_png, heat_map};
use catoptric_scene::visible;
use catoptric_tracer::{RenderControl, RenderSettings};
use serde_json::{Value, json};

use super::{CommandOutcome, check_picture, mark_class};
use crate::arguments::{CompareArguments, Size};
use crate::backend::threads;
use crate::console::{json_text, print};
use crate::files::CommandFiles;
use crate::input::{self, NamedScene};
use crate::layers::LayerReader;
use crate::progress::Progress;

pub(super) const REPORT: &str = "report.html";
pub(super) const METRICS: &str = "metrics.json";

/// The size of pictures if none is given.
const SIZE: Size = Size { width: 640, height: 360 };
/// The directory of the report if none is given.
const OUTPUT: &str = "compared";

pub(crate) fn run(arguments: &CompareArguments) -> Result<CommandOutcome> {
    if let Some(class) = &arguments.class {
        return mark_class::run(class, arguments);
    }
    if let (Some(scene), []) = (&arguments.scene, arguments.methods.as_slice()) {
        return check_picture::run(scene, arguments);
    }
    let size = size(arguments);
    Picture::check_size(size.width, size.height)?;
    let mut files = CommandFiles::default();
    if arguments.scene.is_none() && !arguments.set.edits.is_empty() {
        bail!("--set changes a scene, but only pictures are compared; name a scene");
    }
    let input = arguments.scene.as_deref();
    let input = input.map(|scene| input::scene(scene, &arguments.set, Some(size), &mut files)).transpose()?;
    if let Some(input) = &input
        && !arguments.quiet
    {
        input.warn();
    }
    let pictures = read_pictures(arguments, &mut files)?;
    if arguments.methods.len() + pictures.len() < 2 {
        bail!("a comparison takes two pictures or more; name more methods or pictures");
    }
    let output = arguments.output.as_deref().unwrap_or(Path::new(OUTPUT));
    files.add_directory(output, names(arguments, &pictures))?;
    let pool = threads(arguments.threads.map_or(0, usize::from))?;
    let mut contenders = match &input {
        Some(input) => draw(arguments, input, &pool)?,
        None => Vec::new(),
    };
    contenders.extend(pictures);
    let progress = Progress::new(arguments.quiet);
    let folder = output.to_string_lossy();
    let compared = progress.of_writing(&folder, || -> Result<MethodComparison> {
        let compared = compare(contenders, tolerance(arguments))?;
        let settings = settings(arguments, input.as_ref(), pool.current_num_threads());
        let html = page(&compared, &Machine::here(), &settings)?;
        let write = |name: &str, bytes: &[u8]| files.write(&output.join(name), bytes);
        write(REPORT, html.as_bytes())?;
        write_pictures(&compared, &settings.development, &write)?;
        write(METRICS, json_text(&as_json(&compared)).as_bytes())?;
        Ok(compared)
    })?;
    if !arguments.quiet {
        let report = output.join(REPORT);
        print(&format!("{}report: {}\n", summary(&compared), report.display()))?;
    }
    Ok(CommandOutcome::Done)
}

fn size(arguments: &CompareArguments) -> Size {
    arguments.size.unwrap_or(SIZE)
}

fn tolerance(arguments: &CompareArguments) -> f64 {
    arguments.tolerance.unwrap_or(1.0 / 255.0)
}

/// The picture files, before anything is drawn: what cannot be read is reported at once.
fn read_pictures(arguments: &CompareArguments, files: &mut CommandFiles) -> Result<Vec<Contender>> {
    let mut contenders: Vec<Contender> = Vec::new();
    let mut layers = LayerReader::new(arguments.layer.as_deref());
    for path in picture_files(arguments) {
        files.add_input(&path)?;
        let picture = layers.read(&path)?;
        let size = match (contenders.first(), &arguments.scene) {
            (_, Some(_)) => size(arguments).into(),
            (Some(first), None) => [first.picture.width(), first.picture.height()],
            (None, None) => [picture.width(), picture.height()],
        };
        if size != [picture.width(), picture.height()] {
            let hint = if arguments.scene.is_some() { "; give --size as the pictures have it" } else { "" };
            bail!(
                "{} has {}x{} pixels, the others have {}x{}{hint}",
                path.display(),
                picture.width(),
                picture.height(),
                size[0],
                size[1]
            );
        }
        contenders.push(Contender { name: path.display().to_string(), picture, drawn: None });
    }
    layers.finish()?;
    Ok(contenders)
}

fn draw(
    arguments: &CompareArguments,
    input: &NamedScene,
    pool: &rayon::ThreadPool,
) -> Result<Vec<Contender>> {
    let job = CompareJob {
        scene: &input.loaded.scene,
        variants: &arguments.methods,
        settings: RenderSettings {
            width: size(arguments).width,
            height: size(arguments).height,
            samples: arguments.samples,
        },
        runs: arguments.runs,
        bound: tolerance(arguments),
    };
    let total = arguments.methods.len() * (arguments.runs as usize + 1);
    let control = RenderControl::default();
    Progress::new(arguments.quiet).of_steps(total, |tell| {
        pool.install(|| draw_all(&job, &control, &mut |done, _| tell(done, None)))
            .with_context(|| input.name.clone())
    })
}

fn settings(arguments: &CompareArguments, input: Option<&NamedScene>, threads: usize) -> PageSettings {
    let scene = input.map(|input| &input.loaded.scene);
    PageSettings {
        scene: input.map(|input| input.name.clone()),
        bodies_and_lights: scene.map(|scene| [scene.bodies.len(), scene.lights.len()]),
        samples: scene.map(|_| arguments.samples),
        generations: scene.map(|scene| scene.tracing.generations),
        threads,
        development: arguments.development.development(),
        language: arguments.language,
    }
}

/// The picture files that are named.
pub(super) fn picture_files(arguments: &CompareArguments) -> impl Iterator<Item = PathBuf> {
    arguments.pictures.iter().flat_map(|list| listed_files(list))
}

/// The files of a list with commas between them. A comma may be a part of a name: as many pieces of the list make one
/// name as name a file that exists.
fn listed_files(list: &Path) -> Vec<PathBuf> {
    let Some(text) = list.to_str() else { return vec![list.to_owned()] };
    let ends =
        |rest: &str| rest.match_indices(',').map(|(end, _)| end).chain([rest.len()]).collect::<Vec<_>>();
    let mut files = Vec::new();
    let mut rest = Some(text);
    while let Some(list) = rest {
        let ends = ends(list);
        let whole =
            ends.iter().rev().find(|&&end| list.get(..end).is_some_and(|name| Path::new(name).exists()));
        let end = whole.or(ends.first()).copied().unwrap_or(list.len());
        files.push(PathBuf::from(list.get(..end).unwrap_or_default()));
        rest = list.get(end + 1..);
    }
    files
}

/// The names of all files that a comparison can write.
fn names(arguments: &CompareArguments, pictures: &[Contender]) -> Vec<String> {
    let methods = arguments.methods.iter().map(ToString::to_string);
    let contenders = methods.chain(pictures.iter().map(|picture| picture.name.clone())).enumerate();
    let mut names = vec![REPORT.to_owned(), METRICS.to_owned()];
    for (index, name) in contenders {
        let stem = file_stem(index, &name);
        names.extend(["", "-difference", "-flip", "-reasons"].map(|kind| format!("{stem}{kind}.png")));
    }
    names
}

/// The pictures and maps of the page as files of their own.
fn write_pictures(
    compared: &MethodComparison,
    development: &Development,
    write_bytes: &dyn Fn(&str, &[u8]) -> Result<()>,
) -> Result<()> {
    let plain = Development { exposure_stops: 0.0, tone_curve: ToneCurve::None };
    let write = |name: String, picture: &Picture, development: &Development| -> Result<()> {
        let png = encode_png(&development.develop(picture, BitDepth::Eight)?)?;
        write_bytes(&name, &png)
    };
    for (index, contender) in compared.contenders.iter().enumerate() {
        write(format!("{}.png", file_stem(index, &contender.name)), &contender.picture, development)?;
    }
    let Some(truth) = compared.truth() else { return Ok(()) };
    let options = HeatMap { maximum: compared.scale(), ..HeatMap::default() };
    for (index, (other, metrics)) in compared.others().enumerate() {
        let stem = file_stem(index + 1, &other.name);
        write(
            format!("{stem}-difference.png"),
            &heat_map(&truth.picture, &other.picture, &options)?,
            &plain,
        )?;
        let map = metrics.flip_map.heat_map(&HeatMap { maximum: 1.0, ..HeatMap::default() })?;
        write(format!("{stem}-flip.png"), &map, &plain)?;
        if let Some(map) = other.drawn.as_ref().and_then(|drawn| drawn.reasons.as_ref()) {
            write(format!("{stem}-reasons.png"), &reason_picture(map)?, &plain)?;
        }
    }
    Ok(())
}

/// A name for files: the number of the picture and what of its name any system takes.
fn file_stem(index: usize, name: &str) -> String {
    let name = Path::new(name).file_stem().unwrap_or_default().to_string_lossy();
    let plain = |letter: char| if letter.is_ascii_alphanumeric() || letter == '-' { letter } else { '-' };
    let name: String = name.chars().map(plain).take(60).collect();
    format!("{}-{}", index + 1, name.trim_matches('-'))
}

fn as_json(compared: &MethodComparison) -> Value {
    let finite = |value: f64| value.is_finite().then_some(value);
    let passes = |contender: &Contender| {
        contender.drawn.as_ref().map(|drawn| {
            let passes = drawn.passes.iter().map(|(pass, time)| (pass.name().to_owned(), json!(time)));
            json!({ "total": drawn.time, "passes": Value::Object(passes.collect()) })
        })
    };
    let reasons = |contender: &Contender| {
        let map = contender.drawn.as_ref()?.reasons.as_ref()?;
        let counts = map.counts().into_iter().map(|(reason, count)| (reason.name().to_owned(), json!(count)));
        Some(Value::Object(counts.collect()))
    };
    let others: Vec<Value> = compared
        .others()
        .map(|(other, metrics)| {
            json!({
                "name": other.name,
                "max": finite(metrics.difference.max),
                "mean": finite(metrics.difference.mean),
                "rmse": finite(metrics.difference.rmse),
                "psnr_db": finite(metrics.difference.psnr_db),
                "ssim": metrics.ssim,
                "flip": metrics.flip,
                "pixels_above": metrics.difference.above,
                "share_above": metrics.difference.share_above,
                "milliseconds": passes(other),
                "pixels_by_reason": reasons(other),
            })
        })
        .collect();
    let truth = compared.truth();
    json!({
        "truth": truth.map(|truth| json!({ "name": truth.name, "milliseconds": passes(truth) })),
        "tolerance": compared.bound,
        "others": others,
    })
}

/// A line for each picture.
fn summary(compared: &MethodComparison) -> String {
    let names = compared.contenders.iter().map(|contender| visible(&contender.name).chars().count());
    let width = names.max().unwrap_or(0);
    let mut text = String::new();
    for (other, metrics) in compared.others() {
        let ssim = metrics.ssim.map_or_else(|| "none".to_owned(), |ssim| format!("{ssim:.4}"));
        text.push_str(&format!(
            "{:width$}  RMSE {:.4}  SSIM {ssim}  FLIP {:.4}  wrong {:.2} %\n",
            visible(&other.name),
            metrics.difference.rmse,
            metrics.flip,
            100.0 * metrics.difference.share_above
        ));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_part_names_and_stand_in_them() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
        for name in ["a", "b,c", "b", ",", "d,e,f", "d"] {
            std::fs::write(at(name), "").unwrap();
        }
        let listed = |names: &[&str]| {
            let names: Vec<String> = names.iter().map(|name| at(name)).collect();
            let found = listed_files(Path::new(&names.join(",")));
            found == names.iter().map(PathBuf::from).collect::<Vec<_>>()
        };
        assert!(listed(&["a"]) && listed(&["a", "a", "a"]) && listed(&["b,c"]) && listed(&["b", "a"]));
        assert!(listed(&["a", "b,c", ",", "d,e,f", "d", "none", "a"]));
        assert_eq!(listed_files(Path::new("no,such")), [Path::new("no"), Path::new("such")]);
        assert_eq!(listed_files(Path::new("no,")), [Path::new("no"), Path::new("")]);
    }
}
