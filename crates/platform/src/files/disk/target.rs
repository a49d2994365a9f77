//! The target of a path for output.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::descriptor::{self, Descriptor};
use crate::files::error::WriteError;

/// Symbolic links followed at most, as many as Linux follows.
const LINKS: usize = 40;

/// The target of a path for output.
#[derive(Debug)]
pub(super) enum OutputTarget {
    /// A plain file, existing (then with its permissions) or not, reached through any symbolic links. It is replaced.
    File { path: PathBuf, directory: PathBuf, permissions: Option<fs::Permissions> },
    /// An open descriptor of this process, whatever is behind it. It is written through.
    Descriptor(Descriptor),
    /// A pipe or a device with a path of its own. It is opened and written to.
    Stream { path: PathBuf },
}

impl OutputTarget {
    /// Follows symbolic links and looks at what is there.
    pub(super) fn of(path: &Path) -> Result<Self, WriteError> {
        let target = match follow_links(path)? {
            LinkTarget::Descriptor(descriptor) => return Ok(Self::Descriptor(descriptor)),
            LinkTarget::Foreign(path) => return Ok(Self::Stream { path }),
            LinkTarget::Path(target) => target,
        };
        let permissions = match fs::metadata(&target) {
            Ok(found) if found.is_dir() => return Err(WriteError::IsDirectory { path: path.to_owned() }),
            Ok(found) if !found.is_file() => return Ok(Self::Stream { path: target }),
            Ok(found) if found.permissions().readonly() => {
                return Err(WriteError::Protected { path: path.to_owned() });
            }
            Ok(found) => Some(found.permissions()),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) if error.kind() == io::ErrorKind::NotADirectory => None,
            Err(error) => return Err(WriteError::io(path, error)),
        };
        if target.file_name().is_none() || ends_with_separator(&target) {
            return Err(WriteError::NoName { path: path.to_owned() });
        }
        let directory = directory_of(&target).to_owned();
        if directory.is_dir() {
            Ok(Self::File { path: target, directory, permissions })
        } else {
            Err(WriteError::NoDirectory { path: path.to_owned(), directory })
        }
    }
}

/// The descriptor that a path names, directly or by symbolic links.
pub(super) fn descriptor_of(path: &Path) -> Option<Descriptor> {
    match follow_links(path) {
        Ok(LinkTarget::Descriptor(descriptor)) => Some(descriptor),
        _ => None,
    }
}

/// The directory that a path is in; `.` for a name alone.
pub(super) fn directory_of(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The target of symbolic links.
enum LinkTarget {
    Descriptor(Descriptor),
    /// A descriptor of another process, by its link: the link's text may be the name of a file, which must not be
    /// replaced.
    Foreign(PathBuf),
    /// Whether or not something is there.
    Path(PathBuf),
}

fn follow_links(path: &Path) -> Result<LinkTarget, WriteError> {
    let mut target = path.to_owned();
    for _ in 0..LINKS {
        if let Some(descriptor) = Descriptor::named(&target) {
            return Ok(LinkTarget::Descriptor(descriptor));
        }
        match fs::read_link(&target) {
            Ok(_) if descriptor::is_foreign(&target) => return Ok(LinkTarget::Foreign(target)),
            // An absolute destination replaces the parent.
            Ok(destination) => target = target.parent().unwrap_or(Path::new("")).join(destination),
            Err(_) => return Ok(LinkTarget::Path(target)),
        }
    }
    Err(WriteError::Circle { path: path.to_owned() })
}

/// Whether the path was meant as a directory, like `out/`; `Path` itself overlooks that.
fn ends_with_separator(path: &Path) -> bool {
    path.as_os_str().as_encoded_bytes().last().is_some_and(|&byte| std::path::is_separator(char::from(byte)))
}
