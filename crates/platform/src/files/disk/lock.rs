//! Files that one program at a time holds.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::Path;

use crate::files::LockMode;

/// A locked file. The system lets go of the lock whatever ends the program; the file stays.
#[derive(Debug)]
pub struct FileLock {
    /// Open, and therefore locked.
    _file: File,
}

impl FileLock {
    /// Locks the file at `path` without waiting.
    ///
    /// # Errors
    /// [`io::ErrorKind::WouldBlock`] when somebody holds it, or what the system says. A file that was created for a lock
    /// that fails is removed.
    pub fn take(path: &Path, mode: LockMode) -> io::Result<Self> {
        let mut options = File::options();
        options.read(true).write(true);
        let file = match mode {
            LockMode::New => options.create_new(true),
            LockMode::Existing => &mut options,
            LockMode::Any => options.create(true).truncate(false),
        }
        .open(path)?;
        match file.try_lock() {
            Ok(()) => Ok(Self { _file: file }),
            Err(error) => {
                if mode == LockMode::New {
                    drop(file);
                    let _ = fs::remove_file(path);
                }
                Err(match error {
                    TryLockError::WouldBlock => io::ErrorKind::WouldBlock.into(),
                    TryLockError::Error(error) => error,
                })
            }
        }
    }
}
