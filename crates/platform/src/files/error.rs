//! The errors of writing.

use std::io;
use std::path::{Path, PathBuf};

use super::is_dash;

/// The reason why a file could not be written. An existing file is untouched; a device, a pipe or a shared descriptor
/// may have got some of the bytes.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The path names no file, like `..` or the empty path.
    #[error("cannot write \"{}\": this path names no file; give a file name", path.display())]
    NoName {
        /// The path asked for.
        path: PathBuf,
    },
    /// The path is a directory.
    #[error("cannot write {}: it is a directory; give the name of a file in it", path.display())]
    IsDirectory {
        /// The path asked for.
        path: PathBuf,
    },
    /// The directory does not exist, or is not one.
    #[error(
        "cannot write {}: there is no directory {}; create it or choose another place",
        path.display(), directory.display()
    )]
    NoDirectory {
        /// The path asked for.
        path: PathBuf,
        /// What should be a directory.
        directory: PathBuf,
    },
    /// Nothing can be created in the directory.
    #[error(
        "cannot write {}: nothing can be created in the directory {}; change its permissions or choose another place",
        path.display(), directory.display()
    )]
    Closed {
        /// The path asked for.
        path: PathBuf,
        /// The directory.
        directory: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The existing file is marked read-only. It is respected, though renaming could replace it.
    #[error("cannot write {}: the file is write-protected; choose another name or make it writable", path.display())]
    Protected {
        /// The file.
        path: PathBuf,
    },
    /// A symbolic link leads in a circle.
    #[error("cannot write {}: its symbolic links lead in a circle; choose another name", path.display())]
    Circle {
        /// The path asked for.
        path: PathBuf,
    },
    /// The path names a descriptor that is not open.
    #[error(
        "cannot write {}: this program was not given such an open descriptor; redirect it in the shell, as in `3>FILE`",
        path.display()
    )]
    NoDescriptor {
        /// The path asked for.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The program at the other end of a pipe has ended, or has closed it.
    #[error("cannot write all of {}: what reads from there has ended before", shown(path))]
    ReaderGone {
        /// The path asked for.
        path: PathBuf,
    },
    /// The system refused while the file was looked at, written or renamed.
    #[error("cannot write {}; check the free space and the permissions", shown(path))]
    Io {
        /// The path asked for.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
}

impl WriteError {
    /// Wraps what the system said about `path`.
    pub(crate) fn io(path: &Path, source: io::Error) -> WriteError {
        let path = path.to_owned();
        match source.kind() {
            io::ErrorKind::BrokenPipe => WriteError::ReaderGone { path },
            _ => WriteError::Io { path, source },
        }
    }
}

/// The path for a message; `-` is hard to see.
fn shown(path: &Path) -> String {
    if is_dash(path) { "standard output".to_owned() } else { path.display().to_string() }
}
