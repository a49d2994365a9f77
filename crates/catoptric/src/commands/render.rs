//! `catoptric render`

use std::path::Path;
use std::time::Instant;

use anyhow::{Context as _, Result};
use catoptric_exchange::DEFAULT_SIZE;
use catoptric_lab::depth::DepthMeasure;
use catoptric_lab::maps::{MapKind, MapSettings, map};
use catoptric_picture::{Development, Picture, PictureFormat, SampleDepth, SaveOptions, ToneCurve};
use catoptric_tracer::raster::{GBufferLayer, MethodOutput};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};

use super::CommandOutcome;
use crate::arguments::RenderArguments;
use crate::backend::{RenderedPicture, Renderer, threads};
use crate::console::{count, json_text, say};
use crate::files::CommandFiles;
use crate::output::{format_for_output, milliseconds};
use crate::progress::{Progress, WorkEstimate};
use crate::stats::{Stats, StepTimes};
use crate::{input, memory, notes};

pub(crate) fn run(arguments: &RenderArguments) -> Result<CommandOutcome> {
    let method = arguments.method.chosen()?;
    let mut files = CommandFiles::default();
    let mut options = refuse_early(arguments, &mut files)?;
    let drawer = Renderer::chosen(&arguments.backend, &method, arguments.map.is_some())?;
    let progress = Progress::new(arguments.quiet);
    let mut times = StepTimes::default();

    let pool = threads(arguments.threads.map_or(0, usize::from))?;
    let start = Instant::now();
    let input = input::scene(&arguments.scene, &arguments.set, arguments.size, &mut files)?;
    times.read = milliseconds(start);
    let settings = picture_settings(arguments, input.foreign, &mut options)?;
    if !arguments.quiet {
        warn_of_scene(&input);
    }

    let start = Instant::now();
    let render_scene = pool.install(|| RenderScene::build(&input.loaded.scene));
    let mut render_scene = render_scene.with_context(|| input.name.clone())?;
    drop(input.loaded);
    if let Some(generations) = arguments.generations {
        render_scene = render_scene.with_generations(generations);
    }
    times.prepare = milliseconds(start);

    if let Some(map) = arguments.map {
        return show_map(arguments, (&files, options), map, &render_scene, settings, &pool, progress);
    }
    let control = RenderControl::default();
    let pixels = u64::from(settings.width) * u64::from(settings.height);
    let estimates = !arguments.quiet && method.abilities().has_ray_tree;
    let rays = if estimates { warn_of_work(&render_scene, settings, &pool) } else { None };
    let start = Instant::now();
    let drawn = progress.of_tracing(&control, WorkEstimate { pixels, rays }, || {
        drawer.draw(&render_scene, &method, settings, &pool, &control)
    })?;
    times.trace = milliseconds(start);
    let RenderedPicture { drawing, on_card, fallen_back } = drawn;
    fallen_back.iter().filter(|_| !arguments.quiet).for_each(warn_of_fallback);

    (times.develop, times.write) = progress.of_writing(&arguments.output.to_string_lossy(), || {
        pool.install(|| files.write_picture(&arguments.output, &options, &drawing.picture))
    })?;
    if let Some(folder) = &arguments.method.layers {
        progress.of_writing(&folder.to_string_lossy(), || {
            write_layers(&files, folder, &render_scene, &drawing)
        })?;
    }
    let stats = Stats {
        scene: &input.name,
        width: settings.width,
        height: settings.height,
        samples: settings.samples,
        generations: render_scene.generations(),
        threads: pool.current_num_threads(),
        card: drawer.card().filter(|_| fallen_back.is_none()),
        on_card,
        bodies: render_scene.body_count(),
        lights: render_scene.light_count(),
        stage_bytes: render_scene.bytes(),
        method: method.name(),
        passes: &drawing.passes,
        cube_maps: drawing.cube_maps,
        times,
        rays: drawing.counts,
        peak_memory_bytes: memory::peak_bytes(),
    };
    finish(arguments, &files, &stats, progress)?;
    if progress.is_shown() {
        advise(&render_scene, settings, &pool);
    }
    Ok(CommandOutcome::Done)
}

/// The size of the picture, and how its codes follow from its light: what the arguments leave open, a scene of another
/// ray tracer may ask for.
fn picture_settings(
    arguments: &RenderArguments,
    foreign: Option<input::ForeignPicture>,
    options: &mut SaveOptions,
) -> Result<RenderSettings> {
    let asked = foreign.and_then(|foreign| foreign.size).unwrap_or(DEFAULT_SIZE);
    let [width, height] = arguments.size.map_or(asked, Into::into);
    check_size(width, height, options)?;
    if foreign.is_some() && arguments.development.tone_curve.is_none() {
        options.development.tone_curve = ToneCurve::LinearCodes;
    }
    Ok(RenderSettings { width, height, samples: arguments.samples })
}

fn check_size(width: u32, height: u32, options: &SaveOptions) -> Result<()> {
    Picture::check_size(width, height)?;
    options.check_size(width, height)?;
    Ok(())
}

