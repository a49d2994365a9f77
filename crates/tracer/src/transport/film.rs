//! A picture that is refined sample by sample.

use std::sync::atomic::{AtomicBool, Ordering};

use catoptric_picture::{Picture, SizeError};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::transport::camera::RenderCamera;
use crate::transport::control::RenderControl;
use crate::transport::counts::RayCounts;
use crate::transport::render::{RenderError, mean_of};
use crate::transport::scene::RenderScene;
use crate::transport::tile::{TileRenderer, edge_for};
use crate::transport::tile_rect::{TILE, TileRect};

/// The light gathered so far in every pixel of a picture.
///
/// After n samples [`Self::picture`] equals [`render`](crate::render()) with n samples bit by bit: sums are kept in double
/// precision and grow in the order of the samples.
///
/// A tile takes a sample as a whole or not at all, and remembers how many it has. So a cancelled pass spoils nothing:
/// the picture stays valid, some tiles being a sample ahead, and the next pass does what is missing. So does a pass that
/// [pauses](RenderControl::pausing_when): a film can be traced in slices of a few milliseconds.
#[derive(Clone, Debug)]
pub struct Film {
    width: u32,
    height: u32,
    /// Edge of the tiles, pixels.
    edge: usize,
    tiles: Vec<FilmTile>,
    samples: u32,
    /// The rays of the tiles that are a sample ahead.
    ahead: RayCounts,
}

#[derive(Clone, Debug)]
struct FilmTile {
    place: TileRect,
    /// The sums of the pixels, row by row; without samples none yet, or those of another picture.
    sums: Vec<DVec3>,
    samples: u32,
}

impl Film {
    /// A film without light. Its memory is reserved; those who write into it first get it.
    ///
    /// # Errors
    /// When the size is 0 or too large, or there is too little memory.
    pub fn new(width: u32, height: u32) -> Result<Self, SizeError> {
        Picture::check_size(width, height)?;
        let mut film =
            Self { width, height, edge: 0, tiles: Vec::new(), samples: 0, ahead: RayCounts::default() };
        film.divide(TILE)?;
        Ok(film)
    }

    /// Divides it into tiles without light, as threads take them.
    fn divide(&mut self, edge: usize) -> Result<(), SizeError> {
        let Self { width, height, .. } = *self;
        let places = TileRect::all(width as usize, height as usize, edge);
        let tile = |place: TileRect| {
            let mut sums = Vec::new();
            sums.try_reserve_exact(place.pixels()).ok()?;
            Some(FilmTile { place, sums, samples: 0 })
        };
        let bytes = u64::from(width) * u64::from(height) * size_of::<DVec3>() as u64;
        self.tiles =
            places.map(tile).collect::<Option<_>>().ok_or(SizeError::Memory { width, height, bytes })?;
        self.edge = edge;
        Ok(())
    }

    /// Pixels across.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Pixels down.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Samples that every pixel has.
    pub fn samples(&self) -> u32 {
        self.samples
    }

    /// Forgets all light; the memory is kept for the next picture of this size.
    pub fn clear(&mut self) {
        (self.samples, self.ahead) = (0, RayCounts::default());
        self.tiles.iter_mut().for_each(|tile| tile.samples = 0);
    }

    /// Adds the next sample of every pixel, on the threads of the current rayon pool, and returns the rays it took, those
    /// of earlier passes that did not finish it among them.
    /// Scene and camera must be those of the earlier samples.
    ///
    /// # Errors
    /// When `control` is cancelled or pauses; see above for what becomes of the film. Before the first sample, when there is too
    /// little memory.
    pub fn add_sample(
        &mut self,
        scene: &RenderScene,
        camera: &RenderCamera,
        control: &RenderControl,
    ) -> Result<RayCounts, RenderError> {
        let edge = edge_for(scene, self.width as usize, self.height as usize);
        if edge != self.edge {
            self.divide(edge)?;
        }
        let size = DVec2::new(f64::from(self.width), f64::from(self.height));
        let sample = self.samples;
        let is_begun = AtomicBool::new(false);
        let counts = self
            .tiles
            .iter_mut()
            .filter(|tile| tile.samples == sample)
            .par_bridge()
            .map_init(
                || None,
                |tracer, tile| {
                    // One tile at least is traced in each pass.
                    if is_begun.swap(true, Ordering::Relaxed) && control.should_pause() {
                        return RayCounts::default();
                    }
                    let tracer = tracer.get_or_insert_with(|| TileRenderer::new(scene, camera, control));
                    tile.add_sample(tracer, size, control)
                },
            )
            .reduce(RayCounts::default, std::ops::Add::add);
        self.ahead += counts;
        if self.tiles.iter().any(|tile| tile.samples == sample) {
            return Err(RenderError::Cancelled);
        }
        self.samples = sample + 1;
        Ok(std::mem::take(&mut self.ahead))
    }

    /// The mean of the samples so far; black before the first.
    ///
    /// # Errors
    /// When there is too little memory.
    pub fn picture(&self) -> Result<Picture, SizeError> {
        let mut picture = Picture::new(self.width, self.height)?;
        self.each_row(picture.pixels_mut(), |light, pixels| pixels.copy_from_slice(light));
        Ok(picture)
    }

    /// Shows `take` each row of what [`Self::picture`] would be, with its part of `to`, which has a place for each pixel;
    /// on the threads of the current rayon pool. No picture is made.
    pub fn each_row<T: Send>(&self, to: &mut [T], take: impl Fn(&[[f32; 3]], &mut [T]) + Sync) {
        let width = self.width as usize;
        let bands =
            self.tiles.par_chunks(width.div_ceil(self.edge)).zip(to.par_chunks_mut(width * self.edge));
        bands.for_each_init(
            || vec![[0.0; 3]; width],
            |row, (tiles, rows)| {
                for (y, to) in rows.chunks_mut(width).enumerate() {
                    tiles.iter().for_each(|tile| tile.write(y, row));
                    take(row, to);
                }
            },
        );
    }
}

impl FilmTile {
    fn add_sample(
        &mut self,
        tracer: &mut TileRenderer<'_>,
        size: DVec2,
        control: &RenderControl,
    ) -> RayCounts {
        let before = tracer.counts();
        let Some(light) = tracer.trace(self.place, size, self.samples) else {
            return RayCounts::default();
        };
        self.sums.resize(self.place.pixels(), DVec3::ZERO);
        light.sum_into(&mut self.sums, self.place.width, self.samples == 0);
        self.samples += 1;
        control.add_pixels(self.place.pixels() as u64);
        tracer.counts() - before
    }

    /// Writes the means of its row `y` into a row of the picture.
    fn write(&self, y: usize, row: &mut [[f32; 3]]) {
        let TileRect { x, width, .. } = self.place;
        let row = row.iter_mut().skip(x).take(width);
        if self.samples == 0 {
            row.for_each(|pixel| *pixel = [0.0; 3]);
        } else {
            let sums = self.sums.iter().skip(y * width);
            row.zip(sums).for_each(|(pixel, sum)| *pixel = mean_of(*sum, self.samples));
        }
    }
}
