//! Pictures that a scene takes from files.

pub(crate) mod built_in;

use std::fmt;
use std::sync::Arc;

use catoptric_picture::{DecodeError, Picture, ReadError, ReadOptions, SizeError};

use crate::color::Color;

/// The source of a scene's picture, as scene files have it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ImageSource {
    path: Arc<str>,
    layer: Option<Arc<str>>,
}

impl ImageSource {
    /// The file at `path`, and the layer to take of it if it has several.
    pub fn new(path: impl Into<Arc<str>>, layer: Option<Arc<str>>) -> Self {
        Self { path: path.into(), layer }
    }

    /// The path.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// The name of the layer; `None` for the picture itself.
    pub fn layer(&self) -> Option<&str> {
        self.layer.as_deref()
    }

    /// The pixels as a scene takes them from a decoder: the layer of this source, of at most [`Image::MAX_PIXELS`], with
    /// bounded light.
    ///
    /// # Errors
    /// What is wrong with the picture.
    pub fn pixels_from<E: Into<ImageFault>>(
        &self,
        decode: impl FnOnce(&ReadOptions) -> Result<Picture, E>,
    ) -> Result<Arc<Picture>, ImageFault> {
        let options =
            ReadOptions { layer: self.layer().map(str::to_owned), max_pixels: Image::MAX_PIXELS as u64 };
        let mut picture = decode(&options).map_err(Into::into)?;
        picture.pixels_mut().iter_mut().flatten().for_each(|part| *part = sane(*part));
        Ok(Arc::new(picture))
    }
}

/// Where the pictures that a scene names come from: a folder, the memory of a page.
pub trait Resources {
    /// The pixels of a picture that does not come with the program. The same picture, unchanged, should give the same
    /// pixels while any scene has them.
    ///
    /// # Errors
    /// What is wrong with the picture.
    fn picture(&self, source: &ImageSource) -> Result<Arc<Picture>, ImageFault>;
}

/// No pictures but those that come with the program.
#[derive(Clone, Copy, Debug)]
pub struct NoResources;

impl Resources for NoResources {
    fn picture(&self, source: &ImageSource) -> Result<Arc<Picture>, ImageFault> {
        Err(ImageFault::Missing(source.path().to_owned()))
    }
}

/// A picture that a scene takes from a file: surroundings, or the texture of a body.
///
/// The scene file has its path; the pixels are there once it is [opened](Image::open). Without them,
/// surroundings are the background and a body has its color.
#[derive(Clone)]
pub struct Image {
    source: ImageSource,
    pixels: Option<Arc<Picture>>,
    mean: Color,
    brightest: Color,
}

impl Image {
    /// What paths of pictures begin with that come with the program.
    pub const BUILT_IN: &'static str = "builtin:";

    /// Names of the pictures that come with the program, after [`Self::BUILT_IN`].
    pub const BUILT_IN_NAMES: [&'static str; built_in::ALL.len()] = built_in::NAMES;

    /// The most pixels of an image: 2²⁵, 8192×4096.
    pub const MAX_PIXELS: usize = 1 << 25;

    /// A picture that is not opened yet.
    pub fn new(path: impl Into<Arc<str>>) -> Self {
        Self::from_source(ImageSource::new(path, None))
    }

    /// A picture that is not opened yet.
    pub fn from_source(source: ImageSource) -> Self {
        Self { source, pixels: None, mean: Color::BLACK, brightest: Color::BLACK }
    }

    /// A picture whose pixels are known.
    pub fn with_pixels(path: impl Into<Arc<str>>, pixels: Arc<Picture>) -> Self {
        Self::opened(ImageSource::new(path, None), pixels)
    }

    fn opened(source: ImageSource, pixels: Arc<Picture>) -> Self {
        let (mut sum, mut most) = ([0.0; 3], [0.0_f64; 3]);
        for pixel in pixels.pixels() {
            for ((sum, most), part) in sum.iter_mut().zip(&mut most).zip(pixel) {
                *sum += f64::from(*part);
                *most = most.max(f64::from(*part));
            }
        }
        let mean = sum.map(|part: f64| part / pixels.pixels().len() as f64);
        Self { source, pixels: Some(pixels), mean: mean.into(), brightest: most.into() }
    }

    /// The mean of its pixels; black while they are not known.
    pub fn mean(&self) -> Color {
        self.mean
    }

    /// The most that any pixel has, of each channel; black while they are not known.
    pub fn brightest(&self) -> Color {
        self.brightest
    }

    /// The picture of a source, as `resources` have it.
    ///
    /// # Errors
    /// What is wrong with the picture.
    pub fn open(source: &ImageSource, resources: &dyn Resources) -> Result<Self, ImageError> {
        let found = match source.path.strip_prefix(Self::BUILT_IN) {
            Some(_) if source.layer.is_some() => Err(ImageFault::BuiltInLayer),
            Some(name) => built_in::picture(name).ok_or(ImageFault::NotBuiltIn),
            None => resources.picture(source),
        };
        let refused = |fault| ImageError { image: source.clone(), fault };
        found.map(|pixels| Self::opened(source.clone(), pixels)).map_err(refused)
    }

    /// A picture that comes with the program, by its name after [`Self::BUILT_IN`].
    pub fn built_in(name: &str) -> Option<Self> {
        let source = ImageSource::new(format!("{}{name}", Self::BUILT_IN), None);
        Some(Self::opened(source, built_in::picture(name)?))
    }

    /// Where it comes from, as scene files say it.
    pub fn source(&self) -> &ImageSource {
        &self.source
    }

    /// The path of the picture, as scene files have it.
    pub fn path(&self) -> &str {
        &self.source.path
    }

    /// The layer of its file; `None` for the picture itself.
    pub fn layer(&self) -> Option<&str> {
        self.source.layer()
    }

    /// The pixels of the picture, in linear light, once it is opened.
    pub fn pixels(&self) -> Option<&Arc<Picture>> {
        self.pixels.as_ref()
    }

    /// Whether it comes with the program.
    pub fn is_built_in(&self) -> bool {
        self.path().starts_with(Self::BUILT_IN)
    }

    /// Gives the picture another path.
    #[must_use]
    pub fn with_path(&self, path: impl Into<Arc<str>>) -> Self {
        let layer = self.source.layer.clone();
        Self { source: ImageSource::new(path, layer), ..self.clone() }
    }
}

/// Equal sources, and equal pixels.
impl PartialEq for Image {
    fn eq(&self, other: &Self) -> bool {
        let same_pixels = match (&self.pixels, &other.pixels) {
            (Some(own), Some(others)) => Arc::ptr_eq(own, others) || own == others,
            (None, None) => true,
            _ => false,
        };
        self.source == other.source && same_pixels
    }
}

impl fmt::Debug for Image {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.pixels.as_ref().map(|picture| (picture.width(), picture.height()));
        out.debug_struct("Image").field("source", &self.source).field("size", &size).finish()
    }
}

