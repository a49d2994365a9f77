//! Portable float maps: linear light in 32-bit floats, one or three to a pixel, the bottom row first (Debevec 2001).

use std::io::{self, BufRead, Read};

use super::limits::check_length;
use super::{DecodeError, ReadOptions, Source};
use crate::format::PictureFormat;
use crate::picture::Picture;

/// The longest word of a head, bytes.
const LONGEST_WORD: u64 = 64;

/// Decodes a file of `length` bytes.
pub(super) fn decode_pfm(
    mut source: Source<'_>,
    length: u64,
    options: &ReadOptions,
) -> Result<Picture, DecodeError> {
    let channels = match word(&mut source)?.as_str() {
        "PF" => 3,
        "Pf" => 1,
        other => {
            return Err(corrupt(format!("it begins with `{}`, not with `PF` or `Pf`", other.escape_debug())));
        }
    };
    let mut side = || -> Result<u32, DecodeError> {
        let text = word(&mut source)?;
        text.parse().map_err(|_| corrupt(format!("`{}` is no number of pixels", text.escape_debug())))
    };
    let (width, height) = (side()?, side()?);
    // One white character stands behind the scale, which the word has taken.
    let text = word(&mut source)?;
    let scale = text.parse().ok().filter(|scale: &f32| scale.is_finite() && *scale != 0.0);
    let scale = scale.ok_or_else(|| corrupt(format!("`{}` is no scale", text.escape_debug())))?;
    options.check_size(width, height)?;
    check_length(u64::from(width) * u64::from(height) * channels as u64 * 4, length, 1)?;
    // The sign of the scale tells the order of bytes.
    let (is_little, scale) = (scale < 0.0, scale.abs());
    let value = |bytes: &[u8; 4]| {
        scale * if is_little { f32::from_le_bytes(*bytes) } else { f32::from_be_bytes(*bytes) }
    };
    let mut picture = Picture::new(width, height)?;
    let mut row = vec![0; width as usize * channels * 4];
    for pixels in picture.pixels_mut().chunks_exact_mut(width as usize).rev() {
        source.read_exact(&mut row).map_err(early)?;
        let samples = row.as_chunks().0;
        for (pixel, stored) in pixels.iter_mut().zip(samples.chunks_exact(channels)) {
            *pixel = match stored {
                [red, green, blue] => [value(red), value(green), value(blue)],
                [gray, ..] => [value(gray); 3],
                [] => [0.0; 3],
            };
        }
    }
    Ok(picture)
}

/// The next word, and the white character behind it.
fn word(source: &mut Source<'_>) -> Result<String, DecodeError> {
    let mut word = Vec::new();
    for byte in source.by_ref().take(LONGEST_WORD).bytes() {
        let byte = byte?;
        if !byte.is_ascii_whitespace() {
            word.push(byte);
        } else if !word.is_empty() {
            return Ok(String::from_utf8_lossy(&word).into_owned());
        }
    }
    if source.fill_buf()?.is_empty() {
        return Err(corrupt("the file ends too early".to_owned()));
    }
    Err(corrupt("its head is too long".to_owned()))
}

fn early(error: io::Error) -> DecodeError {
    match error.kind() {
        io::ErrorKind::UnexpectedEof => corrupt("the file ends too early".to_owned()),
        _ => DecodeError::Io(error),
    }
}

fn corrupt(reason: String) -> DecodeError {
    DecodeError::Corrupt { format: PictureFormat::Pfm.name(), reason }
}
