//! The table of the file formats of pictures: extensions, what is read and written, and what the numbers mean.

use std::path::Path;

use crate::develop::BitDepth;
use crate::picture::Picture;

/// A file format of pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PictureFormat {
    /// Portable Network Graphics: codes of 8 or 16 bits, without loss.
    Png,
    /// OpenEXR: linear light in floating-point numbers, with layers.
    Exr,
    /// JPEG: codes of 8 bits, with loss.
    Jpeg,
    /// Radiance HDR (RGBE): linear light with 8 bits of mantissa and a common exponent.
    Hdr,
    /// WebP: codes of 8 bits; written without loss.
    WebP,
    /// TIFF: codes of 8 or 16 bits, or linear light in 32-bit floats.
    Tiff,
    /// Windows bitmap: codes of 8 bits; read only.
    Bmp,
    /// Netpbm: PPM, PGM, PBM and PAM, codes of 8 or 16 bits as text or bytes; written as PPM of 8 bits.
    Ppm,
    /// Portable float map: linear light in 32-bit floats, gray or RGB; written as RGB.
    Pfm,
}

/// The type of a channel's numbers in a written file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SampleDepth {
    /// sRGB codes of so many bits.
    Coded(BitDepth),
    /// Linear light in floating-point numbers.
    Linear,
}

impl SampleDepth {
    /// sRGB codes of 8 bits.
    pub const EIGHT: Self = Self::Coded(BitDepth::Eight);
    /// sRGB codes of 16 bits.
    pub const SIXTEEN: Self = Self::Coded(BitDepth::Sixteen);
}

impl PictureFormat {
    /// All formats, in the order in which to offer them.
    pub const ALL: [Self; 9] = [
        Self::Png,
        Self::Exr,
        Self::Jpeg,
        Self::Hdr,
        Self::WebP,
        Self::Tiff,
        Self::Bmp,
        Self::Ppm,
        Self::Pfm,
    ];

