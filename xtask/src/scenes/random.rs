//! Numbers that look random.

use glam::DVec3;

/// A sequence of numbers, the same on every machine (splitmix64: Steele, Lea, Flood 2014, Fast splittable pseudorandom
/// number generators).
pub(super) struct Random(pub u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        bits ^ (bits >> 31)
    }

    pub(super) fn below(&mut self, limit: u64) -> u64 {
        self.next() % limit
    }

    pub(super) fn number(&mut self, low: f64, high: f64) -> f64 {
        let part = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        // Few digits keep the file short.
        ((low + (high - low) * part) * 1e6).round() / 1e6
    }

    pub(super) fn vector(&mut self, low: f64, high: f64) -> DVec3 {
        DVec3::new(self.number(low, high), self.number(low, high), self.number(low, high))
    }
}
