//! What depths and bodies squares of pixels have: what lets a march pass over many pixels at once (Uludag 2014, Hi-Z
//! Screen-Space Cone-Traced Reflections, GPU Pro 5).

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use rayon::prelude::*;

use crate::geometry::ray::{INWARDS, NO_BODY};
use crate::raster::sample_sums::FrameSize;
use crate::simd::wide::SimdLevel;
use crate::simd::{SimdKernel, Width};
use crate::transport::tile::hits::SurfaceTexel;

/// The depths and bodies of squares of pixels, of each with the pixels next to it, in a pyramid of several sizes.
///
/// What is interpolated between a pixel and its neighbors lies between the least and the largest of their depths. So a
/// mark of a ray before the least has met nothing, whatever its pixel shows; nor has one behind the largest by more than
/// the thickness of surfaces, nor one where all show the ray's own body. Nothing changes by looking here first.
#[derive(Clone, Debug)]
pub(crate) struct DepthPyramid {
    frame: FrameSize,
    /// Squares from one row to the next, in all levels.
    pub(crate) stride: usize,
    /// Rows of all levels together, one below the other.
    pub(crate) rows: usize,
    squares: Vec<DepthSquare>,
}

/// A square of pixels with the pixels around it.
///
/// A ray never meets the body that it leaves. So the depths are known without those of the body with the lowest number and
/// of the one with the highest, too: where two bodies are seen, either ray has those of the other.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct DepthSquare {
    all: DepthRange,
    /// The least number of a body, and the largest: of nothing [`NO_BODY`] and 0.
    bodies: [u32; 2],
    /// Without the depths of the first of these, and of the second.
    others: [DepthRange; 2],
}

/// Numbers of [`ScreenDepth`](crate::transport::camera::ScreenDepth).
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
struct DepthRange {
    /// The least; infinite if nothing is there.
    nearest: f32,
    /// The largest of what is there, -∞ if there is nothing.
    farthest: f32,
}

impl DepthRange {
    const EMPTY: Self = Self { nearest: f32::INFINITY, farthest: f32::NEG_INFINITY };
    /// Nothing is before it, and nothing behind: whatever the projection, a difference from no number is not more than
    /// anything.
    const UNKNOWN: Self = Self { nearest: f32::NEG_INFINITY, farthest: f32::NAN };

    #[inline(always)]
    fn with(self, other: Self) -> Self {
        Self {
            nearest: lesser(self.nearest, other.nearest),
            farthest: greater(self.farthest, other.farthest),
        }
    }
}

impl DepthSquare {
    const EMPTY: Self = Self { all: DepthRange::EMPTY, bodies: [NO_BODY, 0], others: [DepthRange::EMPTY; 2] };

    /// A square of which nothing is known.
    pub(crate) const UNKNOWN: Self =
        Self { all: DepthRange::UNKNOWN, bodies: [0, NO_BODY], others: [DepthRange::UNKNOWN; 2] };

    #[inline(always)]
    fn of(texel: SurfaceTexel) -> Self {
        if texel.is_empty() {
            return Self::EMPTY;
        }
        let all = DepthRange { nearest: texel.depth, farthest: texel.depth };
        Self { all, bodies: [texel.start & !INWARDS; 2], others: [DepthRange::EMPTY; 2] }
    }

    #[inline(always)]
    fn with(self, other: Self) -> Self {
        let bodies = [lesser(self.bodies[0], other.bodies[0]), greater(self.bodies[1], other.bodies[1])];
        let without = |which: usize| {
            let of = |square: Self| {
                if square.bodies[which] == bodies[which] { square.others[which] } else { square.all }
            };
            of(self).with(of(other))
        };
        Self { all: self.all.with(other.all), bodies, others: [without(0), without(1)] }
    }
}

/// The lesser one, in one instruction: none is no number.
#[inline(always)]
fn lesser<T: PartialOrd>(a: T, b: T) -> T {
    if a < b { a } else { b }
}

#[inline(always)]
fn greater<T: PartialOrd>(a: T, b: T) -> T {
    if a > b { a } else { b }
}

impl DepthPyramid {
    /// The edges of the smallest and of the largest squares, pixels: each level's are [`Self::GROWTH`] times as long as
    /// those of the one before.
    pub(crate) const SMALLEST: usize = 4;
    pub(crate) const LARGEST: usize = 256;
    pub(crate) const GROWTH: usize = 4;

    pub(crate) fn new(frame: FrameSize) -> Self {
        let [stride, down] = [frame.width, frame.height].map(|side| side.div_ceil(Self::SMALLEST));
        // Levels of edge e begin at row `rows` · (1 - 4/e). The first one has room there for `down` rows, others for a
        // quarter of the room before; and e divides 4 · `rows`.
        let rows = (4 * down).div_ceil(3).next_multiple_of(Self::LARGEST / 4) + Self::LARGEST / 4;
        Self { frame, stride, rows, squares: vec![DepthSquare::EMPTY; stride * rows] }
    }

    /// Of which nothing is known: every mark is looked at.
    #[cfg(test)]
    pub(crate) fn unknown(frame: FrameSize) -> Self {
        let mut all = Self::new(frame);
        all.squares.fill(DepthSquare::UNKNOWN);
        all
    }

