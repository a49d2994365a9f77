//! JPEG, Radiance HDR, WebP, BMP and PPM to linear light, by the decoders of the `image` crate.

use std::error::Error as _;
use std::io::{ErrorKind, Read, Seek, SeekFrom};

use image::codecs::bmp::BmpDecoder;
use image::codecs::hdr::HdrDecoder;
use image::codecs::jpeg::JpegDecoder;
use image::codecs::pnm::PnmDecoder;
use image::codecs::webp::WebPDecoder;
use image::metadata::Orientation;
use image::{ColorType, ImageDecoder, ImageError, Limits};

use super::limits::{check_length, check_memory};
use super::transfer::Transfer;
use super::{DecodeError, ReadOptions, Source};
use crate::format::PictureFormat;
use crate::picture::{Picture, SizeError};

/// The most bytes that JPEG makes of one: a block of 64 samples may take two bits, and there are planes of fewer.
const JPEG: u64 = 4096;
/// The most bytes that PBM makes of one: eight pixels.
const PBM: u64 = 8;
/// Bytes of memory that decoders take by themselves for each byte that they give, at most: coefficients of progressive
/// JPEG, copies of WebP, strips of TIFF.
pub(super) const WORK: u64 = 4;

/// Decodes a file of `length` bytes.
pub(super) fn decode_image(
    mut source: Source<'_>,
    length: u64,
    format: PictureFormat,
    options: &ReadOptions,
) -> Result<Picture, DecodeError> {
    let refused = |error| refusal(format, error);
    match format {
        PictureFormat::Jpeg => {
            check_end_of_jpeg(&mut source)?;
            let decoder = JpegDecoder::new(source).map_err(refused)?;
            check_length(decoder.total_bytes(), length, JPEG)?;
            picture_of(decoder, format, options)
        }
        PictureFormat::Hdr => {
            // The strict mode knows one of the two signatures only.
            let decoder = HdrDecoder::new_nonstrict(source).map_err(refused)?;
            if decoder.metadata().custom_attributes.iter().any(|(_, value)| value.trim() == "32-bit_rle_xyze")
            {
                let reason = "an HDR picture in XYZ is not read; convert it to RGB".to_owned();
                return Err(DecodeError::Unsupported { reason });
            }
            // A row takes four bytes at least.
            check_length(u64::from(decoder.dimensions().1) * 4, length, 1)?;
            picture_of(decoder, format, options)
        }
        PictureFormat::WebP => picture_of(WebPDecoder::new(source).map_err(refused)?, format, options),
        PictureFormat::Ppm => {
            let decoder = PnmDecoder::new(source).map_err(refused)?;
            check_length(decoder.total_bytes(), length, PBM)?;
            picture_of(decoder, format, options)
        }
        _ => {
            check_length_of_bmp(&mut source, length)?;
            picture_of(BmpDecoder::new(source).map_err(refused)?, format, options)
        }
    }
}

/// Decodes the pixels, upright, and turns codes into light.
pub(super) fn picture_of(
    mut decoder: impl ImageDecoder,
    format: PictureFormat,
    options: &ReadOptions,
) -> Result<Picture, DecodeError> {
    let (width, height) = decoder.dimensions();
    options.check_size(width, height)?;
    let (color, bytes) = (decoder.color_type(), decoder.total_bytes());
    check_memory(width, height, bytes.saturating_mul(WORK))?;
    let mut limits = Limits::no_limits();
    limits.max_image_width = Some(Picture::MAX_SIDE);
    limits.max_image_height = Some(Picture::MAX_SIDE);
    limits.max_alloc = Some(bytes.saturating_mul(WORK).saturating_add(64 << 20));
    decoder.set_limits(limits).map_err(|error| refusal(format, error))?;
    let orientation = decoder.orientation().unwrap_or(Orientation::NoTransforms);
    if color == ColorType::Rgb32F && orientation == Orientation::NoTransforms {
        let mut picture = Picture::new(width, height)?;
        let floats = bytemuck::cast_slice_mut(picture.pixels_mut());
        decoder.read_image(floats).map_err(|error| refusal(format, error))?;
        return Ok(picture);
    }
    let memory = || SizeError::Memory { width, height, bytes };
    let count = usize::try_from(bytes).map_err(|_| memory())?;
    let mut codes: Vec<u8> = bytemuck::allocation::try_zeroed_vec(count).map_err(|()| memory())?;
    decoder.read_image(&mut codes).map_err(|error| refusal(format, error))?;
    let placed = UprightMapping { width, height, orientation };
    let (samples, channels) = (codes.as_slice(), usize::from(color.channel_count()));
    match color {
        ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8 => {
            let light = Transfer::Srgb.table(255);
            placed.fill(samples.chunks_exact(channels), |pixel| {
                color_of(pixel, |sample: &[u8; 1]| value_at(&light, usize::from(sample[0])))
            })
        }
        ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => {
            let light = Transfer::Srgb.table(65535);
            placed.fill(samples.chunks_exact(2 * channels), |pixel| {
                color_of(pixel, |sample| value_at(&light, usize::from(u16::from_ne_bytes(*sample))))
            })
        }
        ColorType::Rgb32F | ColorType::Rgba32F => placed.fill(samples.chunks_exact(4 * channels), |pixel| {
            color_of(pixel, |sample| f32::from_ne_bytes(*sample))
        }),
        other => {
            Err(DecodeError::Unsupported { reason: format!("pixels of the kind {other:?} are not read") })
        }
    }
}

