//! Whether two builds of the program draw the same pictures, for changes that must keep them.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context as _, Result, ensure};
use catoptric_picture::Picture;
use catoptric_tracer::raster::MethodKind;
use clap::Args;
use xtask::{root, shell};

/// Folders whose scenes are drawn. Fewer scenes than this mean that a folder was not found whole.
const FOLDERS: [&str; 3] = ["crates/scene/examples", "tests/reference", "tests/mitsuba"];
const LEAST_SCENES: usize = 50;

#[derive(Debug, Args)]
pub(crate) struct SameArguments {
    /// The program as it was
    old: PathBuf,
    /// The program as it is
    new: PathBuf,
    /// Scene files; without them all examples and the scenes of all reference pictures
    #[arg(value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// Methods; without them all
    #[arg(long, value_delimiter = ',', value_parser = parse_method)]
    methods: Vec<MethodKind>,
    /// Size of the pictures; it should be no multiple of a tile
    #[arg(long, default_value = "200x113")]
    size: String,
    /// Largest difference of a channel that is allowed, in linear light
    #[arg(long, default_value_t = 0.0)]
    allow: f32,
}

/// How far two pictures of one size are apart.
#[derive(Debug, PartialEq)]
struct Deviation {
    pixels: usize,
    largest: f32,
}

fn parse_method(name: &str) -> Result<MethodKind, String> {
    let known = MethodKind::ALL.into_iter().find(|kind| kind.name() == name);
    known.ok_or_else(|| format!("one of {}", MethodKind::ALL.map(MethodKind::name).join(", ")))
}

/// Draws every scene by every method with both programs and compares all bits: one sample, one thread.
pub(crate) fn run(arguments: &SameArguments) -> Result<()> {
    let scenes = if arguments.scenes.is_empty() { all_scenes()? } else { arguments.scenes.clone() };
    let methods =
        if arguments.methods.is_empty() { MethodKind::ALL.to_vec() } else { arguments.methods.clone() };
    let folder = root().join("target/same");
    std::fs::create_dir_all(&folder)?;
    let (mut pictures, mut faults) = (0, 0);
    for scene in &scenes {
        let name = scene.file_stem().unwrap_or_default().to_string_lossy();
        for method in &methods {
            let draw = |program: &Path, kind: &str| -> Result<Picture> {
                let file = folder.join(format!("{kind}.exr"));
                let mut command = Command::new(program);
                command.arg("render").arg(scene).args([
                    "--samples",
                    "1",
                    "--threads",
                    "1",
                    "--backend",
                    "cpu",
                ]);
                command.args(["--size", &arguments.size, "--method", method.name()]);
                shell::output(command.arg("-o").arg(&file))?;
                Ok(catoptric_picture::read(&file)?)
            };
            let pair = [draw(&arguments.old, "old")?, draw(&arguments.new, "new")?];
            pictures += 1;
            if let Some(found) = deviation(&pair[0], &pair[1]) {
                let allowed = found.largest <= arguments.allow;
                let note = if allowed { " (allowed)" } else { "" };
                println!("{name}, {method}: {} pixels, up to {:e}{note}", found.pixels, found.largest);
                faults += usize::from(!allowed);
            }
        }
    }
    ensure!(faults == 0, "{faults} of {pictures} pictures differ");
    println!("{pictures} pictures: the same, or within what is allowed");
    Ok(())
}

fn all_scenes() -> Result<Vec<PathBuf>> {
    let mut scenes = Vec::new();
    for folder in FOLDERS {
        for entry in root().join(folder).read_dir().context(folder)? {
            let path = entry?.path();
            if path.extension().is_some_and(|extension| extension == "toml") {
                scenes.push(path);
            }
        }
    }
    ensure!(scenes.len() >= LEAST_SCENES, "only {} scenes were found", scenes.len());
    scenes.sort();
    Ok(scenes)
}

/// What differs, by bits; nothing if all is equal. Pictures of two sizes differ without bound.
fn deviation(old: &Picture, new: &Picture) -> Option<Deviation> {
    if (old.width(), old.height()) != (new.width(), new.height()) {
        return Some(Deviation { pixels: old.pixels().len(), largest: f32::INFINITY });
    }
    let mut found = Deviation { pixels: 0, largest: 0.0 };
    for (old, new) in old.pixels().iter().zip(new.pixels()) {
        if old.map(f32::to_bits) != new.map(f32::to_bits) {
            found.pixels += 1;
            for (old, new) in old.iter().zip(new) {
                let apart = (old - new).abs();
                // What is not a number is as far off as can be.
                found.largest = found.largest.max(if apart.is_nan() { f32::INFINITY } else { apart });
            }
        }
    }
    (found.pixels > 0).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_bit_counts() {
        let picture = |value: f32| Picture::from_pixels(2, 1, vec![[0.5; 3], [0.5, value, 0.5]]).unwrap();
        assert_eq!(deviation(&picture(0.25), &picture(0.25)), None);
        let close = deviation(&picture(0.25), &picture(0.25_f32.next_up())).unwrap();
        assert_eq!(close, Deviation { pixels: 1, largest: 0.25_f32.next_up() - 0.25 });
        assert_eq!(deviation(&picture(0.0), &picture(-0.0)), Some(Deviation { pixels: 1, largest: 0.0 }));
        let small = Picture::from_pixels(1, 1, vec![[0.5; 3]]).unwrap();
        assert!(deviation(&small, &picture(0.5)).unwrap().largest.is_infinite());
    }

    #[test]
    fn all_folders_have_their_scenes() {
        assert!(all_scenes().unwrap().len() >= LEAST_SCENES);
    }
}
