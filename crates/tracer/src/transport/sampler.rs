//! Numbers that look random, for directions and points that are chosen anew in every sample.
//!
//! Each is the next of a sequence that fills the unit square evenly as samples are added: Sobol's (0, 2)-sequence, in the
//! order and with the digits scrambled for each pixel, generation, body and use (B. Burley 2020, Practical hash-based Owen
//! scrambling). Nothing is kept from ray to ray, so that rays may be traced in any order.

use glam::UVec2;

use crate::simd::{MOST_LANES, Width, Word as _};
use crate::transport::path::PathState;
use crate::transport::sampling::Sample2D;
use crate::transport::scene::RenderScene;

/// Where the pixels lie that rays belong to, and which sample of them is traced.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sampler {
    sample: u32,
    /// The pixel of the picture from which rays count theirs: column and row.
    first: [u32; 2],
    /// Pixels are counted block by block: the width of a block as a power of two, its pixels, and blocks across.
    block: [u32; 3],
    /// Whether all samples are the one in the middle: of a light, the direction to its center.
    is_centered: bool,
}

impl Default for Sampler {
    fn default() -> Self {
        Self::new(0, [0, 0], [1, 1], 1)
    }
}

impl Sampler {
    /// For rays of a tile whose pixels are counted in blocks of this size, so many across.
    pub(crate) fn new(sample: u32, first: [usize; 2], block: [usize; 2], across: usize) -> Self {
        let [width, height] = block;
        let numbers = [width, width * height, across].map(|number| number.max(1) as u32);
        Self { sample, first: first.map(|place| place as u32), block: numbers, is_centered: false }
    }

    /// For rays of one pixel.
    pub(crate) fn of_pixel(sample: u32, pixel: UVec2) -> Self {
        Self::new(sample, [pixel.x as usize, pixel.y as usize], [1, 1], 1)
    }

    /// For points that belong to no pixel.
    pub(crate) fn centered() -> Self {
        Self { is_centered: true, ..Self::default() }
    }

    /// Two numbers for each ray that met one of these bodies.
    #[inline(never)]
    pub(crate) fn sample_2d<W: Width>(
        &self,
        w: W,
        scene: &RenderScene,
        paths: &PathState<W>,
        body: W::W,
        what_for: SampleDimension,
    ) -> Sample2D<W> {
        if self.is_centered {
            return Sample2D { cos: w.real(1.0), sin: w.real(0.0), second: w.real(0.0) };
        }
        let [mut pixels, mut generations, mut bodies] = [[0; MOST_LANES]; 3];
        paths.pixel.store(&mut pixels);
        paths.generation.store(&mut generations);
        body.store(&mut bodies);
        let [mut cos, mut sin, mut second] = [[0.0; MOST_LANES]; 3];
        for lane in 0..W::LANES {
            let [x, y] = self.place_of(pixels[lane]);
            // Its place in the scene: that in the scene may change with edits of others.
            let body = scene.geometry.numbers.get(bodies[lane] as usize).copied().unwrap_or_default();
            let key = [x, y, generations[lane], body, what_for.number()].into_iter().fold(0, hashed);
            let [first, other] = pair(self.sample, key);
            [cos[lane], sin[lane]] = cos_sin_of_turn(first);
            second[lane] = other;
        }
        Sample2D { cos: w.load(&cos), sin: w.load(&sin), second: w.load(&second) }
    }

    /// Column and row in the picture.
    fn place_of(&self, pixel: u32) -> [u32; 2] {
        let [width, pixels, across] = self.block;
        let (block, within) = (pixel / pixels, pixel % pixels);
        let height = pixels / width;
        let x = block % across * width + within % width;
        let y = block / across * height + within / width;
        [self.first[0] + x, self.first[1] + y]
    }
}

/// What numbers are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SampleDimension {
    /// The facet of a rough surface.
    Facet,
    /// The point of a light, by its place in the scene.
    Light(usize),
}

impl SampleDimension {
    fn number(self) -> u32 {
        match self {
            Self::Facet => 0,
            Self::Light(place) => 1 + place as u32,
        }
    }
}

/// A key with another number mixed in (the finalizer of MurmurHash3, A. Appleby 2011).
fn hashed(key: u32, number: u32) -> u32 {
    let mut bits = key.rotate_left(13) ^ number.wrapping_mul(0x9e37_79b9);
    bits = (bits ^ bits >> 16).wrapping_mul(0x85eb_ca6b);
    bits = (bits ^ bits >> 13).wrapping_mul(0xc2b2_ae35);
    bits ^ bits >> 16
}

/// The numbers of a sample.
fn pair(sample: u32, key: u32) -> [f32; 2] {
    let index = scrambled(sample, key);
    let numbers = [index.reverse_bits(), second_of(index)];
    let salts = [0x68bc_21eb, 0x02e5_be93];
    std::array::from_fn(|at| (scrambled(numbers[at], hashed(key, salts[at])) >> 8) as f32 * 2.0_f32.powi(-24))
}

