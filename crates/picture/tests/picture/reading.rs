//! Reading what others wrote: every kind of PNG and EXR.

use std::error::Error;
use std::io::Cursor;

use crate::samples::{exr_of, halves, png_of, stored_png, with_chunk};
use catoptric_picture::{DecodeError, Picture, ReadError, decode, read, srgb};
use exr::prelude::{
    AnyChannel, AnyChannels, Blocks, Compression, Encoding, FlatSamples, Image, Layer, LayerAttributes,
    LineOrder, SmallVec, Text, Vec2, WritableImage,
};

fn linear(code: u32, maximum: u32) -> f32 {
    srgb::decode(f64::from(code) / f64::from(maximum)) as f32
}

#[test]
fn every_color_type_and_depth() {
    use png::{BitDepth as D, ColorType as C};
    let first = |bytes: Vec<u8>| decode(&bytes).unwrap().pixel(0, 0).unwrap();
    let plain = |color, depth, data: &[u8]| first(png_of((1, 1), color, depth, data, |_| {}));
    let gray = |code, maximum| [linear(code, maximum); 3];
    let rgb = |codes: [u32; 3], maximum| codes.map(|code| linear(code, maximum));

    assert_eq!(plain(C::Grayscale, D::One, &[0x80]), [1.0; 3]);
    assert_eq!(plain(C::Grayscale, D::Two, &[0x80]), gray(2, 3));
    assert_eq!(plain(C::Grayscale, D::Four, &[0x70]), gray(7, 15));
    assert_eq!(plain(C::Grayscale, D::Eight, &[100]), gray(100, 255));
    assert_eq!(plain(C::Grayscale, D::Sixteen, &[1, 2]), gray(258, 65535));
    assert_eq!(plain(C::GrayscaleAlpha, D::Eight, &[100, 7]), gray(100, 255));
    assert_eq!(plain(C::GrayscaleAlpha, D::Sixteen, &[1, 2, 0, 0]), gray(258, 65535));
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

#[test]
fn cicp_says_how_codes_become_light_and_comes_first() {
    let gray = png_of((1, 1), png::ColorType::Grayscale, png::BitDepth::Eight, &[128], |encoder| {
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    });
    let display = 128.0 / 255.0_f64;
    let read =
        |points: [u8; 4]| decode(&with_chunk(&gray, b"cICP", &points)).map(|picture| picture.pixels()[0][0]);
    let close = |points, light: f64| {
        let read = read(points).unwrap();
        assert!((f64::from(read) - light).abs() < 1e-6, "{points:?}: {read}, {light} expected");
    };
    close([1, 8, 0, 1], display);
    close([1, 13, 0, 1], srgb::decode(display));
    close([1, 4, 0, 1], display.powf(2.2));
    close([1, 5, 0, 1], display.powf(2.8));
    for rec709 in [1, 6, 14, 15] {
        close([1, rec709, 0, 1], ((display + 0.099) / 1.099).powf(1.0 / 0.45));
    }
    // Unspecified: what else the file says.
    close([2, 2, 0, 1], srgb::decode(display));
    for (points, name) in [
        ([9, 16, 0, 1], "PQ"),
        ([9, 18, 0, 1], "HLG"),
        ([1, 9, 0, 1], "number 9"),
        ([1, 8, 0, 0], "narrow-range"),
    ] {
        let error = read(points).unwrap_err();
        assert!(
            matches!(error, DecodeError::Unsupported { .. }) && error.to_string().contains(name),
            "{error}"
        );
    }
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
fn gray_layers_and_what_is_not_read() {
    let encoding = Encoding::SMALL_LOSSLESS;
    let gray = decode(&exr_of(&[("Y", halves(1.0)), ("Z", halves(2.0))], encoding)).unwrap();
    assert_eq!(gray.pixel(2, 1), Some([7.0; 3]));
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
fn the_part_that_is_the_picture_is_read() {
    let part = |name: &str, channel: [&str; 3], factor: f32| {
        let list: SmallVec<[_; 4]> =
            channel.iter().map(|channel| AnyChannel::new(*channel, halves(factor))).collect();
        let attributes = LayerAttributes::named(Text::new_or_none(name).unwrap());
        Layer::new((5, 3), attributes, Encoding::FAST_LOSSLESS, AnyChannels::sort(list))
    };
    let parts = [
        part("depth", ["Z", "ZBack", "id"], 1.0),
        part("other", ["R", "G", "B"], 3.0),
        part("beauty", ["R", "G", "B"], 2.0),
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
    assert!(error.source().unwrap().to_string().contains("none of the formats that are read"));
    assert!(matches!(decode(&[]), Err(DecodeError::Empty)));
    assert!(matches!(decode(b"\x89PNG"), Err(DecodeError::UnknownFormat)));
}
