//! Opening files.

use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;

use catoptric_editor::{Action, RefusedChange};
use catoptric_exchange::{ForeignFormat, ImportOptions};
use catoptric_store::path_from;
use egui::Context;

use super::{banner, close_guard};
use crate::base::job::{Job, JobStatus};
use crate::base::words::name_of;
use crate::shell::disk::{self, ForeignRefusal, OpenedScene, OverwriteRule, ReadFailure};
use crate::shell::host::FileKind;
use crate::shell::images;
use crate::shell::studio::dialogs::MessageDialog;
use crate::shell::studio::dialogs::question::QuestionDialog;
use crate::shell::studio::documents::{NextDocument, OpenPurpose, OpenTask};
use crate::shell::studio::{Studio, file_prompt};
use crate::state::images::ImageUse;
use crate::state::refusal;
use crate::state::settings::LastScene;

/// Begins to read the file at `path`, to open it instead of the document. Only a file that can be opened leads to the
/// question what becomes of changes.
pub(super) fn begin(context: &Context, studio: &mut Studio, path: &Path) {
    read(context, studio, path, OpenPurpose::Open { is_approximate: false });
}

/// Takes back all changes since the file was saved, as one step.
pub(super) fn revert(context: &Context, studio: &mut Studio) {
    let document = studio.documents.number;
    match (studio.editor.path().map(Path::to_owned), studio.documents.example) {
        (Some(path), _) => read(context, studio, &path, OpenPurpose::Revert(document)),
        (None, Some(example)) => {
            if let Ok(loaded) = example.load() {
                let reverted = studio.editor.revert(loaded.text, loaded.scene);
                after_revert(studio, reverted, "reverted");
            }
        }
        (None, None) => {
            let text = studio.texts.get("revert-no-file").to_owned();
            studio.toasts.info(text);
        }
    }
}

/// Takes what another program has written into the document's file, as one step.
pub(super) fn reload(context: &Context, studio: &mut Studio) {
    if let Some(path) = studio.editor.path().map(Path::to_owned) {
        let document = studio.documents.number;
        read(context, studio, &path, OpenPurpose::Reload(document));
    }
}

fn read(context: &Context, studio: &mut Studio, path: &Path, purpose: OpenPurpose) {
    // The path must mean the same whatever the folder of the program is later.
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let read = path.clone();
    let is_approximate = matches!(purpose, OpenPurpose::Open { is_approximate: true });
    let options = ImportOptions { is_approximate, ..studio.settings.import_options() };
    match Job::start(context, "open", move || disk::read(&read, options)) {
        // A file that was being read is no longer wanted.
        Ok(job) => studio.documents.reading = Some(OpenTask { job, path, purpose }),
        Err(error) => failed(studio, &path, &ReadFailure::Other(error.to_string())),
    }
}

/// Takes up what has been read.
pub(super) fn poll(context: &Context, studio: &mut Studio) {
    let Some(reading) = studio.documents.reading.take() else { return };
    let result = match reading.job.poll() {
        JobStatus::Waiting => {
            studio.documents.reading = Some(reading);
            return;
        }
        JobStatus::Done(result) => result,
        JobStatus::Lost => Err(ReadFailure::Other(studio.texts.get("fault").to_owned())),
    };
    match (result, reading.purpose) {
        (Err(failure), _) => failed(studio, &reading.path, &failure),
        (Ok(opened), OpenPurpose::Open { .. }) if is_untouched_import(studio, &opened.path) => {
            super::show_opened(studio, opened);
        }
        (Ok(opened), OpenPurpose::Open { .. }) => {
            close_guard::replace(context, studio, NextDocument::Show(Rc::new(opened)));
        }
        (Ok(opened), OpenPurpose::Revert(document) | OpenPurpose::Reload(document))
            if studio.documents.number == document =>
        {
            let OpenedScene { text, scene, findings, stamp, .. } = opened;
            let reverted = studio.editor.revert(text.clone(), scene);
            if reverted.is_ok() {
                studio.documents.may = stamp.map(OverwriteRule::Update);
                studio.documents.text_on_disk = Some(Arc::clone(&text));
                studio.documents.is_partial = findings.has_errors();
                banner::show_findings(studio, text, findings);
            }
            let done =
                if matches!(reading.purpose, OpenPurpose::Reload(_)) { "reloaded" } else { "reverted" };
            after_revert(studio, reverted, done);
        }
        (Ok(_), OpenPurpose::Revert(_) | OpenPurpose::Reload(_)) => {}
    }
}

/// Whether the document is what was read from this file of another ray tracer, without any change: reading it again loses
/// nothing.
fn is_untouched_import(studio: &Studio, path: &Path) -> bool {
    let is_last = || matches!(&studio.settings.last, Some(LastScene::File(last)) if last == path);
    let is_changed = || [Action::Undo, Action::Redo].iter().any(|action| studio.editor.can(action));
    studio.editor.path().is_none() && ForeignFormat::of_path(path).is_some() && is_last() && !is_changed()
}

/// Tells that the document is as its file is, with the message `done`, or why it cannot be.
fn after_revert(studio: &mut Studio, reverted: Result<(), RefusedChange>, done: &str) {
    studio.documents.saves += 1;
    match reverted {
        Ok(()) => {
            let text = studio.texts.get(done).to_owned();
            studio.toasts.info(text);
        }
        Err(refused) => {
            studio.toasts.warning(refusal::of_change(&studio.texts, &refused));
        }
    }
}

/// Tells that a file cannot be opened. The open document stays.
pub(super) fn failed(studio: &mut Studio, path: &Path, failure: &ReadFailure) {
    if matches!(failure, ReadFailure::Missing) {
        studio.settings.recent.retain(|recent| recent != path);
    }
    let text = failure.in_words(&studio.texts, path);
    let title = studio.texts.get("open-failed");
    if !matches!(failure, ReadFailure::Foreign(ForeignRefusal { is_approximable: true, .. })) {
        studio.dialogs.open(MessageDialog::new(title, text));
        return;
    }
    let path = path.to_owned();
    let question = QuestionDialog::new(title, text)
        .choice(studio.texts.get("open-approximately"), move |context, studio| {
            read(context, studio, &path, OpenPurpose::Open { is_approximate: true });
        })
        .choice(studio.texts.get("cancel"), |_, _| {});
    studio.dialogs.open(question);
}

/// Opens the first scene file that was dropped on the window.
pub(super) fn take_dropped(context: &Context, studio: &mut Studio) {
    let dropped: Vec<PathBuf> =
        context.input(|input| input.raw.dropped_files.iter().map(|file| file.path().to_owned()).collect());
    if dropped.is_empty() {
        return;
    }
    match dropped.iter().find(|path| file_prompt::fits(path, FileKind::ReadScene)) {
        Some(path) if studio.dialogs.is_any_open() => {
            let name = path.display().to_string();
            studio.toasts.info(studio.texts.with("dropped-later", &[("name", name.into())]));
        }
        Some(path) => {
            if dropped.len() > 1 {
                let name = name_of(path);
                studio.toasts.info(studio.texts.with("dropped-several", &[("name", name.into())]));
            }
            begin(context, studio, path);
        }
        None => match dropped.iter().find(|path| file_prompt::fits(path, FileKind::Picture)) {
            Some(path) if !studio.dialogs.is_any_open() => {
                let folder = studio.editor.path().and_then(Path::parent).unwrap_or(Path::new(""));
                let path = path_from(folder, path);
                images::give(studio, ImageUse::Surroundings, &path);
            }
            _ => {
                let text = studio.texts.get("dropped-other").to_owned();
                studio.toasts.warning(text);
            }
        },
    }
}
