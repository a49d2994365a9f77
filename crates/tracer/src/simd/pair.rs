//! Twice as many numbers as another width has: two vectors.
//!
//! What a packet costs is half its numbers and half what is done once for all of them (looking for bodies, branches, moving
//! things to memory and back), and most of the time one step waits for another. Two vectors share the one and fill the other.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use crate::simd::{Float, Float32, Mask, Width, Word};

/// Twice the numbers of `W`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PairWidth<W>(pub(crate) W);

/// The first numbers, words or answers, and as many more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LanePair<T>(T, T);

impl<W: Width> Width for PairWidth<W> {
    const LANES: usize = 2 * W::LANES;
    const USES_HIERARCHY: bool = false;
    const TESTS_DOUBLES: bool = false;
    type R = LanePair<W::R>;
    type W = LanePair<W::W>;
    type M = LanePair<W::M>;
    type E = W::E;

    #[inline(always)]
    fn real(self, value: f32) -> LanePair<W::R> {
        LanePair(self.0.real(value), self.0.real(value))
    }

    #[inline(always)]
    fn word(self, value: u32) -> LanePair<W::W> {
        LanePair(self.0.word(value), self.0.word(value))
    }

    #[inline(always)]
    fn mask(self, bits: u32) -> LanePair<W::M> {
        LanePair(self.0.mask(bits & (u32::MAX >> (32 - W::LANES))), self.0.mask(bits >> W::LANES))
    }

    #[inline(always)]
    fn load(self, from: &[f32]) -> LanePair<W::R> {
        LanePair(self.0.load(from), self.0.load(&from[W::LANES..]))
    }

    #[inline(always)]
    fn load_words(self, from: &[u32]) -> LanePair<W::W> {
        LanePair(self.0.load_words(from), self.0.load_words(&from[W::LANES..]))
    }

    #[inline(always)]
    fn gather<const N: usize>(self, from: &[[f32; 4]; N], at: &[u32]) -> [LanePair<W::R>; 4] {
        let [a, b, c, d] = self.0.gather(from, at);
        let [e, f, g, h] = self.0.gather(from, &at[W::LANES..]);
        [LanePair(a, e), LanePair(b, f), LanePair(c, g), LanePair(d, h)]
    }

    #[inline(always)]
    fn load_fours(self, from: &[[f32; 4]]) -> [LanePair<W::R>; 4] {
        let [a, b, c, d] = self.0.load_fours(from);
        let [e, f, g, h] = self.0.load_fours(&from[W::LANES..]);
        [LanePair(a, e), LanePair(b, f), LanePair(c, g), LanePair(d, h)]
    }

    #[inline(always)]
    fn store_fours(self, [x, y, z, w]: [LanePair<W::R>; 4], to: &mut [[f32; 4]]) {
        self.0.store_fours([x.0, y.0, z.0, w.0], to);
        self.0.store_fours([x.1, y.1, z.1, w.1], &mut to[W::LANES..]);
    }

    #[inline(always)]
    fn store_threes(self, [x, y, z]: [LanePair<W::R>; 3], to: &mut [[f32; 3]]) {
        self.0.store_threes([x.0, y.0, z.0], to);
        self.0.store_threes([x.1, y.1, z.1], &mut to[W::LANES..]);
    }

    #[inline(always)]
    fn eight(self, numbers: &[f32; 8]) -> W::E {
        self.0.eight(numbers)
    }

    #[inline(always)]
    fn eight_like(self, value: f32) -> W::E {
        self.0.eight_like(value)
    }

    #[inline(always)]
    fn run<T>(self, act: impl FnOnce() -> T) -> T {
        self.0.run(act)
    }

    #[inline(always)]
    fn run_once<T>(self, act: impl FnOnce() -> T) -> T {
        self.0.run_once(act)
    }
}

macro_rules! operators {
    ($($operator:ident, $method:ident);*) => {$(
        impl<R: Float32> $operator for LanePair<R> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
    )*};
}

macro_rules! operators_of_all {
    ($($operator:ident, $method:ident);*) => {$(
        impl<R: Float32> $operator<f32> for LanePair<R> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: f32) -> Self {
                Self(self.0.$method(other), self.1.$method(other))
            }
        }
    )*};
}

operators!(Add, add; Sub, sub; Mul, mul; Div, div);
operators_of_all!(Add, add; Sub, sub; Mul, mul);

impl<R: Float32> Neg for LanePair<R> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

