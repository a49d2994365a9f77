//! Finding scenes by path or by name.

use std::path::Path;

use anyhow::{Context as _, Result, anyhow, bail};
use catoptric_exchange::{ForeignFormat, ImportOptions};
use catoptric_scene::{
    Diagnostic, Example, ImageFault, Language, LoadedScene, Scene, SceneEdit, Severity, visible,
};
use catoptric_store::{Folder, file_of_image, load};

use crate::arguments::{ImportArguments, SetArguments, Size};
use crate::console::{color_on, say, say_colored};
use crate::files::CommandFiles;

/// A scene as the user named it.
pub(crate) struct NamedScene {
    /// For messages: the path, or the example's name.
    pub name: String,
    pub loaded: LoadedScene,
    /// What its file says of its picture, if it is a scene of another ray tracer.
    pub foreign: Option<ForeignPicture>,
}

/// The picture that a scene of another ray tracer asks for. Its codes are in proportion to its light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct ForeignPicture {
    /// Width and height, pixels.
    pub size: Option<[u32; 2]>,
}

impl NamedScene {
    /// Shows the warnings about it on standard error, and of its notes a line each.
    pub(crate) fn warn(&self) {
        let LoadedScene { text, warnings, .. } = &self.loaded;
        let is_note = |finding: &&Diagnostic| finding.severity == Severity::Note;
        if warnings.iter().any(|finding| !is_note(&finding)) {
            say_colored(&warnings.render(&self.name, text, color_on(&std::io::stderr())));
            return;
        }
        for note in warnings.iter().filter(is_note) {
            say(&format!("{}:{}", visible(&self.name), note.line_of_text(Language::English)));
        }
    }
}

/// The source of a scene: a file, standard input or a built-in example.
pub(crate) enum SceneSource<'a> {
    /// A built-in scene.
    Example(&'static Example),
    /// A file.
    File(&'a Path),
}

/// The scene file at `path`, or the built-in scene of that name.
///
/// A file wins over a built-in scene, so that nothing of the user's is hidden; a folder cannot be a scene.
pub(crate) fn source(path: &Path) -> Result<SceneSource<'_>> {
    match path.to_str().and_then(Example::find) {
        Some(example) if !path.exists() || path.is_dir() => Ok(SceneSource::Example(example)),
        None if !path.exists() && !looks_like_path(path) => Err(no_such_scene(&path.to_string_lossy())),
        // When there is nothing, the error of reading it says so.
        _ => Ok(SceneSource::File(path)),
    }
}

/// Loads the scene file at `path`, `-` being standard input, or the built-in scene of that name, and sets values of it.
/// The file and its pictures are added to what the command reads. A scene of another ray tracer is read for a picture
/// of this size, or the one that it asks for.
pub(crate) fn scene(
    path: &Path,
    set: &SetArguments,
    size: Option<Size>,
    files: &mut CommandFiles,
) -> Result<NamedScene> {
    let mut scene = match source(path)? {
        SceneSource::Example(example) => {
            NamedScene { name: example.name.to_owned(), loaded: example.load()?, foreign: None }
        }
        SceneSource::File(path) => file(path, set.import, size, files)?,
    };
    if !set.edits.is_empty() {
        edit(&mut scene.loaded.scene, &set.edits, files)?;
    }
    Ok(scene)
}

/// Sets values of a scene. The paths of new pictures begin in the current directory.
fn edit(scene: &mut Scene, edits: &[SceneEdit], files: &mut CommandFiles) -> Result<()> {
    scene.edit(edits).map_err(|error| {
        let option = format!("--set {}", error.path());
        anyhow!(error).context(option)
    })?;
    for image in scene.images().filter(|image| image.pixels().is_none()) {
        if let Some(file) = file_of_image(image, None) {
            files.add_input(&file)?;
        }
    }
    let Err(errors) = scene.open_images(&Folder::current()) else { return Ok(()) };
    let Some(error) = errors.into_iter().next() else { return Ok(()) };
    if let ImageFault::Missing(file) = &error.fault {
        bail!("--set: there is no picture {file}; the path begins in the current directory");
    }
    Err(error).context("--set")
}

/// Refuses a file that cannot be read at all, as loading it would.
#[cfg(feature = "studio")]
pub(crate) fn check_readable(path: &Path) -> Result<()> {
    if path.is_dir() || std::fs::File::open(path).is_err() {
        load(path)?;
    }
    Ok(())
}

/// Loads the scene file at `path` as it is; see [`scene`].
pub(crate) fn file(
    path: &Path,
    import: ImportArguments,
    size: Option<Size>,
    files: &mut CommandFiles,
) -> Result<NamedScene> {
    files.add_input(path)?;
    let (loaded, foreign) = match ForeignFormat::of_path(path) {
        Some(format) => {
            let ImportArguments { dialect, approximate } = import;
            let options = ImportOptions { dialect, is_approximate: approximate, size: size.map(Into::into) };
            let (loaded, size) = catoptric_exchange::load(path, format, &options)?;
            (loaded, Some(ForeignPicture { size }))
        }
        None => (load(path)?, None),
    };
    files.add_pictures(&loaded.scene, path)?;
    Ok(NamedScene { name: path.display().to_string(), loaded, foreign })
}

/// The error that there is no built-in scene of this name.
pub(crate) fn no_such_example(name: &str) -> anyhow::Error {
    missing(&format!("there is no built-in scene \"{name}\""), name)
}

fn no_such_scene(name: &str) -> anyhow::Error {
    missing(&format!("there is no file and no built-in scene \"{name}\""), name)
}

fn missing(what: &str, name: &str) -> anyhow::Error {
    match Example::nearest(name) {
        Some(near) => anyhow!("{what}; did you mean \"{}\"?", near.name),
        None => anyhow!("{what}; `catoptric examples` lists the scenes"),
    }
}

fn looks_like_path(path: &Path) -> bool {
    path.extension().is_some() || path.components().count() > 1 || is_stdin(path)
}

/// Whether standard input is meant, not a file.
fn is_stdin(path: &Path) -> bool {
    path.as_os_str() == "-"
}
