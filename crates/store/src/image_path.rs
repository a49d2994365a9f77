//! Paths of pictures, as scene files have them, and the files that they lead to.

use std::path::{Path, PathBuf};

use catoptric_platform::files;
use catoptric_scene::Image;

/// The file that a picture of a scene file in `folder` comes from; `None` if it comes with the program.
pub fn file_of_image(image: &Image, folder: Option<&Path>) -> Option<PathBuf> {
    (!image.is_built_in()).then(|| file_of(image.path(), folder))
}

/// What a path of a scene file in the folder `from` has to be in one in `to`, so that it leads to the same file;
/// `None` if it may stay as it is. Without a folder `from` it begins where the program was started; without `to`
/// it becomes a whole path, as it does when the file does not lie in `to`.
pub fn moved_path(path: &str, from: Option<&Path>, to: Option<&Path>) -> Option<String> {
    moved(path, from, to, path_from)
}

/// [`moved_path`], but a relative path stays relative wherever there is a way from `to`, up and
/// down: folders that are moved together find their files still.
pub fn moved_relative_path(path: &str, from: &Path, to: &Path) -> Option<String> {
    let name = |to: &Path, file: &Path| {
        let way = Path::new(path).is_relative().then(|| way(to, file)).flatten();
        way.unwrap_or_else(|| path_from(to, file))
    };
    moved(path, Some(from), Some(to), name)
}

fn moved(
    path: &str,
    from: Option<&Path>,
    to: Option<&Path>,
    name: impl Fn(&Path, &Path) -> String,
) -> Option<String> {
    if path.starts_with(Image::BUILT_IN) {
        return None;
    }
    let file = file_of(path, from);
    let moved = match to {
        // A way that both folders have in common, such as one up and down again, stays as it was written.
        Some(to) if Path::new(path).is_relative() && is_same_file(&file, &to.join(path)) => return None,
        Some(to) => name(to, &file),
        None => path_from(Path::new(""), &file),
    };
    (moved != path).then_some(moved)
}

/// How a scene file in `folder` names the picture in `file`: by the way from there, if it lies in the folder, else
/// by the whole path. An empty folder is none.
pub fn path_from(folder: &Path, file: &Path) -> String {
    let whole = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let (folder, file) = (whole(folder), whole(file));
    path_text(file.strip_prefix(&folder).unwrap_or(&file))
}

/// The file that a path of a scene leads to.
pub(crate) fn file_of(path: &str, folder: Option<&Path>) -> PathBuf {
    folder.map_or_else(|| PathBuf::from(path), |folder| folder.join(path))
}

/// A path as scene files have it, which are the same on all systems.
fn path_text(path: &Path) -> String {
    let text = path.to_string_lossy();
    if cfg!(windows) { text.replace('\\', "/") } else { text.into_owned() }
}

/// The way from a folder to a file, up and down; `None` if there is none, as between two drives.
fn way(folder: &Path, file: &Path) -> Option<String> {
    let by_name = |path: &Path| std::path::absolute(path).map(|whole| without_steps_up(&whole)).ok();
    let real = |path: &Path| files::canonical(path).ok();
    // What is not there yet cannot be asked.
    let is_unknown = !files::exists(file) || !files::exists(folder);
    let leads_there = |way: &PathBuf| is_unknown || is_same_file(file, &folder.join(way));
    // By the names that the user knows, unless a symbolic link on the way makes `..` lead elsewhere.
    let ways = [by_name(folder).zip(by_name(file)), real(folder).zip(real(file))];
    let ways = ways.into_iter().flatten().filter_map(|(folder, file)| pathdiff::diff_paths(file, folder));
    ways.filter(|way| way.is_relative()).find(leads_there).map(|way| path_text(&way))
}

/// An absolute path without `..`, by names alone: each takes the name before it away.
fn without_steps_up(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            std::path::Component::ParentDir => _ = plain.pop(),
            part => plain.push(part),
        }
    }
    plain
}

fn is_same_file(one: &Path, other: &Path) -> bool {
    let canonical = |path: &Path| files::canonical(path).ok();
    one == other || canonical(one).is_some_and(|one| canonical(other) == Some(one))
}
