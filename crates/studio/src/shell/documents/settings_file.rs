//! The settings file: written by a thread, a moment after a change, and at the end.

use catoptric_platform::time::{Duration, Instant};
use egui::Context;

use super::banner;
use crate::base::job::{Job, JobStatus};
use crate::shell::studio::Studio;
use crate::state::layout::{self, Pane};

/// The time without changes after which the settings are written.
const DELAY: Duration = Duration::from_secs(1);

/// Writes the settings if they have changed: once a frame.
pub(super) fn keep(context: &Context, studio: &mut Studio) {
    note_window(context, studio);
    note_layout(studio);
    if let Some(job) = studio.documents.memory.job.take() {
        match job.poll() {
            JobStatus::Waiting => studio.documents.memory.job = Some(job),
            JobStatus::Done(Ok(())) => {}
            JobStatus::Done(Err(reason)) => failed(studio, reason),
            JobStatus::Lost => {}
        }
    }
    let memory = &mut studio.documents.memory;
    if memory.written.as_ref() == Some(&studio.settings) {
        memory.waiting = None;
        return;
    }
    let now = Instant::now();
    match &memory.waiting {
        Some((waiting, since)) if *waiting == studio.settings => {
            let due = *since + DELAY;
            if now < due {
                context.request_repaint_after(due - now);
            } else if memory.job.is_none() {
                write(context, studio);
            }
        }
        _ => {
            memory.waiting = Some((studio.settings.clone(), now));
            context.request_repaint_after(DELAY);
        }
    }
}

fn write(context: &Context, studio: &mut Studio) {
    let settings = studio.settings.clone();
    studio.documents.memory.written = Some(settings.clone());
    let Some(path) = studio.host.settings_path() else { return };
    let work = move || settings.save(&path).map_err(|error| error.to_string());
    match Job::start(context, "settings", work) {
        Ok(job) => studio.documents.memory.job = Some(job),
        Err(error) => failed(studio, error.to_string()),
    }
}

fn failed(studio: &mut Studio, reason: String) {
    if !std::mem::replace(&mut studio.documents.memory.has_failed, true) {
        let text = studio.texts.with("settings-failed", &[("reason", reason.into())]);
        studio.toasts.warning(text);
    }
}

fn note_window(context: &Context, studio: &mut Studio) {
    let zoom = context.zoom_factor();
    // A window in the task bar, or one that fills the screen for a while, tells nothing of the usual state.
    let is_maximized = context.input(|input| {
        let viewport = input.viewport();
        let is_seen = viewport.fullscreen != Some(true) && viewport.minimized != Some(true);
        viewport.maximized.filter(|_| is_seen)
    });
    studio.settings.is_maximized = is_maximized.unwrap_or(studio.settings.is_maximized);
    let size = context.input(|input| {
        let viewport = input.viewport();
        let is_usual = viewport.fullscreen != Some(true)
            && viewport.maximized != Some(true)
            && viewport.minimized != Some(true);
        viewport.inner_rect.filter(|_| is_usual).map(|rect| rect.size() * zoom)
    });
    if let Some(size) = size.filter(|size| size.x >= 100.0 && size.y >= 100.0) {
        studio.settings.window_size = Some([size.x.round(), size.y.round()]);
    }
}

fn note_layout(studio: &mut Studio) {
    if banner::has_shown_pane(studio) {
        // The next scene may have no problems.
        let mut layout = studio.spare_layouts.wide(&studio.layout).clone();
        layout::set_visible(&mut layout, Pane::Problems, false);
        studio.settings.layout = Some(layout);
        return;
    }
    let layout = studio.spare_layouts.wide(&studio.layout);
    if studio.settings.layout.as_ref() != Some(layout) {
        studio.settings.layout = Some(layout.clone());
    }
}

/// The studio is being left: writes at once what has not been written.
pub(super) fn finish(studio: &mut Studio) {
    note_layout(studio);
    // One that is under way must not come later.
    while let Some(JobStatus::Waiting) = studio.documents.memory.job.as_ref().map(Job::poll) {
        catoptric_platform::threads::sleep(Duration::from_millis(5));
    }
    if studio.documents.memory.written.as_ref() == Some(&studio.settings) {
        return;
    }
    if let Some(path) = studio.host.settings_path() {
        // No window is left to show the error.
        let _ = studio.settings.save(&path);
    }
}
