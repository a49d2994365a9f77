//! What is known of a file without reading it.

use std::path::Path;

use crate::time::SystemTime;

/// What is at a path, links followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileStatus {
    /// Whether it is a plain file: no folder, pipe or device.
    pub is_file: bool,
    /// Whether it is a folder.
    pub is_folder: bool,
    /// Bytes of a plain file.
    pub length: u64,
    /// When it was written last, where that is known.
    pub modified: Option<SystemTime>,
}

/// Size and time of a file, which tell whether it has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FileStamp {
    /// When it was written last, where that is known.
    pub modified: Option<SystemTime>,
    /// Bytes.
    pub length: u64,
}

impl FileStamp {
    /// The stamp of the file at `path`, if there is one.
    pub fn of(path: &Path) -> Option<Self> {
        super::status(path).ok().map(Self::from)
    }
}

impl From<FileStatus> for FileStamp {
    fn from(status: FileStatus) -> Self {
        Self { modified: status.modified, length: status.length }
    }
}
