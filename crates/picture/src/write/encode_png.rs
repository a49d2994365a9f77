//! PNG bytes of a developed picture.

use std::io::{self, Write};

use super::EncodeError;
use crate::develop::{Codes, Developed};

/// The developed picture as the bytes of a PNG file: RGB, no alpha, marked as sRGB.
///
/// Chunks: `sRGB` (perceptual), with the `gAMA` and `cHRM` that stand in for it in older readers, and the
/// text `Software` = `Catoptric`. The same picture gives the same bytes: no date, no machine.
///
/// # Errors
/// None is known for a [`Developed`] picture; the encoder's refusals are passed on.
pub fn encode_png(picture: &Developed) -> Result<Vec<u8>, EncodeError> {
    let mut bytes = Vec::new();
    encode_png_to(&mut bytes, picture)?;
    Ok(bytes)
}

/// Writes the bytes of [`encode_png`].
pub(crate) fn encode_png_to(sink: impl Write, picture: &Developed) -> Result<(), EncodeError> {
    let mut sink = Witness { sink, failure: None };
    let encoded = encode_rows(&mut sink, picture);
    sink.failure.map_or(encoded, |failure| Err(EncodeError::Io(failure)))
}

/// Keeps the first failure of the sink as it was: the encoder makes a mere text of it.
struct Witness<W> {
    sink: W,
    failure: Option<io::Error>,
}

impl<W: Write> Witness<W> {
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

impl<W: Write> Write for Witness<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.sink.write(bytes);
        self.note(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        let flushed = self.sink.flush();
        self.note(flushed)
    }
}

fn encode_rows(sink: impl Write, picture: &Developed) -> Result<(), EncodeError> {
    let mut encoder = png::Encoder::new(sink, picture.width(), picture.height());
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(match picture.codes() {
        Codes::Eight(_) => png::BitDepth::Eight,
        Codes::Sixteen(_) => png::BitDepth::Sixteen,
    });
    // Six times as quick as the usual level 6, and a tenth larger on traced pictures.
    encoder.set_deflate_compression(png::DeflateCompression::Level(3));
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    // PNG specification, third edition, 11.3.2.5: the values to put beside sRGB. Others would be left out.
    encoder.set_source_gamma(png::ScaledFloat::from_scaled(45455));
    let chromaticities =
        png::SourceChromaticities::new((0.3127, 0.3290), (0.64, 0.33), (0.30, 0.60), (0.15, 0.06));
    encoder.set_source_chromaticities(chromaticities);
    encoder.add_text_chunk("Software".to_owned(), "Catoptric".to_owned())?;
    let mut header_written = encoder.write_header()?;
    let mut writer = header_written.stream_writer()?;

    match picture.codes() {
        Codes::Eight(codes) => writer.write_all(codes)?,
        Codes::Sixteen(codes) => {
            let mut bytes = Vec::new();
            for row in codes.chunks(3 * picture.width() as usize) {
                bytes.clear();
                bytes.extend(row.iter().flat_map(|code| code.to_be_bytes()));
                writer.write_all(&bytes)?;
            }
        }
    }
    writer.finish()?;
    Ok(header_written.finish()?)
}

impl From<png::EncodingError> for EncodeError {
    fn from(error: png::EncodingError) -> EncodeError {
        match error {
            png::EncodingError::IoError(error) => EncodeError::Io(error),
            other => EncodeError::Refused { format: "PNG", reason: other.to_string() },
        }
    }
}
