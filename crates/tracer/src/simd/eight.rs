//! Eight numbers side by side, whatever the width.

use std::ops::{Add, Mul, Sub};

use fearless_simd::{Bytes as _, Simd, SimdBase as _, SimdMask as _, f32x8, u32x8};

use crate::simd::Float8;

/// Eight numbers by these instructions.
#[derive(Clone, Copy)]
pub(crate) struct SimdFloat8<S: Simd>(f32x8<S>);

impl<S: Simd> SimdFloat8<S> {
    #[inline(always)]
    pub(crate) fn new(simd: S, numbers: &[f32; 8]) -> Self {
        Self(f32x8::from_slice(simd, numbers))
    }

    #[inline(always)]
    pub(crate) fn like(simd: S, value: f32) -> Self {
        Self(f32x8::splat(simd, value))
    }
}

impl<S: Simd> Float8 for SimdFloat8<S> {
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }

    #[inline(always)]
    fn le(self, other: Self) -> u32 {
        self.0.simd_le(other.0).to_bitmask() as u32
    }

    #[inline(always)]
    fn to_words(self) -> [u32; 8] {
        let words: u32x8<S> = self.0.bitcast();
        let mut all = [0; 8];
        words.store_slice(&mut all);
        all
    }
}

/// Operators that the library's vectors have too.
macro_rules! operators {
    ($($operator:ident, $method:ident);*) => {$(
        impl<S: Simd> $operator for SimdFloat8<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }
    )*};
}

operators!(Add, add; Sub, sub; Mul, mul);
