//! Reading pictures from files that may be anything.

mod decode_exr;
mod decode_image;
mod decode_pfm;
mod decode_png;
mod decode_tiff;
mod dwa;
mod guard;
mod layers;
mod limits;
mod transfer;

use std::io::{self, BufReader, Cursor, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use catoptric_platform::files;

use crate::format::PictureFormat;
use crate::picture::{Picture, SizeError};

/// The most bytes that are read from a stream: those of [`Picture::MAX_PIXELS`] in 32-bit floats, uncompressed.
const LONGEST_STREAM: u64 = Picture::MAX_PIXELS * 12 + (1 << 20);

/// The reason why bytes cannot be read as a picture.
#[derive(Debug, thiserror::Error)]
pub enum DecodeError {
    /// No bytes at all.
    #[error("the file is empty; write it anew")]
    Empty,
    /// The first bytes are not those of a known format.
    #[error(
        "this is none of the formats that are read ({}); convert it to one of these",
        PictureFormat::names_in_words()
    )]
    UnknownFormat,
    /// The declared size is beyond the limits, or the memory is not there.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// The picture has more pixels than [`ReadOptions::max_pixels`].
    #[error(
        "the picture has {width}x{height} pixels, more than the {most} that are read here; make it smaller"
    )]
    TooLarge {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// The most pixels.
        most: u64,
    },
    /// The file is shorter than its format could make pictures of the declared size.
    #[error(
        "the file declares {declared} bytes of pixels, more than {actual} bytes of file can hold; it is truncated or corrupt"
    )]
    TooShort {
        /// Bytes of the pixels, uncompressed, as declared.
        declared: u64,
        /// Bytes of the file.
        actual: u64,
    },
    /// The content breaks the rules of its format.
    #[error("the {format} data is truncated or corrupt: {reason}")]
    Corrupt {
        /// The name of the format.
        format: &'static str,
        /// What is wrong.
        reason: String,
    },
    /// The content is valid, but not of a kind that is read here.
    #[error("{reason}")]
    Unsupported {
        /// What it is, and what would do instead.
        reason: String,
    },
    /// The file has several layers, and none is known as the picture.
    #[error(
        "the picture has several layers, and none of them is called `Combined` or has no name; name one of them as \
         the layer: {}", layers.join(", ")
    )]
    ManyLayers {
        /// The names of the layers.
        layers: Vec<String>,
    },
    /// The file has no layer of the name that was asked for.
    #[error("the picture has no layer `{layer}`; {}", layers_in_words(layers))]
    NoSuchLayer {
        /// The name that was asked for.
        layer: String,
        /// The names of the layers that there are; none if the picture has no named layers.
        layers: Vec<String>,
    },
    /// The decoder broke down, which only corrupt data is known to cause.
    #[error("the {format} decoder broke down; the file is most likely corrupt")]
    Breakdown {
        /// The name of the format.
        format: &'static str,
    },
    /// The bytes could not be obtained.
    #[error(transparent)]
    Io(#[from] io::Error),
}

fn layers_in_words(layers: &[String]) -> String {
    match layers {
        [] => "it has no named layers".to_owned(),
        _ => format!("it has {}", layers.join(", ")),
    }
}

/// The reason why a picture file could not be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file could not be opened.
    #[error("cannot open {}; check the name and the permissions", path.display())]
    Open {
        /// The path asked for.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The path is a directory.
    #[error("cannot read {} as a picture: it is a directory and not a plain file", path.display())]
    NotAFile {
        /// The path asked for.
        path: PathBuf,
    },
    /// The content is not a picture that can be read.
    #[error("cannot read the picture {}", path.display())]
    Decode {
        /// The path asked for.
        path: PathBuf,
        /// What is wrong with the content.
        source: DecodeError,
    },
}

/// The options of reading a picture file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ReadOptions {
    /// The layer of an EXR to read. Default `None`: the unnamed one, `Combined`, or the only one.
    pub layer: Option<String>,
    /// The most pixels that the picture may have. Default [`Picture::MAX_PIXELS`], which is also the limit.
    pub max_pixels: u64,
}

impl Default for ReadOptions {
    fn default() -> Self {
        Self { layer: None, max_pixels: Picture::MAX_PIXELS }
    }
}

/// Reads a picture file into linear light with the default [`ReadOptions`]; see [`ReadOptions::read`].
///
/// # Errors
/// Names the file and what is wrong with it.
pub fn read(path: &Path) -> Result<Picture, ReadError> {
    ReadOptions::default().read(path)
}

/// The picture in the bytes of a file; see [`ReadOptions::read`].
///
/// # Errors
/// What is wrong with the bytes.
pub fn decode(bytes: &[u8]) -> Result<Picture, DecodeError> {
    ReadOptions::default().decode(bytes)
}

