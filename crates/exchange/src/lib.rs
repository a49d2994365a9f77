#![doc = include_str!("../README.md")]

mod camera;
mod challenge;
mod draft;
mod format;
mod lines;
mod message;
mod minirt;
mod nff;
mod placement;
mod scene_text;

use std::path::Path;

use catoptric_scene::{Diagnostics, LoadError, LoadedScene, Scene, decode, read_file};

pub use format::ForeignFormat;
pub use minirt::{Dialect, UnknownDialect};
pub use scene_text::{ExportError, ExportOptions, ExportedScene};

/// The longest file that is read, bytes: 16 MiB.
pub const LONGEST_FILE: usize = 16 << 20;

/// The size of a picture that neither the file nor the options give, pixels.
pub const DEFAULT_SIZE: [u32; 2] = [1280, 720];

/// How a scene of another program is read.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ImportOptions {
    /// What miniRT programs do differently. Default what the school's subject says.
    pub dialect: Dialect,
    /// Whether what a scene cannot say is replaced by what comes nearest, or left out, with a warning for each.
    /// Default false: it is an error.
    pub is_approximate: bool,
    /// Width and height of the picture, pixels, instead of those of the file: a horizontal angle of view depends on
    /// them.
    pub size: Option<[u32; 2]>,
}

/// A scene that was read from a file of another program.
#[derive(Clone, Debug)]
pub struct ImportedScene {
    /// The scene.
    pub scene: Scene,
    /// What was interpreted (notes), and what could not be taken over exactly (warnings).
    pub report: Diagnostics,
    /// The size of the picture that the file or the options ask for, pixels.
    pub size: Option<[u32; 2]>,
}

/// Reads a scene from the text of a file.
///
/// # Errors
/// All errors of the text, with their places.
pub fn read(
    format: ForeignFormat,
    text: &str,
    options: &ImportOptions,
) -> Result<ImportedScene, Diagnostics> {
    if text.len() > LONGEST_FILE {
        return Err(draft::too_long());
    }
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
