//! Saving a finished picture.

use std::path::Path;
use std::sync::Arc;

use catoptric_picture::{FormatError, Picture, PictureFormat, SaveOptions};
use catoptric_platform::files;
use egui::Context;

use super::file_name;
use crate::base::job::{Job, JobStatus};
use crate::base::words::{self, name_of};
use crate::shell::disk::write_failure_in_words;
use crate::shell::host::{FileKind, FileQuestion};
use crate::shell::studio::Studio;
use crate::shell::studio::dialogs::question::QuestionDialog;
use crate::shell::studio::file_prompt::{ChosenFile, FilePrompt, FilePromptState};
use crate::shell::studio::pictures::{
    FinishedPicture, PictureSaveFailure, PictureSaveRequest, PictureSaveState, SavedPlace,
};

/// Asks for a file.
pub(super) fn ask(studio: &mut Studio, finished: &mut FinishedPicture) {
    let choices = &studio.settings.render;
    let beside = studio.editor.path().and_then(Path::parent).map(Path::to_owned);
    let question = FileQuestion {
        kind: FileKind::SavedPicture,
        is_saving: true,
        title: studio.texts.get("picture-save-title").to_owned(),
        folder: choices.folder.clone().or(beside),
        name: file_name(&finished.order, finished.order.choices.kind),
    };
    finished.saving = PictureSaveState::Asking(FilePrompt::start(studio, question));
}

/// Takes up an answer, and what has been written.
pub(super) fn poll(context: &Context, studio: &mut Studio, finished: &mut FinishedPicture) {
    match std::mem::take(&mut finished.saving) {
        PictureSaveState::No => {}
        PictureSaveState::Asking(mut prompt) => match prompt.poll(context, studio) {
            FilePromptState::Waiting => finished.saving = PictureSaveState::Asking(prompt),
            FilePromptState::Cancelled => {}
            FilePromptState::Chosen(ChosenFile { path, may_replace }) => {
                let (kind, development) = (finished.order.choices.kind, finished.order.development);
                write(context, studio, finished, PictureSaveRequest { path, may_replace, kind, development });
            }
        },
        PictureSaveState::Writing(order, job) => match job.poll() {
            JobStatus::Waiting => finished.saving = PictureSaveState::Writing(order, job),
            JobStatus::Done(Ok(())) => saved(studio, finished, &order.path),
            JobStatus::Done(Err(failure)) => failed(studio, finished, order, &failure),
            JobStatus::Lost => tell(studio, words::fault(&studio.texts, order.kind.format().name())),
        },
    }
}

/// Writes the file on a thread.
pub(super) fn write(
    context: &Context,
    studio: &mut Studio,
    finished: &mut FinishedPicture,
    order: PictureSaveRequest,
) {
    let (picture, own) = (Arc::clone(&finished.picture), order.clone());
    match Job::start(context, "save picture", move || own.write(&picture)) {
        Ok(job) => finished.saving = PictureSaveState::Writing(order, job),
        Err(error) => tell(studio, words::fault(&studio.texts, &error.to_string())),
    }
}

impl PictureSaveRequest {
    fn write(&self, picture: &Picture) -> Result<(), PictureSaveFailure> {
        if !self.may_replace && files::exists(&self.path) {
            return Err(PictureSaveFailure::Exists);
        }
        let mut options = self.options().map_err(PictureSaveFailure::Format)?;
        options.check_size(picture.width(), picture.height()).map_err(PictureSaveFailure::Format)?;
        options.development = self.development;
        options
            .prepare(picture)
            .map_err(PictureSaveFailure::Size)?
            .write(&self.path)
            .map_err(PictureSaveFailure::Write)
    }

    /// The name decides on the format; it has the chosen depth if it is the chosen format, else its usual one.
    fn options(&self) -> Result<SaveOptions, FormatError> {
        let format = PictureFormat::of_path(&self.path).unwrap_or(self.kind.format());
        SaveOptions::new(format, (format == self.kind.format()).then_some(self.kind.depth()))
    }
}

fn saved(studio: &mut Studio, finished: &mut FinishedPicture, path: &Path) {
    studio.settings.render.folder = path.parent().map(Path::to_owned);
    let name = name_of(path);
    studio.toasts.success(studio.texts.with("picture-saved", &[("name", name.as_str().into())]));
    finished.kept = Some(SavedPlace::File(name));
}

fn failed(
    studio: &mut Studio,
    finished: &FinishedPicture,
    order: PictureSaveRequest,
    failure: &PictureSaveFailure,
) {
    let text = match failure {
        PictureSaveFailure::Exists => return ask_to_replace(studio, finished.number, order),
        PictureSaveFailure::Write(error) => write_failure_in_words(&studio.texts, error),
        PictureSaveFailure::Size(error) => words::size_error(&studio.texts, error),
        PictureSaveFailure::Format(error) => words::format_error(&studio.texts, error),
    };
    tell(studio, text);
}

fn ask_to_replace(studio: &mut Studio, number: u64, order: PictureSaveRequest) {
    let texts = &studio.texts;
    let name = name_of(&order.path);
    let folder = order.path.parent().unwrap_or(Path::new("")).display().to_string();
    let question = QuestionDialog::new(
        texts.with("picture-replace-title", &[("name", name.into())]),
        texts.with("picture-replace-text", &[("folder", folder.into())]),
    )
    .choice(texts.get("picture-other-name"), move |_, studio| {
        FinishedPicture::with(studio, number, ask);
    })
    .choice(texts.get("cancel"), |_, _| {})
    .choice(texts.get("picture-replace"), move |context, studio| {
        let order = PictureSaveRequest { may_replace: true, ..order };
        FinishedPicture::with(studio, number, |studio, finished| write(context, studio, finished, order));
    });
    studio.dialogs.open(question);
}

fn tell(studio: &mut Studio, text: String) {
    let title = studio.texts.get("picture-save-failed").to_owned();
    studio.dialogs.open(crate::shell::studio::dialogs::MessageDialog::new(title, text));
}
