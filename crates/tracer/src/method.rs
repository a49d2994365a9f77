//! The ways of drawing reflections: the traced picture and what is drawn instead of it where tracing is too dear.
//!
//! [`draw`] makes a picture of a stage by any [`Method`], all with the same camera and the same local terms, so that
//! pictures can be held against each other pixel by pixel. What a method gets wrong, [`reasons`] tells by tracing.

mod reasons;
mod settings;

use std::time::{Duration, Instant};

use catoptric_picture::{Picture, SizeError};

use crate::counts::RayCounts;
use crate::render::{Control, RenderError, RenderSettings, render_through};
use crate::stage::{Stage, StageCamera};

pub use reasons::{Reason, ReasonMap, reasons};
pub use settings::{CubeMapSettings, Fallback, LightModel, SettingError, ShadingSettings, SsrSettings};

/// How reflections are found, with the settings of each way. Each has a page in the documents, `methods/`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Whitted's tree of rays (Whitted 1980): the truth of this program.
    Whitted,
    /// Bodies of flat faces, one intensity for each; no reflections.
    Flat(ShadingSettings),
    /// Intensities at the vertices, interpolated across the faces (Gouraud 1971); no reflections.
    Gouraud(ShadingSettings),
    /// Normals interpolated across the faces, the local terms in each pixel (Phong 1975); no reflections.
    Phong(ShadingSettings),
    /// Reflected rays marched through the depths of the picture itself (Sousa et al. 2011; McGuire, Mara 2014).
    Ssr(SsrSettings),
    /// Reflected directions looked up in a picture of the surroundings (Blinn, Newell 1976; Greene 1986).
    CubeMap(CubeMapSettings),
}

/// A [`Method`] without its settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MethodKind {
    /// [`Method::Whitted`].
    Whitted,
    /// [`Method::Flat`].
    Flat,
    /// [`Method::Gouraud`].
    Gouraud,
    /// [`Method::Phong`].
    Phong,
    /// [`Method::Ssr`].
    Ssr,
    /// [`Method::CubeMap`].
    CubeMap,
}

impl MethodKind {
    /// All methods, in the order in which to offer them.
    pub const ALL: [Self; 6] =
        [Self::Whitted, Self::Ssr, Self::CubeMap, Self::Phong, Self::Gouraud, Self::Flat];

    /// The method's name on the command line and in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Whitted => "whitted",
            Self::Flat => "flat",
            Self::Gouraud => "gouraud",
            Self::Phong => "phong",
            Self::Ssr => "ssr",
            Self::CubeMap => "cube-map",
        }
    }

    /// The method with default settings.
    pub fn method(self) -> Method {
        match self {
            Self::Whitted => Method::Whitted,
            Self::Flat => Method::Flat(ShadingSettings::default()),
            Self::Gouraud => Method::Gouraud(ShadingSettings::default()),
            Self::Phong => Method::Phong(ShadingSettings::default()),
            Self::Ssr => Method::Ssr(SsrSettings::default()),
            Self::CubeMap => Method::CubeMap(CubeMapSettings::default()),
        }
    }
}

impl std::fmt::Display for MethodKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(self.name())
    }
}

impl Method {
    /// The method without its settings.
    pub const fn kind(&self) -> MethodKind {
        match self {
            Self::Whitted => MethodKind::Whitted,
            Self::Flat(_) => MethodKind::Flat,
            Self::Gouraud(_) => MethodKind::Gouraud,
            Self::Phong(_) => MethodKind::Phong,
            Self::Ssr(_) => MethodKind::Ssr,
            Self::CubeMap(_) => MethodKind::CubeMap,
        }
    }

    /// The method's name on the command line and in reports.
    pub const fn name(&self) -> &'static str {
        self.kind().name()
    }

    /// Whether the settings are within their ranges.
    ///
    /// # Errors
    /// For the first setting that is not.
    pub fn check(&self) -> Result<(), SettingError> {
        match self {
            Self::Whitted => Ok(()),
            Self::Flat(settings) | Self::Gouraud(settings) | Self::Phong(settings) => settings.check(),
            Self::Ssr(settings) => settings.check(),
            Self::CubeMap(settings) => settings.check(),
        }
    }
}

/// A part of the work of a method, timed by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PassName {
    /// Whitted's tree of rays.
    Trace,
    /// Bodies become faces.
    Tessellate,
    /// The local terms at faces, vertices, or the points that pixels show.
    Light,
    /// Faces become pixels.
    Rasterize,
    /// The points that pixels show.
    Geometry,
    /// Cube maps of the surroundings.
    CubeMaps,
    /// Reflected rays on the screen, or looked up in cube maps.
    Reflect,
}

impl PassName {
    /// The name in statistics and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Trace => "trace",
            Self::Tessellate => "tessellate",
            Self::Light => "light",
            Self::Rasterize => "rasterize",
            Self::Geometry => "geometry",
            Self::CubeMaps => "cube-maps",
            Self::Reflect => "reflect",
        }
    }
}

/// A picture made by a method.
#[derive(Clone, Debug)]
pub struct Drawing {
    /// Linear light.
    pub picture: Picture,
    /// Rays traced; those of cube maps count as primary where they start.
    pub counts: RayCounts,
    /// How long each pass took, in the order of the work, all samples together.
    pub passes: Vec<(PassName, Duration)>,
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum MethodError {
    /// A setting is out of its range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The size cannot be.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// [`Control::cancel`] was called.
    #[error("the drawing was cancelled")]
    Cancelled,
    /// The method is not there yet.
    #[error("the method {0} is not there yet")]
    NotYet(MethodKind),
}

impl From<RenderError> for MethodError {
    fn from(error: RenderError) -> Self {
        match error {
            RenderError::Size(error) => Self::Size(error),
            RenderError::Cancelled => Self::Cancelled,
        }
    }
}

/// Draws `stage` by `method`, on the threads of the current rayon pool. The picture does not depend on their number.
///
/// # Errors
/// When a setting is out of its range, the size is 0 or too large, memory is short, or the drawing is cancelled.
pub fn draw(
    stage: &Stage,
    method: &Method,
    settings: RenderSettings,
    control: &Control,
) -> Result<Drawing, MethodError> {
    draw_through(stage, stage.camera(), method, settings, control)
}

/// The same through a camera of [`Stage::camera_for`].
///
/// # Errors
/// As for [`draw`].
pub fn draw_through(
    stage: &Stage,
    camera: &StageCamera,
    method: &Method,
    settings: RenderSettings,
    control: &Control,
) -> Result<Drawing, MethodError> {
    method.check()?;
    match method {
        Method::Whitted => {
            let start = Instant::now();
            let rendering = render_through(stage, camera, settings, control)?;
            let passes = vec![(PassName::Trace, start.elapsed())];
            Ok(Drawing { picture: rendering.picture, counts: rendering.counts, passes })
        }
        other => Err(MethodError::NotYet(other.kind())),
    }
}
