//! EXR bytes to linear light.

use std::collections::HashSet;
use std::io::{Read, Seek};
use std::panic::{AssertUnwindSafe, catch_unwind};

use exr::block::UncompressedBlock;
use exr::block::reader::{ChunksReader, Reader};
use exr::compression::Compression;
use exr::math::Vec2;
use exr::meta::attribute::{ChannelDescription, SampleType};
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use exr::prelude::f16;

use super::{DecodeError, check_length};
use crate::picture::Picture;

/// The first bytes of every EXR file ("OpenEXR File Layout", magic number 20000630).
pub(super) const MAGIC: [u8; 4] = exr::meta::magic_number::BYTES;

/// Decodes an EXR of `length` bytes. Sizes are checked before the decoder may allocate by them; should it
/// still panic, that is caught here (the panic's message appears on the standard error stream).
pub(super) fn decode_exr(source: impl Read + Seek, length: u64) -> Result<Picture, DecodeError> {
    catch_unwind(AssertUnwindSafe(|| decode_parts(source, length)))
        .unwrap_or(Err(DecodeError::Breakdown { format: "EXR" }))
}

fn decode_parts(source: impl Read + Seek, length: u64) -> Result<Picture, DecodeError> {
    let reader = Reader::read_from_buffered(source, false)?;
    let size = check_tables(reader.meta_data(), length)?;
    let (part, columns) = choose(reader.headers())?;
    let header = reader.headers().get(part).ok_or_else(|| corrupt("no part"))?;
    let (width, height) = check_header(header, length, size)?;

    let chunks = reader
        .filter_chunks(false, |_, tile, block| block.layer == part && tile.is_largest_resolution_level())?;
    let mut picture = Picture::new(width, height)?;
    let mut missing = chunks.expected_chunk_count();
    let mut seen = HashSet::new();
    let mut blocks = chunks.sequential_decompressor(false);
    while let Some(block) = blocks.decompress_next_block() {
        let block = block?;
        let place = (block.index.pixel_position.0, block.index.pixel_position.1);
        if block.index.layer != part || block.index.level != Vec2(0, 0) || !seen.insert(place) {
            return Err(corrupt("a block of pixels is not where the table says"));
        }
        let channels = &blocks.meta_data().headers.get(part).ok_or_else(|| corrupt("no part"))?.channels.list;
        fill(&mut picture, &block, channels, columns)?;
        missing = missing.saturating_sub(1);
    }
    if missing == 0 { Ok(picture) } else { Err(corrupt("blocks of pixels are missing")) }
}

/// Every block needs an 8-byte offset in the file; the decoder takes memory by their number.
/// Returns the number of bytes in all parts' tables.
fn check_tables(meta: &MetaData, length: u64) -> Result<u64, DecodeError> {
    let blocks = meta.headers.iter().fold(0_u64, |sum, header| sum.saturating_add(header.chunk_count as u64));
    let bytes = blocks.saturating_mul(8);
    if bytes > length {
        return Err(corrupt("the table of blocks is longer than the file"));
    }
    Ok(bytes)
}

/// The channels to take as red, green and blue, by their place in the part's list.
type Columns = [usize; 3];

/// The first part that has R, G and B (or else the first that has Y), and which channels these are.
fn choose(parts: &[Header]) -> Result<(usize, Columns), DecodeError> {
    let of_all = |find: fn(&[ChannelDescription]) -> Option<Columns>| {
        let mut found = parts.iter().enumerate().filter(|(_, part)| !part.deep);
        found.find_map(|(index, part)| Some((index, find(&part.channels.list)?)))
    };
    of_all(find_rgb).or_else(|| of_all(find_gray)).ok_or_else(|| {
        let names = parts.iter().flat_map(|part| &part.channels.list).take(20).map(|c| c.name.to_string());
        let names = names.collect::<Vec<_>>().join(", ");
        unsupported(format!("the EXR picture has neither the channels R, G, B nor Y alone, but: {names}"))
    })
}

/// R, G and B with a common prefix that is empty or a layer's name with a dot; the plain ones are preferred.
fn find_rgb(channels: &[ChannelDescription]) -> Option<Columns> {
    let place = |name: &str| channels.iter().position(|channel| channel.name.eq(name));
    let group = |prefix: &str| {
        let place = |letter: &str| place(&format!("{prefix}{letter}"));
        Some([place("R")?, place("G")?, place("B")?])
    };
    group("").or_else(|| {
        let names = channels.iter().map(|channel| channel.name.to_string());
        let mut prefixes = names.filter_map(|name| name.strip_suffix(".R").map(|layer| format!("{layer}.")));
        prefixes.find_map(|prefix| group(&prefix))
    })
}

