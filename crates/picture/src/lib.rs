//! Linear-light pictures: what the tracer fills, the display shows, files hold and tests compare.
//!
//! - [`Picture`]: RGB in linear light, 32-bit floats, top row first.
//! - [`Development`]: exposure → tone curve → sRGB → 8 or 16 bits ([`Developed`]).
//! - [`PictureFormat`]: the table of file formats. [`SaveOptions`], [`write_png`], [`write_exr`]: whole files or none.
//! - [`read`], [`ReadOptions`]: files of all formats, recognized by their content, safe on hostile ones.
//! - [`Difference`] and [`heat_map`]: how far two pictures are apart, and where; [`ssim`] and [`Flip`]: how far apart
//!   they look.
//!
//! The crate knows nothing of scenes or rays. Nothing here panics on any input.
//!
//! ```
//! use catoptric_picture::{Development, Difference, Picture, decode, BitDepth, encode_exr, encode_png};
//!
//! let picture = Picture::from_fn(4, 2, |x, y| [x as f32 / 3.0, y as f32, 0.5])?;
//! let file = encode_exr(&picture)?;
//! assert_eq!(Difference::between(&picture, &decode(&file)?)?.max, 0.0);
//! let shown = Development::default().develop(&picture, BitDepth::Eight)?;
//! assert!(encode_png(&shown)?.starts_with(b"\x89PNG"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod compare;
mod develop;
mod format;
mod picture;
mod quantize;
mod read;
pub mod srgb;
mod tone;
mod write;

pub use catoptric_files::WriteError;
pub use compare::CompareError;
pub use compare::difference::{Comparison, Difference, SizeMismatch};
pub use compare::flip::{Flip, FlipMap};
pub use compare::heat::{HeatMap, heat_map, scale_color};
pub use compare::inferno::inferno;
pub use compare::ssim::ssim;
pub use develop::{BitDepth, Codes, Developed, Development};
pub use format::{PictureFormat, SampleDepth};
pub use picture::{Picture, SizeError};
pub use read::{DecodeError, ReadError, ReadOptions, decode, read};
pub use tone::{ToneCurve, UnknownToneCurve};
pub use write::encode_exr::{encode_exr, encode_exr_at};
pub use write::encode_png::encode_png;
pub use write::save::{FormatError, PreparedPicture, SaveOptions};
pub use write::{EncodeError, write_exr, write_png};