/// The bytes of a file, wherever they are: decoders are large, and compiled once for all.
type Source<'s> = BufReader<&'s mut dyn ReadSeek>;

trait ReadSeek: Read + Seek {}
impl<T: Read + Seek> ReadSeek for T {}

impl ReadOptions {
    /// Reads a picture file into linear light; the content decides which format it is, not the name.
    ///
    /// Alpha is ignored: the stored color counts as it is, over no background. Gray becomes three equal channels.
    /// Color profiles, primaries and chromaticities are not converted.
    ///
    /// - PNG: any color type, depth and interlacing. Codes are decoded as the chunk `cICP` says (sRGB, linear, power,
    ///   Rec. 709; PQ and HLG are refused by name), or else by `gAMA` without `sRGB` and `iCCP`, unless it is the 0.45455
    ///   that stands in for sRGB, or else as sRGB. Of an animation, the default image.
    /// - EXR: the channels R, G, B (half, float or unsigned, as numbers) of the chosen layer, otherwise Y as gray.
    ///   The data window becomes the picture. Not read: deep, subsampled and luminance-chroma pictures.
    /// - JPEG (also progressive, gray, and CMYK without a profile), WebP (also lossy), BMP: 8-bit codes as sRGB.
    ///   The orientation in the Exif data of JPEG and WebP, and in the tags of TIFF, is followed.
    /// - PPM, PGM, PBM and PAM, as text or bytes: 8- and 16-bit codes as sRGB, brought to the largest one that the file
    ///   declares.
    /// - TIFF: 8 and 16 bits, palettes and gray of fewer bits as sRGB, 32-bit floats as linear light.
    /// - PFM: linear light, multiplied by the scale of the file.
    /// - Radiance HDR: linear light, as it is stored (`EXPOSURE` is not divided out). Not read: XYZ.
    ///
    /// Pipes and devices are read to their end first; `-` is standard input.
    ///
    /// Corrupt and hostile files are errors: sizes are checked against the limits and, where the format has a bound,
    /// against the file's length before memory is taken, and a decoder that panics is caught. Memory is that of
    /// the picture with its codes, and a few rows or tiles.
    ///
    /// # Errors
    /// Names the file and what is wrong with it.
    pub fn read(&self, path: &Path) -> Result<Picture, ReadError> {
        let open = |source| ReadError::Open { path: path.to_owned(), source };
        let decoded = match files::status(path) {
            Ok(found) if found.is_file && path.as_os_str() != "-" => {
                let (mut file, length) = files::open(path).map_err(open)?;
                self.decode_from(&mut file, length)
            }
            Ok(found) if found.is_folder => return Err(ReadError::NotAFile { path: path.to_owned() }),
            // Formats are read back and forth, which a stream cannot.
            _ => self.decode(&files::read_bytes(path, LONGEST_STREAM).map_err(open)?),
        };
        decoded.map_err(|source| ReadError::Decode { path: path.to_owned(), source })
    }

    /// The picture in the bytes of a file; see [`Self::read`].
    ///
    /// # Errors
    /// What is wrong with the bytes.
    pub fn decode(&self, bytes: &[u8]) -> Result<Picture, DecodeError> {
        self.decode_from(&mut Cursor::new(bytes), bytes.len() as u64)
    }

    /// Tells the formats apart and decodes; `length` is that of the whole file in bytes.
    fn decode_from(&self, bytes: &mut dyn ReadSeek, length: u64) -> Result<Picture, DecodeError> {
        let mut source = BufReader::new(bytes);
        let mut start = Vec::new();
        source.by_ref().take(32).read_to_end(&mut start)?;
        source.seek(SeekFrom::Start(0))?;
        let format = match PictureFormat::of_content(&start) {
            _ if start.is_empty() => return Err(DecodeError::Empty),
            Some(format) => format,
            None => return Err(DecodeError::UnknownFormat),
        };
        if let (Some(layer), false) = (&self.layer, format.has_layers()) {
            return Err(DecodeError::NoSuchLayer { layer: layer.clone(), layers: Vec::new() });
        }
        guard::guarded(format, || match format {
            PictureFormat::Png => decode_png::decode_png(source, length, self),
            PictureFormat::Exr => decode_exr::decode_exr(source, length, self),
            PictureFormat::Pfm => decode_pfm::decode_pfm(source, length, self),
            PictureFormat::Tiff => decode_tiff::decode_tiff(source, self),
            _ => decode_image::decode_image(source, length, format, self),
        })
    }

    /// Checks the size that a file declares; returns the number of pixels.
    fn check_size(&self, width: u32, height: u32) -> Result<usize, DecodeError> {
        let count = Picture::check_size(width, height)?;
        if count as u64 > self.max_pixels {
            return Err(DecodeError::TooLarge { width, height, most: self.max_pixels });
        }
        Ok(count)
    }
}
