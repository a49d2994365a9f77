//! TIFF to linear light: pictures with a palette, gray of few bits and gray light by the `tiff` crate, all others by `image`.

use std::io::{self, ErrorKind, Read, Seek, SeekFrom};

use image::codecs::tiff::TiffDecoder;
use image::metadata::Orientation;
use tiff::decoder::{Decoder, Limits};
use tiff::tags::Tag;
use tiff::{ColorType, TiffError};

use super::decode_image::{UprightMapping, WORK, picture_of, refusal};
use super::limits::check_memory;
use super::transfer::Transfer;
use super::{DecodeError, ReadOptions, Source};
use crate::format::PictureFormat;
use crate::picture::{Picture, SizeError};

const FORMAT: PictureFormat = PictureFormat::Tiff;

/// Photometric interpretations of TIFF 6.0, section 8: 0 is white, 0 is black, an index into the palette.
const WHITE_IS_ZERO: u32 = 0;
const BLACK_IS_ZERO: u32 = 1;
const PALETTE: u32 = 3;

/// The most tags of a picture; the specification has about a hundred.
const MOST_TAGS: u64 = 4096;

/// Decodes the first picture of a file.
pub(super) fn decode_tiff(mut source: Source<'_>, options: &ReadOptions) -> Result<Picture, DecodeError> {
    let tags = CodeTags::read(&mut source)?;
    source.seek(SeekFrom::Start(0))?;
    match tags {
        Some(tags) if tags.is_one_channel_of_ours() => decode_channel(source, &tags, options),
        _ => picture_of(TiffDecoder::new(source).map_err(|error| refusal(FORMAT, error))?, FORMAT, options),
    }
}

/// The tags of the first picture that say what its codes mean.
#[derive(Debug, Default)]
struct CodeTags {
    photometric: u32,
    /// Where the least byte of the photometric interpretation stands in the file.
    photometric_place: u64,
    bits: u32,
    is_float: bool,
}

impl CodeTags {
    /// Reads them from the first directory; `None` where there is none that can be read.
    fn read(source: &mut Source<'_>) -> io::Result<Option<Self>> {
        let mut head = [0; 16];
        if !fill(source, &mut head)? {
            return Ok(None);
        }
        let is_little = head.starts_with(b"II");
        let number = |bytes: &[u8]| {
            let add = |sum: u64, byte: &u8| (sum << 8) | u64::from(*byte);
            if is_little { bytes.iter().rev().fold(0, add) } else { bytes.iter().fold(0, add) }
        };
        // BigTIFF has longer offsets and counts.
        let is_big = number(&head[2..4]) == 43;
        let (directory, count_size, entry_size, value_at) =
            if is_big { (number(&head[8..16]), 8, 20, 12) } else { (number(&head[4..8]), 2, 12, 8) };
        source.seek(SeekFrom::Start(directory))?;
        let (mut count, mut entry) = ([0; 8], [0; 20]);
        let (count, entry) = (&mut count[..count_size], &mut entry[..entry_size]);
        if !fill(source, count)? || number(count) > MOST_TAGS {
            return Ok(None);
        }
        let mut tags = Self { bits: 1, ..Self::default() };
        for index in 0..number(count) {
            if !fill(source, entry)? {
                return Ok(None);
            }
            let size = match number(&entry[2..4]) {
                1 => 1,
                3 => 2,
                4 => 4,
                _ => continue,
            };
            let value = number(&entry[value_at..value_at + size]) as u32;
            let least = if is_little { 0 } else { size as u64 - 1 };
            let start = directory.saturating_add(count_size as u64 + index * entry_size as u64);
            match (number(&entry[..2]) as u16, number(&entry[4..value_at])) {
                (258, 1) => tags.bits = value,
                (262, 1) => {
                    tags.photometric = value;
                    tags.photometric_place = start.saturating_add(value_at as u64 + least);
                }
                // More samples to a pixel.
                (277, 1) if value != 1 => return Ok(None),
                (339, 1) => tags.is_float = value == 3,
                _ => {}
            }
        }
        Ok(Some(tags))
    }

    fn is_one_channel_of_ours(&self) -> bool {
        match self.photometric {
            PALETTE => matches!(self.bits, 1 | 2 | 4 | 8 | 16) && !self.is_float,
            WHITE_IS_ZERO | BLACK_IS_ZERO if self.is_float => self.bits == 32,
            WHITE_IS_ZERO | BLACK_IS_ZERO => matches!(self.bits, 2 | 4),
            _ => false,
        }
    }
}

/// Fills `bytes` from the file; `false` where it ends before.
fn fill(source: &mut Source<'_>, bytes: &mut [u8]) -> io::Result<bool> {
    match source.read_exact(bytes) {
        Err(error) if error.kind() == ErrorKind::UnexpectedEof => Ok(false),
        other => other.map(|()| true),
    }
}

/// A file with a byte replaced.
struct PatchedSource<'s> {
    source: Source<'s>,
    position: u64,
    place: u64,
    byte: u8,
}

impl Read for PatchedSource<'_> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let count = self.source.read(bytes)?;
        let at = self.place.checked_sub(self.position).and_then(|at| usize::try_from(at).ok());
        if let Some(byte) = at.filter(|at| *at < count).and_then(|at| bytes.get_mut(at)) {
            *byte = self.byte;
        }
        self.position += count as u64;
        Ok(count)
    }
}

