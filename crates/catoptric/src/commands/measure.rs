//! `catoptric measure`

use std::fs;
use std::sync::Arc;

use anyhow::{Context as _, Result, bail};
use catoptric_lab::measure::{Axis, MeasureError, MeasurePlan, PictureQuestion, measure};
use catoptric_lab::report::{MeasurementReport, study};
use catoptric_picture::Picture;
use catoptric_tracer::{RenderControl, RenderSettings};

use super::CommandOutcome;
use crate::arguments::MeasureArguments;
use crate::console::{print, say};
use crate::files::CommandFiles;
use crate::progress::Progress;
use crate::{input, interrupt};

pub(crate) fn run(arguments: &MeasureArguments) -> Result<CommandOutcome> {
    if !cfg!(feature = "plots") {
        bail!(
            "this program is built without plots, which `measure` writes; \
             `cargo install --path crates/catoptric` builds all of it"
        );
    }
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let axes = Axis::read(&arguments.vary, threads).context("--vary")?;
    let questions = arguments.answers.as_deref().map(PictureQuestion::read).transpose();
    let questions = questions.context("--answers")?.unwrap_or_default();
    Picture::check_size(arguments.size.width, arguments.size.height)?;
    let mut files = CommandFiles::default();
    let input = input::scene(&arguments.scene, &arguments.set, Some(arguments.size), &mut files)?;
    if !arguments.quiet {
        input.warn();
    }
    files.add_directory(&arguments.output, MeasurementReport::names(&questions))?;
    // At once: what was measured must not be lost for want of a place when the sweep is interrupted.
    let is_new_directory = !arguments.output.exists();
    fs::create_dir_all(&arguments.output)
        .with_context(|| format!("cannot make the directory {}", arguments.output.display()))?;
    let plan = MeasurePlan {
        scene: input.loaded.scene,
        name: input.name,
        variant: arguments.method.clone(),
        settings: RenderSettings {
            width: arguments.size.width,
            height: arguments.size.height,
            samples: arguments.samples,
        },
        threads: arguments.threads.map_or(0, usize::from),
        axes,
        questions,
        rounds: arguments.rounds,
        least_time: MeasurePlan::LEAST_TIME,
    };
    let control = Arc::new(RenderControl::default());
    let asked = Arc::clone(&control);
    interrupt::ask_first(move || asked.cancel());
    let points: usize = plan.axes.iter().map(|axis| axis.values.len()).product();
    let total = points.saturating_mul(plan.rounds as usize + 1);
    let progress = Progress::new(arguments.quiet);
    let measured = progress
        .of_steps(total, |tell| measure(&plan, &control, &mut |progress| tell(progress.done, progress.left)));
    if measured.is_err() && is_new_directory {
        // It is empty.
        let _ = fs::remove_dir(&arguments.output);
    }
    let measured = match measured {
        Err(MeasureError::Cancelled) => {
            say("interrupted; nothing was written");
            return Ok(CommandOutcome::Interrupted);
        }
        other => other?,
    };
    let study = study(&measured, arguments.language)?;
    for (name, bytes) in &study.files {
        files.write(&arguments.output.join(name), bytes)?;
    }
    if !arguments.quiet {
        let report = arguments.output.join("report.md");
        print(&format!("{}\nreport: {}\n", study.laws.join("\n"), report.display()))?;
    }
    if measured.complete {
        return Ok(CommandOutcome::Done);
    }
    say(&format!("interrupted; what was measured is in {}", arguments.output.display()));
    Ok(CommandOutcome::Interrupted)
}
