//! EXR bytes to linear light.

use std::collections::HashSet;

use exr::block::UncompressedBlock;
use exr::block::chunk::{Chunk, CompressedBlock};
use exr::block::reader::{ChunksReader, Reader};
use exr::compression::Compression;
use exr::math::Vec2;
use exr::meta::attribute::{ChannelDescription, SampleType};
use exr::meta::header::Header;
use exr::meta::{BlockDescription, MetaData};
use exr::prelude::f16;

use super::dwa::check_dwa;
use super::layers::{ChannelIndices, Layer, choose};
use super::limits::{DEFLATE, check_length, check_memory};
use super::{DecodeError, ReadOptions, Source};
use crate::picture::Picture;

/// The most bytes that DWA makes of one: its coefficients are run-length coded before they are deflated, so that two
/// bytes of a symbol may stand for a block of 64 samples of four bytes.
const DWA: u64 = DEFLATE / 2 * 64 * 4;

/// The sizes in single bytes of what the decoder works on for one block, relative to the block: the chunk, the
/// decompressed bytes and their order undone; for DWA, blocks of three channels of floats as well.
const WORK: u64 = 4;
const WORK_OF_DWA: u64 = 12;

/// Decodes an EXR of `length` bytes. Sizes are checked before the decoder may allocate by them.
pub(super) fn decode_exr(
    source: Source<'_>,
    length: u64,
    options: &ReadOptions,
) -> Result<Picture, DecodeError> {
    let reader = Reader::read_from_buffered(source, false)?;
    let table = check_tables(reader.meta_data(), length)?;
    let Layer { part, columns, .. } = choose(reader.headers(), options.layer.as_deref())?;
    let header = reader.headers().get(part).ok_or_else(|| corrupt("no part"))?;
    let (width, height) = check_header(header, length.saturating_sub(table), options)?;

    let mut chunks = reader
        .filter_chunks(false, |_, tile, block| block.layer == part && tile.is_largest_resolution_level())?;
    let mut picture = Picture::new(width, height)?;
    let mut missing = chunks.expected_chunk_count();
    let mut seen = HashSet::new();
    while let Some(chunk) = chunks.read_next_chunk() {
        let meta = chunks.meta_data();
        let header = meta.headers.get(part).ok_or_else(|| corrupt("no part"))?;
        let chunk = chunk?;
        check_chunk(&chunk, part, header)?;
        let block = UncompressedBlock::decompress_chunk(chunk, meta, false)?;
        let place = (block.index.pixel_position.0, block.index.pixel_position.1);
        if block.index.layer != part || block.index.level != Vec2(0, 0) || !seen.insert(place) {
            return Err(misplaced());
        }
        fill(&mut picture, &block, &header.channels.list, columns)?;
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

/// Checks everything that memory is taken by: the picture's size, its blocks, their bytes. `length` is that of the file
/// without the tables of blocks.
fn check_header(header: &Header, length: u64, options: &ReadOptions) -> Result<(u32, u32), DecodeError> {
    let side = |pixels: usize| u32::try_from(pixels).unwrap_or(u32::MAX);
    let (width, height) = (side(header.layer_size.width()), side(header.layer_size.height()));
    let pixels = options.check_size(width, height)? as u64;
    if header.channels.list.iter().any(|channel| channel.sampling != Vec2(1, 1)) {
        return Err(unsupported("the EXR picture has subsampled channels; write it without them"));
    }
    let declared = pixels.saturating_mul(header.channels.bytes_per_pixel as u64);
    let most = match header.compression {
        Compression::Uncompressed => 1,
        Compression::DWAA(_) | Compression::DWAB(_) => DWA,
        _ => DEFLATE,
    };
    check_length(declared, length, most)?;
    if let BlockDescription::Tiles(tiles) = header.blocks {
        let largest = tiles.tile_size.width().max(tiles.tile_size.height());
        if largest > Picture::MAX_SIDE as usize {
            return Err(corrupt("its tiles are larger than any picture"));
        }
    }
    // A chunk's memory is taken by its own claim, which may be as long as a whole block, before it is read.
    let block = header.max_block_byte_size() as u64;
    let work = block.min(declared).saturating_mul(if most == DWA { WORK_OF_DWA } else { WORK });
    check_memory(width, height, work.saturating_add(block.min(i32::MAX as u64)))?;
    Ok((width, height))
}

/// Checks that a chunk is of the part, and what a compressed one claims of itself.
fn check_chunk(chunk: &Chunk, part: usize, header: &Header) -> Result<(), DecodeError> {
    if chunk.layer_index != part {
        return Err(misplaced());
    }
    if !matches!(header.compression, Compression::DWAA(_) | Compression::DWAB(_)) {
        return Ok(());
    }
    let bytes = match &chunk.compressed_block {
        CompressedBlock::ScanLine(block) => &block.compressed_pixels_le,
        CompressedBlock::Tile(block) => &block.compressed_pixels_le,
        _ => return Err(unsupported("deep EXR pictures are not read; flatten it")),
    };
    let size = header
        .get_absolute_block_pixel_coordinates(header.get_block_data_indices(&chunk.compressed_block)?)?
        .size;
    let channels = header.channels.list.len() as u64;
    let blocks = size.width().div_ceil(8) as u64 * size.height().div_ceil(8) as u64 * channels;
    check_dwa(bytes, size.area() as u64 * header.channels.bytes_per_pixel as u64, blocks)
}

fn misplaced() -> DecodeError {
    corrupt("a block of pixels is not where the table says")
}

/// Copies the chosen channels of one block into the picture.
fn fill(
    picture: &mut Picture,
    block: &UncompressedBlock,
    channels: &[ChannelDescription],
    columns: ChannelIndices,
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
