//! Documents that a crash has left.

use std::path::PathBuf;
use std::sync::Arc;

use catoptric_editor::recovery::{Orphan, Snapshot};
use catoptric_platform::time::SystemTime;
use catoptric_scene::{Diagnostics, Scene};

use crate::base::job::Job;

/// A document that a crash has left, with its recovery file.
#[derive(Clone, Debug)]
pub(crate) struct RecoverableDocument {
    pub(crate) orphan: Arc<Orphan>,
    /// The document's title.
    pub(crate) title: String,
    /// The file that it belongs to.
    pub(crate) path: Option<PathBuf>,
    /// When it was written.
    pub(crate) written: SystemTime,
}

impl RecoverableDocument {
    /// Looks into it.
    pub(crate) fn new(orphan: Orphan) -> Self {
        let written = orphan.written();
        let (title, path) = match orphan.read() {
            Ok(Snapshot { title, original_path, .. }) => (title, original_path),
            // It can at least be listed and discarded.
            Err(_) => (orphan.path().display().to_string(), None),
        };
        Self { orphan: Arc::new(orphan), title, path, written }
    }
}

/// A recovered document that was read.
pub(crate) struct RecoveredDocument {
    pub(crate) orphan: Arc<Orphan>,
    pub(crate) snapshot: Snapshot,
    pub(crate) scene: Scene,
    pub(crate) findings: Diagnostics,
    /// Whether it is only the part of its file that could be read.
    pub(crate) is_partial: bool,
}

/// The job that reads a recovery file.
pub(crate) type RecoveryJob = Job<Result<RecoveredDocument, String>>;
