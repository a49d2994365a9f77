//! Files: what is written, that it is written whole, and that it reads back.

use std::fs;
use std::path::Path;

use catoptric_picture::{
    BitDepth, Development, Picture, WriteError, decode, encode_exr, encode_png, read, write_exr, write_png,
};
use proptest::prelude::*;

/// Smooth, noisy, dark, bright and special values.
fn picture() -> Picture {
    Picture::from_fn(67, 41, |x, y| {
        let noise = (x * 7919 + y * 104_729) % 1013;
        [x as f32 / 66.0, y as f32 / 40.0 * 1.5 - 0.2, noise as f32 / 1012.0]
    })
    .unwrap()
}

fn png8(picture: &Picture) -> Vec<u8> {
    encode_png(&Development::default().develop(picture, BitDepth::Eight).unwrap()).unwrap()
}

/// Name and data of every chunk of a PNG, read without the crate that wrote it.
fn chunks(png: &[u8]) -> Vec<(String, Vec<u8>)> {
    let mut rest = &png[8..];
    let mut chunks = Vec::new();
    while !rest.is_empty() {
        let length = u32::from_be_bytes(rest[..4].try_into().unwrap()) as usize;
        let name = String::from_utf8(rest[4..8].to_vec()).unwrap();
        chunks.push((name, rest[8..8 + length].to_vec()));
        rest = &rest[12 + length..];
    }
    chunks
}

fn names(directory: &Path) -> Vec<String> {
    let entries = fs::read_dir(directory).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn png_codes_round_trip() {
    let picture = picture();
    for (depth, step) in [(BitDepth::Eight, 255.0), (BitDepth::Sixteen, 65535.0)] {
        let bytes = encode_png(&Development::default().develop(&picture, depth).unwrap()).unwrap();
        let back = decode(&bytes).unwrap();
        assert_eq!((back.width(), back.height()), (67, 41));
        for (a, b) in picture.pixels().as_flattened().iter().zip(back.pixels().as_flattened()) {
            // Half a code of display value; the steepest the decoding gets is 2.4 / 1.055.
            let bound = 0.5 / step * 2.275 + 1e-6;
            assert!((a.clamp(0.0, 1.0) - b).abs() < bound, "{a} became {b} at {depth:?}");
        }
        assert_eq!(encode_png(&Development::default().develop(&back, depth).unwrap()).unwrap(), bytes);
    }
}

#[test]
fn a_png_is_marked_as_srgb_with_its_stand_ins_and_no_date() {
    let chunks = chunks(&png8(&picture()));
    let of = |name: &str| chunks.iter().find(|chunk| chunk.0 == name).map(|chunk| chunk.1.as_slice());
    assert_eq!(of("sRGB"), Some([0].as_slice()));
    assert_eq!(of("gAMA"), Some(45455_u32.to_be_bytes().as_slice()));
    let primaries = [31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000_u32].map(u32::to_be_bytes);
    assert_eq!(of("cHRM"), Some(primaries.as_flattened()));
    assert_eq!(of("tEXt"), Some(b"Software\0Catoptric".as_slice()));
    assert_eq!(of("tIME"), None);
    assert_eq!(of("IHDR").unwrap()[8..], [8, 2, 0, 0, 0]);
    assert_eq!(chunks.last().unwrap().0, "IEND");
}

#[test]
fn the_same_picture_gives_the_same_bytes() {
    let (a, b) = (picture(), picture());
    assert_eq!(png8(&a), png8(&b));
    assert_eq!(encode_exr(&a).unwrap(), encode_exr(&b).unwrap());
}

proptest! {
    #[test]
    fn exr_keeps_every_bit(width in 1_u32..40, height in 1_u32..40, seed: u32) {
        let mut state = seed;
        let picture = Picture::from_fn(width, height, |_, _| {
            [0; 3].map(|_| {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                f32::from_bits(state)
            })
        }).unwrap();
        let back = decode(&encode_exr(&picture).unwrap()).unwrap();
        prop_assert_eq!((back.width(), back.height()), (width, height));
        let bits = |picture: &Picture| {
            picture.pixels().as_flattened().iter().map(|value| value.to_bits()).collect::<Vec<_>>()
        };
        prop_assert_eq!(bits(&picture), bits(&back));
    }
}

#[test]
fn files_hold_what_the_memory_functions_give_and_the_content_decides() {
    let directory = tempfile::tempdir().unwrap();
    let picture = picture();
    // The names are swapped on purpose.
    let (png, exr) = (directory.path().join("a.exr"), directory.path().join("b.png"));
    write_png(&png, &Development::default().develop(&picture, BitDepth::Eight).unwrap()).unwrap();
    write_exr(&exr, &picture).unwrap();
    assert_eq!(fs::read(&png).unwrap(), png8(&picture));
    assert_eq!(fs::read(&exr).unwrap(), encode_exr(&picture).unwrap());
    assert!(read(&exr).unwrap() == picture);
    assert!(read(&png).is_ok());
    assert_eq!(names(directory.path()), ["a.exr", "b.png"]);
}

#[test]
#[cfg(target_os = "linux")]
fn a_device_is_written_to_and_not_replaced() {
    let picture = picture();
    write_exr(Path::new("/dev/null"), &picture).unwrap();
    let full = write_png(
        Path::new("/dev/full"),
        &Development::default().develop(&picture, BitDepth::Eight).unwrap(),
    );
    let Err(WriteError::Io { source, .. }) = full else { panic!("{full:?}") };
    assert_eq!(source.kind(), std::io::ErrorKind::StorageFull);
    for device in ["/dev/null", "/dev/full"] {
        assert!(!fs::metadata(device).unwrap().is_file());
    }
}
