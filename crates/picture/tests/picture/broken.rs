//! Reading files that are broken on purpose: errors, never panics, never memory for what is not there.

use std::io::Cursor;

use crate::samples::{
    chunk_into, crc, dwa, exr_of, halves, palette_tiff, pfm, png_of, progressive_jpeg, stored_png,
};
use catoptric_picture::{
    BitDepth, DecodeError, Development, Picture, PictureFormat, ReadOptions, SampleDepth, SaveOptions,
    decode, encode_exr, encode_png,
};
use exr::prelude::{Blocks, Compression, Encoding, FlatSamples, Vec2};
use image::codecs::bmp::BmpEncoder;

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

/// How often each sample is mutated: 1500 times, or what `CATOPTRIC_MUTATIONS` says for a soak.
fn rounds() -> usize {
    std::env::var("CATOPTRIC_MUTATIONS").ok().and_then(|rounds| rounds.parse().ok()).unwrap_or(1500)
}

/// Mutates every sample; decoders must not panic but for those of `fragile` formats, whose panics become errors.
fn break_all(seeds: &[(&str, Vec<u8>)], fragile: &[&str]) {
    let mut random = Random(20_260_101);
    for (name, valid) in seeds {
        assert!(decode(valid).is_ok(), "{name}: {:?}", decode(valid).err());
        let (mut refused, mut breakdowns) = (0, 0);
        for round in 0..rounds() {
            let mut bytes = mutate(valid, &mut random);
            // Now and then a piece of another sample.
            if random.below(16) == 0
                && let Some((_, other)) = seeds.get(random.below(seeds.len()))
            {
                let (at, from) = (random.below(bytes.len().max(1)), random.below(other.len()));
                bytes.truncate(at);
                bytes.extend_from_slice(&other[from..]);
            }
            if valid.starts_with(b"\x89PNG") && round % 2 == 0 {
                mend_checksums(&mut bytes);
            }
            match decode(&bytes) {
                Err(DecodeError::Breakdown { format }) => {
                    assert!(fragile.contains(&format), "the {format} decoder panicked: {name} {round}");
                    breakdowns += 1;
                }
                Err(DecodeError::Io(error)) => panic!("{name} {round}: {error}"),
                Err(_) => refused += 1,
                Ok(picture) => assert_eq!(picture.pixels().len(), picture.rows().flatten().count()),
            }
        }
        println!("{name}: {refused} of {} refused, {breakdowns} panics caught", rounds());
        assert!(refused + breakdowns > rounds() / 50, "{name}: only {refused} refused");
    }
}

#[test]
fn broken_png_and_exr_files_are_errors() {
    let compressed = |compression| Encoding { compression, ..Encoding::SMALL_LOSSLESS };
    let tiled = Encoding { blocks: Blocks::Tiles(Vec2(2, 2)), ..Encoding::SMALL_LOSSLESS };
    let channels = ["B", "G", "R"].map(|name| (name, halves(0.37)));
    let layers = ["A.B", "A.G", "A.R", "Combined.B", "Combined.G", "Combined.R", "Depth.Z"];
    let layers = layers.map(|name| (name, FlatSamples::F32((0..15).map(|i| i as f32).collect())));
    let png = |depth| encode_png(&Development::default().develop(&small(), depth).unwrap()).unwrap();
    let palette = png_of((9, 1), png::ColorType::Indexed, png::BitDepth::Two, &[7, 21, 0], |encoder| {
        encoder.set_palette(vec![0, 0, 0, 10, 20, 30]);
    });
    let rows: Vec<u8> = [[0; 6]; 12].as_flattened().to_vec();
    let seeds = [
        ("PNG of 8 bits", png(BitDepth::Eight)),
        ("PNG of 16 bits", png(BitDepth::Sixteen)),
        ("PNG with a palette", palette),
        ("interlaced PNG", stored_png(5, 9, 1, &rows)),
        ("our EXR", encode_exr(&small()).unwrap()),
        ("tiled EXR", exr_of(&channels, tiled)),
        ("EXR with layers", exr_of(&layers, Encoding::SMALL_LOSSLESS)),
        ("uncompressed EXR", exr_of(&channels, Encoding::UNCOMPRESSED)),
        ("EXR by RLE", exr_of(&channels, compressed(Compression::RLE))),
        ("EXR by PIZ", exr_of(&channels, compressed(Compression::PIZ))),
        ("EXR by PXR24", exr_of(&channels, compressed(Compression::PXR24))),
        ("EXR by B44", exr_of(&channels, compressed(Compression::B44))),
        ("EXR by DWAA", dwa(Compression::DWAA(None))),
        ("EXR by DWAB", dwa(Compression::DWAB(None))),
    ];
    // `png` 0.18.1: palettes of a length that is not a multiple of 3. `exr` 1.74.2: sums that overflow where that is
    // checked, in B44 and PIZ.
    break_all(&seeds, &["PNG", "EXR"]);
}

