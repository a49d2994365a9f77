//! As many numbers as the processor's vectors hold.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};
use std::sync::LazyLock;

use fearless_simd::{
    Bytes as _, ExtractToken as _, Level, Select as _, Simd, SimdBase as _, SimdFloat as _, SimdMask as _,
};

use crate::simd::eight::SimdFloat8;
#[cfg(target_arch = "x86_64")]
use crate::simd::pair::PairWidth;
use crate::simd::{Float, Float32, MOST_LANES, Mask, SceneKernel, SimdKernel, Width, Word};

/// A width that the processor has: so many rays are traced side by side. [`RenderScene::build`](crate::RenderScene::build)
/// takes the best one.
#[derive(Clone, Copy, Debug)]
pub struct SimdLevel {
    level: Level,
    packets: Packets,
}

/// What is traced side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Packets {
    /// As many rays as a vector holds.
    Vectors,
    /// Twice as many, where vectors are of AVX-512.
    Pairs,
    /// As many as a vector of at most AVX2 holds; bodies may be in double precision.
    WithDoubles,
}

impl SimdLevel {
    /// What is best for scenes with a hierarchy: the widest vectors.
    pub(crate) fn widest() -> Self {
        Self { level: Level::new(), packets: Packets::Vectors }
    }

    /// What is best for a handful of bodies: where there is room for their code, pairs of the widest vectors.
    pub(crate) fn for_few() -> Self {
        let packets = if has_room_for_pairs() { Packets::Pairs } else { Packets::Vectors };
        Self { packets, ..Self::widest() }
    }

    /// For scenes with bodies in double precision.
    pub(crate) fn with_doubles() -> Self {
        Self { packets: Packets::WithDoubles, ..Self::widest() }
    }

    /// All that differ, by name, the widest first.
    pub fn all() -> Vec<(&'static str, Self)> {
        let widest = Self::widest();
        #[cfg_attr(not(target_arch = "x86_64"), expect(unused_mut))]
        let mut all = vec![("widest", widest), ("with doubles", Self::with_doubles())];
        #[cfg(target_arch = "x86_64")]
        {
            let Self { level, packets } = widest;
            let of = |level| Self { level, packets };
            all.extend(level.as_avx512().map(|_| ("pairs", Self { level, packets: Packets::Pairs })));
            all.extend(level.as_avx2().map(|token| ("AVX2", of(token.level()))));
            all.extend(level.as_sse2().map(|token| ("SSE2", of(token.level()))));
        }
        all
    }

    /// Whether it rounds as the widest of this processor does, so that light is the same to the last bit.
    pub fn rounds_like_widest(self) -> bool {
        #[cfg(target_arch = "x86_64")]
        return self.level.as_avx2().is_some() == Level::new().as_avx2().is_some();
        #[cfg(not(target_arch = "x86_64"))]
        true
    }

    /// Does `work` in this width.
    #[cfg(target_arch = "x86_64")]
    pub(crate) fn run<T: SceneKernel>(self, work: T) -> T::Output {
        // What has no AVX2 is old: one kind of code, SSE2, serves all of it. Bodies in double precision are rare, too.
        match (self.level, self.packets) {
            (Level::Avx512(simd), Packets::Vectors) => run::<_, false, _>(simd, work),
            (Level::Avx512(simd), Packets::Pairs) => simd.vectorize(
                #[inline(always)]
                || work.run(PairWidth(SimdWidth::<_, false>(simd))),
            ),
            (Level::Avx2(simd), Packets::Vectors | Packets::Pairs) => run::<_, false, _>(simd, work),
            (level, _) => match (level.as_avx2(), level.as_sse2()) {
                (Some(simd), _) => run::<_, true, _>(simd, work.general()),
                (None, Some(simd)) => run::<_, true, _>(simd, work.general()),
                (None, None) => unreachable!("x86-64 has SSE2 at least"),
            },
        }
    }

    /// Does `work` in this width or a narrower one, of which there are few: for work whose code is not worth compiling for
    /// each.
    #[cfg(target_arch = "x86_64")]
    pub(crate) fn run_in_few<T: SimdKernel>(self, work: T) -> T::Output {
        match (self.level, self.packets) {
            (Level::Avx512(simd), Packets::Vectors | Packets::Pairs) => run::<_, false, _>(simd, work),
            (level, _) => match (level.as_avx2(), level.as_sse2()) {
                (Some(simd), _) => run::<_, true, _>(simd, work),
                (None, Some(simd)) => run::<_, true, _>(simd, work),
                (None, None) => unreachable!("x86-64 has SSE2 at least"),
            },
        }
    }

    /// Does `work` in this width.
    #[cfg(not(target_arch = "x86_64"))]
    pub(crate) fn run_in_few<T: SimdKernel>(self, work: T) -> T::Output {
        fearless_simd::dispatch!(self.level, simd => work.run(SimdWidth::<_, true>(simd)))
    }

