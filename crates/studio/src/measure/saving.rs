//! Saving what was measured: a folder with report, plots and tables.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptric_files::WriteError;
use catoptric_lab::measure::Measured;
use catoptric_lab::report::{Language, study};
use egui::Context;

use crate::app::Studio;
use crate::dialogs::Message;
use crate::dialogs::question::Question;
use crate::documents::ask::{Answer, Asking, name_of};
use crate::documents::disk::write_failure_in_words;
use crate::documents::job::{Job, Progress};
use crate::host::{FileKind, FileQuestion};
use crate::methods::report_language;
use crate::pictures::{plain_name, told};

/// The file by which a folder is known to have such a report already.
const REPORT: &str = "report.md";

/// How far saving is.
#[derive(Default)]
pub(super) enum Saving {
    /// Nothing is being saved.
    #[default]
    No,
    /// The person is choosing a folder.
    Asking(Asking, Order),
    /// The files are being written.
    Writing(PathBuf, Order, Job<Result<(), Failure>>),
}

/// What is to be saved.
#[derive(Clone)]
pub(super) struct Order {
    measured: Arc<Measured>,
    language: Language,
}

/// Why there are no files.
pub(super) enum Failure {
    /// The folder has a report already, and it was not agreed that it is replaced.
    Exists,
    /// The plots cannot be drawn.
    Plot(String),
    /// The folder cannot be made.
    Folder(std::io::Error),
    /// A file cannot be written.
    Write(WriteError),
}

/// Asks for a folder.
pub(super) fn ask(studio: &mut Studio) {
    let measuring = &studio.panes.measure;
    let Some(measured) = measuring.measured.clone().filter(|_| measuring.is_measured()) else { return };
    let parameters: Vec<&str> = measured.axes.iter().map(|axis| axis.parameter.key()).collect();
    let question = FileQuestion {
        kind: FileKind::Folder,
        is_saving: true,
        title: studio.texts.get("measure-save-title").to_owned(),
        folder: studio.settings.render.folder.clone(),
        name: format!("{}-{}", plain_name(&measured.name), parameters.join("-")),
    };
    let order = Order { measured, language: report_language(&studio.texts) };
    studio.panes.measure.saving = Saving::Asking(Asking::start(studio, question), order);
}

/// Takes up an answer, and what has been written; once a frame.
pub(super) fn poll(context: &Context, studio: &mut Studio) {
    match std::mem::take(&mut studio.panes.measure.saving) {
        Saving::No => {}
        Saving::Asking(mut asking, order) => match asking.poll(context, studio) {
            Answer::Waiting => studio.panes.measure.saving = Saving::Asking(asking, order),
            Answer::Cancelled => {}
            // The system's dialog has asked for a name, not for what a folder of that name has in it.
            Answer::Chosen(chosen) => write(context, studio, order, chosen.path, false),
        },
        Saving::Writing(path, order, job) => match job.poll() {
            Progress::Waiting => studio.panes.measure.saving = Saving::Writing(path, order, job),
            Progress::Done(Ok(())) => {
                let name = [("name", path.display().to_string().into())];
                studio.toasts.success(studio.texts.with("picture-saved", &name));
            }
            Progress::Done(Err(Failure::Exists)) => ask_to_replace(studio, order, path),
            Progress::Done(Err(failure)) => {
                let text = in_words(studio, &path, failure);
                tell(studio, text);
            }
            Progress::Lost => tell(studio, told::fault(&studio.texts, "SVG")),
        },
    }
}

fn in_words(studio: &Studio, path: &Path, failure: Failure) -> String {
    let texts = &studio.texts;
    match failure {
        Failure::Exists => String::new(),
        Failure::Plot(reason) => told::fault(texts, &reason),
        Failure::Folder(error) => {
            let path = path.display().to_string();
            let reason = error.to_string();
            texts.with("measure-no-folder", &[("path", path.into()), ("reason", reason.into())])
        }
        Failure::Write(error) => write_failure_in_words(texts, &error),
    }
}

/// Makes the files and writes them on a thread.
fn write(context: &Context, studio: &mut Studio, order: Order, path: PathBuf, may_replace: bool) {
    let (own, target) = (order.clone(), path.clone());
    let work = move || {
        if !may_replace && target.join(REPORT).exists() {
            return Err(Failure::Exists);
        }
        let study = study(&own.measured, own.language).map_err(|error| Failure::Plot(error.to_string()))?;
        std::fs::create_dir_all(&target).map_err(Failure::Folder)?;
        for (name, bytes) in &study.files {
            catoptric_files::write_bytes(&target.join(name), bytes).map_err(Failure::Write)?;
        }
        Ok(())
    };
    match Job::start(context, "save measurement", work) {
        Ok(job) => studio.panes.measure.saving = Saving::Writing(path, order, job),
        Err(error) => tell(studio, told::fault(&studio.texts, &error.to_string())),
    }
}

fn ask_to_replace(studio: &mut Studio, order: Order, path: PathBuf) {
    let texts = &studio.texts;
    let name = name_of(&path);
    let question = Question::new(
        texts.with("picture-replace-title", &[("name", name.as_str().into())]),
        texts.with("measure-replace-text", &[("folder", path.display().to_string().into())]),
    )
    .choice(texts.get("cancel"), |_, _| {})
    .choice(texts.get("picture-replace"), move |context, studio| {
        write(context, studio, order, path, true);
    });
    studio.dialogs.open(question);
}

fn tell(studio: &mut Studio, text: String) {
    let title = studio.texts.get("report-save-failed").to_owned();
    studio.dialogs.open(Message::new(title, text));
}
