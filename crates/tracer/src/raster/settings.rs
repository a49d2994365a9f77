//! The settings of the methods: defaults, ranges, and what is out of range.

use std::ops::RangeInclusive;

/// A setting is out of its range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("the {name} is {value}; it must be from {least} to {most}")]
pub struct SettingError {
    /// Which one, in words.
    pub name: &'static str,
    /// What it is.
    pub value: f64,
    /// The least it may be.
    pub least: f64,
    /// The most it may be.
    pub most: f64,
}

fn check(name: &'static str, value: f64, range: RangeInclusive<f64>) -> Result<(), SettingError> {
    if range.contains(&value) {
        Ok(())
    } else {
        Err(SettingError { name, value, least: *range.start(), most: *range.end() })
    }
}

/// Which of the local terms count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum LightModel {
    /// Ambient and diffuse light (Lambert 1760): no highlights.
    Lambert,
    /// Highlights too (Phong 1975). The default.
    #[default]
    Phong,
}

impl LightModel {
    /// The name on the command line and in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lambert => "lambert",
            Self::Phong => "phong",
        }
    }
}

/// Settings of `flat`, `gouraud` and `phong`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShadingSettings {
    /// Into how many parts a quarter of a circle and the edge of a cube are divided, 1 to 128. Default 8: a sphere has
    /// 16·32 faces, of which those at the poles are triangles.
    pub fineness: u32,
    /// Whether bodies shade each other. Default false.
    pub shadows: bool,
    /// Which of the local terms count. Default Phong's.
    pub model: LightModel,
}

impl ShadingSettings {
    /// The values that [`Self::fineness`] may have.
    pub const FINENESS: RangeInclusive<u32> = 1..=128;

    pub(crate) fn check(&self) -> Result<(), SettingError> {
        check_whole("fineness", self.fineness, Self::FINENESS)
    }
}

impl Default for ShadingSettings {
    fn default() -> Self {
        Self { fineness: 8, shadows: false, model: LightModel::Phong }
    }
}

/// What a reflected ray brings that is not found on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SsrFallback {
    /// The scene's background. The default.
    #[default]
    Background,
    /// What a cube map of the reflecting body shows.
    CubeMap(CubeMapSettings),
}

/// Settings of `ssr`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SsrSettings {
    /// From one look at the depths to the next, pixels along the longer side of the ray's way, 0.25 to 256. Default 1.
    pub step_pixels: f64,
    /// How thick surfaces are taken to be, meters, above 0 up to 10⁶: a ray that is behind a surface by no more than
    /// this meets it, one that is farther behind passes. Default 0.1.
    pub thickness: f64,
    /// How far reflected rays are followed, meters, above 0 up to 10⁹. Default 1000.
    pub range: f64,
    /// How often the step in which a surface was met is halved, 0 to 32. Default 8.
    pub refinements: u32,
    /// What is taken where the screen has nothing. Default the background.
    pub fallback: SsrFallback,
}

impl SsrSettings {
    /// The values that [`Self::step_pixels`] may have.
    pub const STEP_PIXELS: RangeInclusive<f64> = 0.25..=256.0;
    /// The values that [`Self::thickness`] may have.
    pub const THICKNESS: RangeInclusive<f64> = 1e-9..=1e6;
    /// The values that [`Self::range`] may have.
    pub const RANGE: RangeInclusive<f64> = 1e-9..=1e9;
    /// The values that [`Self::refinements`] may have.
    pub const REFINEMENTS: RangeInclusive<u32> = 0..=32;

    pub(crate) fn check(&self) -> Result<(), SettingError> {
        check("step in pixels", self.step_pixels, Self::STEP_PIXELS)?;
        check("thickness in meters", self.thickness, Self::THICKNESS)?;
        check("range in meters", self.range, Self::RANGE)?;
        check_whole("number of refinements", self.refinements, Self::REFINEMENTS)?;
        match &self.fallback {
            SsrFallback::Background => Ok(()),
            SsrFallback::CubeMap(settings) => settings.check(),
        }
    }
}

impl Default for SsrSettings {
    fn default() -> Self {
        Self {
            step_pixels: 1.0,
            thickness: 0.1,
            range: 1000.0,
            refinements: 8,
            fallback: SsrFallback::Background,
        }
    }
}

/// Settings of `cube-map`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CubeMapSettings {
    /// Edge of each of the six faces, pixels, 1 to 4096. Default 256.
    pub size: u32,
    /// Whether the lookup is corrected for the place on the body, as if all surroundings were painted on a box
    /// (Lagarde, Zanuttini 2012). Default false: everything counts as infinitely far.
    pub parallax: bool,
}

impl CubeMapSettings {
    /// The values that [`Self::size`] may have.
    pub const SIZE: RangeInclusive<u32> = 1..=4096;

    pub(crate) fn check(&self) -> Result<(), SettingError> {
        check_whole("size of the cube map in pixels", self.size, Self::SIZE)
    }
}

impl Default for CubeMapSettings {
    fn default() -> Self {
        Self { size: 256, parallax: false }
    }
}

fn check_whole(name: &'static str, value: u32, range: RangeInclusive<u32>) -> Result<(), SettingError> {
    check(name, f64::from(value), f64::from(*range.start())..=f64::from(*range.end()))
}
