//! TIFF with palettes, and gray that is not of 8 or 16 bits.

use std::path::Path;

use catoptric_picture::{DecodeError, Picture, decode, read, srgb};

use crate::samples::{palette_color, palette_index, palette_tiff};

fn light(code: u16, most: u16) -> f32 {
    srgb::decode(f64::from(code) / f64::from(most)) as f32
}

fn expected(width: usize, height: usize, bits: usize) -> Picture {
    let color =
        |x, y| palette_color(palette_index(x as usize, y as usize, bits)).map(|code| light(code, 255));
    Picture::from_fn(width as u32, height as u32, color).unwrap()
}

#[track_caller]
fn assert_near(found: &Picture, expected: &Picture, what: &str) {
    assert_eq!((found.width(), found.height()), (expected.width(), expected.height()), "{what}");
    let pairs = found.pixels().iter().flatten().zip(expected.pixels().iter().flatten());
    let worst = pairs.map(|(found, expected)| (found - expected).abs()).fold(0.0, f32::max);
    assert!(worst < 1e-6, "{what}: {worst}");
}

#[test]
fn palettes_of_all_depths_are_read() {
    for bits in [1, 2, 4, 8] {
        for width in [1, 7, 8, 33] {
            let found = decode(&palette_tiff(width, 5, bits)).unwrap();
            assert_near(&found, &expected(width, 5, bits), &format!("{bits} bits, {width} across"));
        }
    }
}

/// By Pillow 13.0 (LZW, PackBits), tifffile 2026.3.3 (tiles, largest byte first; BigTIFF) and ImageMagick 6.9.11 (4 bits).
#[test]
fn palettes_by_other_programs_are_read() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/palettes");
    for name in ["palette-lzw", "palette-packbits", "palette-tiles", "palette-big"] {
        let found = read(&folder.join(name).with_extension("tif")).unwrap();
        assert_near(&found, &expected(35, 22, 8), name);
    }
    let four = read(&folder.join("palette-4.tif")).unwrap();
    assert_near(&four, &read(&folder.join("palette-4.ppm")).unwrap(), "palette-4");
}

/// The file with the value of a tag replaced.
fn with_tag(mut tiff: Vec<u8>, tag: u16, value: u32) -> Vec<u8> {
    let directory = u32::from_le_bytes(tiff[4..8].try_into().unwrap()) as usize + 2;
    let entry = tiff[directory..].chunks_exact(12).position(|entry| entry[..2] == tag.to_le_bytes()).unwrap();
    tiff[directory + 12 * entry + 8..][..4].copy_from_slice(&value.to_le_bytes());
    tiff
}

#[test]
fn gray_of_few_bits_is_read() {
    for (bits, photometric) in [(2, 0), (2, 1), (4, 0), (4, 1)] {
        let most = (1 << bits) - 1;
        let gray = |x, y| {
            let index = palette_index(x as usize, y as usize, bits) as u16;
            [light(if photometric == 0 { most - index } else { index }, most); 3]
        };
        let found = decode(&with_tag(palette_tiff(9, 4, bits), 262, photometric)).unwrap();
        assert_near(
            &found,
            &Picture::from_fn(9, 4, gray).unwrap(),
            &format!("{bits} bits, kind {photometric}"),
        );
    }
}

#[test]
fn old_palettes_and_broken_ones() {
    // Codes of 8 bits in one half of the numbers alone.
    for half in [0, 1] {
        let mut old = palette_tiff(9, 4, 2);
        let map = 8 + 4 * 3;
        for entry in old[map..map + 24].chunks_exact_mut(2) {
            entry[half] = 0;
        }
        assert_near(&decode(&old).unwrap(), &expected(9, 4, 2), "8 bits");
    }
    // A map for fewer bits, one at the end of the file, none.
    let whole = palette_tiff(9, 4, 4);
    for broken in [
        with_tag(whole.clone(), 258, 8),
        with_tag(whole.clone(), 320, whole.len() as u32 - 4),
        with_tag(whole.clone(), 277, 3),
        with_tag(whole.clone(), 256, 1 << 30),
    ] {
        let error = decode(&broken).unwrap_err();
        assert!(!matches!(error, DecodeError::Breakdown { .. } | DecodeError::Io(_)), "{error:?}");
    }
}
