//! The kinds of files that can be written.

use std::path::Path;

use catoptric_exchange::ForeignFormat;
use catoptric_picture::PictureFormat;

/// The kind of an output file, known by its extension.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OutputKind {
    Picture(PictureFormat),
    Scene,
    /// A scene of another ray tracer.
    ForeignScene(ForeignFormat),
}

impl OutputKind {
    /// The kind that an extension or `--format` names.
    pub(crate) fn named(name: &str) -> Option<Self> {
        if name.eq_ignore_ascii_case("toml") {
            return Some(Self::Scene);
        }
        let foreign = || ForeignFormat::of_extension(name).map(Self::ForeignScene);
        PictureFormat::of_extension(name).map(Self::Picture).or_else(foreign)
    }

    /// The kind of the file at `path`, if its extension is known.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        Self::named(path.extension()?.to_str()?)
    }
}

/// The formats of pictures that can be written, as `--format` names them.
pub(crate) fn format_names() -> String {
    PictureFormat::all_extensions(true).collect::<Vec<_>>().join(", ")
}
