//! The identity of files: whether two paths lead to the same one, however they are written.

use std::ffi::OsString;
use std::fs;
use std::path::Path;

use super::descriptor::Descriptor;
use super::target::{OutputTarget, directory_of};

/// The identity of a file: equal for all its names, links and descriptors.
///
/// On Unix an existing file is known by its device and number, so that hard links are seen too; elsewhere by its
/// canonical path. A file that is not there yet is known by its directory and name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileId(Id);

#[derive(Clone, Debug, PartialEq, Eq)]
enum Id {
    #[cfg(unix)]
    Node {
        device: u64,
        number: u64,
    },
    #[cfg(not(unix))]
    Path(std::path::PathBuf),
    Missing {
        directory: Box<Id>,
        name: OsString,
    },
}

impl FileId {
    /// The plain file that is read at `path`, `-` being standard input; `None` for pipes and devices, which nothing
    /// that is written can destroy, and for what is not there.
    pub fn of_input(path: &Path) -> Option<Self> {
        let metadata = if crate::files::is_dash(path) {
            Descriptor::STDIN.duplicate().and_then(|file| file.metadata()).ok()?
        } else {
            fs::metadata(path).ok()?
        };
        if metadata.is_file() { Self::of_metadata(&metadata, path) } else { None }
    }

    /// The file or pipe that is written at `path`, `-` being standard output; `None` for devices, such as terminals and
    /// `/dev/null`, which take anything from anyone, and for what cannot be written.
    pub fn of_output(path: &Path) -> Option<Self> {
        match OutputTarget::of(path).ok()? {
            OutputTarget::Descriptor(descriptor) => {
                let metadata = descriptor.duplicate().and_then(|file| file.metadata()).ok()?;
                if is_device(&metadata) { None } else { Self::of_metadata(&metadata, path) }
            }
            OutputTarget::Stream { path } => {
                let metadata = fs::metadata(&path).ok()?;
                if is_device(&metadata) { None } else { Self::of_metadata(&metadata, &path) }
            }
            OutputTarget::File { path, .. } => match fs::metadata(&path) {
                Ok(metadata) => Self::of_metadata(&metadata, &path),
                Err(_) => Self::missing(&path),
            },
        }
    }

    /// What is known by these metadata of `path`.
    pub(super) fn of_metadata(metadata: &fs::Metadata, path: &Path) -> Option<Self> {
        id_of(metadata, path).map(Self)
    }

    fn missing(path: &Path) -> Option<Self> {
        let directory = directory_of(path);
        let directory = Box::new(id_of(&fs::metadata(directory).ok()?, directory)?);
        let name = path.file_name()?.to_owned();
        // Where case does not tell files apart, it must not tell these apart; otherwise two names are two files.
        let folds_case = cfg!(any(windows, target_os = "macos"));
        let name = if folds_case { name.to_string_lossy().to_lowercase().into() } else { name };
        Some(Self(Id::Missing { directory, name }))
    }
}

#[cfg(unix)]
fn id_of(metadata: &fs::Metadata, _path: &Path) -> Option<Id> {
    use std::os::unix::fs::MetadataExt as _;
    Some(Id::Node { device: metadata.dev(), number: metadata.ino() })
}

#[cfg(not(unix))]
fn id_of(_metadata: &fs::Metadata, path: &Path) -> Option<Id> {
    fs::canonicalize(path).ok().map(Id::Path)
}

#[cfg(unix)]
fn is_device(metadata: &fs::Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt as _;
    let kind = metadata.file_type();
    kind.is_char_device() || kind.is_block_device()
}

#[cfg(not(unix))]
fn is_device(metadata: &fs::Metadata) -> bool {
    !metadata.is_file()
}
