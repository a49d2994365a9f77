//! Files to write: which kind by their extension, never over what the same command uses.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context as _, Result, bail};
use catoptric_picture::{BitDepth, Development, Picture, ToneCurve, write_exr, write_png};

use crate::arguments::DevelopmentArguments;
use crate::interrupt;

/// What a file holds, by its extension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Picture(PictureKind),
    Scene,
}

/// A kind of picture file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PictureKind {
    Png,
    Exr,
}

impl Kind {
    /// The kind of the file at `path`, if its extension is known.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "png" => Some(Self::Picture(PictureKind::Png)),
            "exr" => Some(Self::Picture(PictureKind::Exr)),
            "toml" => Some(Self::Scene),
            _ => None,
        }
    }

    /// The kind of picture to write to `path`.
    pub(crate) fn of_picture(path: &Path) -> Result<PictureKind> {
        match Self::of(path) {
            Some(Self::Picture(kind)) => Ok(kind),
            _ => bail!(
                "cannot tell the picture format of {}: give a name that ends in .png or .exr",
                path.display()
            ),
        }
    }
}

impl DevelopmentArguments {
    /// Nothing asked for.
    pub(crate) fn plain() -> Self {
        Self { exposure: 0.0, tone_curve: ToneCurve::None, bits: "8".to_owned() }
    }

    pub(crate) fn development(&self) -> Development {
        Development { exposure_stops: self.exposure, tone_curve: self.tone_curve }
    }

    pub(crate) fn depth(&self) -> BitDepth {
        if self.bits == "16" { BitDepth::Sixteen } else { BitDepth::Eight }
    }
}

/// Asks, before the work begins, whether the file at `path` can be written, and that it is none of `others`, which the
/// same command reads or writes.
pub(crate) fn check_output(path: &Path, others: &[&Path]) -> Result<()> {
    if let Some(other) = others.iter().find(|other| place(other) == place(path)) {
        bail!(
            "cannot write {}: the same command uses this file as {}; give another name",
            path.display(),
            other.display()
        );
    }
    Ok(interrupt::undisturbed(|| catoptric_files::check_writable(path))?)
}

/// Where `path` leads, whether or not something is there yet.
fn place(path: &Path) -> PathBuf {
    if let Ok(place) = fs::canonicalize(path) {
        return place;
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match (fs::canonicalize(folder), path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path.to_owned(),
    }
}

/// Whether standard output is meant, not a file.
pub(crate) fn is_stdout(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Makes a directory for several files, unless it is there, and asks before the work begins whether they can be written.
pub(crate) fn prepare_directory(path: &Path, first: &str) -> Result<()> {
    fs::create_dir_all(path).with_context(|| format!("cannot make the directory {}", path.display()))?;
    check_output(&path.join(first), &[])
}

/// Writes a file, whole or not at all.
pub(crate) fn write_file(path: &Path, bytes: &[u8]) -> Result<()> {
    Ok(interrupt::while_writing(path, || catoptric_files::write_bytes(path, bytes))?)
}

/// Writes a text file, whole or not at all.
pub(crate) fn write_text(path: &Path, text: &str) -> Result<()> {
    write_file(path, text.as_bytes())
}

/// Writes a picture, whole or not at all; returns the milliseconds spent on developing and on writing it.
pub(crate) fn write_picture(
    path: &Path,
    kind: PictureKind,
    picture: &Picture,
    arguments: &DevelopmentArguments,
) -> Result<(f64, f64)> {
    let start = Instant::now();
    match kind {
        PictureKind::Png => {
            let developed = arguments.development().develop(picture, arguments.depth())?;
            let develop = milliseconds(start);
            let start = Instant::now();
            interrupt::while_writing(path, || write_png(path, &developed))?;
            Ok((develop, milliseconds(start)))
        }
        PictureKind::Exr => {
            interrupt::while_writing(path, || write_exr(path, picture))?;
            Ok((0.0, milliseconds(start)))
        }
    }
}

/// Milliseconds since `start`.
pub(crate) fn milliseconds(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}
