//! The state of the open document beyond the editor, and of the work on files.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::rc::{Rc, Weak};
use std::sync::Arc;
use std::sync::mpsc::Receiver;

use catoptric_editor::SceneWriter;
use catoptric_picture::ToneCurve;
use catoptric_platform::time::Instant;
use catoptric_scene::Example;

use super::autosave::Autosave;
use super::file_prompt::FilePrompt;
use super::recovery::{RecoveredDocument, RecoveryJob};
use super::watch::ExternalChanges;
use crate::base::job::Job;
use crate::shell::disk::{OpenedScene, OverwriteRule, ReadFailure, SavedFile, WriteFailure};
use crate::shell::host::LinkOutcome;
use crate::shell::interruption::Interruption;
use crate::state::settings::Settings;

/// The state of the open document beyond the editor, and the work on files.
#[derive(Default)]
pub(crate) struct Documents {
    /// Which document of this window it is.
    pub(crate) number: u64,
    /// Grows when the document is saved or reverted.
    pub(crate) saves: u64,
    pub(crate) unsaved: Option<((u64, u64, u64), bool)>,
    /// When the document's own file may be replaced.
    pub(crate) may: Option<OverwriteRule>,
    /// The text of its file as it was read or written last.
    pub(crate) text_on_disk: Option<Arc<str>>,
    /// What other programs do to its file.
    pub(crate) outside: ExternalChanges,
    /// Whether the document is only the part of its file that could be read.
    pub(crate) is_partial: bool,
    /// The example that it is, or was made of.
    pub(crate) example: Option<&'static Example>,
    pub(crate) reading: Option<OpenTask>,
    /// The tone curve to come back to after a scene of another ray tracer.
    pub(crate) tone_before: Option<ToneCurve>,
    pub(crate) restoring: Option<RecoveryJob>,
    pub(crate) saving: Option<SceneSaveTask>,
    /// To be saved when the present saving is done.
    pub(crate) next_saving: Option<SceneSaveRequest>,
    pub(crate) prompt: Option<(FilePrompt, FilePurpose)>,
    /// The answer to come about a link.
    pub(crate) linking: Option<Receiver<LinkOutcome>>,
    /// Lives as long as the question whether to save changes is open.
    pub(crate) asked_to_save: Weak<()>,
    /// Whether the window may close.
    pub(crate) is_leaving: bool,
    pub(crate) autosave: Autosave,
    pub(crate) memory: SettingsFile,
    pub(crate) recent: RecentFiles,
    pub(crate) notice: ProblemBanner,
    pub(crate) title: String,
    pub(crate) interruption: Option<Interruption>,
}

impl Documents {
    /// Whether a file is being written.
    pub(crate) fn is_saving(&self) -> bool {
        self.saving.is_some()
    }

    /// Which document of this window it is.
    pub(crate) fn number(&self) -> u64 {
        self.number
    }

    /// The example that the document is, or was made of, until it is saved as a file.
    pub(crate) fn example(&self) -> Option<&'static Example> {
        self.example
    }

    /// Whether a file is being read.
    pub(crate) fn is_opening(&self) -> bool {
        self.reading.is_some()
    }
}

/// A file that is being read.
pub(crate) struct OpenTask {
    pub(crate) job: Job<Result<OpenedScene, ReadFailure>>,
    pub(crate) path: PathBuf,
    pub(crate) purpose: OpenPurpose,
}

#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum OpenPurpose {
    /// To be opened instead of the document.
    Open {
        /// Whether what cannot be taken over from another ray tracer is replaced by what comes nearest.
        is_approximate: bool,
    },
    /// To revert the document with this number.
    Revert(u64),
    /// To take into the document with this number what another program has written.
    Reload(u64),
}

impl OpenTask {
    pub(crate) fn since(&self) -> Instant {
        self.job.since()
    }
}

/// A request to save the document.
pub(crate) struct SceneSaveRequest {
    pub(crate) path: PathBuf,
    pub(crate) may: OverwriteRule,
    /// What was meant to come after it.
    pub(crate) then: Option<NextDocument>,
}

/// A save that is under way.
pub(crate) struct SceneSaveTask {
    pub(crate) job: Job<Result<SavedFile, WriteFailure>>,
    pub(crate) writing: SceneWriter,
    pub(crate) document: u64,
    pub(crate) order: SceneSaveRequest,
}

impl SceneSaveTask {
    pub(crate) fn since(&self) -> Instant {
        self.job.since()
    }

    pub(crate) fn path(&self) -> &Path {
        &self.order.path
    }

    /// Has something done after it, unless something else is meant to come already.
    pub(crate) fn then(&mut self, next: NextDocument) {
        self.order.then.get_or_insert(next);
    }
}

/// The document to show next, or the end of the studio.
#[derive(Clone)]
pub(crate) enum NextDocument {
    /// A new scene.
    New,
    /// The file at this path, to be read anew.
    Open(PathBuf),
    /// A file that has been read.
    Show(Rc<OpenedScene>),
    /// A built-in scene.
    Example(&'static Example),
    /// A document that was left behind.
    Recovered(Rc<RecoveredDocument>),
    /// Nothing: the window closes.
    Quit,
}

/// The purpose of a prompt for a scene file.
pub(crate) enum FilePurpose {
    Opening,
    /// To save the document of this number, and what comes after.
    Saving(u64, Option<NextDocument>),
}

/// The recent files, and which of them are missing.
#[derive(Default)]
pub(crate) struct RecentFiles {
    pub(crate) looked_up: Vec<PathBuf>,
    pub(crate) missing: HashSet<PathBuf>,
    pub(crate) job: Option<Job<HashSet<PathBuf>>>,
}

/// The banner about problems of the file.
#[derive(Default)]
pub(crate) struct ProblemBanner {
    /// What it says: errors and warnings.
    pub(crate) banner: Option<(usize, usize)>,
    /// Whether the panel of problems is to be hidden again when there are none.
    pub(crate) has_shown_pane: bool,
}

/// The state of the settings file on the disk.
#[derive(Default)]
pub(crate) struct SettingsFile {
    /// The settings on the disk.
    pub(crate) written: Option<Settings>,
    /// The settings of the last frame, if they differ from those on the disk, and since when.
    pub(crate) waiting: Option<(Settings, Instant)>,
    pub(crate) job: Option<Job<Result<(), String>>>,
    pub(crate) has_failed: bool,
}

impl SettingsFile {
    /// The settings were read from the disk like this.
    pub(crate) fn of(settings: &Settings) -> Self {
        Self { written: Some(settings.clone()), ..Self::default() }
    }
}
