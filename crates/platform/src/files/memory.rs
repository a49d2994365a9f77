//! Files in memory, for a program without a disk. Whoever runs it keeps their changes.

use std::collections::BTreeMap;
use std::io::{self, BufRead, Cursor, Seek};
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::{FileStatus, LockMode, Sink, WriteError};
use crate::time::SystemTime;

/// Whether other programs can change the files.
pub const ARE_SHARED: bool = false;

/// All files and folders by their paths from the root.
static STORE: Mutex<Store> = Mutex::new(Store { entries: BTreeMap::new(), changes: BTreeMap::new() });

#[derive(Debug)]
struct Store {
    entries: BTreeMap<PathBuf, StoredEntry>,
    /// What changed since the changes were taken; the latest for each path.
    changes: BTreeMap<PathBuf, Option<Arc<[u8]>>>,
}

#[derive(Clone, Debug)]
enum StoredEntry {
    Folder,
    File { bytes: Arc<[u8]>, modified: SystemTime },
}

/// A file that changed: its content, or `None` when it was removed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileChange {
    /// The path from the root.
    pub path: PathBuf,
    /// The new content.
    pub bytes: Option<Arc<[u8]>>,
}

/// The identity of a file: its path from the root.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MemoryFileId(PathBuf);

impl MemoryFileId {
    /// The file that is read at `path`, if it exists.
    pub fn of_input(path: &Path) -> Option<Self> {
        status(path).ok().filter(|found| found.is_file).map(|_| Self(whole(path)))
    }

    /// The file that is written at `path`.
    pub fn of_output(path: &Path) -> Option<Self> {
        Some(Self(whole(path)))
    }
}

/// A locked file. Nobody else can see the files of this program, so that the lock can always be had.
#[derive(Debug)]
pub struct MemoryFileLock;

impl MemoryFileLock {
    /// Locks the file at `path`.
    ///
    /// # Errors
    /// When the file is there and must not, or must and is not.
    pub fn take(path: &Path, mode: LockMode) -> io::Result<Self> {
        match (mode, status(path).is_ok()) {
            (LockMode::New, true) => Err(io::ErrorKind::AlreadyExists.into()),
            (LockMode::Existing, false) => Err(io::ErrorKind::NotFound.into()),
            (_, true) => Ok(Self),
            (_, false) => store().write(&whole(path), Arc::default()).map(|()| Self),
        }
    }
}

