//! What is left of documents whose program ended without saving them.

use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// A document to be kept against a crash.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Snapshot {
    /// The file that the document belongs to, if any.
    pub original_path: Option<PathBuf>,
    /// Its title.
    pub title: String,
    /// The text of the scene.
    pub text: String,
}

/// The place of one running editor in a folder of recovery files.
#[derive(Debug)]
pub struct Session {}

impl Session {
    /// Takes a place in `folder`, which is made when it does not exist.
    ///
    /// # Errors
    /// When the folder cannot be written, or files in it cannot be locked.
    pub fn start(_folder: &Path) -> io::Result<Self> {
        Ok(Self {})
    }

    /// Keeps a document instead of the one kept before, whole or not at all.
    ///
    /// # Errors
    /// What stands in the way; the one kept before is untouched then.
    pub fn write(&mut self, _snapshot: &Snapshot) -> io::Result<()> {
        Ok(())
    }

    /// Keeps nothing: the document is saved, or there is none.
    ///
    /// # Errors
    /// When the file cannot be removed.
    pub fn clear(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A document left behind.
#[derive(Debug)]
pub struct Orphan {
    written: SystemTime,
}

impl Orphan {
    /// When it was written.
    pub fn written(&self) -> SystemTime {
        self.written
    }

    /// Reads it.
    ///
    /// # Errors
    /// When the file cannot be read, or is none of this program.
    pub fn read(&self) -> io::Result<Snapshot> {
        Err(io::ErrorKind::NotFound.into())
    }

    /// Removes it for good.
    ///
    /// # Errors
    /// When the file cannot be removed.
    pub fn discard(self) -> io::Result<()> {
        Ok(())
    }
}

/// The documents in `folder` that no running editor holds, the latest first. Other files there are passed over.
pub fn orphans(_folder: &Path) -> Vec<Orphan> {
    Vec::new()
}
