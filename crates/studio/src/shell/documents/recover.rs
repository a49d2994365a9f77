//! Recovery of the documents that a crash has left.

use std::path::Path;
use std::rc::Rc;
use std::sync::Arc;

use catoptric_editor::Editor;
use catoptric_scene::read;
use catoptric_store::{Folder, load_partly};
use egui::Context;

use super::recovery_dialog::RecoveryDialog;
use super::{banner, close_guard, show_recovered};
use crate::base::job::{Job, JobStatus};
use crate::shell::studio::Studio;
use crate::shell::studio::dialogs::MessageDialog;
use crate::shell::studio::documents::NextDocument;
use crate::shell::studio::recovery::{RecoverableDocument, RecoveredDocument};

/// Opens a document that was left behind.
pub(crate) fn restore(context: &Context, studio: &mut Studio, found: &RecoverableDocument) {
    let orphan = Arc::clone(&found.orphan);
    let work = move || {
        let snapshot = orphan.read().map_err(|error| error.to_string())?;
        let mut reading = read(&snapshot.text);
        reading.open_images(
            &Folder::new(snapshot.original_path.as_deref().and_then(Path::parent)),
            &snapshot.text,
        );
        // What was kept reads well even where the file did not; saving would replace the unread parts all the same.
        let has_errors = |path| load_partly(path).is_ok_and(|(reading, _)| reading.diagnostics.has_errors());
        let is_partial =
            reading.diagnostics.has_errors() || snapshot.original_path.as_deref().is_some_and(has_errors);
        let (scene, findings) = (reading.scene, reading.diagnostics);
        Ok(RecoveredDocument { orphan, snapshot, scene, findings, is_partial })
    };
    match Job::start(context, "restore", work) {
        Ok(job) => studio.documents.restoring = Some(job),
        Err(error) => failed(studio, &error.to_string()),
    }
}

/// Removes a document that was left behind for good.
pub(crate) fn discard(studio: &mut Studio, found: RecoverableDocument) {
    studio.documents.autosave.discard(found.orphan);
}

/// Offers what was found, and opens what was wanted.
pub(super) fn poll(context: &Context, studio: &mut Studio) {
    let found = std::mem::take(&mut studio.documents.autosave.found);
    let comes_back = studio.host.abilities().comes_back;
    if let ([only], true) = (&found[..], comes_back) {
        restore(context, studio, only);
    } else if !found.is_empty() {
        studio.dialogs.open(RecoveryDialog::new(found));
        context.request_repaint();
    }
    let Some(job) = studio.documents.restoring.take() else { return };
    match job.poll() {
        JobStatus::Waiting => studio.documents.restoring = Some(job),
        JobStatus::Done(Ok(recovered)) => {
            close_guard::replace(context, studio, NextDocument::Recovered(Rc::new(recovered)));
        }
        JobStatus::Done(Err(reason)) => failed(studio, &reason),
        JobStatus::Lost => {
            let reason = studio.texts.get("fault").to_owned();
            failed(studio, &reason);
        }
    }
}

fn failed(studio: &mut Studio, reason: &str) {
    let text = studio.texts.with("restore-failed", &[("reason", reason.into())]);
    studio.dialogs.open(MessageDialog::new(studio.texts.get("restore-failed-title"), text));
}

/// Puts it into the window, as a changed document with its own file.
pub(super) fn show(studio: &mut Studio, recovered: &RecoveredDocument) {
    let RecoveredDocument { orphan, snapshot, scene, findings, is_partial } = recovered;
    let text: Arc<str> = snapshot.text.as_str().into();
    let editor = match &snapshot.original_path {
        Some(path) => Editor::open(path.clone(), Arc::clone(&text), scene.clone()),
        None => Editor::untitled(snapshot.title.clone(), Arc::clone(&text), scene.clone()),
    };
    show_recovered(studio, editor, orphan.written());
    studio.documents.is_partial = *is_partial;
    let number = studio.documents.number;
    studio.documents.autosave.has_restored(number, Arc::clone(orphan));
    if !findings.is_empty() {
        banner::show_findings(studio, text, findings.clone());
    }
    let title = super::name(studio);
    studio.toasts.success(studio.texts.with("restored", &[("name", title.into())]));
}
