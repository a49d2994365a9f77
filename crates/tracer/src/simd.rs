//! Numbers side by side: the one place that names the SIMD library.
//!
//! The mathematics of rays is written once, over a [`Width`]: one ray ([`ScalarWidth`](scalar::ScalarWidth)), as many as
//! the processor's vectors hold ([`SimdWidth`](wide::SimdWidth): 4 with SSE or NEON, 8 with AVX2, 16 with AVX-512), or
//! twice as many ([`PairWidth`](pair::PairWidth)), chosen when the program runs. Every operation has one correctly rounded
//! result, so that a ray has the same outcome bit by bit by itself
//! and in the widths that a picture is traced in, on all processors but those without fused multiplication and addition
//! (x86 before AVX2): they round the products of [`Float::times_plus`], and have other last digits.
//!
//! Bodies whose numbers do not fit single precision are intersected over a [`Float64`](double::Float64), the same
//! mathematics in double precision.
//!
//! What is written over a width must be inlined into a body of [`Width::run`], where the compiler may use the
//! instructions of the width: `#[inline(always)]` on everything small, `run` around what is called often and large.

pub(crate) mod double;
pub(crate) mod eight;
#[cfg(target_arch = "x86_64")]
pub(crate) mod pair;
pub(crate) mod scalar;
pub(crate) mod vector;
pub(crate) mod wide;

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// The most lanes of any width.
pub(crate) const MOST_LANES: usize = 32;

/// Floating-point numbers of one precision, side by side: what the mathematics of shapes needs.
pub trait Float:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f32, Output = Self>
    + Sub<f32, Output = Self>
    + Mul<f32, Output = Self>
{
    /// How many there are.
    const LANES: usize;
    /// One answer for each.
    type Mask: Mask;

    /// As many numbers, all of this value.
    fn like(self, value: f32) -> Self;
    /// x·`factor` + `term`; numbers in single precision round it once where the processor can do that in one go.
    fn times_plus(self, factor: Self, term: Self) -> Self;
    /// |x|.
    fn abs(self) -> Self;
    /// √x; no number for x < 0.
    fn sqrt(self) -> Self;
    /// The largest whole number not above x.
    fn floor(self) -> Self;
    /// The smaller one; on x86 `other` when one is no number.
    fn min(self, other: Self) -> Self;
    /// The larger one; on x86 `other` when one is no number.
    fn max(self, other: Self) -> Self;
    /// |x| with the sign of `other`.
    fn copysign(self, other: Self) -> Self;
    /// x < `other`.
    fn lt(self, other: Self) -> Self::Mask;
    /// x ≤ `other`.
    fn le(self, other: Self) -> Self::Mask;
    /// x = `other`.
    fn eq(self, other: Self) -> Self::Mask;
    /// `yes` where `mask` holds, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// x > `other`.
    #[inline(always)]
    fn gt(self, other: Self) -> Self::Mask {
        other.lt(self)
    }

    /// x ≥ `other`.
    #[inline(always)]
    fn ge(self, other: Self) -> Self::Mask {
        other.le(self)
    }
}

/// Real numbers in single precision, side by side.
pub trait Float32: Float {
    /// As many 32-bit words.
    type Word: Word<Mask = Self::Mask>;

    /// The bits of the numbers.
    fn to_word(self) -> Self::Word;
    /// The numbers of these bits.
    fn of_word(word: Self::Word) -> Self;
    /// Writes the numbers of `mask` side by side to the front of `to`, which holds at least as many as there are of all.
    fn store_some(self, mask: Self::Mask, to: &mut [f32]);
    /// The smallest of the numbers.
    fn least(self) -> f32;
    /// The largest of the numbers.
    fn greatest(self) -> f32;
    /// Writes the numbers to the front of `to`, which holds at least as many.
    fn store(self, to: &mut [f32]);
}

/// Words of 32 bits, side by side.
pub trait Word: Copy {
    /// How many there are.
    const LANES: usize;
    /// One answer for each.
    type Mask: Mask;

