//! Files on a disk.

mod descriptor;
mod identity;
mod input;
mod lock;
mod target;
mod temporary;

use std::fs::{self, File};
use std::io::{self, BufWriter, Cursor, IsTerminal as _, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use super::{FileStatus, Sink, WriteError};
use target::{OutputTarget, directory_of};

pub use identity::FileId;
pub use input::{directory_of_file, open, read_bytes, read_start};
pub use lock::FileLock;

/// Whether other programs can change the files.
pub const ARE_SHARED: bool = true;

/// Asks, before minutes of work, whether `path` can be written: it names a file, its directory exists and
/// lets files be created (one is created for a moment, and removed), and an existing file is not protected; or it names
/// a pipe, a device, or a descriptor that is open. `-` is standard output.
///
/// ```
/// use std::path::Path;
/// let error = catoptric_platform::files::check_writable(Path::new("/no/such/place/out.png")).unwrap_err();
/// assert!(error.to_string().contains("there is no directory /no/such/place"));
/// ```
///
/// # Errors
/// What stands in the way, where, and what to do. The disk can still run full later.
pub fn check_writable(path: &Path) -> Result<(), WriteError> {
    match OutputTarget::of(path)? {
        OutputTarget::File { directory, .. } => temporary::create(path, &directory).map(drop),
        OutputTarget::Descriptor(descriptor) => descriptor
            .duplicate()
            .map(drop)
            .map_err(|source| WriteError::NoDescriptor { path: path.to_owned(), source }),
        OutputTarget::Stream { .. } => Ok(()),
    }
}

/// Asks whether files can be written into the directory at `path`, which need not be there yet. Nothing stays behind.
///
/// # Errors
/// What stands in the way, where, and what to do.
pub fn check_directory(path: &Path) -> Result<(), WriteError> {
    if path.as_os_str().is_empty() || crate::files::is_dash(path) {
        return Err(WriteError::NoName { path: path.to_owned() });
    }
    let mut existing = path;
    while fs::symlink_metadata(existing).is_err() {
        match existing.parent() {
            Some(_) => existing = directory_of(existing),
            None => break,
        }
    }
    if !existing.is_dir() {
        return Err(WriteError::NoDirectory { path: path.to_owned(), directory: existing.to_owned() });
    }
    temporary::create(path, existing).map(drop)
}

/// Whether what is written to `path` goes through a descriptor, a pipe or a device, and replaces no file.
pub fn is_stream(path: &Path) -> bool {
    matches!(OutputTarget::of(path), Ok(OutputTarget::Descriptor(_) | OutputTarget::Stream { .. }))
}

/// Whether what is written to `path` appears on a terminal.
pub fn is_terminal(path: &Path) -> bool {
    match OutputTarget::of(path) {
        Ok(OutputTarget::Descriptor(descriptor)) => {
            descriptor.duplicate().is_ok_and(|file| file.is_terminal())
        }
        Ok(OutputTarget::Stream { path }) => {
            // Opening a pipe would wait for its reader.
            is_character_device(&path)
                && File::options().write(true).open(&path).is_ok_and(|file| file.is_terminal())
        }
        Ok(OutputTarget::File { .. }) | Err(_) => false,
    }
}

#[cfg(unix)]
fn is_character_device(path: &Path) -> bool {
    use std::os::unix::fs::FileTypeExt as _;
    fs::metadata(path).is_ok_and(|found| found.file_type().is_char_device())
}

#[cfg(not(unix))]
fn is_character_device(_path: &Path) -> bool {
    false
}

/// Lets `fill` write the new content of the file at `path`. What is no plain file, or names an open descriptor (`-` is
/// standard output), gets the same bytes, all at once when `fill` has ended.
///
/// # Errors
/// What [`check_writable`] finds, a full disk, a failing system, and what `fill` returns; nothing has changed then. A stream may have got a part of the
/// bytes.
pub fn write_whole(
    path: &Path,
    fill: impl FnOnce(&mut dyn Sink) -> io::Result<()>,
) -> Result<(), WriteError> {
    let written = match OutputTarget::of(path)? {
        OutputTarget::File { path: target, directory, permissions } => {
            let file = temporary::create(path, &directory)?;
            fill_to_disk(file.as_file(), fill)
                .and_then(|()| finish(file, &target, permissions))
                .map(|()| sync_directory(&directory))
        }
        OutputTarget::Descriptor(descriptor) => {
            let opened = descriptor.duplicate();
            let stream =
                opened.map_err(|source| WriteError::NoDescriptor { path: path.to_owned(), source })?;
            write_through(stream, fill)
        }
        // Opened last: it may wait for a reader. Appended to, in case that it is a file of another process.
        OutputTarget::Stream { path } => {
            File::options().append(true).open(path).and_then(|stream| write_through(stream, fill))
        }
    };
    written.map_err(|source| WriteError::io(path, source))
}

/// Writes the content to something that is no plain file, or shared with others.
fn write_through(mut stream: File, fill: impl FnOnce(&mut dyn Sink) -> io::Result<()>) -> io::Result<()> {
    // Encoders go back, which a stream cannot.
    let mut bytes = Cursor::new(Vec::new());
    fill(&mut bytes)?;
    stream.write_all(bytes.get_ref())?;
    stream.flush()
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

/// What is at `path`, links followed.
///
/// # Errors
/// What the system says.
pub fn status(path: &Path) -> io::Result<FileStatus> {
    fs::metadata(path).map(|found| FileStatus {
        is_file: found.is_file(),
        is_folder: found.is_dir(),
        length: found.len(),
        modified: found.modified().ok(),
    })
}

/// Paths of what is in a folder, in no order.
///
/// # Errors
/// What the system says of the folder; entries that cannot be read are passed over.
pub fn list(folder: &Path) -> io::Result<impl Iterator<Item = PathBuf>> {
    Ok(fs::read_dir(folder)?.filter_map(|entry| Some(entry.ok()?.path())))
}

/// Makes a folder that must not exist.
///
/// # Errors
/// What the system says.
pub fn create_folder(path: &Path) -> io::Result<()> {
    fs::create_dir(path)
}

/// Makes a folder and those that it is in, as far as they do not exist.
///
/// # Errors
/// What the system says.
pub fn create_folders(path: &Path) -> io::Result<()> {
    fs::create_dir_all(path)
}

/// Removes a file.
///
/// # Errors
/// What the system says.
pub fn remove(path: &Path) -> io::Result<()> {
    fs::remove_file(path)
}

/// The path of a file without links and steps up.
///
/// # Errors
/// What the system says; the file must exist.
pub fn canonical(path: &Path) -> io::Result<PathBuf> {
    path.canonicalize()
}

#[cfg(test)]
mod tests {
    use super::super::write_bytes;
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
