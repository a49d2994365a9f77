//! Reading what others wrote: every kind of PNG, half and grey EXR, and files that are broken on purpose.

use std::error::Error;
use std::io::Cursor;

use catoptric_picture::{
    BitDepth, DecodeError, Development, Picture, ReadError, decode, encode_exr, encode_png, read, srgb,
};
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes,
    LineOrder, SmallVec, Text, Vec2, WritableImage, f16,
};

fn linear(code: u32, maximum: u32) -> f32 {
    srgb::decode(f64::from(code) / f64::from(maximum)) as f32
}

/// Encodes samples as they are; `set` adds what a case needs.
fn png_of(
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

#[test]
fn every_color_type_and_depth() {
    use png::{BitDepth as D, ColorType as C};
    let first = |bytes: Vec<u8>| decode(&bytes).unwrap().pixel(0, 0).unwrap();
    let plain = |color, depth, data: &[u8]| first(png_of((1, 1), color, depth, data, |_| {}));
    let grey = |code, maximum| [linear(code, maximum); 3];
    let rgb = |codes: [u32; 3], maximum| codes.map(|code| linear(code, maximum));

    assert_eq!(plain(C::Grayscale, D::One, &[0x80]), [1.0; 3]);
    assert_eq!(plain(C::Grayscale, D::Two, &[0x80]), grey(2, 3));
    assert_eq!(plain(C::Grayscale, D::Four, &[0x70]), grey(7, 15));
    assert_eq!(plain(C::Grayscale, D::Eight, &[100]), grey(100, 255));
    assert_eq!(plain(C::Grayscale, D::Sixteen, &[1, 2]), grey(258, 65535));
    assert_eq!(plain(C::GrayscaleAlpha, D::Eight, &[100, 7]), grey(100, 255));
    assert_eq!(plain(C::GrayscaleAlpha, D::Sixteen, &[1, 2, 0, 0]), grey(258, 65535));
    assert_eq!(plain(C::Rgb, D::Eight, &[1, 2, 3]), rgb([1, 2, 3], 255));
    assert_eq!(plain(C::Rgb, D::Sixteen, &[1, 0, 2, 0, 3, 1]), rgb([256, 512, 769], 65535));
    assert_eq!(plain(C::Rgba, D::Eight, &[1, 2, 3, 0]), rgb([1, 2, 3], 255));
    assert_eq!(plain(C::Rgba, D::Sixteen, &[1, 0, 2, 0, 3, 1, 0, 0]), rgb([256, 512, 769], 65535));
    for (depth, data) in [(D::One, 0x80), (D::Two, 0x40), (D::Four, 0x10), (D::Eight, 1)] {
        let bytes = png_of((1, 1), C::Indexed, depth, &[data], |encoder| {
            encoder.set_palette(vec![0, 0, 0, 10, 20, 30]);
        });
        assert_eq!(first(bytes), rgb([10, 20, 30], 255), "palette at {depth:?}");
    }
    let transparent = png_of((1, 1), C::Rgb, D::Eight, &[1, 2, 3], |encoder| {
        encoder.set_trns(vec![0, 1, 0, 2, 0, 3]);
    });
    assert_eq!(first(transparent), rgb([1, 2, 3], 255));
}

#[test]
fn gamma_counts_only_where_nothing_better_is_said() {
    let with_gamma = |gamma: u32, srgb: bool| {
        let bytes = png_of((1, 1), png::ColorType::Grayscale, png::BitDepth::Eight, &[128], |encoder| {
            encoder.set_source_gamma(png::ScaledFloat::from_scaled(gamma));
            if srgb {
                encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
            }
        });
        decode(&bytes).unwrap().pixel(0, 0).unwrap()[0]
    };
    assert_eq!(with_gamma(100_000, false), (128.0 / 255.0_f64) as f32);
    assert!((with_gamma(50_000, false) - (128.0 / 255.0_f32).powi(2)).abs() < 1e-6);
    assert_eq!(with_gamma(45_455, false), linear(128, 255));
    assert_eq!(with_gamma(100_000, true), linear(128, 255));
}

/// The Adam7 order worked by hand from the figure of the specification, for sizes where passes are empty.
#[test]
fn interlaced_pictures_are_put_together() {
    const PASS: [[u8; 8]; 8] = [
        [1, 6, 4, 6, 2, 6, 4, 6],
        [7, 7, 7, 7, 7, 7, 7, 7],
        [5, 6, 5, 6, 5, 6, 5, 6],
        [7, 7, 7, 7, 7, 7, 7, 7],
        [3, 6, 4, 6, 3, 6, 4, 6],
        [7, 7, 7, 7, 7, 7, 7, 7],
        [5, 6, 5, 6, 5, 6, 5, 6],
        [7, 7, 7, 7, 7, 7, 7, 7],
    ];
    for (width, height) in [(1, 1), (3, 1), (1, 5), (8, 8), (13, 11), (4, 9)] {
        // Written by hand, since the encoder does not interlace: unfiltered rows in a stored deflate block.
        let code = |x: usize, y: usize| (y * 17 + x * 3 + 1) as u8;
        let mut rows = Vec::new();
        for pass in 1..=7 {
            for y in 0..height {
                let line: Vec<u8> =
                    (0..width).filter(|x| PASS[y % 8][x % 8] == pass).map(|x| code(x, y)).collect();
                if !line.is_empty() {
                    rows.push(0);
                    rows.extend(line);
                }
            }
        }
        let picture = decode(&stored_png(width as u32, height as u32, 1, &rows)).unwrap();
        let expected = |x, y| [linear(u32::from(code(x as usize, y as usize)), 255); 3];
        assert!(
            picture == Picture::from_fn(width as u32, height as u32, expected).unwrap(),
            "{width}x{height}"
        );
    }
}

/// An 8-bit grey PNG with these filtered rows, uncompressed.
fn stored_png(width: u32, height: u32, interlace: u8, rows: &[u8]) -> Vec<u8> {
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
        png.extend((data.len() as u32).to_be_bytes());
        let body = [&name[..], &data].concat();
        png.extend(&body);
        png.extend(crc(&body).to_be_bytes());
    }
    png
}

fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |crc, &byte| {
        (0..8).fold(crc ^ u32::from(byte), |crc, _| (crc >> 1) ^ (0xedb8_8320 & (crc & 1).wrapping_neg()))
    })
}

/// Encodes an EXR with these channels, 5 × 3 pixels.
fn exr_of(channels: &[(&str, FlatSamples)], encoding: Encoding) -> Vec<u8> {
    let list = channels.iter().map(|(name, samples)| AnyChannel::new(*name, samples.clone())).collect();
    let layer = Layer::new((5, 3), LayerAttributes::default(), encoding, AnyChannels::sort(list));
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}

fn halves(factor: f32) -> FlatSamples {
    FlatSamples::F16((0..15).map(|i| f16::from_f32(i as f32 * factor)).collect())
}

#[test]
fn exr_channels_of_any_kind_compression_and_tiling() {
    let floats = FlatSamples::F32((0..15).map(|i| i as f32 * 0.1).collect());
    let numbers = FlatSamples::U32((0..15).collect());
    let channels =
        [("A", halves(0.0)), ("B", numbers), ("G", floats), ("R", halves(0.5)), ("Z", halves(9.0))];
    let tiles = Blocks::Tiles(Vec2(2, 2));
    for blocks in [Blocks::ScanLines, tiles] {
        for compression in [Compression::Uncompressed, Compression::RLE, Compression::ZIP1, Compression::PIZ]
        {
            for line_order in [LineOrder::Increasing, LineOrder::Decreasing] {
                let bytes = exr_of(&channels, Encoding { compression, blocks, line_order });
                let picture = decode(&bytes).unwrap();
                let expected = |x, y| {
                    let i = (y * 5 + x) as f32;
                    [i * 0.5, i * 0.1, i]
                };
                assert!(picture == Picture::from_fn(5, 3, expected).unwrap(), "{compression} {blocks:?}");
            }
        }
    }
}

