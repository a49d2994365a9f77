//! The content of a folder, read by a thread, since a disk may be far away.

use std::cmp::Ordering;
use std::io;
use std::path::{Path, PathBuf};

use catoptric_platform::files;
use catoptric_platform::time::SystemTime;

use crate::shell::host::FileKind;
use crate::shell::studio::file_prompt::fits;

/// At most so many entries of a folder are listed.
const MOST: usize = 10_000;

/// A file or folder in a listing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct FolderItem {
    pub(super) name: String,
    /// The name in lower case, to be sorted and searched by.
    pub(super) lowercase: String,
    pub(super) is_folder: bool,
    pub(super) bytes: u64,
    pub(super) modified: Option<SystemTime>,
    /// Whether it is a folder or of the kind that is asked for.
    pub(super) fits: bool,
}

/// The content of a folder.
#[derive(Debug)]
pub(super) struct FolderListing {
    pub(super) folder: PathBuf,
    /// Folders first, by name.
    pub(super) entries: Result<Vec<FolderItem>, io::ErrorKind>,
}

/// Reads a folder. Hidden entries are left out.
pub(super) fn list(folder: PathBuf, kind: FileKind) -> FolderListing {
    let entries = files::list(&folder).map_err(|error| error.kind()).map(|paths| {
        let mut entries: Vec<FolderItem> = paths.filter_map(|path| look(&path, kind)).take(MOST).collect();
        entries.sort_by(compare);
        entries
    });
    FolderListing { folder, entries }
}

fn look(path: &Path, kind: FileKind) -> Option<FolderItem> {
    let name = path.file_name()?.to_str()?.to_owned();
    if name.starts_with('.') {
        return None;
    }
    let status = files::status(path).ok()?;
    let is_folder = status.is_folder;
    Some(FolderItem {
        is_folder,
        bytes: status.length,
        modified: status.modified,
        fits: is_folder || fits(path, kind),
        lowercase: name.to_lowercase(),
        name,
    })
}

fn compare(one: &FolderItem, other: &FolderItem) -> Ordering {
    let by_name = || one.lowercase.cmp(&other.lowercase);
    other.is_folder.cmp(&one.is_folder).then_with(by_name).then_with(|| one.name.cmp(&other.name))
}

/// The folder and the name that a typed text means, when it means another folder than the present one: it has a
/// separator, or begins with `~`.
pub(super) fn split(folder: &Path, home: Option<&Path>, typed: &str) -> Option<(PathBuf, String)> {
    let is_separator = |c: char| std::path::is_separator(c);
    let (before, name) = match typed.rfind(is_separator) {
        Some(at) => (typed.get(..=at)?, typed.get(at + 1..)?),
        None => return None,
    };
    let expanded = match (before.strip_prefix('~'), home) {
        (Some(rest), Some(home)) if rest.starts_with(is_separator) => {
            home.join(rest.trim_start_matches(is_separator))
        }
        _ => PathBuf::from(before),
    };
    Some((plain(&folder.join(expanded)), name.to_owned()))
}

/// The path without `.` and `..`, as a person reads it.
fn plain(path: &Path) -> PathBuf {
    use std::path::Component;
    let mut plain = PathBuf::new();
    for component in path.components() {
        match component {
            Component::CurDir => {}
            Component::ParentDir => {
                plain.pop();
            }
            other => plain.push(other),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn folders_come_first_and_hidden_files_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["b.toml", "A.toml", "c.png", ".hidden.toml"] {
            fs::write(folder.path().join(name), "x").unwrap();
        }
        for name in ["z", "Y"] {
            fs::create_dir(folder.path().join(name)).unwrap();
        }
        let entries = list(folder.path().to_owned(), FileKind::Scene).entries.unwrap();
        let names: Vec<&str> = entries.iter().map(|entry| entry.name.as_str()).collect();
        assert_eq!(names, ["Y", "z", "A.toml", "b.toml", "c.png"]);
        let fitting: Vec<bool> = entries.iter().map(|entry| entry.fits).collect();
        assert_eq!(fitting, [true, true, true, true, false]);
        let missing = list(folder.path().join("none"), FileKind::Scene);
        assert_eq!(missing.entries, Err(io::ErrorKind::NotFound));
    }

    #[cfg(unix)]
    #[test]
    fn a_typed_path_leads_to_its_folder() {
        let split = |typed| split(Path::new("/a/b"), Some(Path::new("/home/me")), typed);
        let some = |folder: &str, name: &str| Some((PathBuf::from(folder), name.to_owned()));
        assert_eq!(split("c.toml"), None);
        assert_eq!(split("~"), None);
        assert_eq!(split("c/"), some("/a/b/c", ""));
        assert_eq!(split("../x.toml"), some("/a", "x.toml"));
        assert_eq!(split("/"), some("/", ""));
        assert_eq!(split("/tmp/x"), some("/tmp", "x"));
        assert_eq!(split("~/scenes/y"), some("/home/me/scenes", "y"));
    }
}