/// The reason why a picture of a scene could not be opened.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cannot open the picture `{}`: {fault}", image.path)]
pub struct ImageError {
    /// Where it should come from, as scene files say it.
    pub image: ImageSource,
    /// What is wrong with it.
    pub fault: ImageFault,
}

/// The fault of a picture, with what to do.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ImageFault {
    /// No built-in picture has this name.
    #[error("there is no built-in picture of this name; there are {}", Image::BUILT_IN_NAMES.join(", "))]
    NotBuiltIn,
    /// A built-in picture has no layers.
    #[error("a built-in picture has no layers; remove `layer`")]
    BuiltInLayer,
    /// There is no such file.
    #[error("there is no file {0}; check the path, which begins at the scene's folder")]
    Missing(String),
    /// The path names a folder, a pipe or a device.
    #[error("it is not a plain file; save the picture in one")]
    NotAFile,
    /// The picture has too many pixels.
    #[error("it has {width}x{height} pixels, but may have as many as 8192x4096; make it smaller")]
    TooLarge {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// The file cannot be read as a picture.
    #[error("{reason}")]
    Unreadable {
        /// What the decoder or the system says of it, in English.
        reason: String,
        /// What is wrong, as far as it is known.
        kind: UnreadableKind,
    },
}

/// The reason why a file cannot be read as a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum UnreadableKind {
    /// The file is empty.
    Empty,
    /// The file has no known format.
    UnknownFormat,
    /// The file is truncated or corrupt.
    Damaged,
    /// The file has several layers, and none is known as the picture.
    ManyLayers {
        /// The names of the layers.
        layers: Vec<String>,
    },
    /// The file has no layer of the requested name.
    NoSuchLayer {
        /// The names of those that there are; none if there are no named layers.
        layers: Vec<String>,
    },
    /// Something else, which is known in English only.
    Other,
}

impl From<DecodeError> for ImageFault {
    fn from(error: DecodeError) -> Self {
        match error {
            DecodeError::TooLarge { width, height, .. }
            | DecodeError::Size(
                SizeError::Pixels { width, height, .. } | SizeError::Side { width, height, .. },
            ) => Self::TooLarge { width, height },
            error => Self::Unreadable { reason: error.to_string(), kind: (&error).into() },
        }
    }
}

impl From<ReadError> for ImageFault {
    fn from(error: ReadError) -> Self {
        match error {
            ReadError::Decode { source, .. } => source.into(),
            other => Self::Unreadable { reason: other.to_string(), kind: UnreadableKind::Other },
        }
    }
}

impl From<&DecodeError> for UnreadableKind {
    fn from(error: &DecodeError) -> Self {
        match error {
            DecodeError::Empty => Self::Empty,
            DecodeError::UnknownFormat => Self::UnknownFormat,
            DecodeError::TooShort { .. } | DecodeError::Corrupt { .. } | DecodeError::Breakdown { .. } => {
                Self::Damaged
            }
            DecodeError::ManyLayers { layers } => Self::ManyLayers { layers: layers.clone() },
            DecodeError::NoSuchLayer { layers, .. } => Self::NoSuchLayer { layers: layers.clone() },
            _ => Self::Other,
        }
    }
}

/// An amount of light as scenes have them: a file may say anything.
fn sane(part: f32) -> f32 {
    const MOST: f32 = 1e6;
    if part.is_nan() { 0.0 } else { part.clamp(0.0, MOST) }
}
