//! A prompt for a file: the system's dialog where there is one, else the studio's own.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, TryRecvError};

use crate::app::Studio;
use crate::dialogs::files::FileDialog;
use crate::host::{FileAnswer, FileKind, FileQuestion};

/// A file that was chosen.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ChosenFile {
    /// Where it is.
    pub(crate) path: PathBuf,
    /// Whether the person has agreed that a file there is replaced.
    pub(crate) may_replace: bool,
}

/// The state of a prompt for a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum FilePromptState {
    /// The person is still choosing.
    Waiting,
    /// The person chose no file.
    Cancelled,
    /// A file was chosen.
    Chosen(ChosenFile),
}

/// An open prompt for a file, polled once a frame.
pub(crate) struct FilePrompt {
    question: FileQuestion,
    way: FilePromptChannel,
}

enum FilePromptChannel {
    System(FileAnswer),
    Own(Receiver<Option<ChosenFile>>),
}

impl FilePrompt {
    /// Asks `question`.
    pub(crate) fn start(studio: &mut Studio, question: FileQuestion) -> Self {
        let way = match studio.host.ask_file(&question) {
            Some(answer) => FilePromptChannel::System(answer),
            None => own(studio, &question),
        };
        Self { question, way }
    }

    /// The answer so far.
    pub(crate) fn poll(&mut self, context: &egui::Context, studio: &mut Studio) -> FilePromptState {
        match &self.way {
            FilePromptChannel::System(answer) => match answer.try_recv() {
                Ok(Some(path)) => FilePromptState::Chosen(self.complete(path)),
                Ok(None) => FilePromptState::Cancelled,
                Err(TryRecvError::Empty) => {
                    // The system does not wake the window.
                    context.request_repaint_after(std::time::Duration::from_millis(100));
                    FilePromptState::Waiting
                }
                // The system's dialog could not appear.
                Err(TryRecvError::Disconnected) => {
                    self.way = own(studio, &self.question);
                    FilePromptState::Waiting
                }
            },
            FilePromptChannel::Own(answer) => match answer.try_recv() {
                Ok(Some(chosen)) => FilePromptState::Chosen(chosen),
                Ok(None) | Err(TryRecvError::Disconnected) => FilePromptState::Cancelled,
                Err(TryRecvError::Empty) => FilePromptState::Waiting,
            },
        }
    }

    /// The system's dialog has asked before replacing the file that was chosen, but not one of a longer name.
    fn complete(&self, path: PathBuf) -> ChosenFile {
        if !self.question.is_saving {
            return ChosenFile { path, may_replace: false };
        }
        let whole = completed(path.clone(), &self.question);
        ChosenFile { may_replace: whole == path, path: whole }
    }
}

fn own(studio: &mut Studio, question: &FileQuestion) -> FilePromptChannel {
    let (sender, receiver) = mpsc::channel();
    let recent = studio.settings.recent.iter().filter_map(|path| Some(path.parent()?.to_owned()));
    let dialog = FileDialog::new(question.clone(), recent, sender);
    studio.dialogs.open(dialog);
    FilePromptChannel::Own(receiver)
}

/// `path` with an extension that fits: if it has none, that of the proposed name.
pub(crate) fn completed(path: PathBuf, question: &FileQuestion) -> PathBuf {
    let proposed = Path::new(&question.name);
    match proposed.extension() {
        Some(extension) if fits(proposed, question.kind) && !fits(&path, question.kind) => {
            appended(path, extension)
        }
        _ => with_extension(path, question.kind),
    }
}

/// `path` with an extension that fits; one that fits already stays.
pub(crate) fn with_extension(path: PathBuf, kind: FileKind) -> PathBuf {
    if fits(&path, kind) {
        return path;
    }
    match kind.extensions().first() {
        Some(extension) => appended(path, extension.as_ref()),
        None => path,
    }
}

fn appended(path: PathBuf, extension: &OsStr) -> PathBuf {
    let mut whole = path.into_os_string();
    whole.push(".");
    whole.push(extension);
    whole.into()
}

/// What the file at `path` is called.
pub(crate) fn name_of(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Whether the extension of `path` is one of this kind of file.
pub(crate) fn fits(path: &Path, kind: FileKind) -> bool {
    path.extension().is_some_and(|extension| {
        kind.extensions().iter().any(|fitting| extension.eq_ignore_ascii_case(fitting))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_proposed_name_gives_the_extension() {
        let question = |name: &str| FileQuestion {
            kind: FileKind::SavedPicture,
            is_saving: true,
            title: String::new(),
            folder: None,
            name: name.to_owned(),
        };
        assert_eq!(completed("a".into(), &question("scene.exr")), Path::new("a.exr"));
        assert_eq!(completed("a.PNG".into(), &question("scene.exr")), Path::new("a.PNG"));
        assert_eq!(completed("a.Jpeg".into(), &question("scene.exr")), Path::new("a.Jpeg"));
        assert_eq!(completed("a.bmp".into(), &question("scene.exr")), Path::new("a.bmp.exr"), "only read");
        assert_eq!(completed("a".into(), &question("scene")), Path::new("a.png"));
    }

    #[test]
    fn extensions_are_added_and_never_replaced() {
        let named = |name: &str| with_extension(name.into(), FileKind::Scene);
        assert_eq!(named("a"), Path::new("a.toml"));
        assert_eq!(named("a.TOML"), Path::new("a.TOML"));
        assert_eq!(named("version 1.2"), Path::new("version 1.2.toml"));
        assert_eq!(with_extension("a.exr".into(), FileKind::Picture), Path::new("a.exr"));
        assert_eq!(with_extension("a.toml".into(), FileKind::Picture), Path::new("a.toml.png"));
    }
}
