//! EXR bytes of a picture's linear light.

use std::io::Cursor;

use catoptric_platform::files::Sink;
use exr::block::chunk::{Chunk, CompressedBlock, CompressedScanLineBlock};
use exr::block::writer::ChunksWriter;
use exr::compression::Compression;
use exr::math::Vec2;
use exr::meta::BlockDescription;
use exr::meta::attribute::{ChannelDescription, Chromaticities, LineOrder, SampleType, Text};
use exr::meta::header::{Header, LayerAttributes};
use flate2::{Compress, FlushCompress};
use rayon::prelude::*;

use super::EncodeError;
use crate::picture::Picture;

/// Rows that are compressed together, as ZIP has it.
const ROWS: usize = 16;

/// The level of Deflate. See "Writing pictures" in BENCHMARKS.md for what others take and give.
const LEVEL: u32 = 1;

/// Blocks that a thread compresses before what is there is written, so that little of it waits in memory.
const BLOCKS_OF_THREAD: usize = 8;

/// The picture as the bytes of an OpenEXR file: channels R, G, B in linear light, 32-bit floats, as they are
/// (also negative, infinite and NaN), compressed without loss (ZIP, 16 lines) on all threads.
///
/// Attributes: Rec. 709 chromaticities with white D65, `software` = `Catoptric`. The same picture gives the
/// same bytes: no date, no machine, no matter how many threads.
///
/// # Errors
/// None is known for a [`Picture`]; the encoder's refusals are passed on.
pub fn encode_exr(picture: &Picture) -> Result<Vec<u8>, EncodeError> {
    encode_exr_at(picture, LEVEL)
}

/// The bytes of [`encode_exr`] by another level of Deflate, 0 (as they are) to 9 (slow); for measuring.
///
/// # Errors
/// Those of [`encode_exr`].
pub fn encode_exr_at(picture: &Picture, level: u32) -> Result<Vec<u8>, EncodeError> {
    let mut bytes = Cursor::new(Vec::new());
    write_at(&mut bytes, picture, level.min(9))?;
    Ok(bytes.into_inner())
}

/// Writes the bytes of [`encode_exr`]; the sink should be buffered.
pub(crate) fn encode_exr_to(sink: &mut dyn Sink, picture: &Picture) -> Result<(), EncodeError> {
    write_at(sink, picture, LEVEL)
}

fn write_at(sink: &mut dyn Sink, picture: &Picture, level: u32) -> Result<(), EncodeError> {
    let headers = std::iter::once(header(picture)).collect();
    let written = exr::block::write(sink, headers, true, |_, writer| {
        let batch = ROWS * BLOCKS_OF_THREAD * rayon::current_num_threads();
        let width = picture.width() as usize;
        let mut index = 0;
        for rows in picture.pixels().chunks(batch * width) {
            let blocks = rows.par_chunks(ROWS * width);
            let blocks: Vec<_> =
                blocks.map_init(|| Compressor::new(level), |own, rows| own.block(rows, width)).collect();
            for compressed_pixels_le in blocks {
                let y_coordinate = (ROWS * index) as i32;
                let block =
                    CompressedScanLineBlock { y_coordinate, compressed_pixels_le: compressed_pixels_le? };
                let chunk = Chunk { layer_index: 0, compressed_block: CompressedBlock::ScanLine(block) };
                writer.write_chunk(index, chunk)?;
                index += 1;
            }
        }
        Ok(())
    });
    written.map_err(|error| match error {
        exr::error::Error::Io(error) => EncodeError::Io(error),
        other => EncodeError::Refused { format: "EXR", reason: other.to_string() },
    })
}

fn header(picture: &Picture) -> Header {
    let size = (picture.width() as usize, picture.height() as usize);
    let channels = ["B", "G", "R"].map(|name| ChannelDescription::new(name, SampleType::F32, false));
    let mut header = Header::new(Text::default(), size, channels.into_iter().collect()).with_encoding(
        Compression::ZIP16,
        BlockDescription::ScanLines,
        LineOrder::Increasing,
    );
    let software_name = Text::new_or_none("Catoptric");
    header.own_attributes = LayerAttributes { software_name, ..LayerAttributes::default() };
    header.shared_attributes.chromaticities = Some(Chromaticities {
        red: Vec2(0.64, 0.33),
        green: Vec2(0.30, 0.60),
        blue: Vec2(0.15, 0.06),
        white: Vec2(0.3127, 0.3290),
    });
    header
}

/// Compresses blocks of rows as ZIP has it (OpenEXR's internal_zip.c): the even bytes, then the odd ones, each byte as
/// its difference from the one before plus 128, and Deflate.
struct Compressor {
    deflate: Compress,
    /// The bytes of the rows as a file has them: little-endian, of each row all of blue, then green, then red.
    bytes: Vec<u8>,
    /// The bytes of `bytes` in the order in which they are compressed.
    sorted: Vec<u8>,
}

impl Compressor {
    fn new(level: u32) -> Self {
        let deflate = Compress::new(flate2::Compression::new(level), true);
        Self { deflate, bytes: Vec::new(), sorted: Vec::new() }
    }

    /// The compressed bytes of some rows of this width, or as they are if that is shorter.
    fn block(&mut self, rows: &[[f32; 3]], width: usize) -> exr::error::Result<Vec<u8>> {
        self.bytes.clear();
        for row in rows.chunks(width) {
            for channel in [2, 1, 0] {
                self.bytes.extend(row.iter().flat_map(|pixel| pixel[channel].to_le_bytes()));
            }
        }
        self.sorted.clear();
        let (pairs, _) = self.bytes.as_chunks::<2>();
        self.sorted.extend(pairs.iter().map(|pair| pair[0]));
        self.sorted.extend(pairs.iter().map(|pair| pair[1]));
        let mut before = 0;
        for byte in &mut self.sorted {
            let own = *byte;
            *byte = own.wrapping_sub(before).wrapping_add(128);
            before = own;
        }
        if let (Some(first), Some(own)) = (self.sorted.first_mut(), self.bytes.first()) {
            *first = *own;
        }
        self.deflate.reset();
        let mut compressed = Vec::with_capacity(self.sorted.len());
        let status = self.deflate.compress_vec(&self.sorted, &mut compressed, FlushCompress::Finish);
        match status {
            Ok(flate2::Status::StreamEnd) if compressed.len() < self.bytes.len() => Ok(compressed),
            // Bytes that do not become fewer stay as they are; readers know them by their length.
            Ok(_) => Ok(self.bytes.clone()),
            Err(error) => Err(exr::error::Error::Invalid(error.to_string().into())),
        }
    }
}
