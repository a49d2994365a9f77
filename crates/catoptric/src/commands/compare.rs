//! `catoptric compare`

use std::path::Path;

use anyhow::{Context as _, Result, bail};
use catoptric_lab::Machine;
use catoptric_lab::compare::{Compared, Contender, Job, compare, draw_all, reason_picture};
use catoptric_lab::report::{Settings, page};
use catoptric_picture::{BitDepth, Development, HeatMap, Picture, ToneCurve, encode_png, heat_map, read};
use catoptric_tracer::{Control, RenderSettings};
use serde_json::{Value, json};

use super::Outcome;
use crate::arguments::CompareArguments;
use crate::backend::threads;
use crate::console::print;
use crate::input::{self, Named};
use crate::output::{prepare_directory, write_file, write_text};
use crate::progress::Progress;

pub(crate) fn run(arguments: &CompareArguments) -> Result<Outcome> {
    Picture::check_size(arguments.size.width, arguments.size.height)?;
    let input = arguments.scene.as_deref().map(input::scene).transpose()?;
    if let Some(input) = &input
        && !arguments.quiet
    {
        input.warn();
    }
    let files = read_pictures(arguments)?;
    if arguments.methods.len() + files.len() < 2 {
        bail!("a comparison takes two pictures or more; name more methods or pictures");
    }
    prepare_directory(&arguments.output, "report.html")?;
    let pool = threads(arguments.threads.map_or(0, usize::from))?;
    let mut contenders = match &input {
        Some(input) => draw(arguments, input, &pool)?,
        None => Vec::new(),
    };
    contenders.extend(files);
    let progress = Progress::new(arguments.quiet);
    let folder = arguments.output.to_string_lossy();
    let compared = progress.of_writing(&folder, || -> Result<Compared> {
        let compared = compare(contenders, arguments.tolerance)?;
        let settings = settings(arguments, input.as_ref(), pool.current_num_threads());
        let html = page(&compared, &Machine::here(), &settings)?;
        write_text(&arguments.output.join("report.html"), &html)?;
        write_pictures(&compared, &arguments.output, &settings.development)?;
        write_text(&arguments.output.join("metrics.json"), &format!("{:#}\n", as_json(&compared)))?;
        Ok(compared)
    })?;
    if !arguments.quiet {
        let report = arguments.output.join("report.html");
        print(&format!("{}report: {}\n", summary(&compared), report.display()))?;
    }
    Ok(Outcome::Done)
}

/// The picture files, before anything is drawn: what cannot be read is told at once.
fn read_pictures(arguments: &CompareArguments) -> Result<Vec<Contender>> {
    let mut contenders: Vec<Contender> = Vec::new();
    for path in &arguments.pictures {
        let picture = read(path)?;
        let size = match (contenders.first(), &arguments.scene) {
            (_, Some(_)) => [arguments.size.width, arguments.size.height],
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
    Ok(contenders)
}

fn draw(arguments: &CompareArguments, input: &Named, pool: &rayon::ThreadPool) -> Result<Vec<Contender>> {
    let job = Job {
        scene: &input.loaded.scene,
        variants: &arguments.methods,
        settings: RenderSettings {
            width: arguments.size.width,
            height: arguments.size.height,
            samples: arguments.samples,
        },
        runs: arguments.runs,
        bound: arguments.tolerance,
    };
    let total = arguments.methods.len() * (arguments.runs as usize + 1);
    let control = Control::default();
    Progress::new(arguments.quiet).of_steps(total, |tell| {
        pool.install(|| draw_all(&job, &control, &mut |done, _| tell(done, None)))
            .with_context(|| input.name.clone())
    })
}

fn settings(arguments: &CompareArguments, input: Option<&Named>, threads: usize) -> Settings {
    let scene = input.map(|input| &input.loaded.scene);
    Settings {
        scene: input.map(|input| input.name.clone()),
        bodies_and_lights: scene.map(|scene| [scene.bodies.len(), scene.lights.len()]),
        samples: scene.map(|_| arguments.samples),
        generations: scene.map(|scene| scene.tracing.generations),
        threads,
        development: arguments.development.development(),
        language: arguments.language,
    }
}

/// The pictures and maps of the page as files of their own.
fn write_pictures(compared: &Compared, folder: &Path, development: &Development) -> Result<()> {
    let plain = Development { exposure_stops: 0.0, tone_curve: ToneCurve::None };
    let write = |name: String, picture: &Picture, development: &Development| -> Result<()> {
        let png = encode_png(&development.develop(picture, BitDepth::Eight)?)?;
        write_file(&folder.join(name), &png)
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

fn as_json(compared: &Compared) -> Value {
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
fn summary(compared: &Compared) -> String {
    let width = compared.contenders.iter().map(|contender| contender.name.chars().count()).max().unwrap_or(0);
    let mut text = String::new();
    for (other, metrics) in compared.others() {
        let ssim = metrics.ssim.map_or_else(|| "none".to_owned(), |ssim| format!("{ssim:.4}"));
        text.push_str(&format!(
            "{:width$}  RMSE {:.4}  SSIM {ssim}  FLIP {:.4}  wrong {:.2} %\n",
            other.name,
            metrics.difference.rmse,
            metrics.flip,
            100.0 * metrics.difference.share_above
        ));
    }
    text
}