impl Seek for PatchedSource<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.position = self.source.seek(to)?;
        Ok(self.position)
    }
}

/// Decodes the only channel. The decoder refuses palettes, but hands out indices as what they look like: gray.
fn decode_channel(
    source: Source<'_>,
    tags: &CodeTags,
    options: &ReadOptions,
) -> Result<Picture, DecodeError> {
    let is_palette = tags.photometric == PALETTE;
    let byte = (if is_palette { BLACK_IS_ZERO } else { tags.photometric }) as u8;
    let source = PatchedSource { source, position: 0, place: tags.photometric_place, byte };
    let mut decoder = Decoder::new(source).map_err(refused)?;
    let (width, height) = decoder.dimensions().map_err(refused)?;
    options.check_size(width, height)?;
    let color = decoder.colortype().map_err(refused)?;
    if !matches!(color, ColorType::Gray(bits) if u32::from(bits) == tags.bits) {
        return Err(corrupt(format!("its pixels are {color:?}")));
    }
    let layout = decoder.image_buffer_layout().map_err(refused)?;
    let bytes = layout.complete_len as u64;
    check_memory(width, height, bytes.saturating_mul(WORK))?;
    let most = layout.complete_len.saturating_mul(WORK as usize).saturating_add(64 << 20);
    let mut limits = Limits::default();
    (limits.decoding_buffer_size, limits.intermediate_buffer_size) = (most, most);
    let mut decoder = decoder.with_limits(limits);
    let light = if is_palette {
        palette(&decoder.get_tag_u16_vec(Tag::ColorMap).map_err(refused)?, tags.bits)?
    } else {
        let most = (1_u16 << tags.bits.min(8)) - 1;
        Transfer::Srgb.table(most).into_iter().map(|gray| [gray; 3]).collect()
    };
    let orientation = decoder.find_tag_unsigned::<u8>(Tag::Orientation).ok().flatten();
    let orientation = orientation.and_then(Orientation::from_exif).unwrap_or(Orientation::NoTransforms);
    let memory = || SizeError::Memory { width, height, bytes };
    let mut codes: Vec<u8> =
        bytemuck::allocation::try_zeroed_vec(layout.complete_len).map_err(|()| memory())?;
    decoder.read_image_bytes(&mut codes).map_err(refused)?;
    let stride = layout.row_stride.map_or(1, usize::from);
    let places = codes.chunks_exact(stride).flat_map(|row| (0..width as usize).map(move |x| (row, x)));
    let placed = UprightMapping { width, height, orientation };
    if tags.is_float {
        return placed.fill(places, |(row, x)| [f32::from_ne_bytes(sample(row, x)); 3]);
    }
    let bits = tags.bits as usize;
    placed.fill(places, |(row, x)| {
        let index = match bits {
            16 => usize::from(u16::from_ne_bytes(sample(row, x))),
            _ => packed(row, x, bits),
        };
        light.get(index).copied().unwrap_or_default()
    })
}

/// The sample of `N` bytes at column `x`.
fn sample<const N: usize>(row: &[u8], x: usize) -> [u8; N] {
    row.as_chunks().0.get(x).copied().unwrap_or([0; N])
}

/// The sample of so many bits, a divisor of 8, at column `x`: the first one has the highest bits.
fn packed(row: &[u8], x: usize, bits: usize) -> usize {
    let byte = row.get(x * bits / 8).copied().map_or(0, usize::from);
    (byte >> (8 - bits - x * bits % 8)) & ((1 << bits) - 1)
}

/// The light of the colors of a map: all reds, then all greens, then all blues, codes of 16 bits.
fn palette(map: &[u16], bits: u32) -> Result<Vec<[f32; 3]>, DecodeError> {
    let count = 1 << bits;
    let (Some(red), Some(green), Some(blue)) =
        (map.get(..count), map.get(count..2 * count), map.get(2 * count..3 * count))
    else {
        return Err(corrupt("the palette is too short".to_owned()));
    };
    // Some programs put codes of 8 bits into the upper halves alone, so that white is 0xff00, and old ones into the lower.
    let (most, shift) = if map.iter().all(|code| *code < 256) {
        (255, 0)
    } else if map.iter().all(|code| code % 256 == 0) {
        (255, 8)
    } else {
        (65_535, 0)
    };
    let light = Transfer::Srgb.table(most);
    let value = |code: &u16| light.get(usize::from(code >> shift)).copied().unwrap_or_default();
    let colors = red.iter().zip(green).zip(blue);
    Ok(colors.map(|((red, green), blue)| [value(red), value(green), value(blue)]).collect())
}

fn corrupt(reason: String) -> DecodeError {
    DecodeError::Corrupt { format: FORMAT.name(), reason }
}

/// What a decoder's error means.
fn refused(error: TiffError) -> DecodeError {
    match error {
        TiffError::IoError(error) if error.kind() == ErrorKind::UnexpectedEof => {
            corrupt("the file ends too early".to_owned())
        }
        // Decoders of streams say so of data, too.
        TiffError::IoError(error) => corrupt(error.to_string()),
        TiffError::UnsupportedError(reason) => {
            DecodeError::Unsupported { reason: format!("this kind of TIFF is not read: {reason}") }
        }
        other => corrupt(other.to_string()),
    }
}
