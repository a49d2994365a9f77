//! Reading from files and streams.

use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Read, Seek};
use std::path::Path;

use super::descriptor::Descriptor;
use super::target::descriptor_of;

/// All bytes of the file, pipe or device at `path`; `-` is standard input.
///
/// # Errors
/// What the system says. [`io::ErrorKind::FileTooLarge`] if there are more than `limit` bytes, and
/// [`io::ErrorKind::OutOfMemory`] if there is no memory for them.
pub fn read_bytes(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let (file, length) = if crate::files::is_dash(path) {
        (Descriptor::STDIN.duplicate()?, 0)
    } else {
        let metadata = fs::metadata(path)?;
        if metadata.is_dir() {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        // A pipe says 0.
        (File::open(path)?, metadata.len())
    };
    if length > limit {
        return Err(io::ErrorKind::FileTooLarge.into());
    }
    let mut bytes = Vec::new();
    // One more, so that the end is found without growing.
    let expected = usize::try_from(length).unwrap_or(usize::MAX).saturating_add(1);
    bytes.try_reserve_exact(expected).map_err(|_| io::ErrorKind::OutOfMemory)?;
    // A pipe, or a file that grows, can bring more than its metadata say.
    file.take(limit.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit {
        return Err(io::ErrorKind::FileTooLarge.into());
    }
    Ok(bytes)
}

/// Opens the plain file at `path` to read it back and forth, with its length in bytes.
///
/// # Errors
/// What the system says.
pub fn open(path: &Path) -> io::Result<(impl BufRead + Seek, u64)> {
    let file = File::open(path)?;
    let length = file.metadata()?.len();
    Ok((BufReader::with_capacity(1 << 16, file), length))
}

/// The first `limit` bytes of the plain file at `path`, or all that it has.
///
/// # Errors
/// What the system says.
pub fn read_start(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?.take(limit).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Where relative paths in the file at `path` begin: its directory. `None` for `-`, descriptors, pipes and devices,
/// which are in no directory: their paths begin where the program was started.
pub fn directory_of_file(path: &Path) -> Option<&Path> {
    let is_stream = descriptor_of(path).is_some() || fs::metadata(path).is_ok_and(|found| !found.is_file());
    if is_stream { None } else { path.parent() }
}
