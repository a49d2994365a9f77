//! JPEG, WebP, TIFF, BMP, PFM and Radiance HDR: what is read and what is written.

use std::io::Cursor;

use crate::samples::progressive_jpeg;
use catoptric_picture::{
    BitDepth, Codes, Comparison, DecodeError, Development, FormatError, Picture, PictureFormat, SampleDepth,
    SaveOptions, ToneCurve, decode, encode_exr, encode_png, read, srgb,
};
use image::codecs::bmp::BmpEncoder;
use image::codecs::tiff::TiffEncoder;
use image::{ExtendedColorType, ImageEncoder as _};
use proptest::prelude::*;

/// Smooth, with light below 0 and beyond white.
fn picture() -> Picture {
    Picture::from_fn(67, 41, |x, y| [x as f32 / 66.0, y as f32 / 40.0 * 1.5 - 0.2, (x + y) as f32 / 106.0])
        .unwrap()
}

fn saved(picture: &Picture, format: PictureFormat, depth: Option<SampleDepth>) -> Vec<u8> {
    SaveOptions::new(format, depth).unwrap().prepare(picture).unwrap().encode().unwrap()
}

fn codes(picture: &Picture) -> Vec<u8> {
    match Development::default().develop(picture, BitDepth::Eight).unwrap().codes() {
        Codes::Eight(codes) => codes.clone(),
        Codes::Sixteen(_) => panic!("asked for 8 bits"),
    }
}

#[test]
fn formats_without_loss_bring_back_their_codes() {
    for (format, depth) in [
        (PictureFormat::Png, SampleDepth::EIGHT),
        (PictureFormat::Png, SampleDepth::SIXTEEN),
        (PictureFormat::WebP, SampleDepth::EIGHT),
        (PictureFormat::Ppm, SampleDepth::EIGHT),
        (PictureFormat::Tiff, SampleDepth::EIGHT),
        (PictureFormat::Tiff, SampleDepth::SIXTEEN),
    ] {
        let SampleDepth::Coded(bits) = depth else { panic!() };
        let bytes = saved(&picture(), format, Some(depth));
        assert_eq!(PictureFormat::of_content(&bytes), Some(format));
        let back = decode(&bytes).unwrap();
        let develop = |picture: &Picture| Development::default().develop(picture, bits).unwrap();
        assert_eq!(develop(&back), develop(&picture()), "{} {bits:?}", format.name());
        assert_eq!(saved(&picture(), format, Some(depth)), bytes, "the same picture gives the same bytes");
    }
}

#[test]
fn linear_formats_bring_back_the_light() {
    let linear = Some(SampleDepth::Linear);
    for (format, depth) in
        [(PictureFormat::Exr, None), (PictureFormat::Pfm, None), (PictureFormat::Tiff, linear)]
    {
        assert!(decode(&saved(&picture(), format, depth)).unwrap() == picture(), "{}", format.name());
    }
    let back = decode(&saved(&picture(), PictureFormat::Hdr, None)).unwrap();
    for (pixel, own) in back.pixels().iter().zip(picture().pixels()) {
        // A step of the common exponent; the encoder cuts instead of rounding.
        let step = own.iter().fold(0.0_f32, |most, &value| most.max(value)) / 128.0;
        for (value, own) in pixel.iter().zip(own) {
            assert!((value - own.max(0.0)).abs() <= step, "{own} became {value}");
        }
    }
}

#[test]
fn text_and_bytes_of_netpbm_are_read() {
    let light = |code: f64| srgb::decode(code) as f32;
    let (none, half, full) = (0.0, light(7.0 / 15.0), 1.0);
    let near = |bytes: &[u8], pixels: &[[f32; 3]]| {
        let picture = decode(bytes).unwrap();
        assert_eq!((picture.width(), picture.height() as usize), (2, pixels.len() / 2));
        for (found, expected) in picture.pixels().iter().flatten().zip(pixels.iter().flatten()) {
            assert!((found - expected).abs() < 1e-3, "{:?}: {found} for {expected}", bytes.escape_ascii());
        }
    };
    near(b"P3\n# by hand\n2 1\n15\n0 7 15  15 0 7\n", &[[none, half, full], [full, none, half]]);
    near(b"P2 2 1 15 7 15", &[[half; 3], [full; 3]]);
    near(b"P1\n2 1\n0 1\n", &[[full; 3], [none; 3]]);
    near(b"P6\n2 1\n255\n\x00\x77\xff\xff\x00\x77", &[[none, half, full], [full, none, half]]);
    near(b"P5\n2 1\n65535\n\x77\x77\xff\xff", &[[half; 3], [full; 3]]);
    for broken in
        ["P3\n2 1\n255\n0 0 0", "P3 2 1 255 0 0 x 0 0 0", "P6\n9999 9999\n255\n", "P6\n0 1\n255\n", "P6 2"]
    {
        assert!(decode(broken.as_bytes()).is_err(), "{broken}");
    }
    assert!(matches!(decode(b"P6\n9999 9999\n255\n"), Err(DecodeError::TooShort { .. })));
}