macro_rules! each {
    ($($name:ident($($other:ident),*) -> $out:ty;)*) => {$(
        #[inline(always)]
        fn $name(self, $($other: Self),*) -> $out {
            LanePair(self.0.$name($($other.0),*), self.1.$name($($other.1),*))
        }
    )*};
}

impl<R: Float32> Float for LanePair<R> {
    const LANES: usize = 2 * R::LANES;
    type Mask = LanePair<R::Mask>;

    each! {
        times_plus(factor, term) -> Self;
        abs() -> Self;
        sqrt() -> Self;
        floor() -> Self;
        min(other) -> Self;
        max(other) -> Self;
        copysign(other) -> Self;
        lt(other) -> LanePair<R::Mask>;
        le(other) -> LanePair<R::Mask>;
        eq(other) -> LanePair<R::Mask>;
    }

    #[inline(always)]
    fn like(self, value: f32) -> Self {
        Self(self.0.like(value), self.1.like(value))
    }

    #[inline(always)]
    fn select(mask: LanePair<R::Mask>, yes: Self, no: Self) -> Self {
        Self(R::select(mask.0, yes.0, no.0), R::select(mask.1, yes.1, no.1))
    }
}

impl<R: Float32> Float32 for LanePair<R> {
    type Word = LanePair<R::Word>;

    each! {
        to_word() -> LanePair<R::Word>;
    }

    #[inline(always)]
    fn of_word(word: LanePair<R::Word>) -> Self {
        Self(R::of_word(word.0), R::of_word(word.1))
    }

    #[inline(always)]
    fn store_some(self, mask: LanePair<R::Mask>, to: &mut [f32]) {
        self.0.store_some(mask.0, to);
        self.1.store_some(mask.1, &mut to[mask.0.bits().count_ones() as usize..]);
    }

    #[inline(always)]
    fn least(self) -> f32 {
        self.0.min(self.1).least()
    }

    #[inline(always)]
    fn greatest(self) -> f32 {
        self.0.max(self.1).greatest()
    }

    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        self.0.store(to);
        self.1.store(&mut to[R::LANES..]);
    }
}

impl<W: Word> Word for LanePair<W> {
    type Mask = LanePair<W::Mask>;
    const LANES: usize = 2 * W::LANES;

    each! {
        plus(other) -> Self;
        or(other) -> Self;
    }

    #[inline(always)]
    fn like(self, value: u32) -> Self {
        Self(self.0.like(value), self.1.like(value))
    }

    #[inline(always)]
    fn is(self, value: u32) -> LanePair<W::Mask> {
        LanePair(self.0.is(value), self.1.is(value))
    }

    #[inline(always)]
    fn equals(self, other: Self) -> LanePair<W::Mask> {
        LanePair(self.0.equals(other.0), self.1.equals(other.1))
    }

    #[inline(always)]
    fn has(self, bits: u32) -> LanePair<W::Mask> {
        LanePair(self.0.has(bits), self.1.has(bits))
    }

    #[inline(always)]
    fn and(self, bits: u32) -> Self {
        Self(self.0.and(bits), self.1.and(bits))
    }

    #[inline(always)]
    fn shifted_right(self, by: u32) -> Self {
        Self(self.0.shifted_right(by), self.1.shifted_right(by))
    }

    #[inline(always)]
    fn shifted_left(self, by: u32) -> Self {
        Self(self.0.shifted_left(by), self.1.shifted_left(by))
    }

    #[inline(always)]
    fn select(mask: LanePair<W::Mask>, yes: Self, no: Self) -> Self {
        Self(W::select(mask.0, yes.0, no.0), W::select(mask.1, yes.1, no.1))
    }

    #[inline(always)]
    fn store_some(self, mask: LanePair<W::Mask>, to: &mut [u32]) {
        self.0.store_some(mask.0, to);
        self.1.store_some(mask.1, &mut to[mask.0.bits().count_ones() as usize..]);
    }

    #[inline(always)]
    fn store(self, to: &mut [u32]) {
        self.0.store(to);
        self.1.store(&mut to[W::LANES..]);
    }
}

impl<M: Mask> BitAnd for LanePair<M> {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0, self.1 & other.1)
    }
}

impl<M: Mask> BitOr for LanePair<M> {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0, self.1 | other.1)
    }
}

impl<M: Mask> Not for LanePair<M> {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0, !self.1)
    }
}

impl<M: Mask> Mask for LanePair<M> {
    const LANES: usize = 2 * M::LANES;

    #[inline(always)]
    fn any(self) -> bool {
        (self.0 | self.1).any()
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        self.0.bits() | self.1.bits() << M::LANES
    }
}
