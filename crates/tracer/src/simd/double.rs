//! Numbers in double precision, side by side: for the few bodies whose numbers do not fit single precision.
//!
//! Every operation is rounded by itself, so that numbers do not depend on how many stand side by side. All are short loops
//! over arrays, which the compiler makes vectors of where it is told which the processor has.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use crate::simd::{Float, Mask};

/// So many numbers in double precision.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Float64<const N: usize>(pub(crate) [f64; N]);

/// Answers about them, as words of ones or zeros.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mask64<const N: usize>([u64; N]);

impl<const N: usize> Mask64<N> {
    /// The answers of these bits, the first the lowest.
    #[inline(always)]
    pub(crate) fn of_bits(bits: u32) -> Self {
        let mut mask = [0; N];
        for (lane, mask) in mask.iter_mut().enumerate() {
            *mask = 0_u64.wrapping_sub(u64::from(bits >> lane & 1));
        }
        Self(mask)
    }
}

impl<const N: usize> Mask64<N> {
    /// Makes `words` this value where it holds.
    #[inline(always)]
    pub(crate) fn select_words(self, value: u32, words: &mut [u32; N]) {
        for (word, mask) in words.iter_mut().zip(self.0) {
            *word = value & mask as u32 | *word & !mask as u32;
        }
    }
}

macro_rules! operators {
    ($lanes:ident: $($operator:ident, $method:ident, $act:tt);*) => {$(
        impl<const N: usize> $operator for $lanes<N> {
            type Output = Self;

            #[inline(always)]
            fn $method(mut self, other: Self) -> Self {
                for lane in 0..N {
                    self.0[lane] $act other.0[lane];
                }
                self
            }
        }
    )*};
}

macro_rules! operators_of_all {
    ($($operator:ident, $method:ident, $act:tt);*) => {$(
        impl<const N: usize> $operator<f32> for Float64<N> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: f32) -> Self {
                self $act self.like(other)
            }
        }
    )*};
}

macro_rules! compare {
    ($($name:ident, $act:tt);*) => {$(
        #[inline(always)]
        fn $name(self, other: Self) -> Mask64<N> {
            let mut mask = [0; N];
            for lane in 0..N {
                mask[lane] = if self.0[lane] $act other.0[lane] { u64::MAX } else { 0 };
            }
            Mask64(mask)
        }
    )*};
}

operators!(Float64: Add, add, +=; Sub, sub, -=; Mul, mul, *=; Div, div, /=);
operators_of_all!(Add, add, +; Sub, sub, -; Mul, mul, *);
operators!(Mask64: BitAnd, bitand, &=; BitOr, bitor, |=);

impl<const N: usize> Neg for Float64<N> {
    type Output = Self;

    #[inline(always)]
    fn neg(mut self) -> Self {
        for lane in 0..N {
            self.0[lane] = -self.0[lane];
        }
        self
    }
}

impl<const N: usize> Not for Mask64<N> {
    type Output = Self;

    #[inline(always)]
    fn not(mut self) -> Self {
        for lane in 0..N {
            self.0[lane] = !self.0[lane];
        }
        self
    }
}

impl<const N: usize> Mask for Mask64<N> {
    const LANES: usize = N;

    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        let mut bits = 0;
        for lane in 0..N {
            bits |= (self.0[lane] as u32 & 1) << lane;
        }
        bits
    }
}

impl<const N: usize> Float for Float64<N> {
    const LANES: usize = N;
    type Mask = Mask64<N>;

    compare!(lt, <; le, <=; eq, ==);

    #[inline(always)]
    fn like(self, value: f32) -> Self {
        Self([f64::from(value); N])
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    #[inline(always)]
    fn abs(mut self) -> Self {
        for lane in 0..N {
            self.0[lane] = self.0[lane].abs();
        }
        self
    }

    #[inline(always)]
    fn sqrt(mut self) -> Self {
        for lane in 0..N {
            self.0[lane] = self.0[lane].sqrt();
        }
        self
    }

    #[inline(always)]
    fn floor(mut self) -> Self {
        for lane in 0..N {
            self.0[lane] = self.0[lane].floor();
        }
        self
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select(self.lt(other), self, other)
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select(other.lt(self), self, other)
    }

    #[inline(always)]
    fn copysign(mut self, other: Self) -> Self {
        for lane in 0..N {
            self.0[lane] = self.0[lane].copysign(other.0[lane]);
        }
        self
    }

    #[inline(always)]
    fn select(mask: Mask64<N>, yes: Self, no: Self) -> Self {
        let mut chosen = no;
        for lane in 0..N {
            let (yes, no, mask) = (yes.0[lane].to_bits(), no.0[lane].to_bits(), mask.0[lane]);
            chosen.0[lane] = f64::from_bits(yes & mask | no & !mask);
        }
        chosen
    }
}