#[test]
fn grey_layers_and_what_is_not_read() {
    let encoding = Encoding::SMALL_LOSSLESS;
    let grey = decode(&exr_of(&[("Y", halves(1.0)), ("Z", halves(2.0))], encoding)).unwrap();
    assert_eq!(grey.pixel(2, 1), Some([7.0; 3]));
    let names = ["depth.Z", "glass.B", "glass.G", "glass.R"];
    let layer = decode(&exr_of(&names.map(|name| (name, halves(1.0))), encoding)).unwrap();
    assert_eq!(layer.pixel(4, 2), Some([14.0; 3]));
    for names in [["BY", "RY", "Y"], ["G", "R", "Z"]] {
        let error = decode(&exr_of(&names.map(|name| (name, halves(1.0))), encoding)).unwrap_err();
        assert!(matches!(&error, DecodeError::Unsupported { .. }), "{error:?}");
        assert!(error.to_string().contains(&names.join(", ")), "{error}");
    }
}

#[test]
fn the_first_part_with_color_is_read() {
    let part = |name: &str, channel: [&str; 3], factor: f32| {
        let list: SmallVec<[_; 4]> =
            channel.iter().map(|channel| AnyChannel::new(*channel, halves(factor))).collect();
        let attributes = LayerAttributes::named(Text::new_or_none(name).unwrap());
        Layer::new((5, 3), attributes, Encoding::FAST_LOSSLESS, AnyChannels::sort(list))
    };
    let parts = [
        part("depth", ["Z", "ZBack", "id"], 1.0),
        part("beauty", ["R", "G", "B"], 2.0),
        part("other", ["R", "G", "B"], 3.0),
    ];
    let bounds = exr::meta::attribute::IntegerBounds::from_dimensions((5, 3));
    let attributes = exr::meta::header::ImageAttributes::new(bounds);
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layers(attributes, parts.to_vec()).write().non_parallel().to_buffered(&mut bytes).unwrap();
    assert_eq!(decode(bytes.get_ref()).unwrap().pixel(1, 0), Some([2.0; 3]));
}

#[test]
fn what_is_no_picture_is_said_with_the_file_name() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("poem.png");
    let missing = read(&path).unwrap_err();
    assert!(matches!(missing, ReadError::Open { .. }) && missing.to_string().contains("poem.png"));
    assert!(matches!(read(directory.path()), Err(ReadError::NotAFile { .. })));
    std::fs::write(&path, "Two roads diverged").unwrap();
    let error = read(&path).unwrap_err();
    assert!(error.to_string().contains("poem.png"), "{error}");
    assert!(error.source().unwrap().to_string().contains("neither a PNG nor an EXR"));
    assert!(matches!(decode(&[]), Err(DecodeError::Empty)));
    assert!(matches!(decode(b"\x89PNG"), Err(DecodeError::UnknownFormat)));
}

fn small() -> Picture {
    Picture::from_fn(33, 20, |x, y| [x as f32 / 32.0, y as f32 / 19.0, ((x * y) % 7) as f32]).unwrap()
}

#[test]
fn sizes_that_the_file_cannot_hold_are_turned_away() {
    let declare = |width: u32, height: u32| decode(&stored_png(width, height, 0, &[0; 100])).unwrap_err();
    assert!(matches!(declare(0, 1), DecodeError::Corrupt { .. } | DecodeError::Size(_)));
    assert!(matches!(declare(i32::MAX as u32, 1), DecodeError::Size(_)));
    assert!(matches!(declare(1 << 15, 1 << 15), DecodeError::Size(_)));
    assert!(matches!(declare(1 << 14, 1 << 14), DecodeError::TooShort { .. }));

    let exr = encode_exr(&small()).unwrap();
    let declare = |width: i32, height: i32| {
        let corner = [width - 1, height - 1].map(i32::to_le_bytes);
        let bytes = patch(&exr, b"dataWindow\0box2i\0\x10\0\0\0\0\0\0\0\0\0\0\0", corner.as_flattened());
        // 16 lines to a block.
        let blocks = (height as u32).div_ceil(16).to_le_bytes();
        decode(&patch(&bytes, b"chunkCount\0int\0\x04\0\0\0", &blocks)).unwrap_err()
    };
    assert!(matches!(declare(1 << 29, 1), DecodeError::Size(_)));
    assert!(matches!(declare(1 << 20, 1 << 8), DecodeError::TooShort { .. }));
    assert!(matches!(declare(1 << 15, 1 << 15), DecodeError::Corrupt { .. }));
    assert!(matches!(declare(33, 1 << 23), DecodeError::Corrupt { .. }));
}

