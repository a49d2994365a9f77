//! Reading pictures from files that may be anything.

mod decode_exr;
mod decode_png;

use std::fs::File;
use std::io::{self, BufRead, BufReader, Cursor, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use crate::picture::{Picture, SizeError};

/// Why bytes are not a picture that can be read.
#[derive(Debug, thiserror::Error)]
pub enum DecodeError {
    /// No bytes at all.
    #[error("the file is empty; write it anew")]
    Empty,
    /// The first bytes are not those of a known format.
    #[error("this is neither a PNG nor an EXR picture; convert it to one of these")]
    UnknownFormat,
    /// The declared size is beyond the limits, or the memory is not there.
    #[error(transparent)]
    Size(#[from] SizeError),
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
        /// `PNG` or `EXR`.
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
    /// The decoder broke down, which only corrupt data is known to cause.
    #[error("the {format} decoder broke down; the file is most likely corrupt")]
    Breakdown {
        /// `PNG` or `EXR`.
        format: &'static str,
    },
    /// The bytes could not be obtained.
    #[error(transparent)]
    Io(#[from] io::Error),
}

/// Why a picture file could not be read.
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
    /// The path is a directory, a pipe or a device.
    #[error("cannot read {} as a picture: it is not a plain file", path.display())]
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

/// Reads a PNG or EXR picture into linear light; the content decides which it is, not the name.
///
/// - PNG: any color type, depth and interlacing. Alpha is ignored: the stored color counts as it is, over
///   no background. Gray becomes three equal channels. Codes are decoded as sRGB, unless there is a `gAMA`
///   chunk without `sRGB` and `iCCP` whose value is not the 0.45455 that stands in for sRGB: then by that
///   power. Color profiles and primaries are not converted. Of an animation, the default image.
/// - EXR: the channels R, G, B (half, float or unsigned, as numbers) of the first part that has them, plain
///   or within a layer (`diffuse.R` …); otherwise Y as gray. The data window becomes the picture.
///   Chromaticities are not converted. Not read: deep, subsampled and luminance-chroma pictures.
///
/// Corrupt and hostile files are errors. Memory stays below that of [`Picture::MAX_PIXELS`] pixels and a few
/// rows or tiles, and a file too short for the size that it declares is turned away before.
///
/// # Errors
/// Names the file and what is wrong with it.
pub fn read(path: &Path) -> Result<Picture, ReadError> {
    let open = |source| ReadError::Open { path: path.to_owned(), source };
    let found = std::fs::metadata(path).map_err(open)?;
    if !found.is_file() {
        return Err(ReadError::NotAFile { path: path.to_owned() });
    }
    let file = BufReader::with_capacity(1 << 16, File::open(path).map_err(open)?);
    decode_from(file, found.len()).map_err(|source| ReadError::Decode { path: path.to_owned(), source })
}

/// The picture in the bytes of a PNG or EXR file; see [`read()`].
///
/// # Errors
/// What is wrong with the bytes.
pub fn decode(bytes: &[u8]) -> Result<Picture, DecodeError> {
    decode_from(Cursor::new(bytes), bytes.len() as u64)
}

/// Tells the formats apart and decodes; `length` is that of the whole file in bytes.
fn decode_from(mut source: impl BufRead + Seek, length: u64) -> Result<Picture, DecodeError> {
    let mut start = [0; 8];
    let mut known = 0;
    while let Some(rest) = start.get_mut(known..).filter(|rest| !rest.is_empty()) {
        match source.read(rest) {
            Ok(0) => break,
            Ok(count) => known += count,
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error.into()),
        }
    }
    source.seek(SeekFrom::Start(0))?;
    if known == 0 {
        Err(DecodeError::Empty)
    } else if start.starts_with(&decode_png::MAGIC) {
        decode_png::decode_png(source, length)
    } else if start.starts_with(&decode_exr::MAGIC) {
        decode_exr::decode_exr(source, length)
    } else {
        Err(DecodeError::UnknownFormat)
    }
}

/// Turns away files that cannot possibly hold what they declare, before memory is taken for it.
///
/// Deflate makes at most 1032 bytes of one (258 bytes from two bits); the run lengths of PIZ and RLE, and the
/// blocks of B44, make fewer.
fn check_length(declared: u64, actual: u64) -> Result<(), DecodeError> {
    if declared / 1100 > actual { Err(DecodeError::TooShort { declared, actual }) } else { Ok(()) }
}
