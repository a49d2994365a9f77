//! SVG as pixels, if the library is built for it (feature `plots`).

#[cfg(feature = "plots")]
mod svg;

use catoptric_picture::{EncodeError, SizeError};

#[cfg(feature = "plots")]
pub use svg::rasterize;

/// The reason why an SVG cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum RasterError {
    /// The library is built without what draws.
    #[cfg(not(feature = "plots"))]
    #[error("this program is built without plots")]
    Absent,
    /// The text is no SVG.
    #[cfg(feature = "plots")]
    #[error("the plot cannot be drawn: {0}")]
    Svg(#[from] resvg::usvg::Error),
    /// The picture would be too large.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// The pixels cannot be written as a PNG.
    #[error(transparent)]
    Encode(#[from] EncodeError),
}

/// Draws no SVG.
///
/// # Errors
/// Always.
#[cfg(not(feature = "plots"))]
pub fn rasterize(_svg: &str, _scale: f32) -> Result<catoptric_picture::Picture, RasterError> {
    Err(RasterError::Absent)
}
