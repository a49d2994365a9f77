//! The results that are being exported as files.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use catoptric_platform::files::WriteError;

use super::file_prompt::FilePrompt;
use crate::base::job::Job;

/// A result that can be exported as a file, or as a folder of files.
pub(crate) trait Export: Send + Sync + 'static {
    /// Makes it and writes it; on a thread.
    fn write(&self, path: &Path) -> Result<(), ExportFailure>;

    /// The file by which a folder of its kind is known; `None` if it is one file.
    fn landmark(&self) -> Option<&'static str> {
        None
    }
}

/// The reason why nothing was exported.
pub(crate) enum ExportFailure {
    /// The content cannot be made.
    Content(String),
    /// The folder cannot be made.
    Folder(std::io::Error),
    /// A file cannot be written.
    Write(WriteError),
}

/// The exports that are prompted for or being written.
#[derive(Default)]
pub(crate) struct Exports {
    pub(crate) going: Vec<ExportTask>,
}

/// An export that is under way.
pub(crate) enum ExportTask {
    /// The person is choosing where.
    Asking(FilePrompt, Arc<dyn Export>),
    /// A thread writes it; `None` means that something is there already.
    Writing(PathBuf, Arc<dyn Export>, Job<Option<Result<(), ExportFailure>>>),
}
