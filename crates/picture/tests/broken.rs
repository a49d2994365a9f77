//! Reading files that are broken on purpose: errors, never panics, never memory for what is not there.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "helpers of tests may panic as tests may")]

mod samples;

use catoptric_picture::{BitDepth, DecodeError, Development, Picture, decode, encode_exr, encode_png};
use exr::prelude::{Blocks, Compression, Encoding, Vec2};
use samples::{crc, exr_of, halves, png_of, stored_png};

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
    let png = |depth| encode_png(&Development::default().develop(&small(), depth).unwrap()).unwrap();
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