    /// The name of the format, such as `PNG`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Png => "PNG",
            Self::Exr => "EXR",
            Self::Jpeg => "JPEG",
            Self::Hdr => "HDR",
            Self::WebP => "WebP",
            Self::Tiff => "TIFF",
            Self::Bmp => "BMP",
            Self::Ppm => "PPM",
            Self::Pfm => "PFM",
        }
    }

    /// The usual extensions in lower case, without a dot; the first one is for new files.
    pub const fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Png => &["png"],
            Self::Exr => &["exr"],
            Self::Jpeg => &["jpg", "jpeg"],
            Self::Hdr => &["hdr"],
            Self::WebP => &["webp"],
            Self::Tiff => &["tif", "tiff"],
            Self::Bmp => &["bmp"],
            Self::Ppm => &["ppm", "pnm"],
            Self::Pfm => &["pfm"],
        }
    }

    /// The depths in which the format is written, the default first; empty if it is only read.
    pub const fn depths(self) -> &'static [SampleDepth] {
        match self {
            Self::Png => &[SampleDepth::EIGHT, SampleDepth::SIXTEEN],
            Self::Exr | Self::Hdr | Self::Pfm => &[SampleDepth::Linear],
            Self::Jpeg | Self::WebP | Self::Ppm => &[SampleDepth::EIGHT],
            Self::Tiff => &[SampleDepth::SIXTEEN, SampleDepth::EIGHT, SampleDepth::Linear],
            Self::Bmp => &[],
        }
    }

    /// The most pixels along a side of a file that is written.
    pub const fn max_side(self) -> u32 {
        match self {
            Self::Jpeg => 65_535,
            Self::WebP => 16_384,
            _ => Picture::MAX_SIDE,
        }
    }

    /// True if renders can be written in this format.
    pub const fn is_written(self) -> bool {
        !self.depths().is_empty()
    }

    /// True if files of this format hold linear light, never codes.
    pub const fn is_of_light(self) -> bool {
        matches!(self.depths(), [SampleDepth::Linear])
    }

    /// True if files of this format can have several layers.
    pub const fn has_layers(self) -> bool {
        matches!(self, Self::Exr)
    }

    /// The format of the name's extension, in any case.
    pub fn of_path(path: &Path) -> Option<Self> {
        Self::of_extension(path.extension()?.to_str()?)
    }

    /// The format of an extension without a dot, in any case.
    pub fn of_extension(extension: &str) -> Option<Self> {
        let fits = |format: &Self| format.extensions().iter().any(|own| own.eq_ignore_ascii_case(extension));
        Self::ALL.into_iter().find(fits)
    }

    /// The extensions of the formats that are read, or of those that are written.
    pub fn all_extensions(is_for_writing: bool) -> impl Iterator<Item = &'static str> {
        let formats = Self::ALL.into_iter().filter(move |format| !is_for_writing || format.is_written());
        formats.flat_map(|format| format.extensions().iter().copied())
    }

    /// The extensions in words: `.png, .exr or .jpg`.
    pub fn extensions_in_words(is_for_writing: bool) -> String {
        let dotted: Vec<String> = Self::all_extensions(is_for_writing).map(|own| format!(".{own}")).collect();
        match dotted.as_slice() {
            [first @ .., last] if !first.is_empty() => format!("{} or {last}", first.join(", ")),
            other => other.concat(),
        }
    }

    /// The names of the formats that are read, in words.
    pub fn names_in_words() -> String {
        Self::ALL.map(Self::name).join(", ")
    }

    /// The format that a file's first bytes tell, at least twelve of them where the file is so long.
    pub fn of_content(start: &[u8]) -> Option<Self> {
        let starts = |magic: &[u8]| start.starts_with(magic);
        if starts(b"\x89PNG\r\n\x1a\n") {
            Some(Self::Png)
        } else if starts(b"\x76\x2f\x31\x01") {
            Some(Self::Exr)
        } else if starts(b"\xff\xd8\xff") {
            Some(Self::Jpeg)
        } else if starts(b"#?RADIANCE") || starts(b"#?RGBE") {
            Some(Self::Hdr)
        } else if starts(b"RIFF") && start.get(8..12) == Some(b"WEBP") {
            Some(Self::WebP)
        } else if starts(b"II\x2a\0") || starts(b"MM\0\x2a") || starts(b"II\x2b\0") || starts(b"MM\0\x2b") {
            Some(Self::Tiff)
        } else if starts(b"BM") {
            Some(Self::Bmp)
        } else if let [b'P', b'1'..=b'7', space, ..] = start
            && (space.is_ascii_whitespace() || *space == b'#')
        {
            Some(Self::Ppm)
        } else if let [b'P', b'F' | b'f', space, ..] = start
            && space.is_ascii_whitespace()
        {
            Some(Self::Pfm)
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extensions_belong_to_one_format_in_any_case() {
        for format in PictureFormat::ALL {
            for extension in format.extensions() {
                for name in [format!("a.b.{extension}"), format!("x.{}", extension.to_uppercase())] {
                    assert_eq!(PictureFormat::of_path(Path::new(&name)), Some(format));
                }
            }
        }
        for name in ["png", "a.png.txt", "a.", "a.toml", ".png"] {
            assert_eq!(PictureFormat::of_path(Path::new(name)), None, "{name}");
        }
    }

    #[test]
    fn what_is_only_read_is_not_offered_for_writing() {
        let (read, written) =
            (PictureFormat::extensions_in_words(false), PictureFormat::extensions_in_words(true));
        assert_eq!(read, ".png, .exr, .jpg, .jpeg, .hdr, .webp, .tif, .tiff, .bmp, .ppm, .pnm or .pfm");
        assert_eq!(written, ".png, .exr, .jpg, .jpeg, .hdr, .webp, .tif, .tiff, .ppm, .pnm or .pfm");
    }
}