    /// As many words, all of this value.
    fn like(self, value: u32) -> Self;
    /// Whether each equals `value`.
    fn is(self, value: u32) -> Self::Mask;
    /// Whether each equals that of `other`.
    fn equals(self, other: Self) -> Self::Mask;
    /// Whether each has one of these bits.
    fn has(self, bits: u32) -> Self::Mask;
    /// The sum, wrapping.
    fn plus(self, other: Self) -> Self;
    /// The bits of both.
    fn or(self, other: Self) -> Self;
    /// The common bits.
    fn and(self, bits: u32) -> Self;
    /// Shifted towards the low bits.
    fn shifted_right(self, by: u32) -> Self;
    /// Shifted towards the high bits.
    fn shifted_left(self, by: u32) -> Self;
    /// `yes` where `mask` holds, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Writes the words of `mask` side by side to the front of `to`, which holds at least as many as there are of all.
    fn store_some(self, mask: Self::Mask, to: &mut [u32]);
    /// Writes the words to the front of `to`, which holds at least as many.
    fn store(self, to: &mut [u32]);
}

/// Answers, side by side.
pub trait Mask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// How many there are.
    const LANES: usize;

    /// Whether any holds.
    fn any(self) -> bool;
    /// A bit for each, the first the lowest.
    fn bits(self) -> u32;
}

/// Eight real numbers side by side in every width: one for each box of a node.
pub(crate) trait Float8: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// The smaller one; on x86 `other` when one is no number.
    fn min(self, other: Self) -> Self;
    /// The larger one; on x86 `other` when one is no number.
    fn max(self, other: Self) -> Self;
    /// A bit for each x ≤ `other`, the first the lowest.
    fn le(self, other: Self) -> u32;
    /// The bits of the numbers.
    fn to_words(self) -> [u32; 8];
}

/// How many numbers stand side by side.
pub(crate) trait Width: Copy {
    /// Their number, at most [`MOST_LANES`].
    const LANES: usize;
    /// Whether it is for scenes with a hierarchy, too. Without, it has no code for one, and goes through all bodies.
    const USES_HIERARCHY: bool;
    /// Whether it is for scenes with bodies in double precision, too: the calls for them cost all others 2 to 9 %.
    const TESTS_DOUBLES: bool;
    type R: Float32<Mask = Self::M, Word = Self::W>;
    type W: Word<Mask = Self::M>;
    type M: Mask;
    type E: Float8;

    fn real(self, value: f32) -> Self::R;
    fn word(self, value: u32) -> Self::W;
    /// The answers of these bits, the first the lowest.
    fn mask(self, bits: u32) -> Self::M;
    /// Those of the first `count`.
    #[inline(always)]
    fn first(self, count: usize) -> Self::M {
        self.mask(((1_u64 << count.min(Self::LANES)) - 1) as u32)
    }
    /// The first numbers of `from`, which holds at least as many.
    fn load(self, from: &[f32]) -> Self::R;
    /// The first words of `from`, which holds at least as many.
    fn load_words(self, from: &[u32]) -> Self::W;
    /// The four numbers of `from` at each of these places, of which there are at least as many; `N` is a power of 2, and
    /// places are taken modulo it.
    fn gather<const N: usize>(self, from: &[[f32; 4]; N], at: &[u32]) -> [Self::R; 4];
    /// The first fours of numbers of `from`, which holds at least as many.
    fn load_fours(self, from: &[[f32; 4]]) -> [Self::R; 4];
    /// Writes fours of numbers to the front of `to`, which holds at least as many.
    fn store_fours(self, numbers: [Self::R; 4], to: &mut [[f32; 4]]);
    /// Writes threes of numbers to the front of `to`, which holds at least as many.
    fn store_threes(self, numbers: [Self::R; 3], to: &mut [[f32; 3]]);
    /// These eight numbers.
    fn eight(self, numbers: &[f32; 8]) -> Self::E;
    /// Eight numbers, all of this value.
    fn eight_like(self, value: f32) -> Self::E;
    /// Runs `act` where the compiler may use the instructions of this width.
    fn run<T>(self, act: impl FnOnce() -> T) -> T;
    /// Runs `act`, in a function of its own where short code counts for more than quick code.
    fn run_once<T>(self, act: impl FnOnce() -> T) -> T;
}

/// Work that is written over a width.
pub(crate) trait SimdKernel {
    type Output;

    fn run<W: Width>(self, w: W) -> Self::Output;
}

/// Work with code of its own for plain scenes.
pub(crate) trait SceneKernel: SimdKernel {
    /// The work by code for all scenes.
    type General: SimdKernel<Output = Self::Output>;

    /// What is run in widths for which one kind of code is enough.
    fn general(self) -> Self::General;
}

/// Calls `act` for each lane whose bit is set.
#[inline(always)]
pub(crate) fn each_lane(mut lanes: u32, mut act: impl FnMut(usize)) {
    while lanes != 0 {
        act(lanes.trailing_zeros() as usize % MOST_LANES);
        lanes &= lanes - 1;
    }
}
