//! Files written whole or not at all.
//!
//! The new content goes to a temporary file in the target's own directory, is synchronized to the disk and
//! renamed over the target, which POSIX and Windows do in one step. So a reader sees the old file or the
//! new one. Hard links to the old file keep the old content; its permissions pass to the new one.

mod error;

use std::fs::{self, File};
use std::io::{self, BufWriter, Cursor, Seek, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

pub use error::WriteError;

/// What the content is written to.
pub trait Sink: Write + Seek {}
impl<T: Write + Seek> Sink for T {}

/// Where the bytes will go.
#[derive(Debug)]
enum Target {
    /// A plain file, existing (then with its permissions) or not, reached through any symbolic links.
    File { path: PathBuf, directory: PathBuf, permissions: Option<fs::Permissions> },
    /// Something that must not be renamed over: `/dev/stdout`, a pipe.
    Device { path: PathBuf },
}

/// Symbolic links followed at most, as many as Linux follows.
const LINKS: usize = 40;

/// Asks, before minutes of work, whether `path` can be written: it names a file, its directory exists and
/// lets files be created (one is created for a moment, and removed), and an existing file is not protected.
///
/// ```
/// use std::path::Path;
/// let error = catoptric_files::check_writable(Path::new("/no/such/place/out.png")).unwrap_err();
/// assert!(error.to_string().contains("there is no directory /no/such/place"));
/// ```
///
/// # Errors
/// What stands in the way, where, and what to do. The disk can still run full later.
pub fn check_writable(path: &Path) -> Result<(), WriteError> {
    match find(path)? {
        Target::File { directory, .. } => temporary(path, &directory).map(drop),
        Target::Device { .. } => Ok(()),
    }
}

/// Writes these bytes to a file, whole or not at all; an existing file is replaced.
///
/// # Errors
/// What [`check_writable`] finds, a full disk, or a failing system. The old file, if any, is untouched then.
pub fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    write_whole(path, |sink| sink.write_all(bytes))
}

/// Lets `fill` write the new content of the file at `path`.
///
/// # Errors
/// As for [`write_bytes`], and what `fill` returns; nothing has changed then.
pub fn write_whole(
    path: &Path,
    fill: impl FnOnce(&mut dyn Sink) -> io::Result<()>,
) -> Result<(), WriteError> {
    let written = match find(path)? {
        Target::Device { path: device } => {
            let mut bytes = Cursor::new(Vec::new());
            fill(&mut bytes).and_then(|()| write_through(&device, bytes.get_ref()))
        }
        Target::File { path: target, directory, permissions } => {
            let file = temporary(path, &directory)?;
            fill_to_disk(file.as_file(), fill)
                .and_then(|()| finish(file, &target, permissions))
                .map(|()| sync_directory(&directory))
        }
    };
    written.map_err(|source| WriteError::io(path, source))
}

/// Writes the content down to the disk.
fn fill_to_disk(file: &File, fill: impl FnOnce(&mut dyn Sink) -> io::Result<()>) -> io::Result<()> {
    let mut sink = BufWriter::with_capacity(1 << 16, file);
    fill(&mut sink)?;
    sink.flush()?;
    file.sync_all()
}

/// Makes the new name durable, where the system can; the content is safe already.
fn sync_directory(directory: &Path) {
    if cfg!(unix) {
        let _ = File::open(directory).and_then(|directory| directory.sync_all());
    }
}

/// Puts the temporary file in the target's place; if that fails it is removed.
fn finish(file: NamedTempFile, target: &Path, permissions: Option<fs::Permissions>) -> io::Result<()> {
    if let Some(permissions) = permissions {
        file.as_file().set_permissions(permissions)?;
    }
    file.persist(target).map(drop).map_err(|error| error.error)
}

/// Writes to something that is no plain file.
fn write_through(device: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::options().write(true).open(device)?;
    file.write_all(bytes)?;
    file.flush()
}

/// A new temporary file in this directory, removed when dropped; the umask decides who may read it.
fn temporary(path: &Path, directory: &Path) -> Result<NamedTempFile, WriteError> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".catoptric-").suffix(".tmp");
    #[cfg(unix)]
    let permissions = <fs::Permissions as std::os::unix::fs::PermissionsExt>::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(permissions);
    builder.tempfile_in(directory).map_err(|source| WriteError::Closed {
        path: path.to_owned(),
        directory: directory.to_owned(),
        source,
    })
}

/// Follows symbolic links and looks at what is there.
fn find(path: &Path) -> Result<Target, WriteError> {
    let target = follow_links(path)?;
    let permissions = match fs::metadata(&target) {
        Ok(found) if found.is_dir() => return Err(WriteError::IsDirectory { path: path.to_owned() }),
        Ok(found) if !found.is_file() => return Ok(Target::Device { path: target }),
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
    let directory = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent.to_owned(),
        _ => PathBuf::from("."),
    };
    if directory.is_dir() {
        Ok(Target::File { path: target, directory, permissions })
    } else {
        Err(WriteError::NoDirectory { path: path.to_owned(), directory })
    }
}

/// The path that the symbolic links lead to, whether or not something is there.
fn follow_links(path: &Path) -> Result<PathBuf, WriteError> {
    let mut target = path.to_owned();
    for _ in 0..LINKS {
        match fs::read_link(&target) {
            // An absolute destination replaces the parent.
            Ok(destination) => target = target.parent().unwrap_or(Path::new("")).join(destination),
            Err(_) => return Ok(target),
        }
    }
    Err(WriteError::Circle { path: path.to_owned() })
}

/// Whether the path was meant as a directory, like `out/`; `Path` itself overlooks that.
fn ends_with_separator(path: &Path) -> bool {
    path.as_os_str().as_encoded_bytes().last().is_some_and(|&byte| std::path::is_separator(char::from(byte)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(directory: &Path) -> Vec<String> {
        let entries = fs::read_dir(directory).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn failing_content_leaves_the_old_file_and_no_temporary() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("picture.png");
        fs::write(&path, "old").unwrap();
        let error = write_whole(&path, |sink| {
            sink.write_all(&[0; 100_000])?;
            Err(io::Error::from(io::ErrorKind::StorageFull))
        });
        assert!(matches!(error, Err(WriteError::Io { .. })), "{error:?}");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(directory.path()), ["picture.png"]);
    }

    #[test]
    fn a_failing_rename_leaves_no_temporary() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("picture.png");
        let error = write_whole(&path, |sink| {
            sink.write_all(b"new")?;
            // Meanwhile someone makes a directory of that name, which no file can replace.
            fs::create_dir(&path)
        });
        assert!(matches!(error, Err(WriteError::Io { .. })), "{error:?}");
        assert_eq!(names(directory.path()), ["picture.png"]);
        assert!(path.is_dir());
    }

    #[test]
    fn bytes_replace_the_old_file() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("report.csv");
        write_bytes(&path, b"a much longer old text").unwrap();
        write_bytes(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(names(directory.path()), ["report.csv"]);
    }
}
