//! Numbers that look random.

use glam::DVec3;

/// A sequence of numbers, the same on every machine (splitmix64: Steele, Lea, Flood 2014, Fast splittable pseudorandom
/// number generators).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence of this number.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }

    /// A whole number from 0 up to below `limit`, which is at least 1 (0 counts as 1).
    pub fn below(&mut self, limit: u64) -> u64 {
        self.bits() % limit.max(1)
    }

    /// A number between two, to six decimal places: few digits keep scene files short.
    pub fn number(&mut self, low: f64, high: f64) -> f64 {
        let part = (self.bits() >> 11) as f64 / (1_u64 << 53) as f64;
        ((low + (high - low) * part) * 1e6).round() / 1e6
    }

    /// Three such numbers.
    pub fn vector(&mut self, low: f64, high: f64) -> DVec3 {
        DVec3::new(self.number(low, high), self.number(low, high), self.number(low, high))
    }
}
