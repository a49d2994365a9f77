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

/// A PFM of this head with these numbers, the largest byte of each first.
pub fn pfm(head: &[u8], values: &[f32]) -> Vec<u8> {
    head.iter().copied().chain(values.iter().flat_map(|value| value.to_be_bytes())).collect()
}

/// The color of an index in the palette of [`palette_tiff`], codes of 8 bits.
pub fn palette_color(index: usize) -> [u16; 3] {
    [index * 5 % 256, 255 - index * 3 % 256, index * 7 % 256].map(|code| code as u16)
}

/// The index at column `x`, row `y` of [`palette_tiff`].
pub fn palette_index(x: usize, y: usize, bits: usize) -> usize {
    (x * 3 + y * 5) % (1 << bits)
}

/// An uncompressed little-endian TIFF with a palette and two strips, as TIFF 6.0 says, section 5.
pub fn palette_tiff(width: usize, height: usize, bits: usize) -> Vec<u8> {
    let row = |y: usize| {
        let mut bytes = vec![0_u8; (width * bits).div_ceil(8)];
        for x in 0..width {
            let at = x * bits;
            bytes[at / 8] |= (palette_index(x, y, bits) << (8 - bits - at % 8)) as u8;
        }
        bytes
    };
    let (first, rest) = (height / 2 + 1, height - height / 2 - 1);
    let strips = [0..first, first..height].map(|rows| rows.flat_map(row).collect::<Vec<u8>>());
    let colors: Vec<_> = (0..1 << bits).map(palette_color).collect();
    let map: Vec<u8> = (0..3)
        .flat_map(|channel| colors.iter().flat_map(move |color| (color[channel] * 257).to_le_bytes()))
        .collect();
    let [top, bottom] = &strips;
    assert!(rest > 0);
    // Behind the head: the strips, the palette, two tables of two offsets, the directory.
    let map_at = 8 + top.len() + bottom.len();
    let tables_at = map_at + map.len();
    let directory_at = tables_at + 16;
    let mut file = b"II\x2a\0".to_vec();
    file.extend((directory_at as u32).to_le_bytes());
    file.extend([top.as_slice(), bottom, &map].concat());
    for number in [8, 8 + top.len(), top.len(), bottom.len()] {
        file.extend((number as u32).to_le_bytes());
    }
    let tags = [
        (256, 3, 1, width),
        (257, 3, 1, height),
        (258, 3, 1, bits),
        (259, 3, 1, 1),
        (262, 3, 1, 3),
        (273, 4, 2, tables_at),
        (277, 3, 1, 1),
        (278, 3, 1, first),
        (279, 4, 2, tables_at + 8),
        (320, 3, 3 << bits, map_at),
    ];
    file.extend((tags.len() as u16).to_le_bytes());
    for (tag, kind, count, value) in tags {
        file.extend((tag as u16).to_le_bytes());
        file.extend((kind as u16).to_le_bytes());
        file.extend((count as u32).to_le_bytes());
        file.extend((value as u32).to_le_bytes());
    }
    file.extend([0; 4]);
    file
}
