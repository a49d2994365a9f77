//! A new folder in the one that is listed.

use std::io;
use std::path::{Path, PathBuf};

use catoptric_platform::files;
use egui::accesskit::Role;
use egui::{Key, Modifiers, RichText, TextEdit, Ui, WidgetInfo, vec2};

use crate::base::job::{Job, JobStatus};
use crate::base::texts::Texts;
use crate::base::theme;
use crate::shell::studio::dialogs::withhold_enter;

/// The name field of a new folder, or the thread that makes it.
pub(super) struct NewFolderField {
    name: String,
    is_new: bool,
    making: Option<Job<io::Result<PathBuf>>>,
    error: Option<io::ErrorKind>,
}

/// The result of a frame of [`NewFolderField`].
pub(super) enum NewFolderOutcome {
    /// The name is still being typed.
    Stay,
    /// The folder was given up.
    Close,
    /// The folder has been made.
    Made(PathBuf),
}

impl NewFolderField {
    /// Asks for a name; `name` is proposed.
    pub(super) fn new(name: &str) -> Self {
        Self { name: name.to_owned(), is_new: true, making: None, error: None }
    }

    /// Draws the field and its buttons, and below them why the folder could not be made in `parent`. Enter and Esc are
    /// for this row while it is there.
    pub(super) fn ui(&mut self, ui: &mut Ui, parent: &Path, texts: &Texts) -> NewFolderOutcome {
        if let Some(made) = self.poll() {
            return NewFolderOutcome::Made(made);
        }
        let is_given_up = ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
        let is_entered = withhold_enter(ui);
        let (mut makes, mut closes) = (is_entered, is_given_up);
        ui.horizontal(|ui| {
            let label = ui.label(texts.get("files-new-folder-name"));
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                closes |= ui.button(texts.get("cancel")).clicked();
                makes |= ui.button(texts.get("files-create")).clicked();
                let edit = TextEdit::singleline(&mut self.name).desired_width(f32::INFINITY);
                let response = ui.add(edit.margin(vec2(8.0, 5.0))).labelled_by(label.id);
                if response.changed() {
                    self.error = None;
                }
                if std::mem::take(&mut self.is_new) {
                    response.request_focus();
                    super::select_stem(ui, response.id, &self.name);
                }
            });
        });
        if let Some(kind) = self.error {
            let words = texts.get(words_for(kind));
            let color = theme::palette(ui.visuals()).error;
            let response = ui.add(egui::Label::new(RichText::new(words).color(color)).wrap());
            response.widget_info(|| WidgetInfo::labeled(Role::Alert, true, words));
        }
        if closes {
            return NewFolderOutcome::Close;
        }
        if makes && self.making.is_none() {
            self.make(ui, parent);
        }
        NewFolderOutcome::Stay
    }

    fn make(&mut self, ui: &Ui, parent: &Path) {
        let name = self.name.trim().to_owned();
        let parent = parent.to_owned();
        match Job::start(ui.ctx(), "new folder", move || make(&parent, &name)) {
            Ok(job) => self.making = Some(job),
            Err(error) => self.fail(error.kind()),
        }
    }

    /// Another name can be typed at once.
    fn fail(&mut self, kind: io::ErrorKind) {
        self.error = Some(kind);
        self.is_new = true;
    }

    fn poll(&mut self) -> Option<PathBuf> {
        let making = self.making.take()?;
        match making.poll() {
            JobStatus::Waiting => self.making = Some(making),
            JobStatus::Done(Ok(folder)) => return Some(folder),
            JobStatus::Done(Err(error)) => self.fail(error.kind()),
            JobStatus::Lost => self.fail(io::ErrorKind::Other),
        }
        None
    }
}

/// Makes the folder `name` in `parent`; only a plain name is allowed.
fn make(parent: &Path, name: &str) -> io::Result<PathBuf> {
    if name.is_empty() || name == "." || name == ".." || name.contains(std::path::is_separator) {
        return Err(io::ErrorKind::InvalidFilename.into());
    }
    let folder = parent.join(name);
    files::create_folder(&folder)?;
    Ok(folder)
}

const fn words_for(kind: io::ErrorKind) -> &'static str {
    match kind {
        io::ErrorKind::AlreadyExists => "files-new-folder-exists",
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => "files-new-folder-denied",
        io::ErrorKind::InvalidFilename | io::ErrorKind::InvalidInput => "files-new-folder-bad-name",
        io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => "files-no-folder",
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "files-new-folder-full",
        _ => "files-new-folder-failed",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_plain_name_makes_a_folder() {
        let parent = tempfile::tempdir().unwrap();
        let kind = |name: &str| make(parent.path(), name).map_err(|error| error.kind());
        for name in ["", ".", "..", "a/b"] {
            assert_eq!(kind(name), Err(io::ErrorKind::InvalidFilename), "{name}");
        }
        assert_eq!(kind("a"), Ok(parent.path().join("a")));
        assert_eq!(kind("a"), Err(io::ErrorKind::AlreadyExists));
        assert!(parent.path().join("a").is_dir());
    }
}
