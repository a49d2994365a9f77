//! The formats of other programs.

use std::path::Path;

/// A format of another program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ForeignFormat {
    /// The scenes of *miniRT*, an exercise of the school 42: `.rt`.
    MiniRt,
    /// The scenes of *The Ray Tracer Challenge* (Buck 2019): `.yml`, `.yaml`.
    Challenge,
    /// Haines's Neutral File Format (1987): `.nff`.
    Nff,
}

impl ForeignFormat {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::MiniRt, Self::Challenge, Self::Nff];

    /// The extensions of its files, the usual one first.
    pub const fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::MiniRt => &["rt"],
            Self::Challenge => &["yml", "yaml"],
            Self::Nff => &["nff"],
        }
    }

    /// What the format is called.
    pub const fn name(self) -> &'static str {
        match self {
            Self::MiniRt => "miniRT",
            Self::Challenge => "The Ray Tracer Challenge",
            Self::Nff => "NFF",
        }
    }

    /// The format whose files have this extension, in small or capital letters.
    ///
    /// ```
    /// use catoptric_exchange::ForeignFormat;
    /// assert_eq!(ForeignFormat::of_extension("YML"), Some(ForeignFormat::Challenge));
    /// ```
    pub fn of_extension(extension: &str) -> Option<Self> {
        let has = |format: &Self| format.extensions().iter().any(|own| own.eq_ignore_ascii_case(extension));
        Self::ALL.into_iter().find(has)
    }

    /// The format that the extension of a path names.
    pub fn of_path(path: &Path) -> Option<Self> {
        Self::of_extension(path.extension()?.to_str()?)
    }
}
