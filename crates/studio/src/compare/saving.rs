//! Files of the comparison: its report, and pictures to be compared.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptric_files::WriteError;
use catoptric_lab::Machine;
use catoptric_lab::report::{Language, Settings, page};
use catoptric_picture::Development;
use egui::Context;

use super::Comparing;
use super::work::Found;
use crate::app::Studio;
use crate::dialogs::Message;
use crate::dialogs::question::Question;
use crate::documents::ask::{Answer, Asking, Chosen, name_of};
use crate::documents::disk::write_failure_in_words;
use crate::documents::job::{Job, Progress};
use crate::host::{FileKind, FileQuestion};
use crate::methods::report_language;
use crate::pictures::{plain_name, told};

/// What is asked for or written.
#[derive(Default)]
pub(super) enum Saving {
    /// Nothing.
    #[default]
    No,
    /// The person is choosing a picture for one of the sides.
    Opening(Asking, usize),
    /// The person is choosing where to save the report.
    Asking(Asking, Report),
    /// The report is being written.
    Writing(PathBuf, Report, Job<Result<(), Failure>>),
}

/// What is to be reported.
#[derive(Clone)]
pub(super) struct Report {
    found: Arc<Found>,
    language: Language,
    development: Development,
}

/// Why there is no file.
pub(super) enum Failure {
    /// There is one already, and it was not agreed that it is replaced.
    Exists,
    /// The page cannot be made.
    Page(String),
    /// It cannot be written.
    Write(WriteError),
}

/// Asks for a picture file for one of the sides.
pub(crate) fn ask_for_picture(studio: &mut Studio, side: usize) {
    let question = FileQuestion {
        kind: FileKind::Picture,
        is_saving: false,
        title: studio.texts.get("compare-open-title").to_owned(),
        folder: studio.settings.render.folder.clone(),
        name: String::new(),
    };
    studio.panes.compare.saving = Saving::Opening(Asking::start(studio, question), side);
}

/// Asks where to save the report.
pub(crate) fn ask_to_save(studio: &mut Studio) {
    let Some(found) = studio.panes.compare.found.clone() else { return };
    let report =
        Report { found, language: report_language(&studio.texts), development: studio.view.development };
    let stem = plain_name(&report.found.name);
    let question = FileQuestion {
        kind: FileKind::Page,
        is_saving: true,
        title: studio.texts.get("compare-save-title").to_owned(),
        folder: studio.settings.render.folder.clone(),
        name: format!("{stem}-{}.html", studio.texts.get("compare-file-name")),
    };
    studio.panes.compare.saving = Saving::Asking(Asking::start(studio, question), report);
}

/// Takes up an answer, and what has been written; once a frame.
pub(crate) fn poll(context: &Context, studio: &mut Studio) {
    match std::mem::take(&mut studio.panes.compare.saving) {
        Saving::No => {}
        Saving::Opening(mut asking, side) => match asking.poll(context, studio) {
            Answer::Waiting => studio.panes.compare.saving = Saving::Opening(asking, side),
            Answer::Cancelled => {}
            Answer::Chosen(chosen) => take_picture(&mut studio.panes.compare, side, chosen.path),
        },
        Saving::Asking(mut asking, report) => match asking.poll(context, studio) {
            Answer::Waiting => studio.panes.compare.saving = Saving::Asking(asking, report),
            Answer::Cancelled => {}
            Answer::Chosen(chosen) => write(context, studio, report, chosen),
        },
        Saving::Writing(path, report, job) => match job.poll() {
            Progress::Waiting => studio.panes.compare.saving = Saving::Writing(path, report, job),
            Progress::Done(Ok(())) => {
                let name = [("name", name_of(&path).into())];
                studio.toasts.success(studio.texts.with("picture-saved", &name));
            }
            Progress::Done(Err(Failure::Exists)) => ask_to_replace(studio, report, path),
            Progress::Done(Err(Failure::Page(reason))) => tell(studio, told::fault(&studio.texts, &reason)),
            Progress::Done(Err(Failure::Write(error))) => {
                tell(studio, write_failure_in_words(&studio.texts, &error));
            }
            Progress::Lost => tell(studio, told::fault(&studio.texts, "HTML")),
        },
    }
}

fn take_picture(comparing: &mut Comparing, side: usize, path: PathBuf) {
    if let Some(side) = comparing.sides.get_mut(side) {
        side.file = Some(path);
    }
    // A file of the same name may be another one by now.
    (comparing.found, comparing.failed) = (None, None);
}

/// Makes the page and writes it on a thread.
fn write(context: &Context, studio: &mut Studio, report: Report, chosen: Chosen) {
    let Chosen { path, may_replace } = chosen;
    let (own, target) = (report.clone(), path.clone());
    let work = move || {
        if !may_replace && target.exists() {
            return Err(Failure::Exists);
        }
        let html = own.page().map_err(Failure::Page)?;
        catoptric_files::write_bytes(&target, html.as_bytes()).map_err(Failure::Write)
    };
    match Job::start(context, "save report", work) {
        Ok(job) => studio.panes.compare.saving = Saving::Writing(path, report, job),
        Err(error) => tell(studio, told::fault(&studio.texts, &error.to_string())),
    }
}

impl Report {
    /// The page of `catoptric compare`.
    fn page(&self) -> Result<String, String> {
        let found = &*self.found;
        let is_drawn = found.key.view.is_some();
        let scene = is_drawn.then_some(&found.scene);
        let settings = Settings {
            scene: is_drawn.then(|| found.name.clone()),
            bodies_and_lights: scene.map(|scene| [scene.bodies.len(), scene.lights.len()]),
            samples: is_drawn.then_some(1),
            generations: scene.map(|scene| scene.tracing.generations),
            threads: found.threads,
            development: self.development,
            language: self.language,
        };
        page(&found.compared, &Machine::here(), &settings).map_err(|error| error.to_string())
    }
}

fn ask_to_replace(studio: &mut Studio, report: Report, path: PathBuf) {
    let texts = &studio.texts;
    let folder = path.parent().unwrap_or(Path::new("")).display().to_string();
    let question = Question::new(
        texts.with("picture-replace-title", &[("name", name_of(&path).into())]),
        texts.with("picture-replace-text", &[("folder", folder.into())]),
    )
    .choice(texts.get("cancel"), |_, _| {})
    .choice(texts.get("picture-replace"), move |context, studio| {
        write(context, studio, report, Chosen { path, may_replace: true });
    });
    studio.dialogs.open(question);
}

fn tell(studio: &mut Studio, text: String) {
    let title = studio.texts.get("report-save-failed").to_owned();
    studio.dialogs.open(Message::new(title, text));
}
