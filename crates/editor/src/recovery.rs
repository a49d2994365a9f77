//! Recovery of documents whose program ended without saving them.
//!
//! Every running editor has a place in a folder: a lock file, held as long as the editor runs, and beside it the
//! document, a scene file whose first lines tell where it came from. The system lets go of the lock whatever ends the
//! program; a document whose lock nobody holds is an orphan. Orphans are removed by [`Orphan::discard`] alone.

mod entry;

use std::ffi::OsStr;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use catoptric_platform::files::{self, FileLock, LockMode, WriteError, write_bytes};
use catoptric_platform::time::{SystemTime, UNIX_EPOCH};

/// A document to be kept against a crash.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Snapshot {
    /// The file that the document belongs to, if any.
    pub original_path: Option<PathBuf>,
    /// The document's title.
    pub title: String,
    /// The text of the scene.
    pub text: String,
}

const LOCK: &str = "lock";
const DOCUMENT: &str = "toml";

/// Tells apart the sessions of one process.
static SESSIONS: AtomicU32 = AtomicU32::new(0);

/// The place of one running editor in a folder of recovery files. When it is dropped, its files are removed.
#[derive(Debug)]
pub struct Session {
    document: PathBuf,
    lock_path: PathBuf,
    /// Held as long as the session lives.
    lock: Option<FileLock>,
    is_left_behind: bool,
}

impl Session {
    /// Takes a place in `folder`, which is made when it does not exist.
    ///
    /// # Errors
    /// When the folder cannot be written, or files in it cannot be locked.
    pub fn start(folder: &Path) -> io::Result<Self> {
        files::create_folders(folder)?;
        loop {
            let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
            let count = SESSIONS.fetch_add(1, Ordering::Relaxed);
            let stem = format!("{:x}-{:x}-{count:x}", now.as_nanos(), catoptric_platform::process::number());
            let lock_path = folder.join(&stem).with_extension(LOCK);
            match FileLock::take(&lock_path, LockMode::New) {
                // Somebody who cleared away took it for one left behind, before it was locked.
                Ok(_) if !files::exists(&lock_path) => {}
                Ok(lock) => {
                    let document = folder.join(&stem).with_extension(DOCUMENT);
                    return Ok(Self { document, lock_path, lock: Some(lock), is_left_behind: false });
                }
                // Another session has it, or somebody looks for orphans just now; another name is free.
                Err(error)
                    if matches!(error.kind(), io::ErrorKind::AlreadyExists | io::ErrorKind::WouldBlock) => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// Keeps a document instead of the one kept before, whole or not at all. This waits for the disk: not for a thread
    /// that draws.
    ///
    /// # Errors
    /// What stands in the way; the one kept before is untouched then.
    pub fn write(&mut self, snapshot: &Snapshot) -> Result<(), WriteError> {
        write_bytes(&self.document, entry::to_text(snapshot).as_bytes())
    }

    /// Keeps nothing: the document is saved, or there is none.
    ///
    /// # Errors
    /// When the file cannot be removed.
    pub fn clear(&mut self) -> io::Result<()> {
        remove(&self.document)
    }

    /// Ends without removing anything: the document is offered at the next start.
    pub fn leave_behind(mut self) {
        self.is_left_behind = true;
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        if self.is_left_behind {
            return;
        }
        // Where the document cannot be removed it becomes an orphan, which is better than lost.
        let _ = self.clear();
        drop(self.lock.take());
        let _ = files::remove(&self.lock_path);
    }
}

/// A document left behind. As long as this lives, no other program takes it for its own to recover.
#[derive(Debug)]
pub struct Orphan {
    document: PathBuf,
    lock_path: PathBuf,
    written: SystemTime,
    /// The lock, where it could be had.
    lock: Option<FileLock>,
}

impl Orphan {
    /// When it was written.
    pub fn written(&self) -> SystemTime {
        self.written
    }

    /// The recovery file.
    pub fn path(&self) -> &Path {
        &self.document
    }

    /// Reads it. The text may have errors like any file's; nothing is checked.
    ///
    /// # Errors
    /// When the file cannot be read, or is no text.
    pub fn read(&self) -> io::Result<Snapshot> {
        files::read_text(&self.document, u64::MAX).map(|text| entry::from_text(&text))
    }

    /// Removes it for good.
    ///
    /// # Errors
    /// When the file cannot be removed.
    pub fn discard(mut self) -> io::Result<()> {
        remove(&self.document)?;
        drop(self.lock.take());
        remove(&self.lock_path)
    }
}

/// The documents in `folder` that no running editor holds, the latest first; a folder that cannot be read has none.
/// Locks that killed editors left without a document are removed, and nothing else; other files are passed over.
pub fn orphans(folder: &Path) -> Vec<Orphan> {
    let Ok(entries) = files::list(folder) else { return Vec::new() };
    let mut found: Vec<Orphan> = entries
        .filter_map(|path| {
            remove_widowed(&path);
            orphan(path)
        })
        .collect();
    found.sort_by(|a, b| b.written.cmp(&a.written).then_with(|| a.document.cmp(&b.document)));
    found
}

/// Removes the lock of a session that was killed while it kept no document.
fn remove_widowed(lock_path: &Path) {
    if !is_lock(lock_path) || files::exists(&lock_path.with_extension(DOCUMENT)) {
        return;
    }
    // Removed while it is held: a session that starts just now sees either that or that its file is gone.
    if let Ok(_held) = FileLock::take(lock_path, LockMode::Existing) {
        let _ = files::remove(lock_path);
    }
}

/// Whether a file is called as a session's lock.
fn is_lock(path: &Path) -> bool {
    let is_number = |part: &str| u128::from_str_radix(part, 16).is_ok();
    let stem = path.file_stem().and_then(OsStr::to_str).unwrap_or_default();
    path.extension().is_some_and(|extension| extension == LOCK)
        && stem.split('-').count() == 3
        && stem.split('-').all(is_number)
}

/// The orphan whose document is at this path, if it is one.
fn orphan(document: PathBuf) -> Option<Orphan> {
    if document.extension()? != DOCUMENT || !entry::is_one(&document) {
        return None;
    }
    let lock_path = document.with_extension(LOCK);
    let lock = match FileLock::take(&lock_path, LockMode::Any) {
        Ok(lock) => Some(lock),
        Err(error) if error.kind() == io::ErrorKind::WouldBlock => return None,
        // Without a lock file, or locks at all, nobody can hold it.
        Err(_) => None,
    };
    // The session may have ended well since the folder was read.
    let Ok(status) = files::status(&document) else {
        drop(lock);
        let _ = files::remove(&lock_path);
        return None;
    };
    let written = status.modified.unwrap_or(UNIX_EPOCH);
    status.is_file.then_some(Orphan { document, lock_path, written, lock })
}

/// Removes a file that need not exist.
fn remove(path: &Path) -> io::Result<()> {
    match files::remove(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests;
