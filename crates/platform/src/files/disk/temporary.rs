//! Temporary files beside their targets, and those that killed processes have left behind.
//!
//! A temporary file is locked as long as its process lives: the system lets go of the lock whatever ends the process. A
//! temporary file that nobody has locked is stale and is removed by the next process that writes into the same
//! directory.

use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use tempfile::NamedTempFile;

use super::identity::FileId;
use crate::files::error::WriteError;

const PREFIX: &str = ".catoptric-";
const SUFFIX: &str = ".tmp";

/// How often a new name is tried when a sweep of another process takes the file away before it is locked.
const TRIES: usize = 16;

/// Directories that were swept; once is enough, for what this process leaves behind it cannot remove either.
static SWEPT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// A new temporary file in this directory for the target `path`, locked, removed when dropped; the umask decides who
/// may read it.
pub(super) fn create(path: &Path, directory: &Path) -> Result<NamedTempFile, WriteError> {
    sweep_once(directory);
    let closed = |error: std::io::Error| WriteError::Closed {
        path: path.to_owned(),
        directory: directory.to_owned(),
        // The whole error names the temporary file, of which nobody has heard.
        source: error.kind().into(),
    };
    for _ in 0..TRIES {
        let file = create_unlocked(directory).map_err(closed)?;
        match file.as_file().try_lock() {
            // Another process may have removed it before it was locked.
            Ok(()) if is_in_place(&file) => return Ok(file),
            Ok(()) | Err(TryLockError::WouldBlock) => {}
            // Where there are no locks, other processes cannot lock it either, and leave it alone.
            Err(TryLockError::Error(_)) => return Ok(file),
        }
    }
    Err(closed(std::io::ErrorKind::ResourceBusy.into()))
}

fn create_unlocked(directory: &Path) -> std::io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    #[cfg(unix)]
    let permissions = <fs::Permissions as std::os::unix::fs::PermissionsExt>::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(permissions);
    builder.tempfile_in(directory)
}

fn is_in_place(file: &NamedTempFile) -> bool {
    let found = fs::symlink_metadata(file.path()).ok();
    let own = file.as_file().metadata().ok();
    match (found, own) {
        (Some(found), Some(own)) => {
            FileId::of_metadata(&found, file.path()) == FileId::of_metadata(&own, file.path())
        }
        _ => false,
    }
}

fn sweep_once(directory: &Path) {
    let place = fs::canonicalize(directory).unwrap_or_else(|_| directory.to_owned());
    if SWEPT.lock().unwrap_or_else(PoisonError::into_inner).insert(place) {
        sweep(directory);
    }
}

/// Removes the temporary files of processes that have ended. What cannot be removed stays, and is no error.
fn sweep(directory: &Path) {
    for entry in fs::read_dir(directory).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let is_temporary = name.to_str().is_some_and(is_temporary_name);
        // Anything but a plain file might block when it is opened.
        if !is_temporary || !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            continue;
        }
        // The lock is held until the file is gone: a process that has just made it waits for no lock, and makes
        // another.
        if let Ok(file) = File::open(entry.path())
            && file.try_lock().is_ok()
        {
            let _ = fs::remove_file(entry.path());
        }
    }
}

fn is_temporary_name(name: &str) -> bool {
    let middle = name.strip_prefix(PREFIX).and_then(|name| name.strip_suffix(SUFFIX));
    middle.is_some_and(|middle| !middle.is_empty() && middle.bytes().all(|byte| byte.is_ascii_alphanumeric()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_stale_temporaries_are_swept() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let kept =
            [".catoptric-.tmp", ".catoptric-a.b.tmp", ".catoptric-abc123", "catoptric-abc123.tmp", "a.png"];
        for name in kept.iter().chain(&[".catoptric-abc123.tmp", ".catoptric-Zz9.tmp"]) {
            fs::write(at(name), "").unwrap();
        }
        fs::create_dir(at(".catoptric-folder.tmp")).unwrap();
        let living = create(&at("b.png"), folder.path()).unwrap();
        // Each process sweeps once; this is another one's sweep.
        sweep(folder.path());
        for name in kept.iter().chain(&[".catoptric-folder.tmp"]) {
            assert!(at(name).exists(), "{name}");
        }
        assert!(!at(".catoptric-abc123.tmp").exists() && !at(".catoptric-Zz9.tmp").exists());
        assert!(living.path().exists());
        let path = living.path().to_owned();
        drop(living);
        assert!(!path.exists());
    }

    /// Sweeps and new files at the same time: every file that is handed out stays in its place.
    #[test]
    fn no_living_temporary_is_swept() {
        let folder = tempfile::tempdir().unwrap();
        std::thread::scope(|scope| {
            let writers: Vec<_> = (0..4)
                .map(|_| {
                    scope.spawn(|| {
                        for _ in 0..200 {
                            let file = create(Path::new("a.png"), folder.path()).unwrap();
                            assert!(is_in_place(&file));
                            std::thread::yield_now();
                            assert!(is_in_place(&file));
                        }
                    })
                })
                .collect();
            while writers.iter().any(|writer| !writer.is_finished()) {
                sweep(folder.path());
            }
        });
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    }
}
