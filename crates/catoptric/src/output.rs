//! Files to write: their formats and how pictures are saved in them.

use std::path::Path;
use std::time::Instant;

use anyhow::{Result, bail};
use catoptric_picture::{Development, PictureFormat, SampleDepth, SaveOptions};
use catoptric_platform::files::is_stream;

use crate::arguments::DevelopmentArguments;

/// The format of the picture to write to `path`: `format` if it is given, else what the extension says. PNG for a pipe,
/// a device or a descriptor whose name says nothing.
pub(crate) fn format_for_output(path: &Path, format: Option<PictureFormat>) -> Result<PictureFormat> {
    match (format, PictureFormat::of_path(path)) {
        (Some(format), _) | (None, Some(format)) => Ok(format),
        (None, None) if is_stream(path) => Ok(PictureFormat::Png),
        _ => bail!(
            "cannot tell the picture format of {}: give a name that ends in {}, or --format",
            path.display(),
            PictureFormat::extensions_in_words(true)
        ),
    }
}

impl DevelopmentArguments {
    pub(crate) fn development(&self) -> Development {
        Development { exposure_stops: self.exposure, tone_curve: self.tone_curve.unwrap_or_default() }
    }

    /// How to save a picture in this format; formats that hold linear light only leave the bits aside.
    ///
    /// # Errors
    /// When the format is only read, or has no such depth.
    pub(crate) fn save_options(&self, format: PictureFormat, quality: Option<u8>) -> Result<SaveOptions> {
        let depth = match self.bits.as_deref() {
            Some("8") => Some(SampleDepth::EIGHT),
            Some("16") => Some(SampleDepth::SIXTEEN),
            Some(_) => Some(SampleDepth::Linear),
            None => None,
        };
        let is_linear = format.depths() == [SampleDepth::Linear];
        let mut options = SaveOptions::new(format, depth.filter(|_| !is_linear))?;
        options.development = self.development();
        if let Some(quality) = quality {
            if format != PictureFormat::Jpeg {
                bail!("only JPEG has a quality; leave --quality out, or write a name that ends in .jpg");
            }
            options.quality = quality;
        }
        Ok(options)
    }
}

/// Milliseconds since `start`.
pub(crate) fn milliseconds(start: Instant) -> f64 {
    start.elapsed().as_secs_f64() * 1e3
}
