//! Files to write: which kind they are.

use std::path::Path;
use std::time::Instant;

use anyhow::{Result, bail};
use catoptric_files::is_stream;
use catoptric_picture::{BitDepth, Development, ToneCurve};

use crate::arguments::DevelopmentArguments;

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
    /// The formats that can be written, as `--format` and extensions name them.
    pub(crate) const NAMES: &'static str = "png, exr or toml";

    /// The kind that an extension or `--format` names.
    pub(crate) fn named(name: &str) -> Option<Self> {
        match name.to_ascii_lowercase().as_str() {
            "png" => Some(Self::Picture(PictureKind::Png)),
            "exr" => Some(Self::Picture(PictureKind::Exr)),
            "toml" => Some(Self::Scene),
            _ => None,
        }
    }

    /// The kind of the file at `path`, if its extension is known.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        Self::named(path.extension()?.to_str()?)
    }
}

impl PictureKind {
    /// The formats that can be written.
    pub(crate) const NAMES: &'static str = "png or exr";

    /// The format that `--format` names.
    pub(crate) fn named(name: &str) -> Option<Self> {
        match Kind::named(name)? {
            Kind::Picture(kind) => Some(kind),
            Kind::Scene => None,
        }
    }

    /// The kind of picture to write to `path`: `format` if it is given, else what the extension says. PNG for a pipe, a
    /// device or a descriptor whose name says nothing.
    pub(crate) fn for_output(path: &Path, format: Option<Self>) -> Result<Self> {
        match (format, Kind::of(path)) {
            (Some(kind), _) | (None, Some(Kind::Picture(kind))) => Ok(kind),
            (None, None) if is_stream(path) => Ok(Self::Png),
            _ => bail!(
                "cannot tell the picture format of {}: give a name that ends in .png or .exr, or --format",
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

/// Milliseconds since `start`.
pub(crate) fn milliseconds(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}
