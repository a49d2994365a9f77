//! Pictures that stay on the card that drew them.

/// A picture in the memory of the graphics card that drew it.
#[cfg(not(target_family = "wasm"))]
pub type CardPicture = catoptric_gpu::GpuPicture;

/// A picture in the memory of the graphics card that drew it. A page has none: its window is drawn by WebGL, which cannot
/// show what WebGPU has.
#[cfg(target_family = "wasm")]
#[derive(Debug)]
pub enum CardPicture {}

#[cfg(target_family = "wasm")]
impl CardPicture {
    /// Whether it lies in the memory of this card.
    pub fn is_on(&self, _: &catoptric_gpu::Gpu) -> bool {
        match *self {}
    }

    /// Red, green, blue (sRGB) and 255 for every pixel, row by row from the top.
    ///
    /// # Errors
    /// When the card is lost.
    pub async fn read(&self) -> Result<Vec<u8>, catoptric_gpu::GpuError> {
        match *self {}
    }
}
