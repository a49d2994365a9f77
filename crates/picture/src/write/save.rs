//! A picture in a file of any format that is written.

use std::io;
use std::path::Path;

use catoptric_platform::files::{Sink, WriteError, write_whole};

use super::EncodeError;
use super::encode_exr::encode_exr_to;
use super::encode_image::{
    encode_hdr_to, encode_jpeg_to, encode_ppm_to, encode_tiff_codes_to, encode_tiff_light_to, encode_webp_to,
};
use super::encode_pfm::encode_pfm_to;
use super::encode_png::encode_png_to;
use crate::develop::{Developed, Development};
use crate::format::{PictureFormat, SampleDepth};
use crate::picture::{Picture, SizeError};

/// The reason why a picture cannot be saved in a format.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FormatError {
    /// The format is only read.
    #[error("{} pictures are read, but not written; give a name that ends in {}",
        format.name(), PictureFormat::extensions_in_words(true))]
    ReadOnly {
        /// The format.
        format: PictureFormat,
    },
    /// The format has no such depth.
    #[error("{} files are not written with {}; they have {}", format.name(), in_words(*depth), depths_in_words(*format))]
    Depth {
        /// The format.
        format: PictureFormat,
        /// The depth asked for.
        depth: SampleDepth,
    },
    /// The format has no room for so large a picture.
    #[error("a {} file has at most {most} pixels along a side, not {width}x{height}; choose another format", format.name())]
    Side {
        /// The format.
        format: PictureFormat,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// The most pixels along a side.
        most: u32,
    },
}

fn in_words(depth: SampleDepth) -> &'static str {
    match depth {
        SampleDepth::EIGHT => "8 bits per channel",
        SampleDepth::SIXTEEN => "16 bits per channel",
        SampleDepth::Linear => "linear light",
    }
}

fn depths_in_words(format: PictureFormat) -> String {
    format.depths().iter().map(|depth| in_words(*depth)).collect::<Vec<_>>().join(" or ")
}

/// The options of saving a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SaveOptions {
    format: PictureFormat,
    depth: SampleDepth,
    /// How light becomes codes; linear depths leave it aside. Default: unchanged light, no tone curve.
    pub development: Development,
    /// The quality of a JPEG, 1 to 100. Default [`SaveOptions::QUALITY`].
    pub quality: u8,
}

impl SaveOptions {
    /// The default quality of a JPEG: hardly any block is seen at normal size.
    pub const QUALITY: u8 = 92;

    /// For files of this format, in its default depth or another of its depths.
    ///
    /// # Errors
    /// When the format is only read or has no such depth.
    pub fn new(format: PictureFormat, depth: Option<SampleDepth>) -> Result<Self, FormatError> {
        let first = *format.depths().first().ok_or(FormatError::ReadOnly { format })?;
        let depth = depth.unwrap_or(first);
        if !format.depths().contains(&depth) {
            return Err(FormatError::Depth { format, depth });
        }
        Ok(Self { format, depth, development: Development::default(), quality: Self::QUALITY })
    }

    /// The format of the file.
    pub fn format(&self) -> PictureFormat {
        self.format
    }

    /// What the numbers of the file are.
    pub fn depth(&self) -> SampleDepth {
        self.depth
    }

    /// Asks before the work whether the format has room for a picture of this size.
    ///
    /// # Errors
    /// When a side is too long.
    pub fn check_size(&self, width: u32, height: u32) -> Result<(), FormatError> {
        let (format, most) = (self.format, self.format.max_side());
        if width.max(height) > most { Err(FormatError::Side { format, width, height, most }) } else { Ok(()) }
    }

    /// Develops the picture if the file holds codes.
    ///
    /// # Errors
    /// When there is too little memory.
    pub fn prepare<'p>(&self, picture: &'p Picture) -> Result<PreparedPicture<'p>, SizeError> {
        let pixels = match self.depth {
            SampleDepth::Linear => Pixels::Light(picture),
            SampleDepth::Coded(depth) => Pixels::Codes(self.development.develop(picture, depth)?),
        };
        Ok(PreparedPicture { format: self.format, quality: self.quality.clamp(1, 100), pixels })
    }
}

/// A picture in the numbers of its file, to be encoded.
#[derive(Debug)]
pub struct PreparedPicture<'p> {
    format: PictureFormat,
    quality: u8,
    pixels: Pixels<'p>,
}

#[derive(Debug)]
enum Pixels<'p> {
    Light(&'p Picture),
    Codes(Developed),
}

impl PreparedPicture<'_> {
    /// Writes the file, whole or not at all; an existing one is replaced.
    ///
    /// # Errors
    /// What [`check_writable`](catoptric_platform::files::check_writable) finds, a full disk, or a failing system.
    pub fn write(&self, path: &Path) -> Result<(), WriteError> {
        write_whole(path, |sink| Ok(self.encode_to(sink)?))
    }

    /// The bytes of the file. The same picture gives the same bytes for any number of threads.
    ///
    /// # Errors
    /// When the encoder refuses the picture.
    pub fn encode(&self) -> Result<Vec<u8>, EncodeError> {
        let mut bytes = io::Cursor::new(Vec::new());
        self.encode_to(&mut bytes)?;
        Ok(bytes.into_inner())
    }

    /// Writes the bytes of [`Self::encode`].
    ///
    /// # Errors
    /// Those of [`Self::encode`], and those of the sink.
    pub fn encode_to(&self, sink: &mut dyn Sink) -> Result<(), EncodeError> {
        match (&self.pixels, self.format) {
            (Pixels::Light(picture), PictureFormat::Hdr) => encode_hdr_to(sink, picture),
            (Pixels::Light(picture), PictureFormat::Tiff) => encode_tiff_light_to(sink, picture),
            (Pixels::Light(picture), PictureFormat::Pfm) => encode_pfm_to(sink, picture),
            (Pixels::Light(picture), _) => encode_exr_to(sink, picture),
            (Pixels::Codes(codes), PictureFormat::Jpeg) => encode_jpeg_to(sink, codes, self.quality),
            (Pixels::Codes(codes), PictureFormat::WebP) => encode_webp_to(sink, codes),
            (Pixels::Codes(codes), PictureFormat::Ppm) => encode_ppm_to(sink, codes),
            (Pixels::Codes(codes), PictureFormat::Tiff) => encode_tiff_codes_to(sink, codes),
            (Pixels::Codes(codes), _) => encode_png_to(sink, codes),
        }
    }
}