    /// Does `work` in this width.
    #[cfg(not(target_arch = "x86_64"))]
    pub(crate) fn run<T: SceneKernel>(self, work: T) -> T::Output {
        match self.packets {
            Packets::Vectors | Packets::Pairs => self.run_in_few(work),
            Packets::WithDoubles => self.run_in_few(work.general()),
        }
    }
}

/// Does `work` in vectors of one kind.
#[cfg(target_arch = "x86_64")]
fn run<S: InstructionSet, const DOUBLES: bool, T: SimdKernel>(simd: S, work: T) -> T::Output {
    simd.run(
        #[inline(always)]
        || work.run(SimdWidth::<S, DOUBLES>(simd)),
    )
}

/// Whether code for two vectors side by side stays in the cache next to the processor. Where it does (64 KB, Intel), a
/// handful of bodies takes 0.9 of the time; with half as much (32 KB, Zen 5) it took 1.1.
fn has_room_for_pairs() -> bool {
    /// Asking takes long, in virtual machines above all.
    static ROOM: LazyLock<bool> = LazyLock::new(|| code_cache_bytes() >= 64 << 10);
    *ROOM
}

/// The size of the first cache of code; 0 if it is not told.
fn code_cache_bytes() -> usize {
    #[cfg(target_arch = "x86_64")]
    {
        use raw_cpuid::{CacheType, CpuId};
        let caches = CpuId::new().get_cache_parameters();
        let first = caches.and_then(|mut caches| {
            caches.find(|cache| cache.level() == 1 && cache.cache_type() == CacheType::Instruction)
        });
        first.map_or(0, |cache| cache.sets() * cache.associativity() * cache.coherency_line_size())
    }
    #[cfg(not(target_arch = "x86_64"))]
    0
}

/// x·`factor` + `term`, rounded as the widest vectors of this processor round it. Not inlined: the code of single rays has
/// thousands of them.
#[cfg(target_arch = "x86_64")]
#[inline(never)]
pub(crate) fn times_plus_like_widest(x: f32, factor: f32, term: f32) -> f32 {
    match Level::new().as_avx2() {
        Some(simd) => simd.vectorize(
            #[inline(always)]
            || x.mul_add(factor, term),
        ),
        None => x * factor + term,
    }
}

/// x·`factor` + `term`, rounded as the vectors of this processor round it.
#[cfg(not(target_arch = "x86_64"))]
#[inline(always)]
pub(crate) fn times_plus_like_widest(x: f32, factor: f32, term: f32) -> f32 {
    #[cfg(all(target_arch = "wasm32", target_feature = "relaxed-simd"))]
    if let Some(simd) = Level::new().as_wasm_simd128() {
        // Of vectors alone a browser says that they round as its vectors do.
        let [x, factor, term] = [x, factor, term].map(|number| fearless_simd::f32x4::splat(simd, number));
        return x.mul_add(factor, term)[0];
    }
    if cfg!(target_feature = "neon") { x.mul_add(factor, term) } else { x * factor + term }
}

/// The instructions of a level.
pub(crate) trait InstructionSet: Simd {
    /// Runs `act`, in a function of its own, where the compiler may use these instructions.
    #[inline(always)]
    fn run<T>(self, act: impl FnOnce() -> T) -> T {
        self.vectorize(act)
    }
}

#[cfg(target_arch = "x86_64")]
impl InstructionSet for fearless_simd::Avx512 {}

#[cfg(target_arch = "x86_64")]
impl InstructionSet for fearless_simd::Avx2 {}

#[cfg(target_arch = "x86_64")]
impl InstructionSet for fearless_simd::Sse2 {
    // Everywhere the compiler may use these, so that it would copy `act` to each place where it is run.
    #[inline(never)]
    fn run<T>(self, act: impl FnOnce() -> T) -> T {
        act()
    }
}

#[cfg(not(target_arch = "x86_64"))]
impl<S: Simd> InstructionSet for S {}

/// As many numbers as a vector holds, perhaps for scenes with bodies in double precision.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SimdWidth<S, const DOUBLES: bool>(S);

/// Numbers in a vector.
#[derive(Clone, Copy)]
pub(crate) struct SimdFloat32<S: Simd>(S::f32s);

/// Words in a vector.
#[derive(Clone, Copy)]
pub(crate) struct SimdWord<S: Simd>(S::u32s);

/// Answers for the numbers of a vector.
#[derive(Clone, Copy)]
pub(crate) struct SimdMask<S: Simd>(S::mask32s);

