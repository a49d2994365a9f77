//! Files by their paths: on a disk, or in memory where a program has no disk, as in a browser.
//!
//! ## How a file is replaced
//!
//! The new content goes to a temporary file in the target's own directory. That file is synchronized to the disk and
//! renamed over the target, which POSIX and Windows do in one step. A reader sees the old file or the new one. Hard
//! links to the old file keep the old content; its permissions pass to the new one.
//!
//! A pipe or device is opened and written to. A path that names an open descriptor (`-`, `/dev/stdout`, `/dev/fd/3`, a
//! link to one) is written through that descriptor, so that a shell's `>>` appends and several programs can share a
//! file.

#[cfg(not(target_family = "wasm"))]
mod disk;
mod error;
#[cfg(any(target_family = "wasm", test))]
#[cfg_attr(test, allow(dead_code, unreachable_pub, reason = "on a desktop tests alone use it"))]
mod memory;
mod status;

use std::io::{self, Seek, Write};
use std::path::Path;

#[cfg(not(target_family = "wasm"))]
use disk as store;
#[cfg(target_family = "wasm")]
use memory as store;

#[cfg(not(target_family = "wasm"))]
pub use disk::{FileId, FileLock};
pub use error::WriteError;
#[cfg(target_family = "wasm")]
pub use memory::{FileChange, put, take_changes};
#[cfg(target_family = "wasm")]
pub use memory::{MemoryFileId as FileId, MemoryFileLock as FileLock};
pub use status::{FileStamp, FileStatus};
pub use store::{
    ARE_SHARED, canonical, check_directory, check_writable, create_folder, create_folders, directory_of_file,
    is_stream, is_terminal, list, open, read_bytes, read_start, remove, status, write_whole,
};

/// The target of a file's content.
pub trait Sink: Write + Seek {}
impl<T: Write + Seek> Sink for T {}

/// The way to take a [`FileLock`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LockMode {
    /// The file must not exist, and is created.
    New,
    /// The file must exist.
    Existing,
    /// The file is created if it does not exist.
    Any,
}

/// Whether the path is the name of standard input and output on command lines.
fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Writes these bytes to a file, whole or not at all; an existing file is replaced. See [`write_whole`].
///
/// # Errors
/// What [`check_writable`] finds, a full disk, or a failing system. The old file, if any, is untouched then.
pub fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    write_whole(path, |sink| sink.write_all(bytes))
}

/// The text of the file at `path`.
///
/// # Errors
/// Those of [`read_bytes`], and [`io::ErrorKind::InvalidData`] when it is no UTF-8.
pub fn read_text(path: &Path, limit: u64) -> io::Result<String> {
    String::from_utf8(read_bytes(path, limit)?).map_err(|_| io::ErrorKind::InvalidData.into())
}

/// Whether something is at `path`, links followed.
pub fn exists(path: &Path) -> bool {
    status(path).is_ok()
}

/// Whether a folder is at `path`, links followed.
pub fn is_folder(path: &Path) -> bool {
    status(path).is_ok_and(|found| found.is_folder)
}
