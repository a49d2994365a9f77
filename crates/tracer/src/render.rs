//! The CPU driver: tiles over all threads, progress, cancellation.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use catoptric_picture::{Picture, SizeError};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::counts::RayCounts;
use crate::sampling::sample_offset;
use crate::stage::Stage;
use crate::whitted::Whitted;

/// Edge of a tile, pixels: small enough to balance, large enough that rays of a tile meet the same bodies.
const TILE: usize = 16;

/// What to render.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RenderSettings {
    /// Width of the picture, pixels.
    pub width: u32,
    /// Height of the picture, pixels.
    pub height: u32,
    /// Samples per pixel, at least 1; one goes through the pixel's center.
    pub samples: u32,
}

/// How a running render is watched and stopped, from any thread.
#[derive(Debug, Default)]
pub struct Control {
    cancel: AtomicBool,
    pixels_done: AtomicU64,
}

impl Control {
    /// Asks the render to stop; it does so within a tile.
    pub fn cancel(&self) {
        self.cancel.store(true, Ordering::Relaxed);
    }

    /// Whether [`Self::cancel`] was called.
    pub fn is_cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// Pixels finished so far.
    pub fn pixels_done(&self) -> u64 {
        self.pixels_done.load(Ordering::Relaxed)
    }
}

/// A finished render.
#[derive(Clone, Debug)]
pub struct Rendering {
    /// Linear light.
    pub picture: Picture,
    /// Rays traced.
    pub counts: RayCounts,
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The size cannot be.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// [`Control::cancel`] was called.
    #[error("the render was cancelled")]
    Cancelled,
}

/// Traces `stage` into a picture on the threads of the current rayon pool.
///
/// The picture does not depend on the number of threads: each pixel is computed by one thread from the stage alone.
///
/// # Errors
/// When the size is 0 or too large, or the render is cancelled.
pub fn render(stage: &Stage, settings: RenderSettings, control: &Control) -> Result<Rendering, RenderError> {
    let mut picture = Picture::new(settings.width, settings.height)?;
    let mut tiles = tiles(&mut picture);
    let counts = tiles
        .par_iter_mut()
        .map_init(
            || Whitted::new(stage, &control.cancel),
            |tracer, tile| {
                let before = tracer.counts();
                fill(tile, tracer, settings, control);
                tracer.counts() - before
            },
        )
        .reduce(RayCounts::default, std::ops::Add::add);
    drop(tiles);
    if control.is_cancelled() {
        return Err(RenderError::Cancelled);
    }
    Ok(Rendering { picture, counts })
}

/// A square of the picture: its upper left pixel and its rows.
struct Tile<'a> {
    x: usize,
    y: usize,
    rows: Vec<&'a mut [[f32; 3]]>,
}

fn tiles(picture: &mut Picture) -> Vec<Tile<'_>> {
    let width = picture.width() as usize;
    let across = width.div_ceil(TILE);
    let mut tiles: Vec<Tile<'_>> = Vec::new();
    for (band, rows) in picture.pixels_mut().chunks_mut(width * TILE).enumerate() {
        let first = tiles.len();
        tiles.extend((0..across).map(|column| Tile { x: column * TILE, y: band * TILE, rows: Vec::new() }));
        for row in rows.chunks_mut(width) {
            for (tile, part) in tiles[first..].iter_mut().zip(row.chunks_mut(TILE)) {
                tile.rows.push(part);
            }
        }
    }
    tiles
}

fn fill(tile: &mut Tile<'_>, tracer: &mut Whitted<'_>, settings: RenderSettings, control: &Control) {
    let size = DVec2::new(f64::from(settings.width), f64::from(settings.height));
    let samples = settings.samples.max(1);
    for (row, y) in tile.rows.iter_mut().zip(tile.y..) {
        for (pixel, x) in row.iter_mut().zip(tile.x..) {
            if control.is_cancelled() {
                return;
            }
            let corner = DVec2::new(x as f64, y as f64);
            // In double precision: thousands of equal samples, added in single, would drift from their mean.
            let light: DVec3 = (0..samples)
                .map(|sample| tracer.trace(corner + sample_offset(sample), size).as_dvec3())
                .sum();
            *pixel = (light / f64::from(samples)).as_vec3().to_array();
        }
        control.pixels_done.fetch_add(row.len() as u64, Ordering::Relaxed);
    }
}
