//! Quantization: from displayable linear light to sRGB codes.
//!
//! The codes are defined by the exact formula, ⌊maximum · encode(x) + ½⌋ in double precision. For 8 bits a
//! table gives the same code without the power: the floats of 0…1 are cut into buckets of equal upper 16
//! bits. Over such a bucket x grows by 1/128 at most, and the code by 255 · 1.055 / 2.4 · ln(1 + 1/128) < 0.88;
//! so a bucket holds at most one threshold, and the code at its start and the float from which it is one
//! more say everything.
//! The idea of indexing by the float's own bits is F. Giesen's ("float→sRGB8", 2012).

use std::sync::LazyLock;

use crate::srgb;

/// The 8-bit code of a linear value by the formula.
pub(crate) fn exact8(x: f32) -> u8 {
    (255.0 * srgb::encode(f64::from(x)) + 0.5) as u8
}

/// The 16-bit code of a linear value by the formula.
pub(crate) fn exact16(x: f32) -> u16 {
    (65535.0 * srgb::encode(f64::from(x)) + 0.5) as u16
}

/// One bucket of the table: `code` at its start, `code + 1` from `next` on.
#[derive(Clone, Copy)]
struct QuantizeBucket {
    next: f32,
    code: u8,
}

/// Gives the same as [`exact8`] for every float within 0…1.
pub(crate) struct Table8 {
    /// A power of two of them, so that masking the index replaces a check in the innermost loop.
    steps: [QuantizeBucket; 2048],
}

/// Upper half of the bits of 2⁻¹³; all smaller values have code 0, as 2⁻¹³ itself has.
const FIRST_BUCKET: u32 = 0x3900;
/// Upper half of the bits of 1.
const LAST_BUCKET: u32 = 0x3f80;

impl Table8 {
    /// The table, made at the first call (well under a millisecond).
    pub(crate) fn get() -> &'static Table8 {
        static TABLE: LazyLock<Table8> = LazyLock::new(Table8::build);
        &TABLE
    }

    fn build() -> Table8 {
        let thresholds: Vec<f32> = (1..=255).map(threshold).collect();
        let step = |bucket: u32| {
            let code = exact8(f32::from_bits(bucket << 16));
            let next = thresholds.get(usize::from(code)).copied().unwrap_or(f32::INFINITY);
            QuantizeBucket { next, code }
        };
        let mut steps = [QuantizeBucket { next: f32::INFINITY, code: 255 }; 2048];
        for (place, bucket) in steps.iter_mut().zip(FIRST_BUCKET..=LAST_BUCKET) {
            *place = step(bucket);
        }
        Table8 { steps }
    }

    /// The code of `x`, which must be within 0…1 (anything else gives some code).
    #[inline]
    pub(crate) fn code(&self, x: f32) -> u8 {
        let bucket = (x.to_bits() >> 16).saturating_sub(FIRST_BUCKET) as usize;
        let step = self.steps[bucket & 2047];
        step.code.wrapping_add(u8::from(x >= step.next))
    }
}

/// The smallest float whose code is at least `code`, by halving; positive floats are ordered as their bits.
fn threshold(code: u8) -> f32 {
    let (mut below, mut reached) = (0_u32, 1.0_f32.to_bits());
    while reached - below > 1 {
        let middle = below + (reached - below) / 2;
        if exact8(f32::from_bits(middle)) >= code { reached = middle } else { below = middle }
    }
    f32::from_bits(reached)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn agree(bits: u32) {
        let x = f32::from_bits(bits);
        assert_eq!(Table8::get().code(x), exact8(x), "at {x:e}");
    }

    #[test]
    fn the_table_is_exact_around_every_threshold() {
        for code in 1..=255 {
            let at = threshold(code).to_bits();
            (at - 1000..=at + 1000).filter(|&bits| bits <= 0x3f80_0000).for_each(agree);
        }
    }

    #[test]
    fn the_table_is_exact_at_the_ends_of_every_bucket_and_on_a_grid() {
        for bucket in 0..=LAST_BUCKET {
            agree(bucket << 16);
            if bucket < LAST_BUCKET {
                agree((bucket << 16) | 0xffff);
            }
        }
        (0..=0x3f80_0000).step_by(997).for_each(agree);
    }

    #[test]
    fn the_table_is_exact_everywhere() {
        (0x3800_0000..=0x3f80_0000).for_each(agree);
    }

    #[test]
    fn known_codes() {
        for (x, code8, code16) in [
            (0.0, 0, 0),
            (0.214_041_14, 128, 32768),
            (0.5, 188, 48192),
            (0.18, 118, 30235),
            (1.0, 255, 65535),
        ] {
            assert_eq!((exact8(x), exact16(x)), (code8, code16), "{x}");
        }
        // Half a code rounds up: the linear value of display 0.5 / 255.
        assert_eq!(exact8((0.5 / 255.0 / 12.92) as f32), 1);
    }

    #[test]
    fn codes_round_trip() {
        for code in 0..=255_u8 {
            assert_eq!(exact8(srgb::decode(f64::from(code) / 255.0) as f32), code);
        }
        for code in 0..=65535_u16 {
            assert_eq!(exact16(srgb::decode(f64::from(code) / 65535.0) as f32), code);
        }
    }
}
