//! Why a method draws no picture.

use catoptric_picture::SizeError;

use crate::raster::settings::SettingError;
use crate::transport::render::RenderError;

/// The most bytes that the cube maps of a picture may take.
pub(crate) const MOST_CUBE_MAP_BYTES: u64 = 1 << 31;

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum MethodError {
    /// A setting is out of its range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The size cannot be.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// [`RenderControl::cancel`](crate::RenderControl::cancel) was called.
    #[error("the drawing was cancelled")]
    Cancelled,
    /// The cube maps of all reflecting bodies would take too much memory.
    #[error(
        "the cube maps of {bodies} reflecting bodies with faces of {size}x{size} pixels would take {bytes} bytes, and may \
         take at most {limit}; make them smaller",
        limit = MOST_CUBE_MAP_BYTES
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