impl<S: InstructionSet, const DOUBLES: bool> Width for SimdWidth<S, DOUBLES> {
    const LANES: usize = S::f32s::LEN;
    const USES_HIERARCHY: bool = true;
    const TESTS_DOUBLES: bool = DOUBLES;
    type R = SimdFloat32<S>;
    type W = SimdWord<S>;
    type M = SimdMask<S>;
    type E = SimdFloat8<S>;

    #[inline(always)]
    fn real(self, value: f32) -> SimdFloat32<S> {
        SimdFloat32(S::f32s::splat(self.0, value))
    }

    #[inline(always)]
    fn word(self, value: u32) -> SimdWord<S> {
        SimdWord(S::u32s::splat(self.0, value))
    }

    #[inline(always)]
    fn mask(self, bits: u32) -> SimdMask<S> {
        SimdMask(S::mask32s::from_bitmask(self.0, u64::from(bits)))
    }

    #[inline(always)]
    fn load(self, from: &[f32]) -> SimdFloat32<S> {
        SimdFloat32(S::f32s::from_slice(self.0, &from[..Self::LANES]))
    }

    #[inline(always)]
    fn load_words(self, from: &[u32]) -> SimdWord<S> {
        SimdWord(S::u32s::from_slice(self.0, &from[..Self::LANES]))
    }

    #[inline(always)]
    fn gather<const N: usize>(self, from: &[[f32; 4]; N], at: &[u32]) -> [SimdFloat32<S>; 4] {
        let mut fours = [[0.0; 4]; MOST_LANES];
        for (four, &at) in fours[..Self::LANES].iter_mut().zip(&at[..Self::LANES]) {
            *four = from[at as usize % N];
        }
        self.load_fours(&fours)
    }

    #[inline(always)]
    fn load_fours(self, from: &[[f32; 4]]) -> [SimdFloat32<S>; 4] {
        let numbers = from[..Self::LANES].as_flattened();
        let part =
            |at: usize| S::f32s::from_slice(self.0, &numbers[at * Self::LANES..(at + 1) * Self::LANES]);
        let (even, odd) = part(0).deinterleave(part(1));
        let (evens, odds) = part(2).deinterleave(part(3));
        let (x, z) = even.deinterleave(evens);
        let (y, w) = odd.deinterleave(odds);
        [SimdFloat32(x), SimdFloat32(y), SimdFloat32(z), SimdFloat32(w)]
    }

    #[inline(always)]
    fn store_fours(self, [x, y, z, w]: [SimdFloat32<S>; 4], to: &mut [[f32; 4]]) {
        let (even, evens) = x.0.interleave(z.0);
        let (odd, odds) = y.0.interleave(w.0);
        let (first, second) = even.interleave(odd);
        let (third, fourth) = evens.interleave(odds);
        let numbers = to[..Self::LANES].as_flattened_mut();
        for (part, to) in [first, second, third, fourth].iter().zip(numbers.chunks_exact_mut(Self::LANES)) {
            part.store_slice(to);
        }
    }

    #[inline(always)]
    fn store_threes(self, [x, y, z]: [SimdFloat32<S>; 3], to: &mut [[f32; 3]]) {
        let numbers = to[..Self::LANES].as_flattened_mut();
        for (to, [of_xy, of_all]) in numbers.chunks_exact_mut(Self::LANES).zip(const { &threes(Self::LANES) })
        {
            let bytes = Self::LANES * size_of::<f32>();
            let of_xy = S::u8s::from_slice(self.0, &of_xy[..bytes]);
            let of_all = S::u8s::from_slice(self.0, &of_all[..bytes]);
            x.0.concat_swizzle_dyn(y.0, of_xy).concat_swizzle_dyn(z.0, of_all).store_slice(to);
        }
    }

    #[inline(always)]
    fn eight(self, numbers: &[f32; 8]) -> SimdFloat8<S> {
        SimdFloat8::new(self.0, numbers)
    }

    #[inline(always)]
    fn eight_like(self, value: f32) -> SimdFloat8<S> {
        SimdFloat8::like(self.0, value)
    }

    #[inline(always)]
    fn run<T>(self, act: impl FnOnce() -> T) -> T {
        self.0.run(act)
    }

    #[inline(always)]
    fn run_once<T>(self, act: impl FnOnce() -> T) -> T {
        act()
    }
}

/// Where the bytes of each of three vectors that make threes of x, y and z come from: those of x and y out of these two, one
/// behind the other, and then all of them out of that and z.
const fn threes(lanes: usize) -> [[[u8; 64]; 2]; 3] {
    let mut from = [[[0; 64]; 2]; 3];
    let mut at = 0;
    while at < 3 * lanes {
        let (three, part) = (at / 3, at % 3);
        let (vector, lane) = (at / lanes, at % lanes);
        let of_xy = if part == 1 { lanes + three } else { three };
        let of_all = if part == 2 { lanes + three } else { lane };
        let mut byte = 0;
        while byte < 4 {
            from[vector][0][4 * lane + byte] = (4 * of_xy + byte) as u8;
            from[vector][1][4 * lane + byte] = (4 * of_all + byte) as u8;
            byte += 1;
        }
        at += 1;
    }
    from
}

