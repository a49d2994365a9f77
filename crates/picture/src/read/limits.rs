//! The limits on sizes that a file's length can justify.

use super::DecodeError;
use crate::picture::SizeError;

/// The most bytes that Deflate makes of one: 258 bytes from two bits, with some room. The run lengths of PIZ and RLE,
/// and the blocks of B44, make fewer.
pub(super) const DEFLATE: u64 = 1100;

/// Turns away files that cannot possibly hold what they declare, before memory is taken for it: each of their bytes
/// makes `most` bytes of pixels at most.
pub(super) fn check_length(declared: u64, actual: u64, most: u64) -> Result<(), DecodeError> {
    if declared / most > actual { Err(DecodeError::TooShort { declared, actual }) } else { Ok(()) }
}

/// Asks for memory that a decoder will take by itself: its own request cannot be refused without ending the program.
pub(super) fn check_memory(width: u32, height: u32, bytes: u64) -> Result<(), DecodeError> {
    let refused = || SizeError::Memory { width, height, bytes };
    let count = usize::try_from(bytes).map_err(|_| refused())?;
    Vec::<u8>::new().try_reserve_exact(count).map_err(|_| refused())?;
    Ok(())
}
