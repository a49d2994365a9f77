#![doc = include_str!("../README.md")]

mod compare;
mod develop;
mod format;
mod picture;
mod quantize;
mod read;
pub mod srgb;
mod tone;
mod write;

pub use catoptric_platform::files::WriteError;
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