/// The bytes with those that follow `after` replaced.
fn patch(bytes: &[u8], after: &[u8], by: &[u8]) -> Vec<u8> {
    let place =
        bytes.windows(after.len()).position(|window| window == after).expect("the attribute is there");
    let mut bytes = bytes.to_vec();
    bytes[place + after.len()..][..by.len()].copy_from_slice(by);
    bytes
}

/// SplitMix64 (Steele, Lea, Flood 2014): a seeded source that needs no crate.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % bound as u64) as usize
    }
}

/// Breaks a valid file: bits flipped, bytes replaced by telling ones, cut off, or a stretch doubled or lost.
fn mutate(valid: &[u8], random: &mut Random) -> Vec<u8> {
    const TELLING: [u8; 6] = [0, 1, 0x7f, 0x80, 0xfe, 0xff];
    let mut bytes = valid.to_vec();
    for _ in 0..=random.below(4) {
        // Half of the breaks go where the headers are.
        let reach = if random.below(2) == 0 { bytes.len().min(500) } else { bytes.len() };
        if reach == 0 {
            break;
        }
        let at = random.below(reach);
        match random.below(12) {
            0 => bytes.truncate(at),
            1 => bytes.extend_from_within(at..),
            2 => drop(bytes.drain(at..(at + 1 + random.below(8)).min(bytes.len()))),
            3..=6 => bytes[at] = TELLING[random.below(TELLING.len())],
            _ => bytes[at] ^= 1 << random.below(8),
        }
    }
    bytes
}

/// Makes the checksums of a broken PNG right again, so that the decoder looks further.
fn mend_checksums(png: &mut [u8]) {
    let mut at = 8;
    while let Some(length) = png.get(at..at + 4).map(|b| u32::from_be_bytes(b.try_into().unwrap()) as usize) {
        let Some(sum) = png.get(at + 4..at.saturating_add(8).saturating_add(length)).map(crc) else { return };
        let Some(place) = png.get_mut(at + 8 + length..at + 12 + length) else { return };
        place.copy_from_slice(&sum.to_be_bytes());
        at += 12 + length;
    }
}

#[test]
fn broken_files_are_errors_and_never_panics() {
    let tiled = Encoding { blocks: Blocks::Tiles(Vec2(2, 2)), ..Encoding::SMALL_LOSSLESS };
    let piz = Encoding { compression: Compression::PIZ, ..Encoding::SMALL_LOSSLESS };
    let rle = Encoding { compression: Compression::RLE, ..Encoding::SMALL_LOSSLESS };
    let pxr = Encoding { compression: Compression::PXR24, ..Encoding::SMALL_LOSSLESS };
    let b44 = Encoding { compression: Compression::B44, ..Encoding::SMALL_LOSSLESS };
    let channels = ["B", "G", "R"].map(|name| (name, halves(0.37)));
    let png = |depth| encode_png(&small(), &Development::default(), depth).unwrap();
    let palette = png_of((9, 1), png::ColorType::Indexed, png::BitDepth::Two, &[7, 21, 0], |encoder| {
        encoder.set_palette(vec![0, 0, 0, 10, 20, 30]);
    });
    let rows: Vec<u8> = [[0; 6]; 12].as_flattened().to_vec();
    let mut seeds = vec![png(BitDepth::Eight), png(BitDepth::Sixteen), palette, stored_png(5, 9, 1, &rows)];
    seeds.push(encode_exr(&small()).unwrap());
    seeds.extend([tiled, piz, rle, pxr, b44].map(|encoding| exr_of(&channels, encoding)));

    let mut random = Random(20_260_101);
    // Known: the B44 decoder subtracts below zero where overflow is checked. The breakdown is caught.
    let fragile = seeds.len() - 1;
    for (kind, valid) in seeds.iter().enumerate() {
        let mut refused = 0;
        for round in 0..1500 {
            let mut bytes = mutate(valid, &mut random);
            if kind < 4 && round % 2 == 0 {
                mend_checksums(&mut bytes);
            }
            match decode(&bytes) {
                Err(DecodeError::Breakdown { format }) if kind != fragile => {
                    panic!("{format} decoder panicked: {kind} {round}")
                }
                Err(_) => refused += 1,
                Ok(picture) => assert_eq!(picture.pixels().len(), picture.rows().flatten().count()),
            }
        }
        assert!(refused > 300, "only {refused} of file {kind} refused");
    }
}