#[test]
fn light_of_any_size_becomes_an_hdr_that_can_be_read() {
    let values = [
        0.0,
        -1.0,
        1e-45,
        1e-39,
        1e-30,
        1.0,
        1e30,
        3e38,
        f32::MAX,
        f32::INFINITY,
        f32::NAN,
        f32::NEG_INFINITY,
    ];
    let picture = Picture::from_fn(12, 12, |x, y| [values[x as usize], values[y as usize], 0.0]).unwrap();
    let back = decode(&saved(&picture, PictureFormat::Hdr, None)).unwrap();
    for (pixel, own) in back.pixels().iter().zip(picture.pixels()) {
        let most = own.iter().fold(0.0_f32, |most, &value| most.max(value)).min(8.5e37);
        let found = pixel.iter().fold(0.0_f32, |most, &value| most.max(value));
        assert!((found - most).abs() <= most / 128.0 || most < 1e-37, "{own:?} became {pixel:?}");
        assert!(pixel.iter().all(|value| value.is_finite() && *value >= 0.0));
    }
}

#[test]
fn a_jpeg_is_close_and_closer_with_more_quality() {
    let shown = decode(&saved(&picture(), PictureFormat::Png, None)).unwrap();
    let error = |quality| {
        let mut options = SaveOptions::new(PictureFormat::Jpeg, None).unwrap();
        options.quality = quality;
        let bytes = options.prepare(&picture()).unwrap().encode().unwrap();
        let back = decode(&bytes).unwrap();
        (Comparison::default().compare(&back, &shown).unwrap().rmse, bytes.len())
    };
    let (usual, bytes) = error(SaveOptions::QUALITY);
    assert!(usual < 0.01, "{usual}");
    let (poor, fewer) = error(10);
    assert!(poor > 2.0 * usual && fewer < bytes);
    assert_eq!(error(0), error(1), "what is beyond the scale is its end");
    assert_eq!(error(255), error(100));
}

#[test]
fn jpegs_of_all_kinds_are_read() {
    let (width, height) = (64, 48);
    let smooth = Picture::from_fn(64, 48, |x, y| [x as f32 / 63.0, y as f32 / 47.0, 0.5]).unwrap();
    let rgb = codes(&smooth);
    let near = |bytes: &[u8], what: &str| {
        let rmse = Comparison::default().compare(&decode(bytes).unwrap(), &smooth).unwrap().rmse;
        assert!(rmse < 0.03, "{what}: {rmse}");
    };
    near(&progressive_jpeg(&rgb, width, height), "progressive");
    let encode = |data: &[u8], color| {
        let mut bytes = Vec::new();
        jpeg_encoder::Encoder::new(&mut bytes, 95).encode(data, width, height, color).unwrap();
        bytes
    };
    near(&encode(&rgb, jpeg_encoder::ColorType::Rgb), "subsampled");
    let cmyk: Vec<u8> = rgb.chunks(3).flat_map(|rgb| [255 - rgb[0], 255 - rgb[1], 255 - rgb[2], 0]).collect();
    near(&encode(&cmyk, jpeg_encoder::ColorType::CmykAsYcck), "YCCK");
    near(&encode(&cmyk, jpeg_encoder::ColorType::Cmyk), "CMYK");
    let gray: Vec<u8> = (0..48 * 64_u32).map(|i| (i / 64 * 5) as u8).collect();
    let read = decode(&encode(&gray, jpeg_encoder::ColorType::Luma)).unwrap();
    assert!((read.pixel(30, 20).unwrap()[0] - srgb::decode(100.0 / 255.0) as f32).abs() < 0.02);
    assert!(read.pixels().iter().all(|[r, g, b]| r == g && g == b));
}

