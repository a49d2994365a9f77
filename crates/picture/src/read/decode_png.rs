//! PNG bytes to linear light.

use super::limits::{DEFLATE, check_length};
use super::transfer::Transfer;
use super::{DecodeError, ReadOptions, Source};
use crate::picture::Picture;

/// Decodes a PNG of `length` bytes.
pub(super) fn decode_png(
    source: Source<'_>,
    length: u64,
    options: &ReadOptions,
) -> Result<Picture, DecodeError> {
    // The memory of rows and of the chunks beside the pixels is limited to 64 MiB.
    let mut decoder = png::Decoder::new(source);
    // Palettes become RGB, 1 to 4 bits become 8, transparent colors become alpha.
    decoder.set_transformations(png::Transformations::EXPAND);
    decoder.set_ignore_text_chunk(true);
    let header = decoder.read_header_info()?;
    let (width, height) = (header.width, header.height);
    options.check_size(width, height)?;
    check_length((header.raw_row_length() as u64).saturating_mul(u64::from(height)), length, DEFLATE)?;

    let mut reader = decoder.read_info()?;
    let interlaced = reader.info().interlaced;
    let (color, depth) = reader.output_color_type();
    let (samples, wide) = (color.samples(), depth == png::BitDepth::Sixteen);
    let light = Transfer::of(reader.info())?.table(if wide { 65535 } else { 255 });
    let light_of = |code: usize| light.get(code).copied().unwrap_or_default();

    let mut picture = Picture::new(width, height)?;
    for place in rows(width, height, interlaced) {
        let row = reader.next_row()?.ok_or_else(|| corrupt("rows are missing"))?;
        let Some(target) = picture.rows_mut().nth(place.y) else { continue };
        let pixels = target.iter_mut().skip(place.x).step_by(place.step);
        let bytes = if wide { 2 } else { 1 };
        if row.data().len() != pixels.len() * samples * bytes {
            return Err(corrupt("a row has a wrong length"));
        }
        if wide {
            let value =
                |pair: &[u8]| light_of(pair.iter().fold(0, |high, &low| high << 8 | usize::from(low)));
            fill(pixels, row.data().chunks_exact(2 * samples), |pixel| {
                color_of(pixel.chunks_exact(2).map(value))
            });
        } else {
            let value = |&code: &u8| light_of(usize::from(code));
            fill(pixels, row.data().chunks_exact(samples), |pixel| color_of(pixel.iter().map(value)));
        }
    }
    reader.finish()?;
    Ok(picture)
}

/// Puts the colors of the encoded pixels in place.
fn fill<'p, 'd>(
    pixels: impl Iterator<Item = &'p mut [f32; 3]>,
    encoded: impl Iterator<Item = &'d [u8]>,
    color: impl Fn(&'d [u8]) -> [f32; 3],
) {
    for (pixel, encoded) in pixels.zip(encoded) {
        *pixel = color(encoded);
    }
}

/// The color of one pixel from its samples: three or more are RGB and perhaps alpha, fewer are gray.
fn color_of(mut samples: impl Iterator<Item = f32>) -> [f32; 3] {
    let first = samples.next().unwrap_or_default();
    match (samples.next(), samples.next()) {
        (Some(green), Some(blue)) => [first, green, blue],
        _ => [first; 3],
    }
}

/// The target of a stored row: row `y`, every `step`-th column from `x` on.
struct RowTarget {
    y: usize,
    x: usize,
    step: usize,
}

/// The stored rows in their order: one pass from the top, or the seven passes of Adam7 (PNG specification,
/// third edition, 8.2), where passes without pixels are left out.
fn rows(width: u32, height: u32, interlaced: bool) -> impl Iterator<Item = RowTarget> {
    // First column, first row, columns apart, rows apart.
    const WHOLE: [[usize; 4]; 1] = [[0, 0, 1, 1]];
    const ADAM7: [[usize; 4]; 7] =
        [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];
    let passes: &[[usize; 4]] = if interlaced { &ADAM7 } else { &WHOLE };
    let (width, height) = (width as usize, height as usize);
    passes.iter().filter(move |[x, ..]| *x < width).flat_map(move |&[x, y, step, apart]| {
        (y..height).step_by(apart).map(move |y| RowTarget { y, x, step })
    })
}

fn corrupt(reason: impl Into<String>) -> DecodeError {
    DecodeError::Corrupt { format: "PNG", reason: reason.into() }
}

impl From<png::DecodingError> for DecodeError {
    fn from(error: png::DecodingError) -> DecodeError {
        match error {
            png::DecodingError::IoError(error) if error.kind() != std::io::ErrorKind::UnexpectedEof => {
                DecodeError::Io(error)
            }
            other => corrupt(other.to_string()),
        }
    }
}
