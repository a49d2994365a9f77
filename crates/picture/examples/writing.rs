//! What writing a picture takes and gives in each format and setting: a table of bytes and times.
//!
//! ```sh
//! cargo run --release -p catoptric-picture --example writing -- picture.exr
//! ```

#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a program for measuring")]

use std::io::Cursor;
use std::path::Path;
use std::time::Instant;

use catoptric_picture::{Picture, PictureFormat, SampleDepth, SaveOptions, encode_exr_at, read};
use exr::prelude::WritableImage as _;
use exr::prelude::{
    Blocks, Compression, Encoding, Image, Layer, LayerAttributes, LineOrder, SpecificChannels, Vec2,
};

/// How often each is written; the shortest time counts.
const ROUNDS: usize = 15;

fn main() {
    let path = std::env::args_os().nth(1).expect("the path of a picture");
    let picture = read(Path::new(&path)).unwrap();
    println!(
        "{}x{} pixels, {} threads, the shortest of {ROUNDS}\n",
        picture.width(),
        picture.height(),
        rayon::current_num_threads()
    );
    println!("| Format and setting                 |     Bytes |     ms |");
    println!("|------------------------------------|----------:|-------:|");
    for level in [0, 1, 2, 3, 4, 6, 9] {
        row(&format!("EXR, ZIP of 16 rows, level {level}"), || encode_exr_at(&picture, level).unwrap());
    }
    for (name, compression) in [
        ("uncompressed", Compression::Uncompressed),
        ("RLE", Compression::RLE),
        ("ZIP of 1 row", Compression::ZIP1),
        ("ZIP of 16 rows", Compression::ZIP16),
        ("PIZ", Compression::PIZ),
    ] {
        row(&format!("EXR by the crate, {name}"), || by_the_crate(&picture, compression));
    }
    for (format, depth, name) in [
        (PictureFormat::Png, SampleDepth::EIGHT, "PNG of 8 bits"),
        (PictureFormat::Png, SampleDepth::SIXTEEN, "PNG of 16 bits"),
        (PictureFormat::Jpeg, SampleDepth::EIGHT, "JPEG of quality 92"),
        (PictureFormat::WebP, SampleDepth::EIGHT, "WebP"),
        (PictureFormat::Tiff, SampleDepth::EIGHT, "TIFF of 8 bits"),
        (PictureFormat::Tiff, SampleDepth::SIXTEEN, "TIFF of 16 bits"),
        (PictureFormat::Tiff, SampleDepth::Linear, "TIFF of floats"),
        (PictureFormat::Hdr, SampleDepth::Linear, "Radiance HDR"),
    ] {
        let options = SaveOptions::new(format, Some(depth)).unwrap();
        let prepared = options.prepare(&picture).unwrap();
        row(name, || prepared.encode().unwrap());
    }
}

fn row(name: &str, mut encode: impl FnMut() -> Vec<u8>) {
    let mut best = f64::INFINITY;
    let mut bytes = 0;
    for _ in 0..ROUNDS {
        let start = Instant::now();
        bytes = encode().len();
        best = best.min(start.elapsed().as_secs_f64() * 1e3);
    }
    println!("| {name:34} | {bytes:9} | {best:6.1} |");
}

/// The picture by the crate's own writer, on one thread.
fn by_the_crate(picture: &Picture, compression: Compression) -> Vec<u8> {
    let channels = SpecificChannels::rgb(|Vec2(x, y): Vec2<usize>| {
        let [r, g, b] = picture.pixel(x as u32, y as u32).unwrap_or_default();
        (r, g, b)
    });
    let encoding = Encoding { compression, blocks: Blocks::ScanLines, line_order: LineOrder::Increasing };
    let size = (picture.width() as usize, picture.height() as usize);
    let image = Image::from_layer(Layer::new(size, LayerAttributes::default(), encoding, channels));
    let mut bytes = Cursor::new(Vec::new());
    image.write().non_parallel().to_buffered(&mut bytes).unwrap();
    bytes.into_inner()
}
