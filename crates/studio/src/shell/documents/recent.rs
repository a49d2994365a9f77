//! The recent files that still exist, looked up by a thread, since a disk may be far away.

use std::path::Path;

use catoptric_platform::files;
use egui::Context;

use crate::base::job::{Job, JobStatus};
use crate::shell::studio::Studio;

/// Looks the recent files up when their list has changed: once a frame.
pub(super) fn keep(context: &Context, studio: &mut Studio) {
    let recent = &mut studio.documents.recent;
    if let Some(job) = recent.job.take() {
        match job.poll() {
            JobStatus::Waiting => recent.job = Some(job),
            JobStatus::Done(missing) => recent.missing = missing,
            JobStatus::Lost => {}
        }
    } else if recent.looked_up != studio.settings.recent {
        recent.looked_up.clone_from(&studio.settings.recent);
        let paths = recent.looked_up.clone();
        let work = move || paths.into_iter().filter(|path| !files::exists(path)).collect();
        recent.job = Job::start(context, "recent files", work).ok();
    }
}

/// Whether a recent file was missing when it was looked up last: the menu shows it weakly.
pub(crate) fn is_missing(studio: &Studio, path: &Path) -> bool {
    studio.documents.recent.missing.contains(path)
}

/// Looks the recent files up again, as when their menu opens.
pub(crate) fn look_again(studio: &mut Studio) {
    studio.documents.recent.looked_up.clear();
}
