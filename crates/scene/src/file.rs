//! Scene files on disk.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use catoptric_files::{WriteError, write_bytes};

use crate::Scene;
use crate::format::{Diagnostics, LONGEST_TEXT, Reading, read_bytes};

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

/// Reads a scene file, and the pictures that it names.
pub fn load(path: impl AsRef<Path>) -> Result<Loaded, LoadError> {
    let path = path.as_ref();
    let (reading, text) = load_partly(path)?;
    match reading.into_result() {
        Ok(warned) => Ok(Loaded { scene: warned.value, text, warnings: warned.warnings }),
        Err(diagnostics) => Err(LoadError::Diagnostics { path: path.to_owned(), text, diagnostics }),
    }
}

/// Reads a scene file, and the pictures that it names, as far as it can be understood, whatever is wrong in it. With the reading comes the text that its
/// places refer to.
///
/// # Errors
/// When the file cannot be read at all.
pub fn load_partly(path: impl AsRef<Path>) -> Result<(Reading, String), LoadError> {
    let path = path.as_ref();
    let (mut reading, text) = read_bytes(read_file(path)?);
    reading.open_images(path.parent(), &text);
    Ok((reading, text))
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

/// Writes `text` to the file at `path`, whole or not at all: a crash leaves the old file or the new one, never half of
/// one. Symbolic links are followed, and a file that is replaced hands on its permissions.
///
/// # Errors
/// What stands in the way; the old file is untouched then.
pub fn save(path: impl AsRef<Path>, text: &str) -> Result<(), WriteError> {
    write_bytes(path.as_ref(), text.as_bytes())
}
