//! PNG bytes of a developed picture.

use std::io::{self, Write};
use std::ops::Range;

use flate2::{Compress, FlushCompress};
use rayon::prelude::*;

use super::EncodeError;
use crate::develop::{Codes, Developed};

/// The level of Deflate: six times as quick as the usual level 6, and a tenth larger on traced pictures.
const LEVEL: u32 = 3;
/// Bytes of a strip of rows, as 16-bit codes.
const STRIP: usize = 1 << 19;
/// Strips that are compressed before they are written, however many threads there are.
const STRIPS_AT_ONCE: usize = 64;

/// The developed picture as the bytes of a PNG file: RGB, no alpha, marked as sRGB.
///
/// Chunks: `sRGB` (perceptual), with the `gAMA` and `cHRM` that stand in for it in older readers, and the
/// text `Software` = `Catoptric`. Rows are filtered and compressed on all threads. The same picture gives the same
/// bytes: no date, no machine, no matter how many threads.
///
/// # Errors
/// None is known for a [`Developed`] picture; the encoder's refusals are passed on.
pub fn encode_png(picture: &Developed) -> Result<Vec<u8>, EncodeError> {
    let mut bytes = Vec::new();
    encode_png_to(&mut bytes, picture)?;
    Ok(bytes)
}

/// Writes the bytes of [`encode_png`].
pub(crate) fn encode_png_to(sink: &mut dyn Write, picture: &Developed) -> Result<(), EncodeError> {
    let mut sink = FailureRecorder { sink, failure: None };
    let encoded = encode_rows(&mut sink, picture);
    sink.failure.map_or(encoded, |failure| Err(EncodeError::Io(failure)))
}

/// Keeps the first error of the sink, of which the encoder makes a mere text.
struct FailureRecorder<'s> {
    sink: &'s mut dyn Write,
    failure: Option<io::Error>,
}

impl FailureRecorder<'_> {
    fn note<T>(&mut self, result: io::Result<T>) -> io::Result<T> {
        result.map_err(|error| {
            let kind = error.kind();
            if kind != io::ErrorKind::Interrupted {
                self.failure.get_or_insert(error);
            }
            kind.into()
        })
    }
}

impl Write for FailureRecorder<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.sink.write(bytes);
        self.note(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        let flushed = self.sink.flush();
        self.note(flushed)
    }
}