fn value_at(light: &[f32], code: usize) -> f32 {
    light.get(code).copied().unwrap_or_default()
}

/// The color of a pixel from its samples of `N` bytes: three or more are RGB and perhaps alpha, fewer are gray.
fn color_of<const N: usize>(pixel: &[u8], light: impl Fn(&[u8; N]) -> f32) -> [f32; 3] {
    match pixel.as_chunks::<N>().0 {
        [red, green, blue, ..] => [light(red), light(green), light(blue)],
        [gray, ..] => [light(gray); 3],
        [] => [0.0; 3],
    }
}

/// The map from stored pixels to the upright picture.
pub(super) struct UprightMapping {
    /// Pixels across, as stored.
    pub(super) width: u32,
    /// Pixels down, as stored.
    pub(super) height: u32,
    pub(super) orientation: Orientation,
}

impl UprightMapping {
    /// The upright picture of the stored pixels, in their order.
    pub(super) fn fill<S>(
        &self,
        pixels: impl Iterator<Item = S>,
        color: impl Fn(S) -> [f32; 3],
    ) -> Result<Picture, DecodeError> {
        if self.orientation == Orientation::NoTransforms {
            let mut picture = Picture::new(self.width, self.height)?;
            picture.pixels_mut().iter_mut().zip(pixels).for_each(|(target, stored)| *target = color(stored));
            return Ok(picture);
        }
        let [across, down] = self.size();
        let mut picture = Picture::new(across, down)?;
        let places = (0..self.height).flat_map(|y| (0..self.width).map(move |x| (x, y)));
        for ((x, y), stored) in places.zip(pixels) {
            let [x, y] = self.upright(x, y);
            let place = u64::from(y) * u64::from(across) + u64::from(x);
            if let Some(target) = picture.pixels_mut().get_mut(place as usize) {
                *target = color(stored);
            }
        }
        Ok(picture)
    }

    /// The size of the upright picture.
    fn size(&self) -> [u32; 2] {
        use Orientation::{Rotate90, Rotate90FlipH, Rotate270, Rotate270FlipH};
        match self.orientation {
            Rotate90 | Rotate270 | Rotate90FlipH | Rotate270FlipH => [self.height, self.width],
            _ => [self.width, self.height],
        }
    }

    /// Where the stored pixel at column `x`, row `y` is in the upright picture.
    fn upright(&self, x: u32, y: u32) -> [u32; 2] {
        let (right, below) = (self.width - 1 - x, self.height - 1 - y);
        match self.orientation {
            Orientation::NoTransforms => [x, y],
            Orientation::FlipHorizontal => [right, y],
            Orientation::Rotate180 => [right, below],
            Orientation::FlipVertical => [x, below],
            Orientation::Rotate90FlipH => [y, x],
            Orientation::Rotate90 => [below, x],
            Orientation::Rotate270FlipH => [below, right],
            Orientation::Rotate270 => [y, right],
        }
    }
}

