//! Files: what is written, that it is written whole, and that it reads back.

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "helpers of tests may panic as tests may")]

use std::fs;
use std::path::Path;

use catoptric_picture::{
    BitDepth, Development, Picture, WriteError, check_writable, decode, encode_exr, encode_png, read,
    write_bytes, write_exr, write_png,
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
fn what_cannot_be_written_is_said_before_the_work_and_while_writing() {
    let directory = tempfile::tempdir().unwrap();
    let folder = directory.path();
    fs::write(folder.join("file"), "").unwrap();
    let check = |path: &Path| {
        let early = check_writable(path).unwrap_err();
        let late = write_bytes(path, b"x").unwrap_err();
        assert_eq!(early.to_string(), late.to_string());
        early
    };
    assert!(matches!(check(&folder.join("none/a.png")), WriteError::NoDirectory { .. }));
    assert!(matches!(check(&folder.join("file/a.png")), WriteError::NoDirectory { .. }));
    assert!(matches!(check(folder), WriteError::IsDirectory { .. }));
    assert!(matches!(check(Path::new("..")), WriteError::IsDirectory { .. }));
    assert!(matches!(check(Path::new("")), WriteError::NoName { .. }));
    assert!(matches!(check(&folder.join("new/")), WriteError::NoName { .. }));
    assert!(check_writable(&folder.join("new.png")).is_ok());
    assert!(check_writable(Path::new("name-alone.png")).is_ok());
    assert_eq!(names(folder), ["file"]);
}

#[test]
fn a_protected_file_is_respected() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("treasure.png");
    fs::write(&path, "old").unwrap();
    let mut permissions = fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).unwrap();
    assert!(matches!(check_writable(&path), Err(WriteError::Protected { .. })));
    assert!(matches!(write_bytes(&path, b"new"), Err(WriteError::Protected { .. })));
    assert_eq!(fs::read(&path).unwrap(), b"old");
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o777
    }

    #[test]
    fn a_new_file_has_ordinary_permissions_and_a_replaced_one_keeps_its_own() {
        let directory = tempfile::tempdir().unwrap();
        let (ordinary, ours) = (directory.path().join("ordinary"), directory.path().join("ours"));
        fs::write(&ordinary, "").unwrap();
        write_bytes(&ours, b"").unwrap();
        assert_eq!(mode(&ours), mode(&ordinary));
        fs::set_permissions(&ours, fs::Permissions::from_mode(0o640)).unwrap();
        write_bytes(&ours, b"new").unwrap();
        assert_eq!(mode(&ours), 0o640);
    }

    #[test]
    fn symbolic_links_are_written_through() {
        let directory = tempfile::tempdir().unwrap();
        let at = |name: &str| directory.path().join(name);
        fs::create_dir(at("real")).unwrap();
        fs::write(at("real/picture"), "old").unwrap();
        symlink("real/picture", at("link")).unwrap();
        symlink("link", at("chain")).unwrap();
        symlink("real/not-yet", at("dangling")).unwrap();
        symlink("circle", at("circle")).unwrap();

        write_bytes(&at("chain"), b"new").unwrap();
        write_bytes(&at("dangling"), b"new").unwrap();
        assert_eq!(fs::read(at("real/picture")).unwrap(), b"new");
        assert_eq!(fs::read(at("real/not-yet")).unwrap(), b"new");
        assert!(fs::symlink_metadata(at("chain")).unwrap().is_symlink());
        assert!(fs::symlink_metadata(at("link")).unwrap().is_symlink());
        assert!(matches!(check_writable(&at("circle")), Err(WriteError::Circle { .. })));
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
}
