//! Autosave: when unsaved work is written to the recovery folder.

use std::path::Path;

use catoptric_platform::time::{Duration, Instant};

use egui::Context;

use super::{has_unsaved_work, name};
use crate::shell::studio::Studio;
use crate::shell::studio::autosave::{AutosaveReport, AutosaveRequest, DocumentState};

/// The delay from a change to its writing, which includes later changes.
const DELAY: Duration = Duration::from_millis(500);
/// At most once in so long; at the worst, a crash loses this, the delay and the time of writing.
const INTERVAL: Duration = Duration::from_secs(3);
/// The longest time that the window waits for the thread.
const PATIENCE: Duration = Duration::from_secs(2);

/// Keeps the document if it has unsaved work: once a frame.
pub(super) fn keep(context: &Context, studio: &mut Studio) {
    take_reports(studio);
    let state = (studio.documents.number, studio.editor.revision());
    let changed = has_unsaved_work(studio);
    let autosave = &mut studio.documents.autosave;
    autosave.discard_restored(|number| number != state.0 || !changed);
    if !changed {
        autosave.waits_since = None;
        if autosave.sent.take().is_some() {
            autosave.kept = None;
            autosave.order(AutosaveRequest::Clear);
        }
        return;
    }
    let is_sent = autosave.sent.is_some_and(|(sent, _)| sent == state) && !autosave.has_failed;
    if autosave.thread.is_none() || is_sent {
        autosave.waits_since = None;
        return;
    }
    let now = Instant::now();
    let since = *autosave.waits_since.get_or_insert(now);
    let last = autosave.sent.map(|(_, at)| at + INTERVAL);
    let due = last.map_or(since + DELAY, |last| last.max(since + DELAY));
    if now < due {
        context.request_repaint_after(due - now);
    } else if !autosave.is_busy {
        send(studio, state, now);
    }
}

fn send(studio: &mut Studio, state: DocumentState, now: Instant) {
    let order = AutosaveRequest::Keep {
        state,
        writing: studio.editor.writing(),
        path: studio.editor.path().map(Path::to_owned),
        title: title(studio),
    };
    let autosave = &mut studio.documents.autosave;
    autosave.order(order);
    autosave.sent = Some((state, now));
    autosave.is_busy = true;
    autosave.waits_since = None;
}

fn title(studio: &Studio) -> String {
    let title = studio.editor.title();
    if title.is_empty() { name(studio) } else { title.to_owned() }
}

fn take_reports(studio: &mut Studio) {
    let autosave = &mut studio.documents.autosave;
    let Some(thread) = &autosave.thread else { return };
    let reports: Vec<AutosaveReport> = thread.reports.try_iter().collect();
    for report in reports {
        let autosave = &mut studio.documents.autosave;
        match report {
            AutosaveReport::Found(found) => autosave.found = found,
            AutosaveReport::Kept(state) => {
                autosave.kept = Some(state);
                autosave.is_busy = false;
                autosave.has_failed = false;
                autosave.discard_restored(|number| number == state.0);
            }
            AutosaveReport::Failed(reason) => {
                autosave.is_busy = false;
                if !std::mem::replace(&mut autosave.has_failed, true) {
                    let text = studio.texts.with("keep-failed", &[("reason", reason.into())]);
                    studio.toasts.error(text);
                }
            }
        }
    }
}

/// Keeps the document at once, and waits a moment for that: what comes next may end the program.
pub(super) fn keep_now(studio: &mut Studio) {
    let state = (studio.documents.number, studio.editor.revision());
    if !has_unsaved_work(studio) || studio.documents.autosave.thread.is_none() {
        return;
    }
    let start = Instant::now();
    if studio.documents.autosave.kept != Some(state) {
        send(studio, state, start);
    }
    while studio.documents.autosave.kept != Some(state) && start.elapsed() < PATIENCE {
        catoptric_platform::threads::sleep(Duration::from_millis(5));
        take_reports(studio);
    }
}

/// Ends the thread with the studio. Unless changes are discarded on purpose, they stay for the next start.
pub(super) fn finish(studio: &mut Studio) {
    let changed = has_unsaved_work(studio);
    let leave_behind = changed && (studio.documents.autosave.is_held || !studio.documents.is_leaving);
    let state = (studio.documents.number, studio.editor.revision());
    if leave_behind && studio.documents.autosave.kept != Some(state) {
        send(studio, state, Instant::now());
    }
    let autosave = &mut studio.documents.autosave;
    let restored = std::mem::take(&mut autosave.restored).into_iter().map(|(_, orphan)| orphan).collect();
    autosave.order(AutosaveRequest::Finish { leave_behind, restored });
    autosave.thread = None;
}
