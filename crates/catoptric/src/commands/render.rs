//! `catoptric render`

use std::io::IsTerminal as _;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

use anyhow::{Context as _, Result, bail};
use catoptric_picture::{Picture, check_writable, write_bytes};
use catoptric_tracer::{Control, RenderError, RenderSettings, Stage, render};

use super::Outcome;
use crate::arguments::{Backend, RenderArguments};
use crate::output::{Kind, color_on, print, write_picture};
use crate::stats::{Stats, Times};
use crate::{input, interrupt, memory, progress};

pub(crate) fn run(arguments: &RenderArguments) -> Result<Outcome> {
    // Whatever can be refused is refused before the work begins.
    let kind = Kind::of_picture(&arguments.output)?;
    if arguments.backend == Backend::Gpu {
        bail!("this version has no GPU renderer; use --backend cpu");
    }
    Picture::check_size(arguments.size.width, arguments.size.height)?;
    check_writable(&arguments.output)?;
    if let Some(path) = &arguments.stats
        && !is_stdout(path)
    {
        check_writable(path)?;
    }

    let control = Arc::new(Control::default());
    interrupt::cancels(&control)?;
    let mut times = Times::default();

    let start = Instant::now();
    let input = input::scene(&arguments.scene)?;
    times.read = milliseconds(start);
    if !arguments.quiet {
        warn(&input);
    }

    let start = Instant::now();
    let mut stage = Stage::prepare(&input.loaded.scene).with_context(|| input.name.clone())?;
    drop(input.loaded);
    if let Some(generations) = arguments.generations {
        stage = stage.with_generations(generations);
    }
    times.prepare = milliseconds(start);

    let threads = arguments.threads.map_or(0, usize::from);
    let pool =
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().context("cannot start threads")?;
    let settings = RenderSettings {
        width: arguments.size.width,
        height: arguments.size.height,
        samples: arguments.samples,
    };
    let pixels = u64::from(settings.width) * u64::from(settings.height);
    let start = Instant::now();
    let rendering = progress::show(&control, pixels, arguments.quiet, || {
        pool.install(|| render(&stage, settings, &control))
    });
    times.trace = milliseconds(start);
    let rendering = match rendering {
        Ok(rendering) => rendering,
        Err(RenderError::Cancelled) => return Ok(Outcome::Interrupted),
        Err(error) => return Err(error.into()),
    };

    (times.develop, times.write) =
        write_picture(&arguments.output, kind, &rendering.picture, &arguments.development)?;
    let stats = Stats {
        scene: &input.name,
        width: settings.width,
        height: settings.height,
        samples: settings.samples,
        generations: stage.generations(),
        threads: pool.current_num_threads(),
        bodies: stage.body_count(),
        lights: stage.light_count(),
        stage_bytes: stage.bytes(),
        times,
        rays: rendering.counts,
        peak_memory_bytes: memory::peak_bytes(),
    };
    finish(arguments, &stats)?;
    Ok(Outcome::Done)
}

/// Writes the statistics, and on a terminal says in a line what was done.
fn finish(arguments: &RenderArguments, stats: &Stats<'_>) -> Result<()> {
    if let Some(path) = &arguments.stats {
        let text = format!("{:#}\n", stats.to_json());
        if is_stdout(path) {
            print(&text)?;
        } else {
            write_bytes(path, text.as_bytes())?;
        }
    }
    if !arguments.quiet && std::io::stderr().is_terminal() {
        eprintln!(
            "{}: {}x{}, {:.2} s, {:.1} million rays a second on {} threads",
            arguments.output.display(),
            stats.width,
            stats.height,
            stats.times.trace / 1e3,
            stats.mrays_per_second(),
            stats.threads,
        );
    }
    Ok(())
}

/// Says what may surprise in the picture.
fn warn(input: &input::Named) {
    let loaded = &input.loaded;
    if !loaded.warnings.is_empty() {
        let color = color_on(&std::io::stderr());
        eprintln!("{}", loaded.warnings.render(&input.name, &loaded.text, color));
    }
    if loaded.scene.bodies.is_empty() {
        eprintln!("warning: {}: the scene has no bodies; the picture shows the background only", input.name);
    }
}

fn is_stdout(path: &Path) -> bool {
    path.as_os_str() == "-"
}

fn milliseconds(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}