/// An Exif segment that holds an orientation alone.
fn with_orientation(jpeg: &[u8], orientation: u8) -> Vec<u8> {
    let mut exif = b"Exif\0\0MM\0\x2a\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0".to_vec();
    exif.extend([orientation, 0, 0, 0, 0, 0, 0]);
    let length = (exif.len() as u16 + 2).to_be_bytes();
    [&jpeg[..2], &[0xff, 0xe1], &length, &exif, &jpeg[2..]].concat()
}

#[test]
fn photographs_are_turned_upright() {
    // Red at the upper left, green at the upper right, blue at the lower left, white at the lower right.
    let corner = |x: u32, y: u32| match (x < 16, y < 8) {
        (true, true) => [1.0, 0.0, 0.0],
        (false, true) => [0.0, 1.0, 0.0],
        (true, false) => [0.0, 0.0, 1.0],
        (false, false) => [1.0; 3],
    };
    let upright = Picture::from_fn(32, 16, corner).unwrap();
    let jpeg = saved(&upright, PictureFormat::Jpeg, None);
    let name = |picture: &Picture, x, y| {
        let pixel = picture.pixel(x, y).unwrap().map(|value| value > 0.5);
        match pixel {
            [true, false, false] => 'r',
            [false, true, false] => 'g',
            [false, false, true] => 'b',
            [true, true, true] => 'w',
            _ => '?',
        }
    };
    for (orientation, size, corners) in [
        (1, (32, 16), "rgbw"),
        (2, (32, 16), "grwb"),
        (3, (32, 16), "wbgr"),
        (4, (32, 16), "bwrg"),
        (5, (16, 32), "rbgw"),
        (6, (16, 32), "brwg"),
        (7, (16, 32), "wgbr"),
        (8, (16, 32), "gwrb"),
    ] {
        let picture = decode(&with_orientation(&jpeg, orientation)).unwrap();
        let (width, height) = (picture.width(), picture.height());
        let places = [(2, 2), (width - 3, 2), (2, height - 3), (width - 3, height - 3)];
        let found: String = places.iter().map(|&(x, y)| name(&picture, x, y)).collect();
        assert_eq!(((width, height), found.as_str()), (size, corners), "orientation {orientation}");
    }
}

#[test]
fn tiff_and_bmp_of_other_programs_are_read() {
    let tiff = |bytes: &[u8], kind| {
        let mut file = Cursor::new(Vec::new());
        TiffEncoder::new(&mut file).write_image(bytes, 2, 1, kind).unwrap();
        decode(file.get_ref()).unwrap().pixels().to_vec()
    };
    let light = |code: u32, most: u32| srgb::decode(f64::from(code) / f64::from(most)) as f32;
    assert_eq!(tiff(&[10, 200], ExtendedColorType::L8), [[light(10, 255); 3], [light(200, 255); 3]]);
    let wide: Vec<u8> = [1000_u16, 50_000].iter().flat_map(|code| code.to_ne_bytes()).collect();
    assert_eq!(tiff(&wide, ExtendedColorType::L16), [[light(1000, 65535); 3], [light(50_000, 65535); 3]]);
    let rgba = [1, 2, 3, 0, 4, 5, 6, 255];
    let expected = [[1, 2, 3], [4, 5, 6]].map(|pixel| pixel.map(|code| light(code, 255)));
    assert_eq!(tiff(&rgba, ExtendedColorType::Rgba8), expected, "alpha is ignored");
    let floats: Vec<u8> =
        [0.5_f32, -1.0, 70.0, 0.0, f32::NAN, f32::INFINITY].iter().flat_map(|v| v.to_ne_bytes()).collect();
    let read = tiff(&floats, ExtendedColorType::Rgb32F);
    assert_eq!(read[0], [0.5, -1.0, 70.0]);
    assert!(read[1][1].is_nan() && read[1][2] == f32::INFINITY);
    for (kind, bytes) in [(ExtendedColorType::Rgb8, &rgba[..6]), (ExtendedColorType::L8, &rgba[..2])] {
        let mut file = Cursor::new(Vec::new());
        BmpEncoder::new(&mut file).encode(bytes, 2, 1, kind).unwrap();
        let read = decode(file.get_ref()).unwrap();
        assert_eq!(PictureFormat::of_content(file.get_ref()), Some(PictureFormat::Bmp));
        assert_eq!(read.pixels()[1][0], light(u32::from(bytes[bytes.len() / 2]), 255), "{kind:?}");
    }
}

