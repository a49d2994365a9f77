//! EXR bytes of a picture's linear light.

use std::io::{Cursor, Seek, Write};

use exr::image::write::WritableImage;
use exr::image::{Encoding, Image, Layer, SpecificChannels};
use exr::math::Vec2;
use exr::meta::attribute::{Chromaticities, LineOrder, Text};
use exr::meta::header::LayerAttributes;

use super::EncodeError;
use crate::picture::Picture;

/// The picture as the bytes of an OpenEXR file: channels R, G, B in linear light, 32-bit floats, as they are
/// (also negative, infinite and NaN), compressed without loss (ZIP, 16 lines).
///
/// Attributes: Rec. 709 chromaticities with white D65, `software` = `Catoptric`. The same picture gives the
/// same bytes: no date, no machine.
///
/// # Errors
/// None is known for a [`Picture`]; the encoder's refusals are passed on.
pub fn encode_exr(picture: &Picture) -> Result<Vec<u8>, EncodeError> {
    let mut bytes = Cursor::new(Vec::new());
    encode_exr_to(&mut bytes, picture)?;
    Ok(bytes.into_inner())
}

/// Writes the bytes of [`encode_exr`]; the sink should be buffered.
pub(crate) fn encode_exr_to(sink: impl Write + Seek, picture: &Picture) -> Result<(), EncodeError> {
    let channels = SpecificChannels::rgb(|Vec2(x, y): Vec2<usize>| {
        // Always inside: the encoder asks for the pixels of the size given below.
        let [r, g, b] = picture.pixel(x as u32, y as u32).unwrap_or_default();
        (r, g, b)
    });
    let attributes =
        LayerAttributes { software_name: Text::new_or_none("Catoptric"), ..LayerAttributes::default() };
    let encoding = Encoding { line_order: LineOrder::Increasing, ..Encoding::SMALL_LOSSLESS };
    let encoding = Encoding { compression: exr::compression::Compression::ZIP16, ..encoding };
    let size = (picture.width() as usize, picture.height() as usize);
    let mut image = Image::from_layer(Layer::new(size, attributes, encoding, channels));
    image.attributes.chromaticities = Some(Chromaticities {
        red: Vec2(0.64, 0.33),
        green: Vec2(0.30, 0.60),
        blue: Vec2(0.15, 0.06),
        white: Vec2(0.3127, 0.3290),
    });
    image.write().non_parallel().to_buffered(sink).map_err(|error| match error {
        exr::error::Error::Io(error) => EncodeError::Io(error),
        other => EncodeError::Refused { format: "EXR", reason: other.to_string() },
    })
}