#[test]
fn broken_files_of_the_other_formats_are_errors() {
    let picture = small();
    let saved =
        |format, depth| SaveOptions::new(format, depth).unwrap().prepare(&picture).unwrap().encode().unwrap();
    let rgb: Vec<u8> = (0..33 * 20 * 3).map(|i| (i * 7 % 251) as u8).collect();
    let mut bmp = Cursor::new(Vec::new());
    BmpEncoder::new(&mut bmp).encode(&rgb, 33, 20, image::ExtendedColorType::Rgb8).unwrap();
    let seeds = [
        ("JPEG", saved(PictureFormat::Jpeg, None)),
        ("progressive JPEG", progressive_jpeg(&rgb, 33, 20)),
        ("WebP", saved(PictureFormat::WebP, None)),
        ("TIFF of 8 bits", saved(PictureFormat::Tiff, Some(SampleDepth::EIGHT))),
        ("TIFF of 16 bits", saved(PictureFormat::Tiff, None)),
        ("TIFF of floats", saved(PictureFormat::Tiff, Some(SampleDepth::Linear))),
        ("HDR", saved(PictureFormat::Hdr, None)),
        ("BMP", bmp.into_inner()),
        ("PPM of bytes", saved(PictureFormat::Ppm, None)),
        ("PFM", saved(PictureFormat::Pfm, None)),
        ("gray PFM of large numbers first", pfm(b"Pf\n2 3\n0.5\n", &[0.1, 0.2, 0.3, 0.4, 0.5, 0.6])),
        ("TIFF with a palette", palette_tiff(33, 20, 4)),
        ("PPM of text", b"P3\n# made by hand\n2 2\n255\n0 7 15  15 0 7\n3 3 3 255 0 1\n".to_vec()),
    ];
    break_all(&seeds, &["JPEG", "WebP", "TIFF", "BMP"]);
}

/// One bit of each counter of a DWA chunk flipped: the decoder would ask for up to 9 EB.
#[test]
fn what_dwa_chunks_claim_is_checked_before_memory_is_taken() {
    for compression in [Compression::DWAA(None), Compression::DWAB(None)] {
        let exr = dwa(compression);
        // The last chunk: its place is the last word of the table, before its row and its length.
        let start = exr.windows(8).position(|word| {
            let place = u64::from_le_bytes(word.try_into().unwrap()) as usize;
            place.checked_add(8).and_then(|end| exr.get(place + 4..end)).is_some_and(|length| {
                place + 8 + u32::from_le_bytes(length.try_into().unwrap()) as usize == exr.len()
            })
        });
        let table = start.expect("there is a table");
        let place = u64::from_le_bytes(exr[table..table + 8].try_into().unwrap()) as usize + 8;
        for counter in 1..10 {
            for bit in 0..64 {
                let mut broken = exr.clone();
                broken[place + 8 * counter + bit / 8] ^= 1 << (bit % 8);
                if bit >= 16 {
                    let error = decode(&broken).unwrap_err();
                    assert!(
                        error.to_string().contains("impossible"),
                        "counter {counter}, bit {bit}: {error}"
                    );
                } else {
                    // Small wrong claims are left to the decoder.
                    let _ = decode(&broken);
                }
            }
        }
    }
}

#[test]
fn files_that_end_early_are_errors_in_every_format() {
    for format in PictureFormat::ALL.into_iter().filter(|format| format.is_written()) {
        let whole = SaveOptions::new(format, None).unwrap().prepare(&small()).unwrap().encode().unwrap();
        assert!(decode(&whole).is_ok());
        for length in (1..whole.len()).step_by(1 + whole.len() / 200) {
            let early = decode(&whole[..length]);
            // What stands behind the pixels of a TIFF is its directory; the last bytes of WebP and PNG are padding or
            // an end.
            assert!(
                early.is_err() || length + 12 > whole.len(),
                "{} cut to {length} of {}",
                format.name(),
                whole.len()
            );
        }
    }
}

#[test]
fn a_picture_of_more_pixels_than_asked_for_is_refused_before_it_is_decoded() {
    let few = ReadOptions { max_pixels: 659, ..ReadOptions::default() };
    for format in PictureFormat::ALL.into_iter().filter(|format| format.is_written()) {
        let bytes = SaveOptions::new(format, None).unwrap().prepare(&small()).unwrap().encode().unwrap();
        let error = few.decode(&bytes).unwrap_err();
        assert!(matches!(error, DecodeError::TooLarge { width: 33, height: 20, most: 659 }), "{error:?}");
        assert!(ReadOptions { max_pixels: 660, ..ReadOptions::default() }.decode(&bytes).is_ok());
    }
}

#[test]
fn heads_that_declare_more_than_the_file_has_are_turned_away() {
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16384 +X 16384\n\x02\x02\x40\x00";
    assert!(matches!(decode(hdr), Err(DecodeError::TooShort { .. })));
    let mut bmp = b"BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\0\x40\0\0\0\x40\0\0\x01\0\x18\0".to_vec();
    bmp.extend([0; 24]);
    assert!(matches!(decode(&bmp), Err(DecodeError::TooShort { .. })));
    let xyz = b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n\0\0\0\0";
    assert!(matches!(decode(xyz), Err(DecodeError::Unsupported { .. })));
    // A JPEG of the largest size in a few bytes.
    let mut jpeg =
        SaveOptions::new(PictureFormat::Jpeg, None).unwrap().prepare(&small()).unwrap().encode().unwrap();
    let frame = jpeg.windows(2).position(|marker| marker == [0xff, 0xc0]).unwrap();
    jpeg[frame + 5..frame + 9].copy_from_slice(&[0x40, 0, 0x40, 0]);
    assert!(matches!(decode(&jpeg), Err(DecodeError::TooShort { .. })), "{:?}", decode(&jpeg).err());
    let mut png = b"\x89PNG\r\n\x1a\n".to_vec();
    chunk_into(&mut png, b"IHDR", &[0, 0, 0x40, 0, 0, 0, 0x40, 0, 8, 2, 0, 0, 0]);
    assert!(matches!(decode(&png), Err(DecodeError::TooShort { .. })));
}