fn encode_rows(sink: &mut FailureRecorder<'_>, picture: &Developed) -> Result<(), EncodeError> {
    let mut encoder = png::Encoder::new(sink, picture.width(), picture.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(match picture.codes() {
        Codes::Eight(_) => png::BitDepth::Eight,
        Codes::Sixteen(_) => png::BitDepth::Sixteen,
    });
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    // PNG specification, third edition, 11.3.2.5: the values to put beside sRGB. Others would be left out.
    encoder.set_source_gamma(png::ScaledFloat::from_scaled(45455));
    let chromaticities =
        png::SourceChromaticities::new((0.3127, 0.3290), (0.64, 0.33), (0.30, 0.60), (0.15, 0.06));
    encoder.set_source_chromaticities(chromaticities);
    encoder.add_text_chunk("Software".to_owned(), "Catoptric".to_owned())?;
    let mut writer = encoder.write_header()?;
    write_rows(&mut writer, picture, LEVEL)?;
    Ok(writer.finish()?)
}

/// Writes the rows, strips of which are filtered and compressed on all threads: their blocks follow one another in one
/// stream of Deflate.
fn write_rows(
    writer: &mut png::Writer<&mut FailureRecorder<'_>>,
    picture: &Developed,
    level: u32,
) -> Result<(), EncodeError> {
    let (width, height) = (picture.width() as usize, picture.height() as usize);
    let rows = (STRIP / (6 * width)).max(1);
    let strips = height.div_ceil(rows);
    let mut sum = Adler32 { sum: 1 };
    for first in (0..strips).step_by(STRIPS_AT_ONCE) {
        let strips_now = first..strips.min(first + STRIPS_AT_ONCE);
        let compressed: Vec<_> = strips_now
            .into_par_iter()
            .map(|strip| compress(&filtered(picture, strip * rows..height.min((strip + 1) * rows)), level))
            .collect();
        for (strip, compressed) in (first..).zip(compressed) {
            let CompressedStrip { mut bytes, adler, length } = compressed?;
            sum = sum.followed_by(adler, length);
            if strip == 0 {
                // Deflate with a window of 32 KiB (RFC 1950, section 2.2).
                bytes.splice(0..0, [0x78, 0x01]);
            }
            if strip + 1 == strips {
                // An empty last block, and the sum of all.
                bytes.extend([0x03, 0x00]);
                bytes.extend(sum.sum.to_be_bytes());
            }
            writer.write_chunk(png::chunk::IDAT, &bytes)?;
        }
    }
    Ok(())
}

/// Compressed rows, ended at a whole byte and without an end of the stream.
struct CompressedStrip {
    bytes: Vec<u8>,
    /// The Adler-32 of the bytes before compression, and their number.
    adler: u32,
    length: usize,
}

/// Compresses the bytes of some rows.
fn compress(bytes: &[u8], level: u32) -> Result<CompressedStrip, EncodeError> {
    let refused = |reason: &str| EncodeError::Refused { format: "PNG", reason: reason.to_owned() };
    let mut deflate = Compress::new(flate2::Compression::new(level), true);
    // Room for the most that Deflate makes of any bytes.
    let mut compressed = Vec::with_capacity(bytes.len() + bytes.len() / 8 + 256);
    let failed = |error: flate2::CompressError| refused(&error.to_string());
    deflate.compress_vec(bytes, &mut compressed, FlushCompress::Sync).map_err(failed)?;
    if deflate.total_in() != bytes.len() as u64 || compressed.len() == compressed.capacity() {
        return Err(refused("its rows do not become fewer bytes"));
    }
    // The end of this stream has the sum; it does not go into the file.
    let mut end = Vec::with_capacity(64);
    deflate.compress_vec(&[], &mut end, FlushCompress::Finish).map_err(failed)?;
    let sum = end.last_chunk::<4>().ok_or_else(|| refused("its stream has no end"))?;
    let adler = u32::from_be_bytes(*sum);
    Ok(CompressedStrip { bytes: compressed.split_off(2), adler, length: bytes.len() })
}

/// The checksum of RFC 1950, section 8.2: two sums modulo 65521, of bytes and of sums.
struct Adler32 {
    sum: u32,
}

impl Adler32 {
    /// The checksum of the bytes so far and `length` more, whose own checksum is `next`.
    fn followed_by(&self, next: u32, length: usize) -> Self {
        const BASE: u64 = 65_521;
        let parts = |sum: u32| (u64::from(sum & 0xffff), u64::from(sum >> 16));
        let ((own, own_sums), (next, next_sums)) = (parts(self.sum), parts(next));
        let bytes = (own + next + BASE - 1) % BASE;
        let sums = (own_sums + next_sums + (length as u64 % BASE) * ((own + BASE - 1) % BASE)) % BASE;
        Self { sum: (sums << 16 | bytes) as u32 }
    }
}

/// The rows of a range, each with the filter that leaves the smallest differences (PNG specification, third edition,
/// sections 9.2 and 12.7).
fn filtered(picture: &Developed, range: Range<usize>) -> Vec<u8> {
    let mut filter = RowFilter::new(picture);
    if let Some(before) = range.start.checked_sub(1) {
        filter.load(picture, before);
    }
    let mut bytes = Vec::with_capacity(range.len() * (filter.length() + 1));
    for y in range {
        filter.load(picture, y);
        filter.append(&mut bytes);
    }
    bytes
}

/// Two rows, and what the filters make of the second.
struct RowFilter {
    /// Bytes of a pixel, as many of which stand as zeros before each row.
    pixel: usize,
    above: Vec<u8>,
    row: Vec<u8>,
    tried: Vec<u8>,
    best: Vec<u8>,
}

impl RowFilter {
    fn new(picture: &Developed) -> Self {
        let pixel = match picture.codes() {
            Codes::Eight(_) => 3,
            Codes::Sixteen(_) => 6,
        };
        let length = pixel * picture.width() as usize;
        let row = || vec![0; pixel + length];
        Self { pixel, above: row(), row: row(), tried: vec![0; length], best: vec![0; length] }
    }

    /// Bytes of a row.
    fn length(&self) -> usize {
        self.best.len()
    }

    /// Goes on to the row `y`.
    fn load(&mut self, picture: &Developed, y: usize) {
        std::mem::swap(&mut self.above, &mut self.row);
        let count = 3 * picture.width() as usize;
        let target = self.row.iter_mut().skip(self.pixel);
        match picture.codes() {
            Codes::Eight(codes) => {
                target.zip(codes.iter().skip(y * count)).for_each(|(target, code)| *target = *code);
            }
            Codes::Sixteen(codes) => {
                let bytes = codes.iter().skip(y * count).take(count).flat_map(|code| code.to_be_bytes());
                target.zip(bytes).for_each(|(target, byte)| *target = byte);
            }
        }
    }

    /// Appends the number of the best filter and what it makes of the row.
    fn append(&mut self, bytes: &mut Vec<u8>) {
        let mut best = (u64::MAX, 0);
        for number in 0..5 {
            self.attempt(number);
            // The sum of the differences, which count as signed.
            let sum = self.tried.iter().map(|byte| u64::from((*byte as i8).unsigned_abs())).sum();
            if sum < best.0 {
                best = (sum, number);
                std::mem::swap(&mut self.tried, &mut self.best);
            }
        }
        bytes.push(best.1);
        bytes.extend_from_slice(&self.best);
    }

    /// Filters the row by the filter of this number.
    fn attempt(&mut self, number: u8) {
        let Self { pixel, above, row, tried, .. } = self;
        let (own, up) = (row.iter().skip(*pixel), above.iter().skip(*pixel));
        let own = tried.iter_mut().zip(own);
        let left = row.iter();
        match number {
            0 => own.for_each(|(to, own)| *to = *own),
            1 => own.zip(left).for_each(|((to, own), left)| *to = own.wrapping_sub(*left)),
            2 => own.zip(up).for_each(|((to, own), up)| *to = own.wrapping_sub(*up)),
            3 => own.zip(left).zip(up).for_each(|(((to, own), left), up)| {
                *to = own.wrapping_sub(((u16::from(*left) + u16::from(*up)) / 2) as u8);
            }),
            _ => own.zip(left).zip(up).zip(above.iter()).for_each(|((((to, own), left), up), corner)| {
                *to = own.wrapping_sub(paeth(*left, *up, *corner));
            }),
        }
    }
}

/// The neighbor that is nearest to left + above − corner, left before above before corner.
fn paeth(left: u8, up: u8, corner: u8) -> u8 {
    let [a, b, c] = [left, up, corner].map(i16::from);
    let (to_a, to_b, to_c) = ((b - c).abs(), (a - c).abs(), (a + b - 2 * c).abs());
    if to_a <= to_b && to_a <= to_c {
        left
    } else if to_b <= to_c {
        up
    } else {
        corner
    }
}

impl From<png::EncodingError> for EncodeError {
    fn from(error: png::EncodingError) -> EncodeError {
        match error {
            png::EncodingError::IoError(error) => EncodeError::Io(error),
            other => EncodeError::Refused { format: "PNG", reason: other.to_string() },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checksums_of_parts_make_that_of_the_whole() {
        // RFC 1950's own words: a is 1 plus the sum of the bytes, b the sum of all a.
        let whole = |bytes: &[u8]| {
            let (a, b) = bytes.iter().fold((1_u32, 0_u32), |(a, b), byte| {
                let a = (a + u32::from(*byte)) % 65_521;
                (a, (b + a) % 65_521)
            });
            b << 16 | a
        };
        let bytes: Vec<u8> = (0..200_000_u64).map(|i| (i * i % 253) as u8).collect();
        for cut in [0, 1, 2, 65_520, 65_521, 131_042, 200_000] {
            let (one, other) = bytes.split_at(cut);
            let sum = Adler32 { sum: whole(one) }.followed_by(whole(other), other.len()).sum;
            assert_eq!(sum, whole(&bytes), "cut at {cut}");
        }
        let strip = compress(&bytes, LEVEL).unwrap();
        assert_eq!((strip.adler, strip.length), (whole(&bytes), bytes.len()));
    }

    #[test]
    fn bytes_without_any_order_are_compressed_too() {
        let mut state = 1_u64;
        let noise: Vec<u8> = std::iter::repeat_with(|| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 56) as u8
        })
        .take(700_000)
        .collect();
        for level in [1, 3, 6, 9] {
            assert!(compress(&noise, level).is_ok_and(|strip| strip.bytes.len() > 600_000));
        }
    }
}
