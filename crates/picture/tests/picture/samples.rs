//! Files made for the tests of reading.

#![allow(clippy::unwrap_used, reason = "helpers of tests may panic as tests may")]
#![allow(dead_code, unreachable_pub, reason = "every test program uses its part")]

use std::io::Cursor;

use exr::prelude::{
    AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes, WritableImage, f16,
};

/// Encodes samples as they are; `set` adds what a case needs.
pub fn png_of(
    (width, height): (u32, u32),
    color: png::ColorType,
    depth: png::BitDepth,
    data: &[u8],
    set: impl FnOnce(&mut png::Encoder<'_, &mut Vec<u8>>),
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(color);
    encoder.set_depth(depth);
    set(&mut encoder);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(data).unwrap();
    writer.finish().unwrap();
    bytes
}

/// An 8-bit gray PNG with these filtered rows, uncompressed.
pub fn stored_png(width: u32, height: u32, interlace: u8, rows: &[u8]) -> Vec<u8> {
    let mut zlib = vec![0x78, 0x01, 1];
    let length = rows.len() as u16;
    zlib.extend(length.to_le_bytes());
    zlib.extend((!length).to_le_bytes());
    zlib.extend(rows);
    let (mut a, mut b) = (1_u32, 0_u32);
    for &byte in rows {
        a = (a + u32::from(byte)) % 65521;
        b = (b + a) % 65521;
    }
    zlib.extend(((b << 16) | a).to_be_bytes());
    let header = [&width.to_be_bytes()[..], &height.to_be_bytes(), &[8, 0, 0, 0, interlace]].concat();
    let mut png = b"\x89PNG\r\n\x1a\n".to_vec();
    for (name, data) in [(b"IHDR", header), (b"IDAT", zlib), (b"IEND", vec![])] {
        chunk_into(&mut png, name, &data);
    }
    png
}

/// Appends a chunk to a PNG.
pub fn chunk_into(png: &mut Vec<u8>, name: &[u8; 4], data: &[u8]) {
    png.extend((data.len() as u32).to_be_bytes());
    let body = [&name[..], data].concat();
    png.extend(&body);
    png.extend(crc(&body).to_be_bytes());
}

/// A PNG with another chunk right after its header.
pub fn with_chunk(png: &[u8], name: &[u8; 4], data: &[u8]) -> Vec<u8> {
    let (head, rest) = png.split_at(33);
    let mut whole = head.to_vec();
    chunk_into(&mut whole, name, data);
    whole.extend(rest);
    whole
}

pub fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()))
    })
}

/// Encodes an EXR with these channels, 5 × 3 pixels.
pub fn exr_of(channels: &[(&str, FlatSamples)], encoding: Encoding) -> Vec<u8> {
    exr_of_size((5, 3), channels, encoding)
}

/// Encodes an EXR of this size with these channels.
pub fn exr_of_size(size: (usize, usize), channels: &[(&str, FlatSamples)], encoding: Encoding) -> Vec<u8> {
    let list = channels.iter().map(|(name, samples)| AnyChannel::new(*name, samples.clone())).collect();
    let layer = Layer::new(size, LayerAttributes::default(), encoding, AnyChannels::sort(list));
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

/// A DWA file of 50×40 pixels, large enough that its chunks are compressed.
pub fn dwa(compression: exr::prelude::Compression) -> Vec<u8> {
    let wave = |i: usize| f16::from_f32((i as f32 * 0.01).sin().abs() + (i % 50) as f32 * 0.02);
    let samples = FlatSamples::F16((0..2000).map(wave).collect());
    let numbers = FlatSamples::U32((0..2000).map(|i| i / 90).collect());
    let channels = ["A", "B", "G", "R"].map(|name| (name, samples.clone()));
    let channels: Vec<_> = channels.into_iter().chain([("id", numbers)]).collect();
    exr_of_size((50, 40), &channels, Encoding { compression, ..Encoding::SMALL_LOSSLESS })
}

pub fn halves(factor: f32) -> FlatSamples {
    FlatSamples::F16((0..15).map(|i| f16::from_f32(i as f32 * factor)).collect())
}

/// A progressive JPEG of RGB codes.
pub fn progressive_jpeg(rgb: &[u8], width: u16, height: u16) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = jpeg_encoder::Encoder::new(&mut bytes, 90);
    encoder.set_progressive(true);
    encoder.encode(rgb, width, height, jpeg_encoder::ColorType::Rgb).unwrap();
    bytes
}