impl Store {
    fn write(&mut self, path: &Path, bytes: Arc<[u8]>) -> io::Result<()> {
        match path.parent().map(|folder| (folder == Path::new("/"), self.entries.get(folder))) {
            None => return Err(io::ErrorKind::IsADirectory.into()),
            Some((true, _) | (_, Some(StoredEntry::Folder))) => {}
            Some((_, Some(StoredEntry::File { .. }))) => return Err(io::ErrorKind::NotADirectory.into()),
            Some((_, None)) => return Err(io::ErrorKind::NotFound.into()),
        }
        if let Some(StoredEntry::Folder) = self.entries.get(path) {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        let file = StoredEntry::File { bytes: Arc::clone(&bytes), modified: SystemTime::now() };
        self.entries.insert(path.to_owned(), file);
        self.changes.insert(path.to_owned(), Some(bytes));
        Ok(())
    }

    fn file(&self, path: &Path) -> io::Result<Arc<[u8]>> {
        match self.entries.get(path) {
            Some(StoredEntry::File { bytes, .. }) => Ok(Arc::clone(bytes)),
            Some(StoredEntry::Folder) => Err(io::ErrorKind::IsADirectory.into()),
            None => Err(io::ErrorKind::NotFound.into()),
        }
    }
}

/// Puts a file where the program finds it, with the folders that it is in; this is no change.
///
/// # Errors
/// When a folder is at `path`, or a file where a folder should be.
pub fn put(path: &Path, bytes: Vec<u8>) -> io::Result<()> {
    let path = whole(path);
    if let Some(folder) = path.parent() {
        create_folders(folder)?;
    }
    let mut store = store();
    store.write(&path, bytes.into())?;
    store.changes.remove(&path);
    Ok(())
}

/// The files that changed since this was asked last, for whoever keeps them.
pub fn take_changes() -> Vec<FileChange> {
    let changes = std::mem::take(&mut store().changes);
    changes.into_iter().map(|(path, bytes)| FileChange { path, bytes }).collect()
}

/// What is at `path`.
///
/// # Errors
/// When nothing is there.
pub fn status(path: &Path) -> io::Result<FileStatus> {
    let path = whole(path);
    let folder = FileStatus { is_file: false, is_folder: true, length: 0, modified: None };
    if path == Path::new("/") {
        return Ok(folder);
    }
    match store().entries.get(&path) {
        Some(StoredEntry::Folder) => Ok(folder),
        Some(StoredEntry::File { bytes, modified }) => Ok(FileStatus {
            is_file: true,
            is_folder: false,
            length: bytes.len() as u64,
            modified: Some(*modified),
        }),
        None => Err(io::ErrorKind::NotFound.into()),
    }
}

/// Paths of what is in a folder, in the order of their names.
///
/// # Errors
/// When there is no such folder.
pub fn list(folder: &Path) -> io::Result<impl Iterator<Item = PathBuf>> {
    if !status(folder)?.is_folder {
        return Err(io::ErrorKind::NotADirectory.into());
    }
    let folder = whole(folder);
    let is_in = |path: &&PathBuf| path.parent() == Some(&*folder);
    let found: Vec<PathBuf> = store().entries.keys().filter(is_in).cloned().collect();
    Ok(found.into_iter())
}

/// Makes a folder that must not exist, in one that does.
///
/// # Errors
/// When it cannot be made.
pub fn create_folder(path: &Path) -> io::Result<()> {
    let path = whole(path);
    if status(&path).is_ok() {
        return Err(io::ErrorKind::AlreadyExists.into());
    }
    let is_in_folder = path.parent().is_some_and(super::is_folder);
    if !is_in_folder {
        return Err(io::ErrorKind::NotFound.into());
    }
    store().entries.insert(path, StoredEntry::Folder);
    Ok(())
}

/// Makes a folder and those that it is in, as far as they do not exist.
///
/// # Errors
/// When a file is in the way.
pub fn create_folders(path: &Path) -> io::Result<()> {
    let path = whole(path);
    match status(&path) {
        Ok(found) if found.is_folder => return Ok(()),
        Ok(_) => return Err(io::ErrorKind::AlreadyExists.into()),
        Err(_) => {}
    }
    if let Some(parent) = path.parent() {
        create_folders(parent)?;
    }
    store().entries.insert(path, StoredEntry::Folder);
    Ok(())
}

/// Removes a file.
///
/// # Errors
/// When there is none.
pub fn remove(path: &Path) -> io::Result<()> {
    let path = whole(path);
    let mut store = store();
    store.file(&path)?;
    store.entries.remove(&path);
    store.changes.insert(path, None);
    Ok(())
}

/// The path from the root, without steps up.
///
/// # Errors
/// When nothing is there.
pub fn canonical(path: &Path) -> io::Result<PathBuf> {
    status(path).map(|_| whole(path))
}

/// All bytes of the file at `path`.
///
/// # Errors
/// When there is no such file, or [`io::ErrorKind::FileTooLarge`] when it has more than `limit` bytes.
pub fn read_bytes(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let bytes = store().file(&whole(path))?;
    if bytes.len() as u64 > limit {
        return Err(io::ErrorKind::FileTooLarge.into());
    }
    let mut copy = Vec::new();
    copy.try_reserve_exact(bytes.len()).map_err(|_| io::ErrorKind::OutOfMemory)?;
    copy.extend_from_slice(&bytes);
    Ok(copy)
}

/// Opens the file at `path` to read it back and forth, with its length in bytes.
///
/// # Errors
/// When there is no such file.
pub fn open(path: &Path) -> io::Result<(impl BufRead + Seek, u64)> {
    let bytes = store().file(&whole(path))?;
    let length = bytes.len() as u64;
    Ok((Cursor::new(bytes), length))
}

/// The first `limit` bytes of the file at `path`, or all that it has.
///
/// # Errors
/// When there is no such file.
pub fn read_start(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let bytes = store().file(&whole(path))?;
    let length = usize::try_from(limit).unwrap_or(usize::MAX).min(bytes.len());
    Ok(bytes.iter().copied().take(length).collect())
}

/// The folder of the file at `path`, where relative paths in it begin.
pub fn directory_of_file(path: &Path) -> Option<&Path> {
    path.parent()
}

/// Asks whether a file can be written at `path`.
///
/// # Errors
/// What stands in the way.
pub fn check_writable(path: &Path) -> Result<(), WriteError> {
    let target = whole(path);
    let Some(directory) = target.parent().filter(|_| path.file_name().is_some()) else {
        return Err(WriteError::NoName { path: path.to_owned() });
    };
    match (status(&target), status(directory)) {
        (Ok(found), _) if found.is_folder => Err(WriteError::IsDirectory { path: path.to_owned() }),
        (_, Ok(found)) if found.is_folder => Ok(()),
        _ => Err(WriteError::NoDirectory { path: path.to_owned(), directory: directory.to_owned() }),
    }
}

/// Asks whether files can be written into the directory at `path`, which need not be there yet.
///
/// # Errors
/// When a file is in the way.
pub fn check_directory(path: &Path) -> Result<(), WriteError> {
    if path.as_os_str().is_empty() {
        return Err(WriteError::NoName { path: path.to_owned() });
    }
    let target = whole(path);
    let existing = target.ancestors().find_map(|folder| Some((folder, status(folder).ok()?)));
    match existing {
        Some((folder, found)) if !found.is_folder => {
            Err(WriteError::NoDirectory { path: path.to_owned(), directory: folder.to_owned() })
        }
        _ => Ok(()),
    }
}

/// No path is a stream here.
pub fn is_stream(_path: &Path) -> bool {
    false
}

/// There is no terminal here.
pub fn is_terminal(_path: &Path) -> bool {
    false
}

/// Lets `fill` write the new content of the file at `path`, whole or not at all.
///
/// # Errors
/// What [`check_writable`] finds, and what `fill` returns; nothing has changed then.
pub fn write_whole(
    path: &Path,
    fill: impl FnOnce(&mut dyn Sink) -> io::Result<()>,
) -> Result<(), WriteError> {
    check_writable(path)?;
    let mut bytes = Cursor::new(Vec::new());
    fill(&mut bytes)
        .and_then(|()| store().write(&whole(path), bytes.into_inner().into()))
        .map_err(|source| WriteError::io(path, source))
}

fn store() -> MutexGuard<'static, Store> {
    STORE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The path from the root, by names alone.
fn whole(path: &Path) -> PathBuf {
    let mut whole = PathBuf::from("/");
    for part in path.components() {
        match part {
            Component::Normal(name) => whole.push(name),
            Component::ParentDir => _ = whole.pop(),
            Component::Prefix(_) | Component::RootDir | Component::CurDir => {}
        }
    }
    whole
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All tests share the store.
    #[test]
    fn files_are_kept_like_those_of_a_disk() {
        let path = Path::new("/a/b/../c.toml");
        let write = |path: &Path| write_whole(path, |sink| sink.write_all(b"text"));
        assert!(matches!(write(path), Err(WriteError::NoDirectory { .. })));
        create_folders(Path::new("/a")).unwrap();
        assert!(matches!(write(Path::new("/a")), Err(WriteError::IsDirectory { .. })));
        write(path).unwrap();
        let failed = write_whole(path, |sink| {
            sink.write_all(b"half")?;
            Err(io::ErrorKind::StorageFull.into())
        });
        assert!(matches!(failed, Err(WriteError::Io { .. })));
        assert_eq!(read_bytes(path, 4).unwrap(), b"text");
        assert_eq!(read_bytes(path, 3).unwrap_err().kind(), io::ErrorKind::FileTooLarge);
        assert_eq!(read_start(path, 2).unwrap(), b"te");
        assert_eq!(list(Path::new("/a")).unwrap().collect::<Vec<_>>(), [Path::new("/a/c.toml")]);
        assert_eq!(MemoryFileId::of_input(Path::new("a/c.toml")), MemoryFileId::of_output(path));
        put(Path::new("/a/d/e.png"), vec![1]).unwrap();
        let found = status(Path::new("/a/d/e.png")).unwrap();
        assert!(found.is_file && found.length == 1 && found.modified.is_some());
        assert!(
            matches!(create_folders(Path::new("/a/d/e.png/f")), Err(error) if error.kind() == io::ErrorKind::AlreadyExists)
        );
        remove(path).unwrap();
        assert_eq!(remove(path).unwrap_err().kind(), io::ErrorKind::NotFound);
        let changes = take_changes();
        assert_eq!(
            changes,
            [FileChange { path: "/a/c.toml".into(), bytes: None }],
            "what is put is no change"
        );
    }
}
