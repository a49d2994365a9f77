//! Scene files on disk.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use crate::Scene;
use crate::format::{Diagnostics, LONGEST_TEXT, read_bytes};

/// A scene file that could be read.
#[derive(Clone, Debug)]
pub struct Loaded {
    /// The scene.
    pub scene: Scene,
    /// The text of the file, which [`crate::update`] needs to keep comments and order.
    pub text: String,
    /// Warnings about it.
    pub warnings: Diagnostics,
}

/// Why a scene file could not be read.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// The file could not be read at all.
    #[error("cannot read {}: {reason}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What went wrong, and what to do.
        reason: String,
        /// The system's error, if it was one.
        source: Option<io::Error>,
    },
    /// The file was read, and there are errors in it.
    #[error("{}:{diagnostics}", path.display())]
    Diagnostics {
        /// The file.
        path: PathBuf,
        /// Its text, for [`Diagnostics::render`].
        text: String,
        /// The errors, and warnings.
        diagnostics: Diagnostics,
    },
}

/// A scene file could not be written. What stood there before still does.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {}: {source}", path.display())]
pub struct SaveError {
    /// The file.
    pub path: PathBuf,
    /// The system's error.
    pub source: io::Error,
}

/// Reads a scene file.
pub fn load(path: impl AsRef<Path>) -> Result<Loaded, LoadError> {
    let path = path.as_ref();
    let bytes = read_file(path)?;
    let (reading, text) = read_bytes(bytes);
    match reading.into_result() {
        Ok(warned) => Ok(Loaded { scene: warned.value, text, warnings: warned.warnings }),
        Err(diagnostics) => Err(LoadError::Diagnostics { path: path.to_owned(), text, diagnostics }),
    }
}

fn read_file(path: &Path) -> Result<Vec<u8>, LoadError> {
    let refused = |reason: String| LoadError::Io { path: path.to_owned(), reason, source: None };
    let failed = |error: io::Error| {
        let reason = match error.kind() {
            io::ErrorKind::NotFound => "there is no such file; check its name".to_owned(),
            io::ErrorKind::PermissionDenied => {
                "this is not permitted; check the rights of the file".to_owned()
            }
            _ => error.to_string(),
        };
        LoadError::Io { path: path.to_owned(), reason, source: Some(error) }
    };
    let metadata = fs::metadata(path).map_err(failed)?;
    if metadata.is_dir() {
        return Err(refused("it is a folder; name a scene file in it".to_owned()));
    }
    let too_long =
        || refused(format!("it is longer than {} MiB, the longest a scene can be", LONGEST_TEXT >> 20));
    let limit = LONGEST_TEXT as u64;
    if metadata.len() > limit {
        return Err(too_long());
    }
    let mut bytes = Vec::with_capacity(usize::try_from(metadata.len()).unwrap_or_default());
    // A pipe or a growing file can bring more than its metadata say.
    File::open(path).and_then(|file| file.take(limit + 1).read_to_end(&mut bytes)).map_err(failed)?;
    if bytes.len() > LONGEST_TEXT {
        return Err(too_long());
    }
    Ok(bytes)
}

/// Writes `text` to the file at `path` in one step: a crash leaves the old file or the new one, never half of one.
/// Symbolic links are followed, and a file that is replaced hands on its permissions.
pub fn save(path: impl AsRef<Path>, text: &str) -> Result<(), SaveError> {
    let path = path.as_ref();
    write_file(path, text.as_bytes()).map_err(|source| SaveError { path: path.to_owned(), source })
}

fn write_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let target = followed(path)?;
    let existing = match fs::metadata(&target) {
        Ok(metadata) if metadata.is_dir() => return Err(io::Error::from(io::ErrorKind::IsADirectory)),
        Ok(metadata) if !metadata.is_file() => return File::create(&target)?.write_all(bytes),
        Ok(metadata) => Some(metadata.permissions()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => None,
        Err(error) => return Err(error),
    };
    if existing.as_ref().is_some_and(fs::Permissions::readonly) {
        return Err(io::Error::from(io::ErrorKind::PermissionDenied));
    }
    let folder = match target.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".catoptric-").suffix(".tmp");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        // Less what the user's mask takes away.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.flush()?;
    if let Some(permissions) = existing {
        file.as_file().set_permissions(permissions)?;
    }
    file.as_file().sync_all()?;
    file.persist(&target).map_err(|error| error.error)?;
    sync_folder(folder);
    Ok(())
}

/// Makes the new name durable, where the system can; the file itself is safe already.
fn sync_folder(folder: &Path) {
    if cfg!(unix) {
        let _ = File::open(folder).and_then(|folder| folder.sync_all());
    }
}

/// Where symbolic links lead to, even when nothing stands there yet.
fn followed(path: &Path) -> io::Result<PathBuf> {
    /// As many links as Linux follows.
    const MOST_LINKS: usize = 40;
    let mut target = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&target) {
            Ok(next) => {
                let folder = target.parent().map(Path::to_owned).unwrap_or_default();
                target = folder.join(next);
            }
            // Not a link, or not there.
            Err(_) => return Ok(target),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}
