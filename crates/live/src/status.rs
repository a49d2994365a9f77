//! The status of the worker.

use catoptric_gpu::GpuError;
use catoptric_picture::SizeError;
use catoptric_tracer::SceneBuildError;
use catoptric_tracer::raster::{CubeMapUse, MethodKind, PassName, SettingError};

/// The status of the worker, for a status bar.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Status {
    /// What traced last: `CPU` or `GPU`.
    pub backend: &'static str,
    /// The name of the graphics card that draws, if one is to.
    pub card: Option<String>,
    /// What in the present scene the card cannot draw, so that the processor does.
    pub card_refuses: Option<GpuError>,
    /// Why the card that should draw draws no more; the processor does until another is named.
    pub card_lost: Option<GpuError>,
    /// How many threads trace.
    pub threads: usize,
    /// How far the picture is refined, 0…1.
    pub progress: f32,
    /// Samples in every pixel of the full picture.
    pub samples_done: u32,
    /// Samples asked for.
    pub samples_wanted: u32,
    /// Width and height of the last picture, pixels.
    pub picture_size: [u32; 2],
    /// What tracing and developing the last picture took.
    pub milliseconds: f64,
    /// How the last picture was drawn; `None` before there is one.
    pub method: Option<MethodKind>,
    /// What each pass of it took, milliseconds; empty for Whitted's tree.
    pub passes: Vec<(PassName, f64)>,
    /// The cube maps that served it, if the method uses any.
    pub cube_maps: Option<CubeMapUse>,
    /// Rays a second while the last picture was traced.
    pub rays_per_second: f64,
    /// Whether there is nothing left to do.
    pub is_idle: bool,
    /// Why the newest request has no picture.
    pub error: Option<LiveError>,
}

/// The reason why there is no picture of a request.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LiveError {
    /// The scene cannot be prepared.
    #[error(transparent)]
    Stage(#[from] SceneBuildError),
    /// There can be no picture of this size.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// The view is larger than [`Request::MAX_PIXELS`](crate::Request::MAX_PIXELS).
    #[error("a view of {width}x{height} pixels is too large to follow")]
    TooLarge {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// A setting of the method is out of its range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The cube maps of all reflecting bodies would take too much memory.
    #[error("the cube maps of {bodies} bodies with faces of {size}x{size} pixels take too much memory")]
    TooManyCubeMaps {
        /// How many bodies reflect in the picture.
        bodies: usize,
        /// Edge of a face, pixels.
        size: u32,
    },
    /// A number of the camera is infinite or not a number.
    #[error("the camera's position, target, up and angle must be finite numbers")]
    Camera,
    /// A fault in the program itself; the worker goes on with the next request.
    #[error("the tracer failed by a fault of its own: {0}")]
    Fault(String),
}
