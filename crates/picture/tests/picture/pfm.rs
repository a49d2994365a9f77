//! Portable float maps: what is read, written and refused.

use catoptric_picture::{DecodeError, Picture, PictureFormat, SaveOptions, decode};

use crate::samples::pfm;

fn little(head: &[u8], values: &[f32]) -> Vec<u8> {
    head.iter().copied().chain(values.iter().flat_map(|value| value.to_le_bytes())).collect()
}

#[test]
fn both_orders_of_bytes_gray_and_scales_are_read_from_the_bottom_up() {
    let values = [0.5, -1.0, 2.0, 1e-30, 7.0, 8.0];
    let gray = Picture::from_fn(2, 3, |x, y| [values[((2 - y) * 2 + x) as usize]; 3]).unwrap();
    let tripled = |value: f32| [value, 0.0, 2.0 * value];
    let color = Picture::from_fn(2, 3, |x, y| tripled(values[((2 - y) * 2 + x) as usize])).unwrap();
    let colors: Vec<f32> = values.into_iter().flat_map(tripled).collect();
    assert!(decode(&pfm(b"Pf\n2 3\n1\n", &values)).unwrap() == gray);
    assert!(decode(&little(b"Pf\n2 3\n-1.0\n", &values)).unwrap() == gray);
    assert!(decode(&pfm(b"PF 2\t3 1.000000\r", &colors)).unwrap() == color);
    assert!(decode(&little(b"PF\n2 3\n-1\n", &colors)).unwrap() == color);
    // pbrt and Mitsuba multiply by the scale.
    let scaled = decode(&little(b"Pf\n1 1\n-2.5\n", &[3.0])).unwrap();
    assert_eq!(scaled.pixel(0, 0), Some([7.5; 3]));
}

#[test]
fn what_is_written_is_what_others_read() {
    let picture = Picture::from_fn(2, 2, |x, y| [x as f32, y as f32, f32::INFINITY]).unwrap();
    let bytes =
        SaveOptions::new(PictureFormat::Pfm, None).unwrap().prepare(&picture).unwrap().encode().unwrap();
    let (zero, one, endless) = (0.0_f32, 1.0_f32, f32::INFINITY);
    let values = [zero, one, endless, one, one, endless, zero, zero, endless, one, zero, endless];
    assert_eq!(bytes, little(b"PF\n2 2\n-1.0\n", &values));
    assert_eq!(PictureFormat::of_content(&bytes), Some(PictureFormat::Pfm));
}

#[test]
fn broken_heads_are_refused_with_words() {
    for (bytes, words) in [
        (b"PF\n2 3\n".as_slice(), "the file ends too early"),
        (b"PF\n2 x\n1\n", "`x` is no number of pixels"),
        (b"PF\n2 3\n0\n", "`0` is no scale"),
        (b"PF\n2 3\nnan\n", "`nan` is no scale"),
        (b"PF\n-2 3\n1\n", "`-2` is no number of pixels"),
        (&[b"PF\n".as_slice(), &[b'1'; 99]].concat(), "its head is too long"),
    ] {
        let error = decode(bytes).unwrap_err();
        let is_corrupt = matches!(error, DecodeError::Corrupt { format: "PFM", .. });
        assert!(is_corrupt && error.to_string().contains(words), "{error}");
    }
    assert!(matches!(decode(b"PF\n16000 16000\n-1\n"), Err(DecodeError::TooShort { .. })));
    assert!(matches!(decode(b"PF\n0 1\n-1\n"), Err(DecodeError::Size(_))));
    assert!(matches!(decode(b"PF4\n1 1\n-1\n"), Err(DecodeError::UnknownFormat)));
}
