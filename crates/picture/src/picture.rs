//! The picture itself and the limits on its size.

use std::fmt;
use std::slice::ChunksExact;

/// The reason why a picture of some size cannot be made.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SizeError {
    /// A side is zero.
    #[error("a picture of {width}x{height} pixels is empty; both sides must be at least 1")]
    Empty {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// A side is longer than [`Picture::MAX_SIDE`].
    #[error(
        "a picture of {width}x{height} pixels is too large: it would need {bytes} bytes, \
         and a side has at most {} pixels",
        Picture::MAX_SIDE
    )]
    Side {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Bytes that its pixels would need.
        bytes: u64,
    },
    /// There are more pixels than [`Picture::MAX_PIXELS`].
    #[error(
        "a picture of {width}x{height} pixels is too large: it would need {bytes} bytes, \
         and there may be at most {} pixels",
        Picture::MAX_PIXELS
    )]
    Pixels {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Bytes that its pixels would need.
        bytes: u64,
    },
    /// The memory is not there.
    #[error("not enough memory for a picture of {width}x{height} pixels: it needs {bytes} bytes")]
    Memory {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Bytes that its pixels need.
        bytes: u64,
    },
    /// The number of pixels handed over is not width × height.
    #[error("a picture of {width}x{height} pixels cannot be made of {count} pixels")]
    Count {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Pixels handed over.
        count: usize,
    },
}

/// A picture in linear light: red, green and blue as 32-bit floats, Rec. 709 primaries, 1.0 = display white.
///
/// Rows run from top to bottom, pixels in a row from left to right. Values may be negative, above 1,
/// infinite or NaN; what becomes of those is said where the picture is shown or compared.
/// There is always at least one pixel and never more than [`Picture::MAX_PIXELS`].
#[derive(Clone, PartialEq)]
pub struct Picture {
    width: u32,
    height: u32,
    pixels: Vec<[f32; 3]>,
}

impl Picture {
    /// The most pixels that a picture may have: 2²⁸, which take 3 GiB.
    pub const MAX_PIXELS: u64 = 1 << 28;

    /// The most pixels that one side may have: 2²⁰.
    pub const MAX_SIDE: u32 = 1 << 20;

    /// A black picture.
    ///
    /// # Errors
    /// A zero side, a size beyond the limits, or too little memory.
    pub fn new(width: u32, height: u32) -> Result<Picture, SizeError> {
        let count = Self::check_size(width, height)?;
        // Fresh memory is all zeros as it comes: nothing is written here, so that the threads that fill the picture
        // share the cost of getting it.
        let pixels = bytemuck::allocation::try_zeroed_vec(count).map_err(|()| {
            let bytes = bytes_needed(width, height);
            SizeError::Memory { width, height, bytes }
        })?;
        Ok(Picture { width, height, pixels })
    }

    /// The picture whose pixel at column `x`, row `y` is `color(x, y)`; rows from the top.
    ///
    /// # Errors
    /// Those of [`Picture::new`].
    pub fn from_fn(
        width: u32,
        height: u32,
        mut color: impl FnMut(u32, u32) -> [f32; 3],
    ) -> Result<Picture, SizeError> {
        let mut picture = Self::new(width, height)?;
        for (y, row) in (0..height).zip(picture.rows_mut()) {
            for (x, pixel) in (0..width).zip(row) {
                *pixel = color(x, y);
            }
        }
        Ok(picture)
    }

    /// The picture made of these pixels, row by row from the top; no pixel is copied.
    ///
    /// # Errors
    /// Those of [`Picture::new`], and a number of pixels other than `width` × `height`.
    pub fn from_pixels(width: u32, height: u32, pixels: Vec<[f32; 3]>) -> Result<Picture, SizeError> {
        if pixels.len() == Self::check_size(width, height)? {
            Ok(Picture { width, height, pixels })
        } else {
            Err(SizeError::Count { width, height, count: pixels.len() })
        }
    }

