//! The light of a picture, in the memory of the processor or of a graphics card.

use std::sync::Arc;

use catoptric_gpu::GpuError;
use catoptric_picture::SizeError;
use catoptric_tracer::{Film, RayCounts, RenderCamera, RenderControl, RenderError, RenderScene};

use crate::card::{CardFilm, CardPort, NoAnswer};

/// The light of a picture.
pub(crate) enum Canvas {
    Processor(Film),
    Card(CardFilm),
}

/// A sample that was added to every pixel.
pub(crate) struct AddedSample {
    pub(crate) rays: RayCounts,
    /// The pixels that a card traced for it, and what they took, milliseconds.
    pub(crate) on_card: Option<(u64, f64)>,
}

/// The reason why a pass was not finished.
pub(crate) enum PassError {
    Cancelled,
    /// It is under way, on a card that is not waited for.
    UnderWay,
    Size(SizeError),
    Card(GpuError),
}

impl Canvas {
    /// A canvas without light, on the card or not.
    pub(crate) fn new(is_on_card: bool, [width, height]: [u32; 2]) -> Result<Self, SizeError> {
        Ok(if is_on_card {
            Self::Card(CardFilm::new([width, height]))
        } else {
            Self::Processor(Film::new(width, height)?)
        })
    }

    pub(crate) fn is_on_card(&self) -> bool {
        matches!(self, Self::Card(_))
    }

    /// Width and height, pixels.
    pub(crate) fn size(&self) -> [u32; 2] {
        match self {
            Self::Processor(film) => [film.width(), film.height()],
            Self::Card(film) => film.size(),
        }
    }

    /// Samples that every pixel has.
    pub(crate) fn samples(&self) -> u32 {
        match self {
            Self::Processor(film) => film.samples(),
            Self::Card(film) => film.samples(),
        }
    }

    /// Forgets all light.
    pub(crate) fn clear(&mut self) {
        match self {
            Self::Processor(film) => film.clear(),
            Self::Card(film) => film.clear(),
        }
    }

    /// Adds a sample to every pixel.
    pub(crate) fn add_sample(
        &mut self,
        card: Option<&CardPort>,
        render_scene: &Arc<RenderScene>,
        camera: &RenderCamera,
        control: &Arc<RenderControl>,
    ) -> Result<AddedSample, PassError> {
        match (self, card) {
            (Self::Processor(film), _) => {
                let rays = film.add_sample(render_scene, camera, control)?;
                Ok(AddedSample { rays, on_card: None })
            }
            (Self::Card(film), Some(card)) => {
                let pass = card.sample(film, render_scene, camera, control)?;
                Ok(AddedSample { rays: pass.rays, on_card: Some(pass.work) })
            }
            // The card was taken away: what was drawn on it is of no use.
            (Self::Card(_), None) => Err(PassError::Cancelled),
        }
    }
}

impl From<RenderError> for PassError {
    fn from(error: RenderError) -> Self {
        match error {
            RenderError::Cancelled => Self::Cancelled,
            RenderError::Size(error) => Self::Size(error),
        }
    }
}

impl From<SizeError> for PassError {
    fn from(error: SizeError) -> Self {
        Self::Size(error)
    }
}

impl From<NoAnswer> for PassError {
    fn from(none: NoAnswer) -> Self {
        match none {
            NoAnswer::Yet => Self::UnderWay,
            NoAnswer::Gpu(error) => error.into(),
        }
    }
}

impl From<GpuError> for PassError {
    fn from(error: GpuError) -> Self {
        match error {
            GpuError::Cancelled => Self::Cancelled,
            GpuError::Size(error) => Self::Size(error),
            error => Self::Card(error),
        }
    }
}
