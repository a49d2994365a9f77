//! Pictures of all built-in scenes, and the README's picture of some of them.

use std::path::Path;

use anyhow::{Context as _, Result};
use catoptric_picture::{BitDepth, Codes, Development, Picture};
use catoptric_platform::files::write_bytes;
use catoptric_scene::Example;
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};
use clap::Args;
use jpeg_encoder::{ColorType, Encoder, SamplingFactor};
use xtask::root;

use crate::sheet::Sheet;

#[derive(Debug, Args)]
pub(crate) struct GalleryArguments {
    /// Only these scenes, without the README's picture
    scenes: Vec<String>,
    /// Samples per pixel
    #[arg(long, default_value_t = 64)]
    samples: u32,
}

/// Size of each picture.
const SIZE: (u32, u32) = (960, 540);
/// Scenes across in the README's picture, and how many times smaller they are there.
const COLUMNS: u32 = 5;
const REDUCED: u32 = 4;

pub(crate) fn run(arguments: &GalleryArguments) -> Result<()> {
    let folder = root().join("docs/gallery");
    std::fs::create_dir_all(&folder).context("docs/gallery")?;
    let wanted = |example: &&Example| {
        arguments.scenes.is_empty() || arguments.scenes.iter().any(|name| name == example.name)
    };
    let mut sheet = Sheet::new(SIZE, REDUCED, COLUMNS);
    for example in Example::ALL.iter().filter(wanted) {
        println!("{}", example.name);
        let picture = picture(example, SIZE, arguments.samples)?;
        write_jpeg(&folder.join(format!("{}.jpg", example.name)), &picture)?;
        sheet.add(&picture);
    }
    if arguments.scenes.is_empty() {
        write_jpeg(&root().join("docs/gallery.jpg"), &sheet.picture()?)?;
    }
    Ok(())
}

/// The picture of a built-in scene, `size` pixels across and down.
pub(crate) fn picture(example: &Example, size: (u32, u32), samples: u32) -> Result<Picture> {
    let render_scene = RenderScene::build(&example.load()?.scene)?;
    let settings = RenderSettings { width: size.0, height: size.1, samples };
    Ok(render(&render_scene, settings, &RenderControl::default())?.picture)
}

/// Pictures in documents are JPEG: a repository should stay small.
pub(crate) fn write_jpeg(path: &Path, picture: &Picture) -> Result<()> {
    Ok(write_bytes(path, &jpeg(picture, 82)?)?)
}

/// A picture as a JPEG of a quality from 1 to 100.
pub(crate) fn jpeg(picture: &Picture, quality: u8) -> Result<Vec<u8>> {
    let developed = Development::default().develop(picture, BitDepth::Eight)?;
    let mut bytes = Vec::new();
    if let Codes::Eight(codes) = developed.codes() {
        let mut encoder = Encoder::new(&mut bytes, quality);
        encoder.set_sampling_factor(SamplingFactor::F_1_1);
        encoder.set_optimized_huffman_tables(true);
        encoder.encode(codes, picture.width() as u16, picture.height() as u16, ColorType::Rgb)?;
    }
    Ok(bytes)
}