/// Checks that a JPEG has an end: the decoder fills what is missing with gray.
///
/// Segments before the first scan have lengths and may hold thumbnails with ends of their own. In a scan, a byte 0xff
/// of the data is followed by 0, so that the marker 0xffd9 can only be the end.
fn check_end_of_jpeg(source: &mut Source<'_>) -> Result<(), DecodeError> {
    let corrupt =
        |reason: &str| DecodeError::Corrupt { format: PictureFormat::Jpeg.name(), reason: reason.to_owned() };
    let early = || corrupt("the file ends too early");
    let mut bytes = Vec::new();
    source.read_to_end(&mut bytes)?;
    source.seek(SeekFrom::Start(0))?;
    let mut rest = bytes.get(2..).unwrap_or_default();
    loop {
        match rest {
            [0xff, 0xda, ..] => break,
            // Fill bytes may stand before a marker; these markers stand alone.
            [0xff, 0xff, ..] => rest = rest.get(1..).unwrap_or_default(),
            [0xff, 0x01 | 0xd0..=0xd8, ..] => rest = rest.get(2..).unwrap_or_default(),
            [0xff, _, high, low, ..] => {
                let length = usize::from(u16::from_be_bytes([*high, *low]));
                rest = rest.get(2 + length..).ok_or_else(early)?;
            }
            // Bytes between segments, which the decoder passes over.
            [_, _, ..] => rest = rest.get(1..).unwrap_or_default(),
            _ => return Err(early()),
        }
    }
    if rest.windows(2).any(|pair| pair == [0xff, 0xd9]) { Ok(()) } else { Err(early()) }
}

/// Checks that an uncompressed BMP is as long as its pixels.
fn check_length_of_bmp(source: &mut Source<'_>, length: u64) -> Result<(), DecodeError> {
    let mut head = Vec::new();
    source.by_ref().take(34).read_to_end(&mut head)?;
    source.seek(SeekFrom::Start(0))?;
    let word =
        |at: usize| head.get(at..at + 4).and_then(|bytes| bytes.try_into().ok()).map(u32::from_le_bytes);
    let (Some(head_size), Some(width), Some(height), Some(compression)) =
        (word(14), word(18), word(22), word(30))
    else {
        return Ok(());
    };
    let bits = word(28).map_or(0, |bits| u64::from(bits & 0xffff));
    // The header of OS/2 is shorter; run lengths have no bound, since they may leave the rest out.
    if head_size < 40 || !matches!(compression, 0 | 3 | 6) {
        return Ok(());
    }
    let (width, height) = (u64::from(width), u64::from((height as i32).unsigned_abs()));
    let declared = (width * bits).div_ceil(32).saturating_mul(4).saturating_mul(height);
    check_length(declared, length, 1)
}

/// What a decoder's error means.
pub(super) fn refusal(format: PictureFormat, error: ImageError) -> DecodeError {
    let corrupt = |reason: String| DecodeError::Corrupt { format: format.name(), reason };
    // The whole error begins with words that are said already.
    let reason = error.source().map_or_else(|| error.to_string(), ToString::to_string);
    match error {
        ImageError::IoError(error) if error.kind() == ErrorKind::UnexpectedEof => {
            corrupt("the file ends too early".to_owned())
        }
        ImageError::IoError(error) if error.kind() == ErrorKind::InvalidData => corrupt(error.to_string()),
        ImageError::IoError(error) => DecodeError::Io(error),
        ImageError::Unsupported(_) => DecodeError::Unsupported {
            reason: format!("this kind of {} is not read: {reason}", format.name()),
        },
        _ => corrupt(reason),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Exif orientation by the tables of the standard (CIPA DC-008, 4.6.5.1, tag 274): which corner the first stored
    /// row and column lie at.
    #[test]
    fn stored_rows_and_columns_lie_where_exif_says() {
        let (width, height) = (3, 2);
        // The place of the first stored pixel, and that of the next one in its row.
        for (exif, first, next) in [
            (1, [0, 0], [1, 0]),
            (2, [2, 0], [1, 0]),
            (3, [2, 1], [1, 1]),
            (4, [0, 1], [1, 1]),
            (5, [0, 0], [0, 1]),
            (6, [1, 0], [1, 1]),
            (7, [1, 2], [1, 1]),
            (8, [0, 2], [0, 1]),
        ] {
            let orientation = Orientation::from_exif(exif).unwrap();
            let placed = UprightMapping { width, height, orientation };
            assert_eq!((placed.upright(0, 0), placed.upright(1, 0)), (first, next), "{exif}");
            assert_eq!(placed.size(), if exif < 5 { [3, 2] } else { [2, 3] });
            let [across, down] = placed.size();
            let all = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
            let mut places: Vec<_> = all.map(|(x, y)| placed.upright(x, y)).collect();
            assert!(places.iter().all(|[x, y]| *x < across && *y < down));
            places.sort_unstable();
            places.dedup();
            assert_eq!(places.len(), 6, "no two at one place");
        }
    }
}
