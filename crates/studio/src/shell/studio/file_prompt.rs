//! A prompt for a file: the system's dialog where there is one, else the studio's own.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::sync::mpsc::Receiver;

use crate::shell::host::{FileAnswer, FileKind, FileQuestion};

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
    pub(crate) question: FileQuestion,
    pub(crate) way: FilePromptChannel,
}

/// The source of the answer.
pub(crate) enum FilePromptChannel {
    /// The system's dialog.
    System(FileAnswer),
    /// The studio's own dialog.
    Own(Receiver<Option<ChosenFile>>),
}

impl FilePrompt {
    /// The system's dialog has asked before replacing the file that was chosen, but not one of a longer name.
    pub(crate) fn complete(&self, path: PathBuf) -> ChosenFile {
        if !self.question.is_saving {
            return ChosenFile { path, may_replace: false };
        }
        let whole = completed(path.clone(), &self.question);
        ChosenFile { may_replace: whole == path, path: whole }
    }
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