    /// The row of the list of all squares in which those of this edge begin.
    fn first_row(&self, edge: usize) -> usize {
        self.rows - Self::SMALLEST * self.rows / edge
    }

    /// Looks at the depths of a sample.
    pub(crate) fn find(&mut self, lanes: SimdLevel, texels: &[SurfaceTexel]) {
        let FrameSize { width, height } = self.frame;
        let across = self.stride;
        let smallest = height.div_ceil(Self::SMALLEST);
        let squares = self.squares.par_chunks_mut(across).take(smallest).enumerate();
        squares.for_each_init(PixelColumns::default, |columns, (row, squares)| {
            let edge = Self::SMALLEST;
            let rows = (row * edge).saturating_sub(1)..((row + 1) * edge + 1).min(height);
            let texels = &texels[rows.start * width..rows.end * width];
            lanes.run_in_few(SquareKernel { columns, texels, width, squares });
        });
        let mut edge = Self::SMALLEST;
        while edge < Self::LARGEST {
            let (finer, coarser) = (self.first_row(edge), self.first_row(Self::GROWTH * edge));
            let rows = height.div_ceil(edge);
            edge *= Self::GROWTH;
            let (finer, coarser) = (finer * across, coarser * across);
            self.squares[coarser..coarser + height.div_ceil(edge) * across].fill(DepthSquare::EMPTY);
            let (from, to) = self.squares.split_at_mut(coarser);
            let rows = from[finer..finer + rows * across].chunks(across).enumerate();
            for (row, from) in rows {
                let to = to.iter_mut().skip(row / Self::GROWTH * across);
                for (square, parts) in to.zip(from.chunks(Self::GROWTH)) {
                    *square = parts.iter().fold(*square, |all, part| all.with(*part));
                }
            }
        }
    }

    /// The square in this row and column of the list of all.
    #[inline(always)]
    pub(crate) fn square(&self, row: usize, column: usize) -> &[[f32; 4]; 2] {
        let square = self.squares.get(row * self.stride + column).unwrap_or(&DepthSquare::UNKNOWN);
        bytemuck::cast_ref(square)
    }
}

/// What the columns of some rows of pixels have: the fields of a [`DepthSquare`], each in a row of its own.
#[derive(Default)]
struct PixelColumns {
    nearest: Vec<f32>,
    farthest: Vec<f32>,
    lowest: Vec<u32>,
    highest: Vec<u32>,
}

/// Looks at a row of the smallest squares.
struct SquareKernel<'k> {
    columns: &'k mut PixelColumns,
    /// The rows of pixels that belong to them, those above and below among them.
    texels: &'k [SurfaceTexel],
    width: usize,
    squares: &'k mut [DepthSquare],
}

impl SimdKernel for SquareKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Width>(self, _: W) {
        let Self { columns, texels, width, squares } = self;
        columns.begin(width);
        for row in texels.chunks_exact(width) {
            columns.add(row);
        }
        for (number, square) in squares.iter_mut().enumerate() {
            let edge = DepthPyramid::SMALLEST;
            let within = (number * edge).saturating_sub(1)..((number + 1) * edge + 1).min(width);
            *square = columns.square(within.clone());
            if square.bodies[0] < square.bodies[1] {
                let rows = texels.chunks_exact(width).map(|row| &row[within.clone()]);
                *square =
                    rows.flatten().fold(DepthSquare::EMPTY, |all, &texel| all.with(DepthSquare::of(texel)));
            }
        }
    }
}

impl PixelColumns {
    #[inline(always)]
    fn begin(&mut self, width: usize) {
        let DepthSquare { all, bodies: [lowest, highest], .. } = DepthSquare::EMPTY;
        for (row, value) in [(&mut self.nearest, all.nearest), (&mut self.farthest, all.farthest)] {
            row.clear();
            row.resize(width, value);
        }
        for (row, value) in [(&mut self.lowest, lowest), (&mut self.highest, highest)] {
            row.clear();
            row.resize(width, value);
        }
    }

    #[inline(always)]
    fn add(&mut self, row: &[SurfaceTexel]) {
        let DepthSquare { all, bodies: [no_lowest, no_highest], .. } = DepthSquare::EMPTY;
        let depths = self.nearest.iter_mut().zip(&mut self.farthest);
        let bodies = self.lowest.iter_mut().zip(&mut self.highest);
        for ((texel, (nearest, farthest)), (lowest, highest)) in row.iter().zip(depths).zip(bodies) {
            let (is_empty, body) = (texel.is_empty(), texel.start & !INWARDS);
            *nearest = lesser(texel.depth, *nearest);
            *farthest = greater(if is_empty { all.farthest } else { texel.depth }, *farthest);
            *lowest = lesser(if is_empty { no_lowest } else { body }, *lowest);
            *highest = greater(if is_empty { no_highest } else { body }, *highest);
        }
    }

    /// Some columns together, as if they had one body.
    #[inline(always)]
    fn square(&self, within: Range<usize>) -> DepthSquare {
        let mut square = DepthSquare::EMPTY;
        for column in within {
            let (nearest, farthest) = (self.nearest[column], self.farthest[column]);
            square.all = square.all.with(DepthRange { nearest, farthest });
            let [lowest, highest] = square.bodies;
            square.bodies = [lesser(lowest, self.lowest[column]), greater(highest, self.highest[column])];
        }
        square
    }
}
