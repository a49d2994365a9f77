//! Paths that name an open descriptor of this process: `-`, `/dev/stdout`, `/dev/fd/3`, and links to them.
//!
//! Linux opens such a path anew: a file behind it then has a second position, and what a shell appends (`>> log`) or
//! several programs share is overwritten. So the descriptor itself is duplicated, which shares position and mode.

use std::fs::File;
use std::io;
use std::path::Path;

use crate::files::is_dash;

/// An open descriptor of this process, if it is open at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Descriptor(u32);

impl Descriptor {
    /// Standard input.
    pub(super) const STDIN: Self = Self(0);
    /// Standard output.
    pub(super) const STDOUT: Self = Self(1);

    /// The descriptor that `path` names itself, links aside; `-` is standard output.
    pub(super) fn named(path: &Path) -> Option<Self> {
        if is_dash(path) { Some(Self::STDOUT) } else { system::number_of(path).map(Self) }
    }

    /// A duplicate that shares position and mode with the descriptor.
    pub(super) fn duplicate(self) -> io::Result<File> {
        system::duplicate(self.0)
    }
}

/// Whether the path is a descriptor of another process, as `/proc/1/fd/1` is.
pub(super) fn is_foreign(path: &Path) -> bool {
    cfg!(unix)
        && system::folder_of(path).is_some_and(|folder| folder.starts_with("/proc") && folder.ends_with("fd"))
        && system::number_of(path).is_none()
}

#[cfg(unix)]
mod system {
    use super::{File, Path, io};
    use std::fs::canonicalize;
    use std::os::fd::BorrowedFd;
    use std::path::PathBuf;

    /// The real folder of a path.
    pub(super) fn folder_of(path: &Path) -> Option<PathBuf> {
        let folder = path.parent()?;
        canonicalize(if folder.as_os_str().is_empty() { Path::new(".") } else { folder }).ok()
    }

    /// The number in `/dev/fd/N`, `/proc/self/fd/N` and the like, however their folder is written.
    pub(super) fn number_of(path: &Path) -> Option<u32> {
        let name = path.file_name()?.to_str()?;
        // Most paths end here.
        let standard = ["stdin", "stdout", "stderr"].iter().position(|standard| *standard == name);
        let number = name.bytes().all(|digit| digit.is_ascii_digit()).then(|| name.parse().ok()).flatten();
        if standard.is_none() && number.is_none() {
            return None;
        }
        let folder = folder_of(path)?;
        if folder == Path::new("/dev") {
            return standard.and_then(|place| u32::try_from(place).ok());
        }
        // A process and its threads share their descriptors.
        let is_own = || canonicalize("/proc/self").is_ok_and(|own| folder.starts_with(own));
        number.filter(|_| folder == Path::new("/dev/fd") || folder.ends_with("fd") && is_own())
    }

    #[allow(
        unsafe_code,
        reason = "no safe function takes the number of a descriptor that a parent has opened"
    )]
    pub(super) fn duplicate(number: u32) -> io::Result<File> {
        let number = i32::try_from(number).map_err(|_| io::ErrorKind::NotFound)?;
        // SAFETY: `number` is not negative. It is borrowed for one system call, which closes nothing and fails with
        // EBADF if the descriptor is not open. The user names the descriptor to have it written to; that it belongs to
        // this program itself can only be if the user names one that the program was not given.
        let descriptor = unsafe { BorrowedFd::borrow_raw(number) };
        descriptor.try_clone_to_owned().map(File::from)
    }
}

#[cfg(not(unix))]
mod system {
    use super::{File, Path, io};
    use std::path::PathBuf;

    pub(super) fn folder_of(_path: &Path) -> Option<PathBuf> {
        None
    }

    pub(super) fn number_of(_path: &Path) -> Option<u32> {
        None
    }

    #[cfg(windows)]
    pub(super) fn duplicate(number: u32) -> io::Result<File> {
        use std::os::windows::io::AsHandle as _;
        let handle = match number {
            0 => io::stdin().as_handle().try_clone_to_owned(),
            _ => io::stdout().as_handle().try_clone_to_owned(),
        };
        handle.map(File::from)
    }

    #[cfg(not(windows))]
    pub(super) fn duplicate(_number: u32) -> io::Result<File> {
        Err(io::ErrorKind::Unsupported.into())
    }
}
