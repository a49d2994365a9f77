//! Files that are made of what was found out: drawings, pages, folders with reports. A person says where; a thread
//! makes them and writes them; what was there before is replaced only if that is agreed.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptric_platform::files;
use egui::Context;

use crate::base::job::{Job, JobStatus};
use crate::base::texts::Texts;
use crate::base::words::{self, name_of};
use crate::shell::disk::write_failure_in_words;
use crate::shell::host::FileQuestion;
use crate::shell::studio::Studio;
use crate::shell::studio::dialogs::MessageDialog;
use crate::shell::studio::dialogs::question::QuestionDialog;
use crate::shell::studio::exports::{Export, ExportFailure, ExportTask};
use crate::shell::studio::file_prompt::{ChosenFile, FilePrompt, FilePromptState};

/// Asks where `export` is to be written; a question that has not been answered is forgotten.
pub(crate) fn ask(studio: &mut Studio, question: FileQuestion, export: impl Export) {
    studio.exports.going.retain(|going| matches!(going, ExportTask::Writing(..)));
    let prompt = FilePrompt::start(studio, question);
    studio.exports.going.push(ExportTask::Asking(prompt, Arc::new(export)));
}

/// Takes up answers, and what has been written; once a frame.
pub(crate) fn poll(context: &Context, studio: &mut Studio) {
    for going in std::mem::take(&mut studio.exports.going) {
        match going {
            ExportTask::Asking(mut prompt, export) => match prompt.poll(context, studio) {
                FilePromptState::Waiting => studio.exports.going.push(ExportTask::Asking(prompt, export)),
                FilePromptState::Cancelled => {}
                FilePromptState::Chosen(ChosenFile { path, may_replace }) => {
                    // The system's dialog asks for a folder's name, not for what such a folder has in it.
                    let may_replace = may_replace && export.landmark().is_none();
                    write(context, studio, export, path, may_replace);
                }
            },
            ExportTask::Writing(path, export, job) => match job.poll() {
                JobStatus::Waiting => studio.exports.going.push(ExportTask::Writing(path, export, job)),
                JobStatus::Done(Some(Ok(()))) => {
                    let name = [("name", name_of(&path).into())];
                    studio.toasts.success(studio.texts.with("picture-saved", &name));
                }
                JobStatus::Done(Some(Err(failure))) => {
                    let text = failure.in_words(&studio.texts, &path);
                    tell(studio, text);
                }
                JobStatus::Done(None) => ask_to_replace(studio, export, path),
                JobStatus::Lost => {
                    let text = words::fault(&studio.texts, &name_of(&path));
                    tell(studio, text);
                }
            },
        }
    }
}

fn write(context: &Context, studio: &mut Studio, export: Arc<dyn Export>, path: PathBuf, may_replace: bool) {
    let (own, target) = (Arc::clone(&export), path.clone());
    let work = move || {
        let is_there =
            own.landmark().map_or_else(|| files::exists(&target), |file| files::exists(&target.join(file)));
        (may_replace || !is_there).then(|| own.write(&target))
    };
    match Job::start(context, "export", work) {
        Ok(job) => studio.exports.going.push(ExportTask::Writing(path, export, job)),
        Err(error) => tell(studio, words::fault(&studio.texts, &error.to_string())),
    }
}

fn ask_to_replace(studio: &mut Studio, export: Arc<dyn Export>, path: PathBuf) {
    let texts = &studio.texts;
    let (text, folder) = match export.landmark() {
        Some(_) => ("measure-replace-text", path.as_path()),
        None => ("picture-replace-text", path.parent().unwrap_or(Path::new(""))),
    };
    let question = QuestionDialog::new(
        texts.with("picture-replace-title", &[("name", name_of(&path).into())]),
        texts.with(text, &[("folder", folder.display().to_string().into())]),
    )
    .choice(texts.get("cancel"), |_, _| {})
    .choice(texts.get("picture-replace"), move |context, studio| {
        write(context, studio, export, path, true);
    });
    studio.dialogs.open(question);
}

impl ExportFailure {
    fn in_words(self, texts: &Texts, path: &Path) -> String {
        match self {
            Self::Content(reason) => words::fault(texts, &reason),
            Self::Folder(error) => {
                let (path, reason) = (path.display().to_string(), error.to_string());
                texts.with("measure-no-folder", &[("path", path.into()), ("reason", reason.into())])
            }
            Self::Write(error) => write_failure_in_words(texts, &error),
        }
    }
}

fn tell(studio: &mut Studio, text: String) {
    let title = studio.texts.get("report-save-failed").to_owned();
    studio.dialogs.open(MessageDialog::new(title, text));
}
