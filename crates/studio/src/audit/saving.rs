//! Saving the tree of an audit as a picture.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptric_files::WriteError;
use catoptric_lab::audit::Audit;
use egui::Context;

use crate::app::Studio;
use crate::dialogs::Message;
use crate::dialogs::question::Question;
use crate::documents::ask::{Answer, Asking, Chosen, name_of};
use crate::documents::disk::write_failure_in_words;
use crate::documents::job::{Job, Progress};
use crate::host::{FileKind, FileQuestion};
use crate::pictures::told;

/// How far saving is.
#[derive(Default)]
pub(super) enum Saving {
    /// Nothing is being saved.
    #[default]
    No,
    /// The person is choosing a file.
    Asking(Asking, Arc<Audit>),
    /// The file is being written.
    Writing(PathBuf, Arc<Audit>, Job<Result<(), Failure>>),
}

/// Why there is no file.
pub(super) enum Failure {
    /// There is one already, and it was not agreed that it is replaced.
    Exists,
    /// It cannot be written.
    Write(WriteError),
}

/// Asks for a file.
pub(super) fn ask(studio: &mut Studio, audit: Arc<Audit>) {
    let stem = studio.editor.path().and_then(Path::file_stem).map(|stem| stem.to_string_lossy().into_owned());
    let stem = stem.unwrap_or_else(|| studio.texts.get("audit-file").to_owned());
    let question = FileQuestion {
        kind: FileKind::Drawing,
        is_saving: true,
        title: studio.texts.get("audit-save-title").to_owned(),
        folder: studio.settings.render.folder.clone(),
        name: format!("{stem}-{}-{}.svg", audit.pixel.x, audit.pixel.y),
    };
    studio.audit.saving = Saving::Asking(Asking::start(studio, question), audit);
}

/// Takes up an answer, and what has been written; in every frame.
pub(crate) fn poll(context: &Context, studio: &mut Studio) {
    match std::mem::take(&mut studio.audit.saving) {
        Saving::No => {}
        Saving::Asking(mut asking, audit) => match asking.poll(context, studio) {
            Answer::Waiting => studio.audit.saving = Saving::Asking(asking, audit),
            Answer::Cancelled => {}
            Answer::Chosen(chosen) => write(context, studio, audit, chosen),
        },
        Saving::Writing(path, audit, job) => match job.poll() {
            Progress::Waiting => studio.audit.saving = Saving::Writing(path, audit, job),
            Progress::Done(Ok(())) => {
                let name = [("name", name_of(&path).into())];
                studio.toasts.success(studio.texts.with("picture-saved", &name));
            }
            Progress::Done(Err(Failure::Exists)) => ask_to_replace(studio, audit, path),
            Progress::Done(Err(Failure::Write(error))) => {
                tell(studio, write_failure_in_words(&studio.texts, &error));
            }
            Progress::Lost => tell(studio, told::fault(&studio.texts, "SVG")),
        },
    }
}

/// Writes the file on a thread.
fn write(context: &Context, studio: &mut Studio, audit: Arc<Audit>, chosen: Chosen) {
    let Chosen { path, may_replace } = chosen;
    let (own, target) = (Arc::clone(&audit), path.clone());
    let work = move || {
        if !may_replace && target.exists() {
            return Err(Failure::Exists);
        }
        catoptric_files::write_bytes(&target, own.to_svg(None).as_bytes()).map_err(Failure::Write)
    };
    match Job::start(context, "save audit", work) {
        Ok(job) => studio.audit.saving = Saving::Writing(path, audit, job),
        Err(error) => tell(studio, told::fault(&studio.texts, &error.to_string())),
    }
}

fn ask_to_replace(studio: &mut Studio, audit: Arc<Audit>, path: PathBuf) {
    let texts = &studio.texts;
    let folder = path.parent().unwrap_or(Path::new("")).display().to_string();
    let question = Question::new(
        texts.with("picture-replace-title", &[("name", name_of(&path).into())]),
        texts.with("picture-replace-text", &[("folder", folder.into())]),
    )
    .choice(texts.get("cancel"), |_, _| {})
    .choice(texts.get("picture-replace"), move |context, studio| {
        write(context, studio, audit, Chosen { path, may_replace: true });
    });
    studio.dialogs.open(question);
}

fn tell(studio: &mut Studio, text: String) {
    let title = studio.texts.get("picture-save-failed").to_owned();
    studio.dialogs.open(Message::new(title, text));
}
