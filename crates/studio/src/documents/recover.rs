//! What an earlier studio left behind when it crashed.

use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;
use std::time::SystemTime;

use catoptric_editor::Editor;
use catoptric_editor::recovery::{Orphan, Snapshot};
use catoptric_scene::{Diagnostics, Scene, load_partly, read};
use egui::Context;

use super::job::{Job, Progress};
use super::{Next, leave, notice, show_recovered};
use crate::app::Studio;
use crate::dialogs::Message;
use crate::dialogs::recovery::Recovery;

/// A document that was left behind, to be offered.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    orphan: Arc<Orphan>,
    /// Its title.
    pub(crate) title: String,
    /// The file that it belongs to.
    pub(crate) path: Option<PathBuf>,
    /// When it was written.
    pub(crate) written: SystemTime,
}

impl Found {
    /// Looks into it.
    pub(super) fn new(orphan: Orphan) -> Self {
        let written = orphan.written();
        let (title, path) = match orphan.read() {
            Ok(Snapshot { title, original_path, .. }) => (title, original_path),
            // It can at least be told and discarded.
            Err(_) => (orphan.path().display().to_string(), None),
        };
        Self { orphan: Arc::new(orphan), title, path, written }
    }
}

/// A document that has been read again.
pub(crate) struct Recovered {
    orphan: Arc<Orphan>,
    snapshot: Snapshot,
    scene: Scene,
    findings: Diagnostics,
    /// Whether it is only the part of its file that could be read.
    is_partial: bool,
}

/// Reading it.
pub(super) type Restoring = Job<Result<Recovered, String>>;

/// Opens a document that was left behind.
pub(crate) fn restore(context: &Context, studio: &mut Studio, found: &Found) {
    let orphan = Arc::clone(&found.orphan);
    let work = move || {
        let snapshot = orphan.read().map_err(|error| error.to_string())?;
        let mut reading = read(&snapshot.text);
        reading.open_images(snapshot.original_path.as_deref().and_then(Path::parent), &snapshot.text);
        // What was kept reads well even where the file did not; saving would replace the unread parts all the same.
        let has_errors = |path| load_partly(path).is_ok_and(|(reading, _)| reading.diagnostics.has_errors());
        let is_partial =
            reading.diagnostics.has_errors() || snapshot.original_path.as_deref().is_some_and(has_errors);
        let (scene, findings) = (reading.scene, reading.diagnostics);
        Ok(Recovered { orphan, snapshot, scene, findings, is_partial })
    };
    match Job::start(context, "restore", work) {
        Ok(job) => studio.documents.restoring = Some(job),
        Err(error) => failed(studio, &error.to_string()),
    }
}

/// Removes a document that was left behind for good.
pub(crate) fn discard(studio: &mut Studio, found: Found) {
    studio.documents.keeper.discard(found.orphan);
}

/// Offers what was found, and opens what was wanted.
pub(super) fn poll(context: &Context, studio: &mut Studio) {
    let found = std::mem::take(&mut studio.documents.keeper.found);
    if !found.is_empty() {
        studio.dialogs.open(Recovery::new(found));
        context.request_repaint();
    }
    let Some(job) = studio.documents.restoring.take() else { return };
    match job.poll() {
        Progress::Waiting => studio.documents.restoring = Some(job),
        Progress::Done(Ok(recovered)) => leave::replace(context, studio, Next::Recovered(Rc::new(recovered))),
        Progress::Done(Err(reason)) => failed(studio, &reason),
        Progress::Lost => {
            let reason = studio.texts.get("fault").to_owned();
            failed(studio, &reason);
        }
    }
}

fn failed(studio: &mut Studio, reason: &str) {
    let text = studio.texts.with("restore-failed", &[("reason", reason.into())]);
    studio.dialogs.open(Message::new(studio.texts.get("restore-failed-title"), text));
}

/// Puts it into the window, as a changed document with its own file.
pub(super) fn show(studio: &mut Studio, recovered: &Recovered) {
    let Recovered { orphan, snapshot, scene, findings, is_partial } = recovered;
    let text: Arc<str> = snapshot.text.as_str().into();
    let editor = match &snapshot.original_path {
        Some(path) => Editor::open(path.clone(), Arc::clone(&text), scene.clone()),
        None => Editor::untitled(snapshot.title.clone(), Arc::clone(&text), scene.clone()),
    };
    show_recovered(studio, editor, orphan.written());
    studio.documents.is_partial = *is_partial;
    let number = studio.documents.number;
    studio.documents.keeper.has_restored(number, Arc::clone(orphan));
    if !findings.is_empty() {
        notice::show_findings(studio, text, findings.clone());
    }
    let title = super::name(studio);
    studio.toasts.success(studio.texts.with("restored", &[("name", title.into())]));
}
