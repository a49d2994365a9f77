//! The difference of two pictures. Each measure has a file of its own.

pub(crate) mod difference;
mod digits;
pub(crate) mod flip;
pub(crate) mod heat;
pub(crate) mod inferno;
mod plane;
pub(crate) mod ssim;

use crate::picture::{Picture, SizeError};
use difference::SizeMismatch;

/// The reason why two pictures cannot be compared, or the comparison not be drawn.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CompareError {
    /// The pictures differ in size.
    #[error(transparent)]
    Mismatch(#[from] SizeMismatch),
    /// There is too little memory, or the map with its legend is too large.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// The structural similarity needs room for its window.
    #[error(
        "the pictures have {width}x{height} pixels; structural similarity needs at least {window}x{window}",
        window = ssim::WINDOW
    )]
    TooSmall {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
}

/// Linear light as a display shows it without a tone curve: clamped to 0…1, NaN as 0.
#[expect(clippy::manual_clamp, reason = "NaN must become 0")]
fn displayed(light: [f32; 3]) -> [f32; 3] {
    light.map(|value| value.max(0.0).min(1.0))
}

/// The error of too little memory for a value of 32 bits a pixel.
fn too_little_memory(picture: &Picture) -> SizeError {
    let (width, height) = (picture.width(), picture.height());
    SizeError::Memory { width, height, bytes: 4 * u64::from(width) * u64::from(height) }
}
