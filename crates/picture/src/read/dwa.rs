//! Claims of DWA chunks, checked before the decoder takes memory by them.
//!
//! A chunk begins with eleven 64-bit counters (`DataSizesSingle` in OpenEXRCore's internal_dwa_compressor.h), after
//! which it takes memory in good faith. `exr` 1.74.2 does: one flipped bit makes it ask for petabytes, which ends the
//! program.

use super::DecodeError;
use super::limits::DEFLATE;

/// The most symbols of 16 bits that one byte of the Huffman coder makes: a run of 255 takes nine bits or more.
const HUFFMAN: u64 = 256;
/// The most bytes that one byte of run lengths makes: 128 of two.
const RUN_LENGTHS: u64 = 64;
/// The samples of a block, for each of which there is one coefficient.
const BLOCK: u64 = 64;

/// Checks a chunk that declares `bytes` bytes of pixels; `blocks` is the number of 8×8 blocks of all its channels.
pub(super) fn check_dwa(chunk: &[u8], bytes: u64, blocks: u64) -> Result<(), DecodeError> {
    // Chunks that grew by compression are stored as they were, and empty ones are black.
    if chunk.is_empty() || chunk.len() as u64 == bytes {
        return Ok(());
    }
    let (counters, _) = chunk.as_chunks::<8>();
    let counter = |index: usize| counters.get(index).map(|bytes| u64::from_le_bytes(*bytes));
    let counters: Option<Vec<u64>> = (0..11).map(counter).collect();
    let Some(&[_, raw, raw_packed, ac_packed, dc_packed, rle_packed, rle, rle_raw, ac, dc, coder]) =
        counters.as_deref()
    else {
        return Err(claims("its head is too short"));
    };
    let packed = [raw_packed, ac_packed, dc_packed, rle_packed];
    let sum = packed.iter().fold(0_u64, |sum, &size| sum.saturating_add(size));
    if sum > chunk.len() as u64 {
        return Err(claims("its parts are longer than the chunk"));
    }
    // No product overflows below: the packed sizes are those of bytes in memory.
    let from_ac = ac_packed * if coder == 0 { HUFFMAN } else { DEFLATE / 2 };
    let is_justified = raw <= raw_packed * DEFLATE
        && rle <= rle_packed * DEFLATE
        && rle_raw <= rle.saturating_mul(RUN_LENGTHS)
        && ac <= from_ac
        && dc <= dc_packed * DEFLATE / 2;
    if !is_justified {
        return Err(claims("it declares more than its bytes can make"));
    }
    if raw > bytes || rle_raw > bytes || rle > bytes.saturating_mul(2) || ac > blocks * BLOCK || dc > blocks {
        return Err(claims("it declares more than its pixels need"));
    }
    // What is not stored by itself has a block of coefficients for 64 samples of four bytes at most.
    if raw + rle_raw + dc * BLOCK * 4 < bytes {
        return Err(claims("it declares less than its pixels need"));
    }
    Ok(())
}

fn claims(reason: &str) -> DecodeError {
    DecodeError::Corrupt { format: "EXR", reason: format!("a DWA chunk is impossible: {reason}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chunk with these counters and a body of 200 bytes.
    fn chunk(counters: [u64; 11]) -> Vec<u8> {
        let mut bytes: Vec<u8> = counters.iter().flat_map(|counter| counter.to_le_bytes()).collect();
        bytes.extend([0; 200]);
        bytes
    }

    #[test]
    fn honest_claims_pass_and_impossible_ones_do_not() {
        // Three channels of halves, 16×8 pixels: six blocks, 768 bytes.
        let honest = [2, 0, 0, 100, 50, 0, 0, 0, 300, 6, 0];
        assert!(check_dwa(&chunk(honest), 768, 6).is_ok());
        assert!(check_dwa(&[], 768, 6).is_ok());
        assert!(check_dwa(&vec![0; 768], 768, 6).is_ok());
        assert!(check_dwa(&[0; 80], 768, 6).is_err(), "a head cut off");
        for place in 1..10 {
            for bit in 10..64 {
                let mut broken = honest;
                broken[place] ^= 1 << bit;
                assert!(check_dwa(&chunk(broken), 768, 6).is_err(), "counter {place}, bit {bit}");
            }
        }
        // Too few blocks for the pixels, though everything else is possible.
        assert!(check_dwa(&chunk([2, 0, 0, 100, 50, 0, 0, 0, 1, 1, 0]), 768, 6).is_err());
    }
}
