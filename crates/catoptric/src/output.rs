//! Standard output, colors, and files by extension.

use std::io::{self, IsTerminal, Write};
use std::path::Path;

use anyhow::{Result, bail};
use catoptric_picture::{BitDepth, Development, Picture, write_exr, write_png};

use crate::arguments::DevelopmentArguments;

/// Prints to standard output. A reader that has gone away, such as `head`, is no error.
pub(crate) fn print(text: &str) -> Result<()> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(error.into()),
        _ => Ok(()),
    }
}

/// Whether a stream should get colors: it is a terminal, and the user does not ask otherwise (<https://no-color.org>).
pub(crate) fn color_on(stream: &impl IsTerminal) -> bool {
    stream.is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// What a file holds, by its extension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Png,
    Exr,
    Scene,
}

impl Kind {
    /// The kind of the file at `path`, if its extension is known.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "png" => Some(Self::Png),
            "exr" => Some(Self::Exr),
            "toml" => Some(Self::Scene),
            _ => None,
        }
    }

    /// The kind of picture to write to `path`.
    pub(crate) fn of_picture(path: &Path) -> Result<PictureKind> {
        match Self::of(path) {
            Some(Self::Png) => Ok(PictureKind::Png),
            Some(Self::Exr) => Ok(PictureKind::Exr),
            _ => bail!(
                "cannot tell the picture format of {}: give a name that ends in .png or .exr",
                path.display()
            ),
        }
    }
}

/// A kind of picture file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PictureKind {
    Png,
    Exr,
}

impl DevelopmentArguments {
    pub(crate) fn development(&self) -> Development {
        Development { exposure_stops: self.exposure, tone_curve: self.tone_curve }
    }

    pub(crate) fn depth(&self) -> BitDepth {
        if self.bits == "16" { BitDepth::Sixteen } else { BitDepth::Eight }
    }
}

/// Writes a picture; returns the milliseconds spent on developing and on writing it.
pub(crate) fn write_picture(
    path: &Path,
    kind: PictureKind,
    picture: &Picture,
    arguments: &DevelopmentArguments,
) -> Result<(f64, f64)> {
    let start = std::time::Instant::now();
    let milliseconds = |start: std::time::Instant| start.elapsed().as_secs_f64() * 1e3;
    match kind {
        PictureKind::Png => {
            let developed = arguments.development().develop(picture, arguments.depth())?;
            let develop = milliseconds(start);
            let start = std::time::Instant::now();
            write_png(path, &developed)?;
            Ok((develop, milliseconds(start)))
        }
        PictureKind::Exr => {
            write_exr(path, picture)?;
            Ok((0.0, milliseconds(start)))
        }
    }
}
