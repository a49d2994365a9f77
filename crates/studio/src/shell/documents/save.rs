//! Saving.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::Context;

use super::{banner, close_guard, save_as};
use crate::base::job::{Job, JobStatus};
use crate::base::words::name_of;
use crate::shell::disk::{self, OverwriteRule, SavedFile, WriteFailure};
use crate::shell::studio::Studio;
use crate::shell::studio::dialogs::question::{AnswerAction, QuestionDialog};
use crate::shell::studio::documents::{NextDocument, SceneSaveRequest, SceneSaveTask};
use crate::state::settings::LastScene;

/// Saves the document to its file, or asks for one; then does what was meant to come after.
pub(crate) fn save(context: &Context, studio: &mut Studio, then: Option<NextDocument>) {
    let Some(path) = studio.editor.path().map(Path::to_owned) else { return save_as(studio, then) };
    if studio.documents.is_partial {
        ask_about_partial(studio, path, then);
        return;
    }
    let may = studio.documents.may.unwrap_or(OverwriteRule::Replace);
    order(context, studio, SceneSaveRequest { path, may, then });
}

/// Begins to save, or waits until the saving under way is done.
pub(super) fn order(context: &Context, studio: &mut Studio, order: SceneSaveRequest) {
    if studio.documents.saving.is_some() {
        studio.documents.next_saving = Some(order);
        return;
    }
    studio.editor.settle();
    let path = std::path::absolute(&order.path).unwrap_or(order.path);
    let order = SceneSaveRequest { path, ..order };
    let writing = studio.editor.writing_to(&order.path);
    let (written, path, may) = (writing.clone(), order.path.clone(), order.may);
    match Job::start(context, "save", move || disk::write(&written, &path, may)) {
        Ok(job) => {
            let document = studio.documents.number;
            studio.documents.saving = Some(SceneSaveTask { job, writing, document, order });
        }
        Err(error) => {
            let path = order.path.display().to_string();
            let arguments = [("path", path.into()), ("reason", error.to_string().into())];
            let text = studio.texts.with("write-other", &arguments);
            tell_failure(studio, &text, order.then);
        }
    }
}

/// Takes up what has been saved.
pub(super) fn poll(context: &Context, studio: &mut Studio) {
    let Some(saving) = studio.documents.saving.take() else { return };
    match saving.job.poll() {
        JobStatus::Waiting => {
            studio.documents.saving = Some(saving);
            return;
        }
        JobStatus::Done(Ok(written)) => return saved(context, studio, saving, written),
        JobStatus::Done(Err(WriteFailure::Other)) => ask_about_replacing(studio, saving.order),
        JobStatus::Done(Err(WriteFailure::Cannot(error))) => {
            let text = disk::write_failure_in_words(&studio.texts, &error);
            tell_failure(studio, &text, saving.order.then);
        }
        JobStatus::Lost => {
            let text = studio.texts.get("fault").to_owned();
            tell_failure(studio, &text, saving.order.then);
        }
    }
    // The error is shown; the person may try again.
    studio.documents.next_saving = None;
}

fn saved(context: &Context, studio: &mut Studio, saving: SceneSaveTask, written: SavedFile) {
    let SceneSaveTask { writing, document, order: SceneSaveRequest { path, then, .. }, .. } = saving;
    let then = then.map(|next| match next {
        // What has been read is no longer what the file says.
        NextDocument::Show(opened) if opened.path == path => NextDocument::Open(path.clone()),
        next => next,
    });
    studio.settings.remember_recent(&path);
    let name = name_of(&path);
    studio.toasts.success(studio.texts.with("saved", &[("name", name.into())]));
    if document == studio.documents.number {
        studio.editor.mark_written(&writing, path.clone(), Arc::clone(&written.text));
        let documents = &mut studio.documents;
        documents.text_on_disk = Some(written.text);
        documents.saves += 1;
        documents.may = written.stamp.map(OverwriteRule::Update);
        documents.is_partial = false;
        documents.example = None;
        studio.settings.last = Some(LastScene::File(path));
        banner::clear_findings(studio);
    }
    match (studio.documents.next_saving.take(), then) {
        (Some(mut next), then) => {
            // First things first.
            next.then = next.then.or(then);
            if let (OverwriteRule::Update(_) | OverwriteRule::UpdateBefore(_), Some(may)) =
                (next.may, studio.documents.may)
            {
                // The file is the one that has just been written.
                next.may = may;
            }
            order(context, studio, next);
        }
        // Asks again if the scene has changed while it was being written.
        (None, Some(next)) => close_guard::replace(context, studio, next),
        (None, None) => {}
    }
}

/// There is a file already, or another program has changed it.
fn ask_about_replacing(studio: &mut Studio, order: SceneSaveRequest) {
    let name = name_of(&order.path);
    let path = order.path.display().to_string();
    let texts = &studio.texts;
    let (title, text) = match order.may {
        OverwriteRule::Create | OverwriteRule::Replace => ("replace-title", "replace-text"),
        OverwriteRule::Update(_) | OverwriteRule::UpdateBefore(_) => ("overwrite-title", "overwrite-text"),
    };
    let question = QuestionDialog::new(
        texts.with(title, &[("name", name.into())]),
        texts.with(text, &[("path", path.into())]),
    );
    let SceneSaveRequest { path, then, .. } = order;
    let other = then.clone();
    let question = question
        .choice(texts.get("save-as"), move |_, studio| save_as(studio, other))
        .choice(texts.get("cancel"), |_, _| {})
        .choice(texts.get("replace"), move |context, studio| {
            super::save::order(context, studio, SceneSaveRequest { path, may: OverwriteRule::Replace, then });
        });
    studio.dialogs.open(question);
}

/// The file has parts that could not be read and would be lost.
fn ask_about_partial(studio: &mut Studio, path: PathBuf, then: Option<NextDocument>) {
    let texts = &studio.texts;
    let name = super::name(studio);
    let other = then.clone();
    let question = QuestionDialog::new(
        texts.with("partial-title", &[("name", name.clone().into())]),
        texts.with("partial-text", &[("name", name.into())]),
    )
    .choice(texts.get("save-as"), move |_, studio| save_as(studio, other))
    .choice(texts.get("cancel"), |_, _| {})
    .choice(texts.get("replace"), move |context, studio: &mut Studio| {
        let may = studio.documents.may.unwrap_or(OverwriteRule::Replace);
        order(context, studio, SceneSaveRequest { path, may, then });
    });
    studio.dialogs.open(question);
}

/// The document could not be saved; nothing is lost.
fn tell_failure(studio: &mut Studio, text: &str, then: Option<NextDocument>) {
    let texts = &studio.texts;
    let rest: AnswerAction = Box::new(move |_, studio| save_as(studio, then));
    let question = QuestionDialog::new(
        texts.get("save-failed"),
        format!("{text}\n\n{}", texts.get("save-failed-nothing-lost")),
    )
    .choice(texts.get("save-as"), rest)
    .choice(texts.get("close"), |_, _| {});
    studio.dialogs.open(question);
}
