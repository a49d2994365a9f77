//! Scene files on disk.

use std::io;
use std::path::{Path, PathBuf};

use catoptric_platform::files::{self, WriteError, directory_of_file, write_bytes};
use catoptric_scene::{Diagnostics, LONGEST_TEXT, LoadedScene, ParsedScene, read_bytes};

use crate::folder::Folder;

/// The reason why a scene file could not be read.
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
        /// The text of the file, for [`Diagnostics::render`].
        text: String,
        /// The errors, and warnings.
        diagnostics: Diagnostics,
    },
}

/// Reads a scene file, and the pictures that it names.
pub fn load(path: impl AsRef<Path>) -> Result<LoadedScene, LoadError> {
    let path = path.as_ref();
    let (reading, text) = load_partly(path)?;
    match reading.into_result() {
        Ok(warned) => Ok(LoadedScene { scene: warned.value, text, warnings: warned.warnings }),
        Err(diagnostics) => Err(LoadError::Diagnostics { path: path.to_owned(), text, diagnostics }),
    }
}

/// Reads a scene file, and the pictures that it names, as far as it can be understood, whatever is wrong in it. With
/// the reading comes the text that its places refer to.
///
/// The paths of pictures begin at the folder of the file; those of a scene from a stream (`-`, `/dev/stdin`, a pipe)
/// where the program was started.
///
/// # Errors
/// When the file cannot be read at all.
pub fn load_partly(path: impl AsRef<Path>) -> Result<(ParsedScene, String), LoadError> {
    let path = path.as_ref();
    let (mut reading, text) = read_bytes(read_file(path, LONGEST_TEXT)?);
    reading.open_images(&Folder::new(directory_of_file(path)), &text);
    Ok((reading, text))
}

/// The bytes of a file, `-` being standard input.
///
/// # Errors
/// When it cannot be read, or is longer than `longest` bytes.
pub fn read_file(path: &Path, longest: usize) -> Result<Vec<u8>, LoadError> {
    files::read_bytes(path, longest as u64).map_err(|error| {
        let reason = match error.kind() {
            io::ErrorKind::NotFound => "there is no such file; check its name".to_owned(),
            io::ErrorKind::PermissionDenied => {
                "this is not permitted; check the rights of the file".to_owned()
            }
            io::ErrorKind::IsADirectory => "it is a folder; name a scene file in it".to_owned(),
            io::ErrorKind::FileTooLarge => {
                format!("it is longer than {} MiB, the longest a scene can be", longest >> 20)
            }
            io::ErrorKind::OutOfMemory => {
                "there is not enough memory for it; close other programs".to_owned()
            }
            _ => error.to_string(),
        };
        // What was found out here is no error of the system.
        let source = error.raw_os_error().is_some().then_some(error);
        LoadError::Io { path: path.to_owned(), reason, source }
    })
}

/// Writes `text` to the file at `path`, whole or not at all: a crash leaves the old file or the new one, never half of
/// one. Symbolic links are followed, and a file that is replaced hands on its permissions.
///
/// # Errors
/// What stands in the way; the old file is untouched then.
pub fn save(path: impl AsRef<Path>, text: &str) -> Result<(), WriteError> {
    write_bytes(path.as_ref(), text.as_bytes())
}
