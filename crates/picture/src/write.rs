//! Writing pictures to files, whole or not at all.

pub(crate) mod encode_exr;
mod encode_image;
mod encode_pfm;
pub(crate) mod encode_png;
pub(crate) mod save;

use std::io;
use std::path::Path;

use catoptric_platform::files::{WriteError, write_whole};

use crate::develop::Developed;
use crate::picture::Picture;

/// The reason why a picture could not be encoded.
#[derive(Debug, thiserror::Error)]
pub enum EncodeError {
    /// The bytes could not be stored.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// The encoder refused the picture.
    #[error("the {format} encoder refused the picture: {reason}")]
    Refused {
        /// The name of the format.
        format: &'static str,
        /// The encoder's words.
        reason: String,
    },
}

impl From<EncodeError> for io::Error {
    fn from(error: EncodeError) -> Self {
        match error {
            EncodeError::Io(error) => error,
            refused @ EncodeError::Refused { .. } => Self::other(refused),
        }
    }
}

/// Writes the developed picture as PNG, whole or not at all; an existing file is replaced.
///
/// The bytes are those of [`encode_png`](encode_png::encode_png). They go to a temporary file beside the
/// target, which is then renamed over it; a symbolic link is followed first and stays one.
///
/// # Errors
/// What [`check_writable`](catoptric_platform::files::check_writable) finds, a full disk, or a failing system.
pub fn write_png(path: &Path, picture: &Developed) -> Result<(), WriteError> {
    write_whole(path, |sink| Ok(encode_png::encode_png_to(sink, picture)?))
}

/// Writes the picture's linear light as EXR, whole or not at all; an existing file is replaced.
///
/// The bytes are those of [`encode_exr`](encode_exr::encode_exr); nothing of the picture is lost.
///
/// # Errors
/// Those of [`write_png`].
pub fn write_exr(path: &Path, picture: &Picture) -> Result<(), WriteError> {
    write_whole(path, |sink| Ok(encode_exr::encode_exr_to(sink, picture)?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::develop::{BitDepth, Development};
    use std::io::{Cursor, Seek, SeekFrom, Write};

    /// A disk with this much room.
    struct Full {
        file: Cursor<Vec<u8>>,
        room: u64,
    }

    impl Write for Full {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            if self.file.position() + bytes.len() as u64 > self.room {
                return Err(io::ErrorKind::StorageFull.into());
            }
            self.file.write(bytes)
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    impl Seek for Full {
        fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
            self.file.seek(to)
        }
    }

    #[test]
    fn a_full_disk_is_an_error_wherever_it_happens() {
        let picture = Picture::from_fn(60, 50, |x, y| [(x * y % 17) as f32 / 16.0; 3]).unwrap();
        let developed = Development::default().develop(&picture, BitDepth::Eight).unwrap();
        let png = encode_png::encode_png(&developed).unwrap().len();
        let exr = encode_exr::encode_exr(&picture).unwrap().len();
        let full = |room: usize| Full { file: Cursor::default(), room: room as u64 };
        let is_full =
            |error| matches!(error, Err(EncodeError::Io(e)) if e.kind() == io::ErrorKind::StorageFull);
        for room in (0..png).step_by(7).chain([png - 1]) {
            let written = encode_png::encode_png_to(&mut full(room), &developed);
            assert!(is_full(written), "PNG with room for {room} of {png} bytes");
        }
        for room in (0..exr).step_by(7).chain([exr - 1]) {
            assert!(
                is_full(encode_exr::encode_exr_to(&mut full(room), &picture)),
                "EXR with {room} of {exr} bytes"
            );
        }
        assert!(encode_exr::encode_exr_to(&mut full(exr), &picture).is_ok());
    }
}