    /// Whether a picture may have this size, and then its number of pixels; nothing is allocated.
    ///
    /// # Errors
    /// A zero side, or a size beyond the limits.
    pub fn check_size(width: u32, height: u32) -> Result<usize, SizeError> {
        let bytes = bytes_needed(width, height);
        let count = u64::from(width) * u64::from(height);
        if count == 0 {
            Err(SizeError::Empty { width, height })
        } else if width.max(height) > Self::MAX_SIDE {
            Err(SizeError::Side { width, height, bytes })
        } else if count > Self::MAX_PIXELS {
            Err(SizeError::Pixels { width, height, bytes })
        } else {
            usize::try_from(count).map_err(|_| SizeError::Memory { width, height, bytes })
        }
    }

    /// Pixels across; at least 1.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Pixels down; at least 1.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The color at column `x`, row `y` from the top; `None` outside the picture.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[f32; 3]> {
        if x >= self.width {
            return None;
        }
        let index = u64::from(y) * u64::from(self.width) + u64::from(x);
        self.pixels.get(usize::try_from(index).ok()?).copied()
    }

    /// All pixels, row by row from the top.
    pub fn pixels(&self) -> &[[f32; 3]] {
        &self.pixels
    }

    /// All pixels for writing, row by row from the top. Cut it into chunks to fill it from several threads.
    pub fn pixels_mut(&mut self) -> &mut [[f32; 3]] {
        &mut self.pixels
    }

    /// The rows, from the top; each has `width` pixels.
    pub fn rows(&self) -> ChunksExact<'_, [f32; 3]> {
        self.pixels.chunks_exact(self.width as usize)
    }

    /// The rows for writing, from the top; each has `width` pixels.
    pub fn rows_mut(&mut self) -> std::slice::ChunksExactMut<'_, [f32; 3]> {
        self.pixels.chunks_exact_mut(self.width as usize)
    }
}

/// Says the size, not the millions of pixels.
impl fmt::Debug for Picture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Picture({}x{})", self.width, self.height)
    }
}

/// Bytes of the pixels of a picture; cannot overflow: 2³² × 2³² × 12 saturates.
fn bytes_needed(width: u32, height: u32) -> u64 {
    (u64::from(width) * u64::from(height)).saturating_mul(size_of::<[f32; 3]>() as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_beyond_the_limits_are_errors_that_say_the_limit_and_the_bytes() {
        assert!(matches!(Picture::new(0, 5), Err(SizeError::Empty { .. })));
        assert!(matches!(Picture::new(5, 0), Err(SizeError::Empty { .. })));
        let long = Picture::new((1 << 20) + 1, 1).unwrap_err().to_string();
        assert!(long.contains("1048576") && long.contains("12582924 bytes"), "{long}");
        let large = Picture::new(1 << 14, (1 << 14) + 1).unwrap_err().to_string();
        assert!(large.contains("268435456") && large.contains("3221422080 bytes"), "{large}");
        assert!(Picture::new(u32::MAX, u32::MAX).is_err());
        assert_eq!(Picture::check_size(1 << 14, 1 << 14), Ok(1 << 28));
        assert_eq!(Picture::check_size(1 << 20, 1 << 8), Ok(1 << 28));
    }

    #[test]
    fn the_top_row_comes_first() {
        let picture = Picture::from_fn(3, 2, |x, y| [x as f32, y as f32, 0.0]).unwrap();
        assert_eq!(picture.pixels()[4], [1.0, 1.0, 0.0]);
        assert_eq!(picture.pixel(1, 1), Some([1.0, 1.0, 0.0]));
        assert_eq!(picture.pixel(3, 0), None);
        assert_eq!(picture.pixel(0, 2), None);
        assert_eq!(picture.pixel(u32::MAX, u32::MAX), None);
        assert_eq!(picture.rows().len(), 2);
    }

    #[test]
    fn pixels_must_fill_the_picture_exactly() {
        assert!(Picture::from_pixels(2, 2, vec![[0.0; 3]; 4]).is_ok());
        let error = Picture::from_pixels(2, 2, vec![[0.0; 3]; 5]).unwrap_err();
        assert_eq!(error, SizeError::Count { width: 2, height: 2, count: 5 });
    }
}