#[test]
fn radiance_files_of_both_signatures_are_read() {
    let pixels = b"\x80\x40\x20\x81\x80\x80\x80\x80";
    for signature in ["#?RADIANCE", "#?RGBE"] {
        let head = format!("{signature}\n# made by hand\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n");
        let read = decode(&[head.as_bytes(), pixels].concat()).unwrap();
        assert_eq!(read.pixels(), [[1.0, 0.5, 0.25], [0.5; 3]], "{signature}");
    }
}

#[test]
fn the_content_decides_and_the_name_does_not() {
    let folder = tempfile::tempdir().unwrap();
    for format in PictureFormat::ALL.into_iter().filter(|format| format.is_written()) {
        let path = folder.path().join("picture.bmp");
        SaveOptions::new(format, None).unwrap().prepare(&picture()).unwrap().write(&path).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), saved(&picture(), format, None));
        let back = read(&path).unwrap();
        assert_eq!((back.width(), back.height()), (67, 41), "{}", format.name());
    }
}

#[test]
fn the_older_functions_write_the_same() {
    let developed = Development::default().develop(&picture(), BitDepth::Eight).unwrap();
    assert_eq!(saved(&picture(), PictureFormat::Png, None), encode_png(&developed).unwrap());
    assert_eq!(saved(&picture(), PictureFormat::Exr, None), encode_exr(&picture()).unwrap());
    let mut options = SaveOptions::new(PictureFormat::WebP, None).unwrap();
    options.development = Development { exposure_stops: -1.0, tone_curve: ToneCurve::Filmic };
    let back = decode(&options.prepare(&picture()).unwrap().encode().unwrap()).unwrap();
    let shown = options.development.develop(&picture(), BitDepth::Eight).unwrap();
    assert_eq!(Development::default().develop(&back, BitDepth::Eight).unwrap(), shown);
}

#[test]
fn what_a_format_cannot_hold_is_refused_by_name() {
    let refused = |format, depth| SaveOptions::new(format, depth).unwrap_err().to_string();
    assert!(refused(PictureFormat::Bmp, None).contains(".png, .exr, .jpg"));
    let sixteen = refused(PictureFormat::Jpeg, Some(SampleDepth::SIXTEEN));
    assert!(sixteen.contains("JPEG") && sixteen.contains("8 bits"), "{sixteen}");
    assert!(refused(PictureFormat::Png, Some(SampleDepth::Linear)).contains("8 bits per channel or 16 bits"));
    let webp = SaveOptions::new(PictureFormat::WebP, None).unwrap();
    assert!(webp.check_size(16_384, 1).is_ok());
    let error = webp.check_size(1, 16_385).unwrap_err();
    assert!(matches!(error, FormatError::Side { most: 16_384, .. }) && error.to_string().contains("1x16385"));
    let wide = Picture::new(16_385, 1).unwrap();
    assert!(webp.prepare(&wide).unwrap().encode().is_err(), "the encoder refuses it, too");
}

#[test]
fn a_layer_is_asked_of_files_that_can_have_some() {
    let options = catoptric_picture::ReadOptions { layer: Some("AO".to_owned()), ..Default::default() };
    for format in [PictureFormat::Png, PictureFormat::Exr, PictureFormat::Jpeg] {
        let error = options.decode(&saved(&picture(), format, None)).unwrap_err();
        assert!(matches!(&error, DecodeError::NoSuchLayer { layers, .. } if layers.is_empty()), "{error}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn bytes_do_not_depend_on_the_threads(width in 1_u32..400, height in 1_u32..400, seed: u32) {
        let picture = Picture::from_fn(width, height, |x, y| {
            [0, 1, 2].map(|c| f32::from_bits((x * 31 + y * 7 + c).wrapping_mul(seed | 1) >> (seed % 9)))
        }).unwrap();
        let by = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| encode_exr(&picture).unwrap())
        };
        let one = by(1);
        prop_assert_eq!(&by(3), &one);
        let png = |threads, depth| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let developed = Development::default().develop(&picture, depth).unwrap();
            pool.install(|| (encode_png(&developed).unwrap(), developed))
        };
        for depth in [BitDepth::Eight, BitDepth::Sixteen] {
            let (one, developed) = png(1, depth);
            prop_assert_eq!(&png(3, depth).0, &one);
            let back = decode(&one).unwrap();
            prop_assert_eq!(Development::default().develop(&back, depth).unwrap(), developed);
        }
        // What the crate itself reads, channel by channel.
        prop_assert_eq!(decode(&one).unwrap().pixels().len(), (width * height) as usize);
    }
}
