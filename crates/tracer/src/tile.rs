//! The squares that a picture is traced in.

use std::ops::Range;

use glam::{DVec2, DVec3};

use crate::render::Control;
use crate::sampling::sample_offset;
use crate::whitted::Whitted;

/// Edge of a tile, pixels: small enough to balance, large enough that rays of a tile meet the same bodies.
pub(crate) const TILE: usize = 16;

/// Where a tile lies: its upper left pixel and its size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Place {
    pub(crate) x: usize,
    pub(crate) y: usize,
    pub(crate) width: usize,
    pub(crate) height: usize,
}

impl Place {
    /// The tiles of a picture, row by row.
    pub(crate) fn all(width: usize, height: usize) -> impl Iterator<Item = Self> {
        (0..height).step_by(TILE).flat_map(move |y| {
            (0..width).step_by(TILE).map(move |x| Self {
                x,
                y,
                width: TILE.min(width - x),
                height: TILE.min(height - y),
            })
        })
    }

    /// How many pixels it has.
    pub(crate) fn pixels(self) -> usize {
        self.width * self.height
    }

    /// Traces these samples of each pixel and hands over their sums, row by row. False if it was cancelled midway.
    pub(crate) fn trace(
        self,
        tracer: &mut Whitted<'_>,
        size: DVec2,
        samples: Range<u32>,
        control: &Control,
        mut light: impl FnMut(DVec3),
    ) -> bool {
        for y in self.y..self.y + self.height {
            for x in self.x..self.x + self.width {
                if control.is_cancelled() {
                    return false;
                }
                let corner = DVec2::new(x as f64, y as f64);
                // In double precision: thousands of equal samples, added in single, would drift from their mean.
                let sample = |sample| tracer.trace(corner + sample_offset(sample), size).as_dvec3();
                light(samples.clone().map(sample).sum());
            }
        }
        // The last pixel may be unfinished too.
        !control.is_cancelled()
    }
}
