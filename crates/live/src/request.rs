//! The request of a window.

use std::sync::Arc;

use catoptric_picture::Development;
use catoptric_scene::{Camera, Scene};
use catoptric_tracer::raster::{GBufferLayer, Method};

/// A snapshot of all that decides what the view shows.
#[derive(Clone, Debug)]
pub struct Request {
    /// The document at this moment; its own camera is not looked at.
    pub scene: Arc<Scene>,
    /// The number of this state of the document; goes into [`Frame::revision`](crate::Frame::revision).
    pub revision: u64,
    /// Where the view looks from.
    pub camera: Camera,
    /// Width and height of the view in physical pixels. A view of no pixels asks for nothing.
    pub size: [u32; 2],
    /// Whether a drag is under way: pictures stay coarse until nothing changes for a moment.
    pub moving: bool,
    /// How reflections are found. Other methods than Whitted's are drawn anew for more samples, in steps of 1, 4, 16 …
    pub method: Method,
    /// What of the drawing is seen.
    pub shows: DisplayContent,
    /// Samples per pixel to refine to; [`Request::NOISY`] times as many in scenes that need it.
    pub samples: u32,
    /// How light becomes display codes.
    pub development: Development,
    /// Bodies to outline, by their places in [`Scene::bodies`].
    pub outline: Vec<usize>,
    /// The body under the pointer, outlined by itself.
    pub hover: Option<usize>,
    /// The ground grid, if it is wanted.
    pub grid: Option<GridSpec>,
    /// Do not refine, while a final render has the processors; first pictures still follow changes.
    pub paused: bool,
}

impl Request {
    /// Samples per pixel unless said otherwise.
    pub const DEFAULT_SAMPLES: u32 = 16;

    /// The factor of samples where a pixel's light is [noisy](catoptric_tracer::RenderScene::is_noisy).
    pub const NOISY: u32 = 16;

    /// The largest view, pixels: beyond the largest displays.
    pub const MAX_PIXELS: u64 = 1 << 25;

    /// Asks for the view of the scene's own camera: still, without outlines or grid.
    pub fn new(scene: Arc<Scene>, revision: u64, size: [u32; 2]) -> Self {
        Self {
            camera: scene.camera,
            scene,
            revision,
            size,
            moving: false,
            method: Method::Whitted,
            shows: DisplayContent::Picture,
            samples: Self::DEFAULT_SAMPLES,
            development: Development::default(),
            outline: Vec::new(),
            hover: None,
            grid: None,
            paused: false,
        }
    }
}

/// The part of a drawing that is displayed. If the method has no such part, the picture is displayed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum DisplayContent {
    /// The picture.
    #[default]
    Picture,
    /// A layer of the buffers behind it (`ssr` and `cube-map`), of the first sample. Light is developed as the picture
    /// is, numbers are not.
    Layer(GBufferLayer),
    /// The unfolded cube map of the body at this place in [`Scene::bodies`], or else the first there is.
    UnfoldedCube(Option<usize>),
}

/// The visible part of the ground grid, which lies in the plane y = 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridSpec {
    /// The lines, their step chosen from the camera's distance.
    pub lines: bool,
    /// The X and Z axes.
    pub axes: bool,
}

impl Default for GridSpec {
    fn default() -> Self {
        Self { lines: true, axes: true }
    }
}
