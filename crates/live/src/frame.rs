//! The frame that a window displays.

use std::sync::Arc;

use catoptric_gpu::{GpuError, wait};
use catoptric_scene::Camera;
use catoptric_tracer::RayCounts;
use glam::Vec2;

use crate::card::CardPicture;
use crate::request::DisplayContent;

/// A picture of the view with what is drawn over it. All belongs to the same request.
#[derive(Clone, Debug)]
pub struct Frame {
    /// Grows with every frame.
    pub serial: u64,
    /// Grows with every picture: a frame whose outlines alone are new keeps it, and the texture need not be renewed.
    pub picture_serial: u64,
    /// [`Request::revision`](crate::Request::revision).
    pub revision: u64,
    /// [`Request::camera`](crate::Request::camera).
    pub camera: Camera,
    /// Width and height of the view that was asked for, pixels; outlines and grid are in its coordinates.
    pub view_size: [u32; 2],
    /// Width and height of the picture, pixels: the view's, or less for a coarse one, to be stretched over the view.
    pub picture_size: [u32; 2],
    /// What is seen: [`Request::shows`](crate::Request::shows), or the picture where the method has no such thing. An
    /// unfolded cube has proportions of its own; outlines and grid do not belong to it.
    pub shows: DisplayContent,
    /// The picture: red, green, blue (sRGB) and 255 for every pixel, row by row from the top. Empty if it is on a card;
    /// see [`Self::codes`].
    pub pixels: Arc<Vec<u8>>,
    /// The picture in the memory of the graphics card that drew it.
    pub card: Option<Arc<CardPicture>>,
    /// Samples per pixel.
    pub samples: u32,
    /// What tracing and developing its last pass took.
    pub milliseconds: f64,
    /// Rays traced in its last pass.
    pub rays: RayCounts,
    /// Outlines of [`Request::outline`](crate::Request::outline).
    pub outline: Arc<Vec<Polyline>>,
    /// Outline of [`Request::hover`](crate::Request::hover).
    pub hover: Arc<Vec<Polyline>>,
    /// The ground grid.
    pub grid: Arc<Vec<GridLine>>,
}

impl Frame {
    /// The codes of the picture as in [`Self::pixels`], wherever they are. Waits for a card that has them.
    ///
    /// # Errors
    /// When the card is lost.
    pub fn codes(&self) -> Result<Arc<Vec<u8>>, GpuError> {
        self.card
            .as_ref()
            .map_or_else(|| Ok(Arc::clone(&self.pixels)), |card| wait(card.read()).map(Arc::new))
    }

    /// Whether the picture has the view's full resolution, or one of its own.
    pub fn is_full(&self) -> bool {
        self.view_size == self.picture_size || matches!(self.shows, DisplayContent::UnfoldedCube(_))
    }
}

/// A piece of an outline, in pixels of the view, (0, 0) being its upper left corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// The body that is outlined, by its place in the scene; `None` for one outline around many bodies.
    pub body: Option<usize>,
    /// The points; at least two.
    pub points: Vec<Vec2>,
    /// Whether the last point is joined to the first.
    pub closed: bool,
    /// Whether other bodies stand before it.
    pub hidden: bool,
}

/// A visible piece of the ground grid, in pixels of the view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridLine {
    /// One end.
    pub from: Vec2,
    /// The other end.
    pub to: Vec2,
    /// Which line it belongs to.
    pub kind: GridKind,
    /// How strongly to draw it, 0…1: it fades towards the distance.
    pub strength: f32,
}

/// The lines of a ground grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GridKind {
    /// Every step.
    Minor,
    /// Every tenth step.
    Major,
    /// The X axis.
    AxisX,
    /// The Z axis.
    AxisZ,
}
