//! The ways of drawing reflections: the traced picture and what is drawn instead of it where tracing is too dear.
//!
//! [`draw`] makes a picture of a stage by any [`Method`], all with the same camera and the same local terms, so that
//! pictures can be held against each other pixel by pixel. What a method gets wrong, [`reasons`] tells by tracing.

mod canvas;
mod cube_map;
mod fronts;
mod gbuffer;
mod mesh;
mod mirrored;
mod probe;
mod raster;
mod reasons;
mod screen;
mod settings;
mod shaded;

use std::time::{Duration, Instant};

use catoptric_picture::{Picture, SizeError};

use crate::counts::RayCounts;
use crate::render::{RenderControl, RenderError, RenderSettings, render_into};
use crate::stage::{RenderCamera, RenderScene};

use gbuffer::GBuffer;
use mirrored::{ActiveCubeMaps, ReflectionSources};
use shaded::ShadingFrequency;

pub use cube_map::{CubeMap, CubeMapUse, CubeMaps};
pub use gbuffer::GBufferLayer;
pub use reasons::{Reason, ReasonMap, reasons};
pub use settings::{CubeMapSettings, LightModel, SettingError, ShadingSettings, SsrFallback, SsrSettings};

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
pub struct MethodOutput {
    /// Linear light.
    pub picture: Picture,
    /// Rays traced; those of cube maps count as primary where they start.
    pub counts: RayCounts,
    /// How long each pass took, in the order of the work, all samples together.
    pub passes: Vec<(PassName, Duration)>,
    /// The cube maps that served, if the method uses any.
    pub cube_maps: Option<CubeMapUse>,
    evidence: FirstSampleBuffers,
}

impl MethodOutput {
    /// Whitted's tree, traced elsewhere in so much time.
    pub fn traced(picture: Picture, counts: RayCounts, time: Duration) -> Self {
        let passes = vec![(PassName::Trace, time)];
        Self { picture, counts, passes, cube_maps: None, evidence: FirstSampleBuffers::None }
    }

    /// A layer of the buffers behind the picture (of `ssr` and `cube-map`; other methods have none), of the first sample.
    /// `stage` is the one that was drawn.
    ///
    /// # Errors
    /// When memory is short.
    pub fn layer(&self, stage: &RenderScene, layer: GBufferLayer) -> Result<Option<Picture>, SizeError> {
        match &self.evidence {
            FirstSampleBuffers::Buffers(buffer, _) => buffer.picture(stage, layer).map(Some),
            FirstSampleBuffers::None | FirstSampleBuffers::Bodies(_) => Ok(None),
        }
    }

    /// The cube maps that served the picture, each with the place in [`Scene::bodies`](catoptric_scene::Scene::bodies) of
    /// its body.
    pub fn maps(&self, stage: &RenderScene) -> Vec<(usize, &CubeMap)> {
        match &self.evidence {
            FirstSampleBuffers::Buffers(_, maps) => {
                maps.iter().filter_map(|(body, map)| Some((stage.scene_index(body)?, map))).collect()
            }
            FirstSampleBuffers::None | FirstSampleBuffers::Bodies(_) => Vec::new(),
        }
    }
}

/// What [`reasons`] needs of a drawing, of its first sample.
#[derive(Clone, Debug)]
enum FirstSampleBuffers {
    None,
    /// The body in each pixel, by its place in the stage.
    Bodies(Vec<u32>),
    /// What the pixels show and reflect, and the maps that they looked into.
    Buffers(Box<GBuffer>, ActiveCubeMaps),
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
    /// [`RenderControl::cancel`] was called.
    #[error("the drawing was cancelled")]
    Cancelled,
    /// The cube maps of all reflecting bodies would take too much memory.
    #[error(
        "the cube maps of {bodies} reflecting bodies with faces of {size}x{size} pixels would take {bytes} bytes, and may \
         take at most {limit}; make them smaller",
        limit = CubeMaps::MOST_BYTES
    )]
    TooManyCubeMaps {
        /// How many bodies reflect in the picture.
        bodies: usize,
        /// Edge of a face, pixels.
        size: u32,
        /// What they would take.
        bytes: u64,
    },
    /// The pictures are not of the size that was asked for.
    #[error("a picture of {width}x{height} pixels was expected, and this one has {of_picture:?}")]
    SizeMismatch {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// What the picture has.
        of_picture: [u32; 2],
    },
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
    stage: &RenderScene,
    method: &Method,
    settings: RenderSettings,
    control: &RenderControl,
) -> Result<MethodOutput, MethodError> {
    draw_through(stage, stage.camera(), method, settings, control, &mut CubeMaps::new())
}

/// The same through a camera of [`RenderScene::camera_for`], with cube maps that are kept in `maps` from picture to picture.
///
/// # Errors
/// As for [`draw`].
pub fn draw_through(
    stage: &RenderScene,
    camera: &RenderCamera,
    method: &Method,
    settings: RenderSettings,
    control: &RenderControl,
    maps: &mut CubeMaps,
) -> Result<MethodOutput, MethodError> {
    method.check()?;
    let shade = |shading, how: &ShadingSettings| shaded::draw(stage, camera, shading, how, settings, control);
    match method {
        Method::Whitted => trace(stage, camera, settings, control),
        Method::Flat(how) => shade(ShadingFrequency::Flat, how),
        Method::Gouraud(how) => shade(ShadingFrequency::Gouraud, how),
        Method::Phong(how) => shade(ShadingFrequency::Phong, how),
        Method::Ssr(how) => {
            mirrored::draw(stage, camera, ReflectionSources::of_screen(how), settings, control, maps)
        }
        Method::CubeMap(how) => {
            mirrored::draw(stage, camera, ReflectionSources::of_maps(how), settings, control, maps)
        }
    }
}

fn trace(
    stage: &RenderScene,
    camera: &RenderCamera,
    settings: RenderSettings,
    control: &RenderControl,
) -> Result<MethodOutput, MethodError> {
    let RenderSettings { width, height, samples } = settings;
    let mut picture = Picture::new(width, height)?;
    control.expect(u64::from(width) * u64::from(height));
    // As by other methods, memory that has to be cleared is no part of a pass.
    let start = Instant::now();
    let counts = render_into(&mut picture, stage, camera, samples, control)?;
    Ok(MethodOutput::traced(picture, counts, start.elapsed()))
}