/// Writes a map instead of the picture: in colors with a legend, or its numbers where the format is linear.
fn show_map(
    arguments: &RenderArguments,
    (files, mut options): (&CommandFiles, SaveOptions),
    map_kind: MapKind,
    render_scene: &RenderScene,
    picture: RenderSettings,
    pool: &rayon::ThreadPool,
    progress: Progress,
) -> Result<CommandOutcome> {
    let settings = MapSettings { kind: map_kind, picture, exposure_stops: arguments.development.exposure };
    let control = RenderControl::default();
    let pixels = u64::from(picture.width) * u64::from(picture.height);
    let map = progress.of_tracing(&control, WorkEstimate { pixels, rays: None }, || {
        pool.install(|| map(render_scene, render_scene.camera(), &settings, &control))
    })?;
    let shown = match options.depth() {
        SampleDepth::Coded(_) => map.to_picture()?,
        SampleDepth::Linear => map.to_numbers()?,
    };
    options.development = Development::default();
    progress.of_writing(&arguments.output.to_string_lossy(), || {
        files.write_picture(&arguments.output, &options, &shown)
    })?;
    if !arguments.quiet && map.incomplete > 0 {
        say(&format!(
            "warning: {} more than {} rays; the map counts so many",
            count(map.incomplete, "pixel has", "pixels have"),
            catoptric_lab::maps::MOST_RAYS
        ));
    }
    if progress.is_shown() {
        say(&format!(
            "{}: {} up to {}, {} on average",
            arguments.output.display(),
            map_kind.name(),
            map.in_words(map.greatest()),
            map.in_words(map.mean() as f32)
        ));
    }
    Ok(CommandOutcome::Done)
}

/// Says it before very many rays are traced. The rays of the picture, if trees can fork.
fn warn_of_work(
    render_scene: &RenderScene,
    settings: RenderSettings,
    pool: &rayon::ThreadPool,
) -> Option<f64> {
    let work = pool.install(|| notes::RayForecast::of(render_scene, settings))?;
    if let Some(warning) = &work.warning {
        say(&format!("warning: {warning}"));
    }
    Some(work.rays)
}

/// Says how many generations the scene needs.
fn advise(render_scene: &RenderScene, settings: RenderSettings, pool: &rayon::ThreadPool) {
    let size = glam::UVec2::new(settings.width, settings.height);
    let measure = pool
        .install(|| DepthMeasure::of(render_scene, render_scene.camera(), size, &RenderControl::default()));
    if let Ok(measure) = measure {
        say(&notes::on_depth(&measure, render_scene.generations()));
    }
}

/// Refuses what can be refused before the work begins; returns how to save the picture.
fn refuse_early(arguments: &RenderArguments, files: &mut CommandFiles) -> Result<SaveOptions> {
    let format = format_for_output(&arguments.output, arguments.format)?;
    let options = arguments.development.save_options(format, arguments.quality)?;
    if let Some(size) = arguments.size {
        check_size(size.width, size.height, &options)?;
    }
    files.add_picture_output(&arguments.output)?;
    if let Some(path) = &arguments.stats {
        files.add_output(path)?;
    }
    if let Some(folder) = &arguments.method.layers {
        files.add_directory(folder, GBufferLayer::ALL.map(layer_file))?;
    }
    Ok(options)
}

fn layer_file(layer: GBufferLayer) -> String {
    format!("{}.png", layer.name())
}

/// Writes the buffers behind the picture: `depth.png` and the like, and of each cube map `cube-map-3.png`, 3 being the
/// number of its body in the scene.
fn write_layers(
    files: &CommandFiles,
    folder: &Path,
    render_scene: &RenderScene,
    drawing: &MethodOutput,
) -> Result<()> {
    let options = SaveOptions::new(PictureFormat::Png, None)?;
    let write = |name: String, picture: &Picture| {
        files.write_picture(&folder.join(name), &options, picture).map(|_| ())
    };
    for layer in GBufferLayer::ALL {
        if let Some(picture) = drawing.layer(render_scene, layer)? {
            write(layer_file(layer), &picture)?;
        }
    }
    for (body, map) in drawing.maps(render_scene) {
        write(format!("cube-map-{}.png", body + 1), &map.unfolded()?)?;
    }
    Ok(())
}

/// Writes the statistics, and on a terminal says in a line what was done.
fn finish(
    arguments: &RenderArguments,
    files: &CommandFiles,
    stats: &Stats<'_>,
    progress: Progress,
) -> Result<()> {
    if let Some(path) = &arguments.stats {
        files.write(path, json_text(&stats.to_json()).as_bytes())?;
    }
    if progress.is_shown() {
        say(&format!(
            "{}: {}x{}, {:.2} s, {:.1} million rays a second on {}",
            arguments.output.display(),
            stats.width,
            stats.height,
            stats.times.trace / 1e3,
            stats.mrays_per_second(),
            stats
                .card
                .map_or_else(|| count(stats.threads, "thread", "threads"), |card| card.name().to_owned()),
        ));
    }
    Ok(())
}

/// Says that what was asked of a card was done without one.
fn warn_of_fallback(reason: &anyhow::Error) {
    say(&format!("warning: the processor draws instead of the graphics card: {reason}"));
}

/// Says what may surprise in the picture.
fn warn_of_scene(input: &input::NamedScene) {
    input.warn();
    if input.loaded.scene.bodies.is_empty() {
        say(&format!(
            "warning: {}: the scene has no bodies; the picture shows the background only",
            input.name
        ));
    }
}
