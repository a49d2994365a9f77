#![doc = include_str!("../README.md")]

mod camera;
mod challenge;
mod dialect;
mod draft;
mod format;
mod lines;
mod message;
mod minirt;
mod nff;
mod options;
mod phrase;
mod scene_text;
mod triangle;

use std::path::Path;

use catoptric_scene::{Diagnostics, LoadedScene, Scene, decode};
use catoptric_store::{LoadError, read_file};

pub use dialect::{Dialect, UnknownDialect};
pub use format::ForeignFormat;
pub use options::{DEFAULT_SIZE, ImportOptions, ImportedScene, LONGEST_FILE};
pub use scene_text::{ExportError, ExportOptions, ExportedScene};

/// Reads a scene from the text of a file.
///
/// # Errors
/// All errors of the text, with their places; also approximately, where no body would be left.
pub fn read(
    format: ForeignFormat,
    text: &str,
    options: &ImportOptions,
) -> Result<ImportedScene, Diagnostics> {
    if text.len() > LONGEST_FILE {
        return Err(draft::too_long());
    }
    let found = read_as(format, text, options)?;
    if options.is_approximate && found.scene.bodies.is_empty() {
        read_as(format, text, &ImportOptions { is_approximate: false, ..*options })?;
    }
    Ok(found)
}

fn read_as(format: ForeignFormat, text: &str, options: &ImportOptions) -> Result<ImportedScene, Diagnostics> {
    match format {
        ForeignFormat::MiniRt => minirt::read(text, options),
        ForeignFormat::Challenge => challenge::read(text, options),
        ForeignFormat::Nff => nff::read(text, options),
    }
}

/// Reads the scene file at `path`. With the scene, its text and its report comes the size of the picture that the file
/// asks for.
///
/// # Errors
/// When the file cannot be read, or its text has errors.
pub fn load(
    path: &Path,
    format: ForeignFormat,
    options: &ImportOptions,
) -> Result<(LoadedScene, Option<[u32; 2]>), LoadError> {
    let failed = |(diagnostics, text)| LoadError::Diagnostics { path: path.to_owned(), text, diagnostics };
    let text = decode(read_file(path, LONGEST_FILE)?).map_err(failed)?;
    match read(format, &text, options) {
        Ok(ImportedScene { scene, report, size }) => {
            Ok((LoadedScene { scene, text, warnings: report }, size))
        }
        Err(diagnostics) => Err(failed((diagnostics, text))),
    }
}

/// The text of a scene in another program's format.
///
/// # Errors
/// All that the format cannot say, unless the options allow to leave it out.
pub fn write(
    format: ForeignFormat,
    scene: &Scene,
    options: &ExportOptions,
) -> Result<ExportedScene, ExportError> {
    let written = match format {
        ForeignFormat::MiniRt => minirt::write(scene, options),
        ForeignFormat::Challenge => challenge::write(scene, options),
        ForeignFormat::Nff => nff::write(scene, options),
    };
    written.finish(options)
}
