//! The services of the system, behind a trait, so that tests and other platforms can replace them.

#[cfg(not(target_family = "wasm"))]
mod desktop;

use std::path::PathBuf;
use std::sync::mpsc::Receiver;

use catoptric_exchange::ForeignFormat;
use catoptric_picture::PictureFormat;

#[cfg(not(target_family = "wasm"))]
pub use desktop::DesktopHost;

pub use crate::state::host::HostAbilities;

/// The kind of file that a person chooses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A scene to be written: `.toml`.
    Scene,
    /// A scene to be read: `.toml`, or one of another ray tracer.
    ReadScene,
    /// A picture of any format that is read.
    Picture,
    /// A picture to be written.
    SavedPicture,
    /// A drawing: `.svg`.
    Drawing,
    /// A page: `.html`.
    Page,
    /// A folder to be made, for several files.
    Folder,
}

impl FileKind {
    /// The usual extensions, the first one for new files.
    pub fn extensions(self) -> Vec<&'static str> {
        match self {
            Self::Scene => vec!["toml"],
            Self::ReadScene => {
                let foreign = ForeignFormat::ALL.into_iter().flat_map(ForeignFormat::extensions);
                std::iter::once("toml").chain(foreign.copied()).collect()
            }
            Self::Picture => PictureFormat::all_extensions(false).collect(),
            Self::SavedPicture => PictureFormat::all_extensions(true).collect(),
            Self::Drawing => vec!["svg"],
            Self::Page => vec!["html"],
            Self::Folder => Vec::new(),
        }
    }
}

/// A question for a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileQuestion {
    /// What kind of file.
    pub kind: FileKind,
    /// Whether the file is to be written.
    pub is_saving: bool,
    /// The title of the dialog.
    pub title: String,
    /// The folder to start in.
    pub folder: Option<PathBuf>,
    /// The name to start with.
    pub name: String,
}

/// The answer to come; `None` when the person cancelled. When it is dropped without an answer, no dialog could appear.
pub type FileAnswer = Receiver<Option<PathBuf>>;

/// What became of a link that was to be given to the person.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LinkOutcome {
    /// It is in the clipboard.
    Copied,
    /// The scene is too large for an address.
    TooLong,
    /// The clipboard cannot be written.
    Refused,
}

/// Puts a picture into the clipboard: width and height in pixels; red, green, blue and 255 of every pixel. It can be
/// called from any thread; on failure it gives the reason.
pub type PictureClipboard = fn([usize; 2], &[u8]) -> Result<(), String>;

/// The system around the studio.
pub trait Host {
    /// Asks for a file without blocking; `None` when the system has no dialog of its own, and the studio's must do.
    fn ask_file(&mut self, question: &FileQuestion) -> Option<FileAnswer>;

    /// The file of the settings, if there is a place for it.
    fn settings_path(&self) -> Option<PathBuf>;

    /// The folder for unsaved work, if there is a place for it.
    fn recovery_folder(&self) -> Option<PathBuf>;

    /// The folder of the person, where files are looked for first.
    fn home_folder(&self) -> Option<PathBuf> {
        None
    }

    /// What puts pictures into the clipboard without the window having to wait; `None` leaves it to the window.
    fn clipboard(&self) -> Option<PictureClipboard> {
        None
    }

    /// What the system has besides.
    fn abilities(&self) -> HostAbilities {
        HostAbilities::DESKTOP
    }

    /// Puts a link to this view of a scene into the clipboard; [`StartDocument::Link`](crate::StartDocument::Link) shows
    /// it again. `None` where there are no links.
    fn copy_link(&mut self, _view: String) -> Option<Receiver<LinkOutcome>> {
        None
    }

    /// Bytes of memory that can be used without harm, if that is known.
    fn free_memory(&self) -> Option<u64> {
        None
    }
}