/// Operators that the library's vectors have too.
macro_rules! operators {
    ($($operator:ident, $method:ident);*) => {$(
        impl<S: Simd> $operator for SimdFloat32<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0))
            }
        }

        impl<S: Simd> $operator<f32> for SimdFloat32<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: f32) -> Self {
                Self(self.0.$method(other))
            }
        }
    )*};
}

operators!(Add, add; Sub, sub; Mul, mul; Div, div);

impl<S: Simd> Neg for SimdFloat32<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<S: Simd> Float for SimdFloat32<S> {
    const LANES: usize = S::f32s::LEN;
    type Mask = SimdMask<S>;

    #[inline(always)]
    fn like(self, value: f32) -> Self {
        Self(S::f32s::splat(self.0.token(), value))
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        Self(self.0.mul_add(factor.0, term.0))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    fn floor(self) -> Self {
        Self(self.0.floor())
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }

    #[inline(always)]
    fn copysign(self, other: Self) -> Self {
        Self(self.0.copysign(other.0))
    }

    #[inline(always)]
    fn lt(self, other: Self) -> SimdMask<S> {
        SimdMask(self.0.simd_lt(other.0))
    }

    #[inline(always)]
    fn le(self, other: Self) -> SimdMask<S> {
        SimdMask(self.0.simd_le(other.0))
    }

    #[inline(always)]
    fn eq(self, other: Self) -> SimdMask<S> {
        SimdMask(self.0.simd_eq(other.0))
    }

    #[inline(always)]
    fn select(mask: SimdMask<S>, yes: Self, no: Self) -> Self {
        Self(mask.0.select(yes.0, no.0))
    }
}

impl<S: Simd> Float32 for SimdFloat32<S> {
    type Word = SimdWord<S>;

    #[inline(always)]
    fn to_word(self) -> SimdWord<S> {
        SimdWord(self.0.bitcast())
    }

    #[inline(always)]
    fn of_word(word: SimdWord<S>) -> Self {
        Self(word.0.bitcast())
    }

    #[inline(always)]
    fn store_some(self, mask: SimdMask<S>, to: &mut [f32]) {
        Self(self.0.compress(mask.0)).store(to);
    }

    #[inline(always)]
    fn least(self) -> f32 {
        self.0.reduce_min()
    }

    #[inline(always)]
    fn greatest(self) -> f32 {
        self.0.reduce_max()
    }

    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        self.0.store_slice(&mut to[..S::f32s::LEN]);
    }
}

impl<S: Simd> Word for SimdWord<S> {
    const LANES: usize = S::u32s::LEN;
    type Mask = SimdMask<S>;

    #[inline(always)]
    fn like(self, value: u32) -> Self {
        Self(S::u32s::splat(self.0.token(), value))
    }

    #[inline(always)]
    fn is(self, value: u32) -> SimdMask<S> {
        SimdMask(self.0.simd_eq(S::u32s::splat(self.0.token(), value)))
    }

    #[inline(always)]
    fn equals(self, other: Self) -> SimdMask<S> {
        SimdMask(self.0.simd_eq(other.0))
    }

    #[inline(always)]
    fn has(self, bits: u32) -> SimdMask<S> {
        SimdMask((self.0 & bits).simd_ne(S::u32s::splat(self.0.token(), 0)))
    }

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }

    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    #[inline(always)]
    fn and(self, bits: u32) -> Self {
        Self(self.0 & bits)
    }

    #[inline(always)]
    fn shifted_right(self, by: u32) -> Self {
        Self(self.0 >> by)
    }

    #[inline(always)]
    fn shifted_left(self, by: u32) -> Self {
        Self(self.0 << by)
    }

    #[inline(always)]
    fn select(mask: SimdMask<S>, yes: Self, no: Self) -> Self {
        Self(mask.0.select(yes.0, no.0))
    }

    #[inline(always)]
    fn store_some(self, mask: SimdMask<S>, to: &mut [u32]) {
        Self(self.0.compress(mask.0)).store(to);
    }

    #[inline(always)]
    fn store(self, to: &mut [u32]) {
        self.0.store_slice(&mut to[..S::u32s::LEN]);
    }
}

impl<S: Simd> BitAnd for SimdMask<S> {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl<S: Simd> BitOr for SimdMask<S> {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl<S: Simd> Not for SimdMask<S> {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0)
    }
}

impl<S: Simd> Mask for SimdMask<S> {
    const LANES: usize = S::f32s::LEN;

    #[inline(always)]
    fn any(self) -> bool {
        self.0.any_true()
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        self.0.to_bitmask() as u32
    }
}