/// The second coordinate of Sobol's sequence (I. M. Sobol 1967): the digits of the index times Pascal's triangle modulo 2.
fn second_of(index: u32) -> u32 {
    let mut bits = index.reverse_bits();
    bits ^= bits << 16;
    bits ^= (bits & 0x00ff_00ff) << 8;
    bits ^= (bits & 0x0f0f_0f0f) << 4;
    bits ^= (bits & 0x3333_3333) << 2;
    bits ^ (bits & 0x5555_5555) << 1
}

/// Owen's scrambling of the digits, from the highest on, by a hash (S. Laine, T. Karras 2011; constants by N. Vegdahl 2021).
fn scrambled(number: u32, key: u32) -> u32 {
    let mut bits = number.reverse_bits();
    bits ^= bits.wrapping_mul(0x3d20_adea);
    bits = bits.wrapping_add(key);
    bits = bits.wrapping_mul(key >> 16 | 1);
    bits ^= bits.wrapping_mul(0x0552_6c56);
    bits ^= bits.wrapping_mul(0x53a2_2864);
    bits.reverse_bits()
}

/// Cosine and sine of a part of a full turn, the same on every machine.
fn cos_sin_of_turn(part: f32) -> [f32; 2] {
    let quarters = part * 4.0;
    let quarter = quarters.floor();
    let x = (quarters - quarter) * std::f32::consts::FRAC_PI_2;
    let square = x * x;
    // Taylor's series; what is left out is below the last digit up to a quarter of a turn.
    let sum = |parts: &[f32]| parts.iter().rev().fold(0.0, |sum, part| sum * square + part);
    let sin = x * sum(&[1.0, -1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362_880.0, -1.0 / 39_916_800.0]);
    let cos =
        sum(&[1.0, -0.5, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40_320.0, -1.0 / 3_628_800.0, 1.0 / 479_001_600.0]);
    match quarter as u32 % 4 {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_those_of_double_precision() {
        for step in 0..10_000_u16 {
            let part = f32::from(step) / 10_000.0;
            let (sin, cos) = (f64::from(part) * std::f64::consts::TAU).sin_cos();
            let [found_cos, found_sin] = cos_sin_of_turn(part);
            assert!(
                (f64::from(found_cos) - cos).abs() < 4e-7 && (f64::from(found_sin) - sin).abs() < 4e-7,
                "{part}"
            );
        }
    }

    #[test]
    fn the_second_coordinate_is_sobols() {
        for index in (0..1000).chain([u32::MAX, 0x1234_5678]) {
            let (mut left, mut direction, mut sum) = (index, 1_u32 << 31, 0);
            while left != 0 {
                if left & 1 == 1 {
                    sum ^= direction;
                }
                (left, direction) = (left >> 1, direction ^ direction >> 1);
            }
            assert_eq!(second_of(index), sum, "{index}");
        }
    }

    /// Of 2ᵏ samples every box of area 2⁻ᵏ whose sides are halves of halves has one.
    #[test]
    fn samples_fill_the_square_evenly() {
        for key in [0, 1, 0xdead_beef, 77] {
            for bits in [2, 4, 6] {
                let count = 1 << bits;
                for across in 0..=bits {
                    let (columns, rows) = (1 << across, 1 << (bits - across));
                    let mut boxes = vec![0; count];
                    for sample in 0..count as u32 {
                        let [x, y] = pair(sample, key);
                        assert!((0.0..1.0).contains(&x) && (0.0..1.0).contains(&y));
                        boxes[(x * columns as f32) as usize * rows + (y * rows as f32) as usize] += 1;
                    }
                    assert!(boxes.iter().all(|&samples| samples == 1), "{key} {bits} {across}");
                }
            }
        }
    }

    #[test]
    fn neighbors_throw_otherwise() {
        let numbers = |x, y| pair(0, [x, y, 1, 0, 0].into_iter().fold(0, hashed));
        let mut sum = 0.0;
        for x in 0..64 {
            for y in 0..64 {
                let ([a, b], [c, d]) = (numbers(x, y), numbers(x + 1, y));
                sum += (a - 0.5) * (c - 0.5) + (b - 0.5) * (d - 0.5);
            }
        }
        // The correlation of independent numbers is within a few hundredths of their variance, 1/12.
        assert!((sum / 4096.0).abs() < 0.01, "{sum}");
    }

    #[test]
    fn a_pixel_throws_alike_in_blocks_of_every_size() {
        let narrow = Sampler::new(3, [32, 64], [1, 1], 20);
        let wide = Sampler::new(3, [32, 64], [4, 4], 5);
        for y in 0..8 {
            for x in 0..20 {
                let block = y / 4 * 5 + x / 4;
                let pixel = block * 16 + y % 4 * 4 + x % 4;
                assert_eq!(narrow.place_of(y * 20 + x), [32 + x, 64 + y]);
                assert_eq!(wide.place_of(pixel), [32 + x, 64 + y]);
            }
        }
    }
}
