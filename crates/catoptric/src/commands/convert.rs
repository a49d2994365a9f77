//! `catoptric convert`

use std::path::Path;

use anyhow::{Result, bail};
use catoptric_exchange::{ExportError, ExportOptions, ForeignFormat};
use catoptric_picture::{PictureFormat, ReadOptions};
use catoptric_platform::files::{directory_of_file, is_stream};
use catoptric_scene::{HasImages as _, Language, Sentence, visible, write};
use catoptric_store::moved_relative_path;

use super::CommandOutcome;
use crate::arguments::ConvertArguments;
use crate::console::say;
use crate::files::CommandFiles;
use crate::input;
use crate::output_kind::OutputKind;

pub(crate) fn run(arguments: &ConvertArguments) -> Result<CommandOutcome> {
    let ConvertArguments { from, to, format, layer, quality, development, .. } = arguments;
    let mut files = CommandFiles::default();
    let is_scene = match OutputKind::of(from) {
        Some(OutputKind::Scene | OutputKind::ForeignScene(_)) => true,
        Some(OutputKind::Picture(_)) => false,
        // The name of a stream says nothing of what it brings.
        None => is_stream(from),
    };
    match (OutputKind::of(from), kind_to_write(from, to, *format)?) {
        (_, OutputKind::Scene) if is_scene => write_scene(arguments, None, &mut files)?,
        (_, OutputKind::ForeignScene(format)) if is_scene => {
            write_scene(arguments, Some(format), &mut files)?;
        }
        (Some(OutputKind::Scene | OutputKind::ForeignScene(_)), OutputKind::Picture(_)) => {
            bail!("{} is a scene: `catoptric render` makes a picture of it", from.display())
        }
        (_, OutputKind::Picture(format)) => {
            let options = development.save_options(format, *quality)?;
            files.add_picture_output(to)?;
            files.add_input(from)?;
            let picture = ReadOptions { layer: layer.clone(), ..ReadOptions::default() }.read(from)?;
            files.write_picture(to, &options, &picture)?;
        }
        (_, OutputKind::Scene | OutputKind::ForeignScene(_)) => bail!(
            "cannot make a scene of {}: only a file that ends in .toml, .rt, .yml or .nff is one; `catoptric \
             examples` writes the built-in scenes",
            from.display()
        ),
    }
    Ok(CommandOutcome::Done)
}

/// What to write: `format` if it is given, else what the extension of `to` says. The name of a stream may say nothing:
/// then a scene becomes a scene, and a picture a PNG.
fn kind_to_write(from: &Path, to: &Path, format: Option<OutputKind>) -> Result<OutputKind> {
    match (format, OutputKind::of(to)) {
        (Some(kind), _) | (None, Some(kind)) => Ok(kind),
        (None, None) if !is_stream(to) => bail!(
            "cannot tell the format of {}: give a name that ends in {}, .toml, .rt, .yml or .nff, or --format",
            to.display(),
            PictureFormat::extensions_in_words(true).replace(" or ", ", ")
        ),
        (None, None) => match OutputKind::of(from) {
            Some(OutputKind::Scene | OutputKind::ForeignScene(_)) => Ok(OutputKind::Scene),
            _ => Ok(OutputKind::Picture(PictureFormat::Png)),
        },
    }
}

/// Writes a scene in its standard form, or in another program's format.
fn write_scene(
    arguments: &ConvertArguments,
    format: Option<ForeignFormat>,
    files: &mut CommandFiles,
) -> Result<()> {
    let ConvertArguments { from, to, import, size, .. } = arguments;
    files.add_output(to)?;
    let input = input::file(from, *import, *size, files)?;
    input.warn();
    let mut scene = input.loaded.scene;
    if let Some(format) = format {
        let asked = input.foreign.and_then(|foreign| foreign.size);
        let options =
            ExportOptions { is_approximate: import.approximate, size: size.map(Into::into).or(asked) };
        let written = match catoptric_exchange::write(format, &scene, &options) {
            Ok(written) => written,
            Err(ExportError { lost }) => {
                tell("error", &lost);
                bail!(
                    "cannot write {}: the format cannot say this; --approximate leaves it out",
                    to.display()
                );
            }
        };
        tell("warning", &written.lost);
        return files.write(to, written.text.as_bytes());
    }
    let (old, new) = (folder_of(from), folder_of(to));
    scene.edit_images(&mut |image| {
        if let Some(path) = moved_relative_path(image.path(), old, new) {
            *image = image.with_path(path);
        }
    });
    files.write(to, write(&scene).as_bytes())
}

/// Says what a format cannot say, on a line each.
fn tell(severity: &str, lost: &[Sentence]) {
    for sentence in lost {
        say(&format!("{severity}: {}", visible(sentence.text(Language::English))));
    }
}

/// Where the paths of pictures begin: in a stream, where the program was started.
fn folder_of(scene: &Path) -> &Path {
    directory_of_file(scene).filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}
