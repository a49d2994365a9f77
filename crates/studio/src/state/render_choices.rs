//! The choices of the render dialog, which the settings remember.

use std::path::PathBuf;

use catoptric_picture::{BitDepth, Picture, PictureFormat, SampleDepth, SizeError};
use catoptric_scene::Tracing;
use catoptric_tracer::RenderSettings;
use serde::{Deserialize, Serialize};

/// The choices of the last render.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct RenderChoices {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Whether one side follows when the other is changed.
    pub keeps_proportions: bool,
    /// Samples per pixel.
    pub samples: u32,
    /// Generations of rays; `None` for those of the scene.
    pub generations: Option<u32>,
    /// The kind of file.
    pub kind: PictureKind,
    /// Where the last picture was saved.
    pub folder: Option<PathBuf>,
}

/// A kind of picture file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PictureKind {
    /// PNG with 8 bits a channel: what displays show.
    #[default]
    Png8,
    /// PNG with 16 bits a channel.
    Png16,
    /// EXR: the linear light itself.
    Exr,
    /// JPEG, of the usual quality.
    Jpeg,
    /// WebP without loss.
    WebP,
    /// TIFF with 16 bits a channel.
    Tiff,
    /// Radiance HDR: the linear light with a common exponent.
    Hdr,
    /// Portable float map: the linear light itself.
    Pfm,
}

impl PictureKind {
    /// All of them, in the order in which to offer them.
    pub const ALL: [Self; 8] =
        [Self::Png8, Self::Png16, Self::Exr, Self::Jpeg, Self::WebP, Self::Tiff, Self::Hdr, Self::Pfm];

    /// The format of the file.
    pub const fn format(self) -> PictureFormat {
        match self {
            Self::Png8 | Self::Png16 => PictureFormat::Png,
            Self::Exr => PictureFormat::Exr,
            Self::Jpeg => PictureFormat::Jpeg,
            Self::WebP => PictureFormat::WebP,
            Self::Tiff => PictureFormat::Tiff,
            Self::Hdr => PictureFormat::Hdr,
            Self::Pfm => PictureFormat::Pfm,
        }
    }

    /// What the numbers of the file are.
    pub const fn depth(self) -> SampleDepth {
        match self {
            Self::Png8 | Self::Jpeg | Self::WebP => SampleDepth::EIGHT,
            Self::Png16 | Self::Tiff => SampleDepth::SIXTEEN,
            Self::Exr | Self::Hdr | Self::Pfm => SampleDepth::Linear,
        }
    }

    /// True if exposure and tone curve leave the file as it is.
    pub(crate) fn is_linear(self) -> bool {
        self.depth() == SampleDepth::Linear
    }

    /// The usual extension.
    pub fn extension(self) -> &'static str {
        self.format().extensions().first().copied().unwrap_or_default()
    }

    /// The message that names it.
    pub(crate) const fn key(self) -> &'static str {
        match self {
            Self::Png8 => "render-kind-png8",
            Self::Png16 => "render-kind-png16",
            Self::Exr => "render-kind-exr",
            Self::Jpeg => "render-kind-jpeg",
            Self::WebP => "render-kind-webp",
            Self::Tiff => "render-kind-tiff",
            Self::Hdr => "render-kind-hdr",
            Self::Pfm => "render-kind-pfm",
        }
    }

    /// Bytes that a pixel takes while the picture is turned into a file.
    const fn bytes_of_pixel(self) -> u64 {
        match self.depth() {
            SampleDepth::Coded(BitDepth::Eight) => 3,
            SampleDepth::Coded(BitDepth::Sixteen) => 6,
            SampleDepth::Linear => 0,
        }
    }
}

impl Default for RenderChoices {
    fn default() -> Self {
        Self {
            width: 1920,
            height: 1080,
            keeps_proportions: true,
            samples: 16,
            generations: None,
            kind: PictureKind::default(),
            folder: None,
        }
    }
}

impl RenderChoices {
    /// Brings numbers that came from a file within their limits.
    pub(crate) fn check(&mut self) {
        self.width = self.width.clamp(1, Picture::MAX_SIDE);
        self.height = self.height.clamp(1, Picture::MAX_SIDE);
        self.samples = self.samples.clamp(1, RenderSettings::MAX_SAMPLES);
        self.generations = self.generations.map(|own| own.clamp(1, Tracing::MAX_GENERATIONS));
    }

    /// Pixels of the picture.
    pub(crate) fn pixels(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    /// Bytes needed while it is traced and saved: the linear picture with the tracer's list of tiles, and the codes.
    pub(crate) fn bytes(&self) -> u64 {
        self.pixels().saturating_mul(size_of::<[f32; 3]>() as u64 + 1 + self.kind.bytes_of_pixel())
    }

    /// Whether a picture can have this size.
    pub(crate) fn check_size(&self) -> Result<(), SizeError> {
        Picture::check_size(self.width, self.height).map(drop)
    }

    /// Whether the kind of file has room for this size.
    pub(crate) fn fits_kind(&self) -> bool {
        self.width.max(self.height) <= self.kind.format().max_side()
    }

    /// For the tracer.
    pub(crate) fn settings(&self) -> RenderSettings {
        RenderSettings { width: self.width, height: self.height, samples: self.samples }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_a_file_are_brought_within_limits() {
        let text = r#"{"width": 0, "height": 4000000000, "samples": 0, "generations": 99, "other": 1}"#;
        let mut choices: RenderChoices = serde_json::from_str(text).unwrap();
        choices.check();
        assert_eq!((choices.width, choices.height, choices.samples), (1, Picture::MAX_SIDE, 1));
        assert_eq!(choices.generations, Some(Tracing::MAX_GENERATIONS));
        assert_eq!(choices.kind, PictureKind::Png8);
    }

    #[test]
    fn memory_grows_with_pixels_and_depth() {
        let choices = RenderChoices { width: 1000, height: 1000, ..RenderChoices::default() };
        assert_eq!(choices.bytes(), 16_000_000);
        let deep = RenderChoices { kind: PictureKind::Png16, ..choices };
        assert_eq!(deep.bytes(), 19_000_000);
    }
}
