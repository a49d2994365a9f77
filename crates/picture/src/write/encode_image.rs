//! JPEG, Radiance HDR, WebP, TIFF and PPM bytes, by the encoders of the `image` crate.

use std::borrow::Cow;
use std::error::Error as _;

use catoptric_platform::files::Sink;
use image::codecs::hdr::HdrEncoder;
use image::codecs::jpeg::JpegEncoder;
use image::codecs::pnm::{PnmEncoder, PnmSubtype, SampleEncoding};
use image::codecs::tiff::TiffEncoder;
use image::codecs::webp::WebPEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError};

use super::EncodeError;
use crate::develop::{Codes, Developed};
use crate::format::PictureFormat;
use crate::picture::Picture;

/// Writes a JPEG of this quality, 1 to 100; colors have the resolution of lightness (4:4:4).
pub(super) fn encode_jpeg_to(
    sink: &mut dyn Sink,
    picture: &Developed,
    quality: u8,
) -> Result<(), EncodeError> {
    write_codes(JpegEncoder::new_with_quality(sink, quality), PictureFormat::Jpeg, picture)
}

/// Writes a WebP without loss.
pub(super) fn encode_webp_to(sink: &mut dyn Sink, picture: &Developed) -> Result<(), EncodeError> {
    write_codes(WebPEncoder::new_lossless(sink), PictureFormat::WebP, picture)
}

/// Writes a PPM, its codes as bytes (`P6`).
pub(super) fn encode_ppm_to(sink: &mut dyn Sink, picture: &Developed) -> Result<(), EncodeError> {
    let encoder = PnmEncoder::new(sink).with_subtype(PnmSubtype::Pixmap(SampleEncoding::Binary));
    write_codes(encoder, PictureFormat::Ppm, picture)
}

/// Writes an uncompressed TIFF of 8 or 16 bits.
pub(super) fn encode_tiff_codes_to(sink: &mut dyn Sink, picture: &Developed) -> Result<(), EncodeError> {
    write_codes(TiffEncoder::new(sink), PictureFormat::Tiff, picture)
}

/// Writes an uncompressed TIFF of the linear light in 32-bit floats, bit by bit.
pub(super) fn encode_tiff_light_to(sink: &mut dyn Sink, picture: &Picture) -> Result<(), EncodeError> {
    let bytes = bytemuck::cast_slice(picture.pixels());
    let (width, height) = (picture.width(), picture.height());
    let written = TiffEncoder::new(sink).write_image(bytes, width, height, ExtendedColorType::Rgb32F);
    written.map_err(|error| refusal(PictureFormat::Tiff, error))
}

/// Writes a Radiance HDR: the largest channel of a pixel with 8 bits, the others in its steps. Light below 0 and NaN
/// become 0; what is beyond the range, which ends near that of single precision, its end.
pub(super) fn encode_hdr_to(sink: &mut dyn Sink, picture: &Picture) -> Result<(), EncodeError> {
    let pixels = within_rgbe(picture.pixels());
    let bytes = bytemuck::cast_slice(&pixels);
    let (width, height) = (picture.width(), picture.height());
    let written = HdrEncoder::new(sink).write_image(bytes, width, height, ExtendedColorType::Rgb32F);
    written.map_err(|error| refusal(PictureFormat::Hdr, error))
}

/// Light whose exponent has room in a byte: the encoder's would wrap around.
#[expect(clippy::manual_clamp, reason = "NaN must become 0")]
fn within_rgbe(pixels: &[[f32; 3]]) -> Cow<'_, [[f32; 3]]> {
    // The exponents of a byte reach from 2⁻¹²⁸ to 2¹²⁷; a margin of one keeps clear of rounded logarithms.
    const LEAST: f32 = 1.0 / ((1_u128 << 126) as f32);
    const MOST: f32 = (1_u128 << 126) as f32;
    let largest = |pixel: &[f32; 3]| pixel.iter().fold(0.0, |most: f32, &value| most.max(value));
    let is_within = |pixel: &[f32; 3]| (LEAST..=MOST).contains(&largest(pixel)) || largest(pixel) == 0.0;
    if pixels.iter().all(is_within) {
        return Cow::Borrowed(pixels);
    }
    let brought = pixels.iter().map(|pixel| {
        if largest(pixel) < LEAST { [0.0; 3] } else { pixel.map(|value| value.max(0.0).min(MOST)) }
    });
    Cow::Owned(brought.collect())
}

fn write_codes(
    encoder: impl ImageEncoder,
    format: PictureFormat,
    picture: &Developed,
) -> Result<(), EncodeError> {
    let (bytes, kind): (&[u8], _) = match picture.codes() {
        Codes::Eight(codes) => (codes, ExtendedColorType::Rgb8),
        Codes::Sixteen(codes) => (bytemuck::cast_slice(codes), ExtendedColorType::Rgb16),
    };
    let written = encoder.write_image(bytes, picture.width(), picture.height(), kind);
    written.map_err(|error| refusal(format, error))
}

fn refusal(format: PictureFormat, error: ImageError) -> EncodeError {
    match error {
        ImageError::IoError(error) => EncodeError::Io(error),
        other => {
            let reason = other.source().map_or_else(|| other.to_string(), ToString::to_string);
            EncodeError::Refused { format: format.name(), reason }
        }
    }
}
