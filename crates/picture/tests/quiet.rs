//! A decoder that panics says nothing; other panics are told as ever. Alone in its program, since the hook is global.

#![allow(clippy::unwrap_used, clippy::panic, reason = "tests may fail like that")]

#[path = "picture/samples.rs"]
mod samples;

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use catoptric_picture::{DecodeError, decode};
use samples::{chunk_into, crc};

/// A picture of one pixel whose palette has a length that is not a multiple of 3, which `png` 0.18.1 does not check.
fn bad_palette(length: usize) -> Vec<u8> {
    let mut png = b"\x89PNG\r\n\x1a\n".to_vec();
    chunk_into(&mut png, b"IHDR", &[0, 0, 0, 1, 0, 0, 0, 1, 8, 3, 0, 0, 0]);
    chunk_into(&mut png, b"PLTE", &vec![0; length]);
    chunk_into(&mut png, b"IDAT", b"\x78\x9c\x63\x60\x00\x00\x00\x02\x00\x01");
    chunk_into(&mut png, b"IEND", b"");
    png
}

#[test]
fn only_the_panics_of_decoders_are_silent() {
    let told = Arc::new(AtomicUsize::new(0));
    let counter = Arc::clone(&told);
    std::panic::set_hook(Box::new(move |_| _ = counter.fetch_add(1, Ordering::Relaxed)));
    assert_ne!(crc(b"IEND"), 0);
    for length in [1, 2, 4, 5, 100] {
        let error = decode(&bad_palette(length)).unwrap_err();
        assert!(
            matches!(error, DecodeError::Breakdown { format: "PNG" } | DecodeError::Corrupt { .. }),
            "{error}"
        );
    }
    assert!(decode(&bad_palette(3)).is_ok());
    assert_eq!(told.load(Ordering::Relaxed), 0);
    let other = std::thread::spawn(|| panic!("another thread")).join();
    assert!(other.is_err());
    assert_eq!(told.load(Ordering::Relaxed), 1);
    let own = std::panic::catch_unwind(|| panic!("this thread, after a guard"));
    assert!(own.is_err());
    assert_eq!(told.load(Ordering::Relaxed), 2);
}
