//! One number at a time.

use std::ops::{Add, Mul, Sub};

use crate::simd::wide::times_plus_like_widest;
use crate::simd::{Float, Float8, Float32, Mask, Width, Word};

/// One number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScalarWidth;

impl Width for ScalarWidth {
    const LANES: usize = 1;
    const USES_HIERARCHY: bool = true;
    const TESTS_DOUBLES: bool = true;
    type R = f32;
    type W = u32;
    type M = bool;
    type E = ScalarFloat8;

    #[inline(always)]
    fn real(self, value: f32) -> f32 {
        value
    }

    #[inline(always)]
    fn word(self, value: u32) -> u32 {
        value
    }

    #[inline(always)]
    fn mask(self, bits: u32) -> bool {
        bits & 1 == 1
    }

    #[inline(always)]
    fn load(self, from: &[f32]) -> f32 {
        from[0]
    }

    #[inline(always)]
    fn load_words(self, from: &[u32]) -> u32 {
        from[0]
    }

    #[inline(always)]
    fn gather<const N: usize>(self, from: &[[f32; 4]; N], at: &[u32]) -> [f32; 4] {
        from[at[0] as usize % N]
    }

    #[inline(always)]
    fn load_fours(self, from: &[[f32; 4]]) -> [f32; 4] {
        from[0]
    }

    #[inline(always)]
    fn store_fours(self, numbers: [f32; 4], to: &mut [[f32; 4]]) {
        to[0] = numbers;
    }

    #[inline(always)]
    fn store_threes(self, numbers: [f32; 3], to: &mut [[f32; 3]]) {
        to[0] = numbers;
    }

    #[inline(always)]
    fn eight(self, numbers: &[f32; 8]) -> ScalarFloat8 {
        ScalarFloat8(*numbers)
    }

    #[inline(always)]
    fn eight_like(self, value: f32) -> ScalarFloat8 {
        ScalarFloat8([value; 8])
    }

    // Single rays are few, and their code would be copied to each place that traces one.
    #[inline(never)]
    fn run<T>(self, act: impl FnOnce() -> T) -> T {
        act()
    }

    #[inline(never)]
    fn run_once<T>(self, act: impl FnOnce() -> T) -> T {
        act()
    }
}

/// Eight numbers, one by one.
#[derive(Clone, Copy)]
pub(crate) struct ScalarFloat8([f32; 8]);

impl ScalarFloat8 {
    #[inline(always)]
    fn with(self, other: Self, act: impl Fn(f32, f32) -> f32) -> Self {
        Self(std::array::from_fn(|at| act(self.0[at], other.0[at])))
    }
}

impl Add for ScalarFloat8 {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(other, |a, b| a + b)
    }
}

impl Sub for ScalarFloat8 {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(other, |a, b| a - b)
    }
}

impl Mul for ScalarFloat8 {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(other, |a, b| a * b)
    }
}

impl Float8 for ScalarFloat8 {
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.with(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.with(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn le(self, other: Self) -> u32 {
        (0..8).fold(0, |bits, at| bits | u32::from(self.0[at] <= other.0[at]) << at)
    }

    #[inline(always)]
    fn to_words(self) -> [u32; 8] {
        self.0.map(f32::to_bits)
    }
}

impl Float for f32 {
    const LANES: usize = 1;
    type Mask = bool;

    #[inline(always)]
    fn like(self, value: f32) -> f32 {
        value
    }

    #[inline(always)]
    fn times_plus(self, factor: f32, term: f32) -> f32 {
        times_plus_like_widest(self, factor, term)
    }

    #[inline(always)]
    fn abs(self) -> f32 {
        f32::abs(self)
    }

    #[inline(always)]
    fn sqrt(self) -> f32 {
        f32::sqrt(self)
    }

    #[inline(always)]
    fn floor(self) -> f32 {
        f32::floor(self)
    }

    #[inline(always)]
    fn min(self, other: f32) -> f32 {
        if self < other { self } else { other }
    }

    #[inline(always)]
    fn max(self, other: f32) -> f32 {
        if self > other { self } else { other }
    }

    #[inline(always)]
    fn copysign(self, other: f32) -> f32 {
        f32::copysign(self, other)
    }

    #[inline(always)]
    fn lt(self, other: f32) -> bool {
        self < other
    }

    #[inline(always)]
    fn le(self, other: f32) -> bool {
        self <= other
    }

    #[inline(always)]
    fn eq(self, other: f32) -> bool {
        self == other
    }

    #[inline(always)]
    fn select(mask: bool, yes: f32, no: f32) -> f32 {
        if mask { yes } else { no }
    }
}

impl Float32 for f32 {
    type Word = u32;

    #[inline(always)]
    fn to_word(self) -> u32 {
        self.to_bits()
    }

    #[inline(always)]
    fn of_word(word: u32) -> f32 {
        f32::from_bits(word)
    }

    #[inline(always)]
    fn store_some(self, _mask: bool, to: &mut [f32]) {
        to[0] = self;
    }

    #[inline(always)]
    fn least(self) -> f32 {
        self
    }

    #[inline(always)]
    fn greatest(self) -> f32 {
        self
    }

    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        to[0] = self;
    }
}

impl Word for u32 {
    const LANES: usize = 1;
    type Mask = bool;

    #[inline(always)]
    fn like(self, value: u32) -> u32 {
        value
    }

    #[inline(always)]
    fn is(self, value: u32) -> bool {
        self == value
    }

    #[inline(always)]
    fn equals(self, other: u32) -> bool {
        self == other
    }

    #[inline(always)]
    fn has(self, bits: u32) -> bool {
        self & bits != 0
    }

    #[inline(always)]
    fn plus(self, other: u32) -> u32 {
        self.wrapping_add(other)
    }

    #[inline(always)]
    fn or(self, other: u32) -> u32 {
        self | other
    }

    #[inline(always)]
    fn and(self, bits: u32) -> u32 {
        self & bits
    }

    #[inline(always)]
    fn shifted_right(self, by: u32) -> u32 {
        self >> by
    }

    #[inline(always)]
    fn shifted_left(self, by: u32) -> u32 {
        self << by
    }

    #[inline(always)]
    fn select(mask: bool, yes: u32, no: u32) -> u32 {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn store_some(self, _mask: bool, to: &mut [u32]) {
        to[0] = self;
    }

    #[inline(always)]
    fn store(self, to: &mut [u32]) {
        to[0] = self;
    }
}

impl Mask for bool {
    const LANES: usize = 1;

    #[inline(always)]
    fn any(self) -> bool {
        self
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        u32::from(self)
    }
}