/// Y as gray, unless chroma channels say that it is only a part of the color.
fn find_gray(channels: &[ChannelDescription]) -> Option<Columns> {
    let place = |name: &str| channels.iter().position(|channel| channel.name.eq(name));
    let chroma = place("RY").or(place("BY"));
    place("Y").filter(|_| chroma.is_none()).map(|y| [y; 3])
}

/// Checks everything that memory is taken by: the picture's size, its blocks, their bytes.
fn check_header(header: &Header, length: u64, table: u64) -> Result<(u32, u32), DecodeError> {
    let side = |pixels: usize| u32::try_from(pixels).unwrap_or(u32::MAX);
    let (width, height) = (side(header.layer_size.width()), side(header.layer_size.height()));
    let pixels = Picture::check_size(width, height)? as u64;
    if header.channels.list.iter().any(|channel| channel.sampling != Vec2(1, 1)) {
        return Err(unsupported("the EXR picture has subsampled channels; write it without them"));
    }
    let declared = pixels.saturating_mul(header.channels.bytes_per_pixel as u64);
    // The coefficients of DWA are run-length coded before they are deflated, so no such bound holds there.
    if !matches!(header.compression, Compression::DWAA(_) | Compression::DWAB(_)) {
        check_length(declared, length.saturating_sub(table))?;
    }
    if let BlockDescription::Tiles(tiles) = header.blocks {
        let largest = tiles.tile_size.width().max(tiles.tile_size.height());
        if largest > Picture::MAX_SIDE as usize {
            return Err(corrupt("its tiles are larger than any picture"));
        }
    }
    Ok((width, height))
}

/// Copies the chosen channels of one block into the picture.
fn fill(
    picture: &mut Picture,
    block: &UncompressedBlock,
    channels: &[ChannelDescription],
    columns: Columns,
) -> Result<(), DecodeError> {
    let Vec2(left, top) = block.index.pixel_position;
    let Vec2(width, height) = block.index.pixel_size;
    let bytes_per_pixel: usize = channels.iter().map(|channel| channel.sample_type.bytes_per_sample()).sum();
    let line_bytes = (bytes_per_pixel * width).max(1);
    for (y, line) in block.data.chunks_exact(line_bytes).take(height).enumerate() {
        let row = picture.rows_mut().nth(top + y).and_then(|row| row.get_mut(left..left + width));
        let row = row.ok_or_else(|| corrupt("a block of pixels lies outside the picture"))?;
        // In a line, the samples of one channel follow those of the one before.
        let mut rest = line;
        for (index, channel) in channels.iter().enumerate() {
            let (samples, next) = rest
                .split_at_checked(channel.sample_type.bytes_per_sample() * width)
                .ok_or_else(|| corrupt("a block of pixels is too short"))?;
            rest = next;
            for (color, &column) in columns.iter().enumerate() {
                if column == index {
                    let targets = row.iter_mut().filter_map(|pixel| pixel.get_mut(color));
                    copy(samples, channel.sample_type, targets);
                }
            }
        }
    }
    Ok(())
}

/// Converts the samples of one channel in one line, which the decoder left in the machine's byte order.
fn copy<'p>(samples: &[u8], kind: SampleType, targets: impl Iterator<Item = &'p mut f32>) {
    let (pairs, _) = samples.as_chunks::<2>();
    let (quads, _) = samples.as_chunks::<4>();
    match kind {
        SampleType::F16 => {
            targets.zip(pairs).for_each(|(to, from)| *to = f16::from_ne_bytes(*from).to_f32());
        }
        SampleType::F32 => targets.zip(quads).for_each(|(to, from)| *to = f32::from_ne_bytes(*from)),
        SampleType::U32 => targets.zip(quads).for_each(|(to, from)| *to = u32::from_ne_bytes(*from) as f32),
    }
}

fn corrupt(reason: impl Into<String>) -> DecodeError {
    DecodeError::Corrupt { format: "EXR", reason: reason.into() }
}

fn unsupported(reason: impl Into<String>) -> DecodeError {
    DecodeError::Unsupported { reason: reason.into() }
}

impl From<exr::error::Error> for DecodeError {
    fn from(error: exr::error::Error) -> DecodeError {
        match error {
            exr::error::Error::Io(error) => DecodeError::Io(error),
            exr::error::Error::NotSupported(what) => {
                unsupported(format!("this kind of EXR is not read: {what}"))
            }
            other => corrupt(other.to_string()),
        }
    }
}
