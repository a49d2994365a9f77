//! What depths and bodies squares of pixels have: what lets a march pass over many pixels at once.

use rayon::prelude::*;

use crate::geometry::ray::NO_BODY;
use crate::raster::gbuffer::GBufferTexel;
use crate::raster::sample_sums::FrameSize;

/// The depths and bodies of squares of pixels, of each with the pixels next to it, in a pyramid of several sizes.
///
/// What is interpolated between a pixel and its neighbors lies between the least and the largest of their depths. So a
/// mark of a ray before the least has met nothing, whatever its pixel shows; nor has one behind the largest by more than
/// the thickness of surfaces, nor one where all show the ray's own body. Nothing changes by looking here first.
#[derive(Clone, Debug)]
pub(crate) struct DepthPyramid {
    frame: FrameSize,
    levels: [PyramidLevel; DepthPyramid::LEVELS],
    squares: Vec<DepthSquare>,
}

/// Squares of one size.
#[derive(Clone, Copy, Debug)]
struct PyramidLevel {
    /// Where they begin in the list of all.
    first: usize,
    across: usize,
    down: usize,
}

/// A square of pixels with the pixels around it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DepthSquare {
    /// The least depth; infinite if nothing is there.
    pub(crate) nearest: f32,
    /// The largest depth of what is there, -∞ if there is nothing.
    pub(crate) farthest: f32,
    /// The least number of a body, and the largest: of nothing [`NO_BODY`] and 0.
    bodies: [u32; 2],
}

impl DepthSquare {
    const EMPTY: Self = Self { nearest: f32::INFINITY, farthest: f32::NEG_INFINITY, bodies: [NO_BODY, 0] };

    /// Of which nothing is known.
    const UNKNOWN: Self = Self { nearest: f32::NEG_INFINITY, farthest: f32::INFINITY, bodies: [0, NO_BODY] };

    fn of(texel: &GBufferTexel) -> Self {
        if texel.is_empty() {
            Self::EMPTY
        } else {
            Self { nearest: texel.depth, farthest: texel.depth, bodies: [texel.start.body; 2] }
        }
    }

    fn with(self, other: Self) -> Self {
        Self {
            nearest: self.nearest.min(other.nearest),
            farthest: self.farthest.max(other.farthest),
            bodies: [self.bodies[0].min(other.bodies[0]), self.bodies[1].max(other.bodies[1])],
        }
    }

    /// Whether it shows this body and no other.
    #[inline(always)]
    pub(crate) fn shows_only(&self, body: u32) -> bool {
        self.bodies == [body; 2]
    }
}

impl DepthPyramid {
    /// How many sizes of squares there are.
    pub(crate) const LEVELS: usize = 4;
    /// The edge of the smallest squares is 2 to this power, pixels.
    const SMALLEST: usize = 2;
    /// The edges of squares of the next level are 2 to this power times as long.
    const GROWTH: usize = 2;

    pub(crate) fn new(frame: FrameSize) -> Self {
        let mut count = 0;
        let levels = std::array::from_fn(|level| {
            let edge = 1 << Self::power(level);
            let (across, down) = (frame.width.div_ceil(edge), frame.height.div_ceil(edge));
            let first = count;
            count += across * down;
            PyramidLevel { first, across, down }
        });
        Self { frame, levels, squares: vec![DepthSquare::EMPTY; count] }
    }

    /// Of which nothing is known: every mark is looked at.
    #[cfg(test)]
    pub(crate) fn unknown(frame: FrameSize) -> Self {
        let mut all = Self::new(frame);
        all.squares.fill(DepthSquare::UNKNOWN);
        all
    }

    /// The edge of the squares of a level is 2 to this power, pixels.
    #[inline(always)]
    pub(crate) const fn power(level: usize) -> usize {
        Self::SMALLEST + Self::GROWTH * level
    }

    /// Looks at the depths of a sample.
    pub(crate) fn find(&mut self, texels: &[GBufferTexel]) {
        let FrameSize { width, height } = self.frame;
        let [smallest, larger @ ..] = self.levels;
        let (edge, ends) = (1 << Self::SMALLEST, smallest.across * smallest.down);
        let (mut finer, mut rest) = self.squares.split_at_mut(ends);
        finer.par_chunks_mut(smallest.across).enumerate().for_each_init(
            Vec::new,
            |columns, (row, squares)| {
                let rows = (row * edge).saturating_sub(1)..((row + 1) * edge + 1).min(height);
                columns.clear();
                columns.resize(width, DepthSquare::EMPTY);
                for row in texels.chunks(width).take(rows.end).skip(rows.start) {
                    for (column, texel) in columns.iter_mut().zip(row) {
                        *column = column.with(DepthSquare::of(texel));
                    }
                }
                for (number, square) in squares.iter_mut().enumerate() {
                    let within = (number * edge).saturating_sub(1)..((number + 1) * edge + 1).min(width);
                    let columns = columns.get(within).unwrap_or_default();
                    *square = columns.iter().fold(DepthSquare::EMPTY, |all, column| all.with(*column));
                }
            },
        );
        let mut below = smallest;
        for level in larger {
            let (squares, next) = rest.split_at_mut(level.across * level.down);
            squares.fill(DepthSquare::EMPTY);
            for (row, from) in finer.chunks(below.across).enumerate() {
                let squares = squares.iter_mut().skip((row >> Self::GROWTH) * level.across);
                for (square, parts) in squares.zip(from.chunks(1 << Self::GROWTH)) {
                    *square = parts.iter().fold(*square, |all, part| all.with(*part));
                }
            }
            (finer, rest, below) = (squares, next, level);
        }
    }

    /// The square of a level at this place among those of its level.
    #[inline(always)]
    pub(crate) fn square(&self, level: usize, column: usize, row: usize) -> DepthSquare {
        let PyramidLevel { first, across, .. } = self.levels[level % Self::LEVELS];
        self.squares.get(first + row * across + column).copied().unwrap_or(DepthSquare::UNKNOWN)
    }
}
