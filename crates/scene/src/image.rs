//! Pictures that a scene takes from files.

pub(crate) mod built_in;

use std::collections::HashMap;
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, LazyLock, Mutex, PoisonError, Weak};
use std::time::SystemTime;

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
}

/// A picture that a scene takes from a file: surroundings, or the texture of a body.
///
/// The scene file has its path; the pixels are there once it is [opened](Image::open_source). Without them,
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

    /// The picture of a source, a file of any format that is read. A relative path begins at `folder`, that of the
    /// scene file, or where the program was started. The same file, unchanged, gives the same pixels while any scene
    /// has them.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn open_source(source: &ImageSource, folder: Option<&Path>) -> Result<Self, ImageError> {
        let found = match source.path.strip_prefix(Self::BUILT_IN) {
            Some(_) if source.layer.is_some() => Err(ImageFault::BuiltInLayer),
            Some(name) => built_in::picture(name).ok_or(ImageFault::NotBuiltIn),
            None => read_or_share(&file_of(&source.path, folder), source.layer()),
        };
        let refused = |fault| ImageError { image: source.clone(), fault };
        found.map(|pixels| Self::opened(source.clone(), pixels)).map_err(refused)
    }

    /// The picture at `path`, without a choice of layer; see [`Self::open_source`].
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn open(path: &str, folder: Option<&Path>) -> Result<Self, ImageError> {
        Self::open_source(&ImageSource::new(path, None), folder)
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

    /// The file that it comes from, for a scene file in `folder`; `None` if it comes with the program.
    pub fn file(&self, folder: Option<&Path>) -> Option<PathBuf> {
        (!self.is_built_in()).then(|| file_of(self.path(), folder))
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

    /// What a path of a scene file in the folder `from` has to be in one in `to`, so that it leads to the same file;
    /// `None` if it may stay as it is. Without a folder `from` it begins where the program was started; without `to`
    /// it becomes a whole path, as it does when the file does not lie in `to`.
    pub fn moved_path(path: &str, from: Option<&Path>, to: Option<&Path>) -> Option<String> {
        Self::moved(path, from, to, Self::path_from)
    }

    /// [`moved_path`](Self::moved_path), but a relative path stays relative wherever there is a way from `to`, up and
    /// down: folders that are moved together find their files still.
    pub fn moved_relative_path(path: &str, from: &Path, to: &Path) -> Option<String> {
        let name = |to: &Path, file: &Path| {
            let way = Path::new(path).is_relative().then(|| way(to, file)).flatten();
            way.unwrap_or_else(|| Self::path_from(to, file))
        };
        Self::moved(path, Some(from), Some(to), name)
    }

    fn moved(
        path: &str,
        from: Option<&Path>,
        to: Option<&Path>,
        name: impl Fn(&Path, &Path) -> String,
    ) -> Option<String> {
        if path.starts_with(Self::BUILT_IN) {
            return None;
        }
        let file = file_of(path, from);
        let moved = match to {
            // A way that both folders have in common, such as one up and down again, stays as it was written.
            Some(to) if Path::new(path).is_relative() && is_same_file(&file, &to.join(path)) => return None,
            Some(to) => name(to, &file),
            None => Self::path_from(Path::new(""), &file),
        };
        (moved != path).then_some(moved)
    }

    /// How a scene file in `folder` names the picture in `file`: by the way from there, if it lies in the folder, else
    /// by the whole path. An empty folder is none.
    pub fn path_from(folder: &Path, file: &Path) -> String {
        let whole = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        let (folder, file) = (whole(folder), whole(file));
        path_text(file.strip_prefix(&folder).unwrap_or(&file))
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
    #[error("there is no file {}; check the path, which begins at the scene's folder", .0.display())]
    Missing(PathBuf),
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

/// The file that a path of a scene leads to.
fn file_of(path: &str, folder: Option<&Path>) -> PathBuf {
    folder.map_or_else(|| PathBuf::from(path), |folder| folder.join(path))
}

/// A path as scene files have it, which are the same on all systems.
fn path_text(path: &Path) -> String {
    let text = path.to_string_lossy();
    if cfg!(windows) { text.replace('\\', "/") } else { text.into_owned() }
}

/// The way from a folder to a file, up and down; `None` if there is none, as between two drives.
fn way(folder: &Path, file: &Path) -> Option<String> {
    let by_name = |path: &Path| std::path::absolute(path).map(|whole| without_steps_up(&whole)).ok();
    let real = |path: &Path| path.canonicalize().ok();
    // What is not there yet cannot be asked.
    let is_unknown = !file.exists() || !folder.exists();
    let leads_there = |way: &PathBuf| is_unknown || is_same_file(file, &folder.join(way));
    // By the names that the user knows, unless a symbolic link on the way makes `..` lead elsewhere.
    let ways = [by_name(folder).zip(by_name(file)), real(folder).zip(real(file))];
    let ways = ways.into_iter().flatten().filter_map(|(folder, file)| pathdiff::diff_paths(file, folder));
    ways.filter(|way| way.is_relative()).find(leads_there).map(|way| path_text(&way))
}

/// An absolute path without `..`, by names alone: each takes the name before it away.
fn without_steps_up(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            std::path::Component::ParentDir => _ = plain.pop(),
            part => plain.push(part),
        }
    }
    plain
}

fn is_same_file(one: &Path, other: &Path) -> bool {
    let canonical = |path: &Path| path.canonicalize().ok();
    one == other || canonical(one).is_some_and(|one| canonical(other) == Some(one))
}

/// An amount of light as scenes have them: a file may say anything.
fn sane(part: f32) -> f32 {
    const MOST: f32 = 1e6;
    if part.is_nan() { 0.0 } else { part.clamp(0.0, MOST) }
}

/// The time, size and content of a file when it was read, while the content is in use.
type CachedFile = (Option<SystemTime>, u64, Weak<Picture>);

/// A file and the layer that is read of it.
type FileLayer = (PathBuf, Option<String>);

static KEPT: LazyLock<Mutex<HashMap<FileLayer, CachedFile>>> = LazyLock::new(Mutex::default);

fn read_or_share(file: &Path, layer: Option<&str>) -> Result<Arc<Picture>, ImageFault> {
    let metadata = std::fs::metadata(file).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => ImageFault::Missing(file.to_owned()),
        _ => ImageFault::Unreadable { reason: error.to_string(), kind: UnreadableKind::Other },
    })?;
    if !metadata.is_file() {
        // Opening a pipe would wait, in the studio too, until someone writes into it.
        return Err(ImageFault::NotAFile);
    }
    let state = (metadata.modified().ok(), metadata.len());
    let layer = layer.map(str::to_owned);
    let name = (file.canonicalize().unwrap_or_else(|_| file.to_owned()), layer.clone());
    let shared = {
        let kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
        kept.get(&name).filter(|kept| (kept.0, kept.1) == state).and_then(|kept| kept.2.upgrade())
    };
    if let Some(shared) = shared {
        return Ok(shared);
    }
    let options = ReadOptions { layer, max_pixels: Image::MAX_PIXELS as u64 };
    let mut picture =
        options.read(file).map_err(|error| match error {
            ReadError::Decode {
                source:
                    DecodeError::TooLarge { width, height, .. }
                    | DecodeError::Size(
                        SizeError::Pixels { width, height, .. } | SizeError::Side { width, height, .. },
                    ),
                ..
            } => ImageFault::TooLarge { width, height },
            ReadError::Decode { source, .. } => {
                ImageFault::Unreadable { reason: source.to_string(), kind: (&source).into() }
            }
            other => ImageFault::Unreadable { reason: other.to_string(), kind: UnreadableKind::Other },
        })?;
    picture.pixels_mut().iter_mut().flatten().for_each(|part| *part = sane(*part));
    let picture = Arc::new(picture);
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    kept.retain(|_, (_, _, picture)| picture.strong_count() > 0);
    kept.insert(name, (state.0, state.1, Arc::downgrade(&picture)));
    Ok(picture)
}
