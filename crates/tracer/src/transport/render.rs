//! The CPU driver: tiles over all threads, progress, cancellation.

use catoptric_picture::{Picture, SizeError};
use glam::{DVec2, DVec3, UVec2};
use rayon::prelude::*;

use crate::transport::camera::RenderCamera;
pub(crate) use crate::transport::control::RenderControl;
use crate::transport::counts::RayCounts;
use crate::transport::scene::RenderScene;
use crate::transport::tile::hits::{FirstHitRows, SurfaceTexel};
use crate::transport::tile::{TileRenderer, TileRows, edge_for};
use crate::transport::tile_rect::{TILE, TileRect};

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

impl RenderSettings {
    /// The most samples per pixel that are offered.
    pub const MAX_SAMPLES: u32 = 65536;
}

/// A finished render.
#[derive(Clone, Debug)]
pub struct RenderOutput {
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
    /// [`RenderControl::cancel`] was called.
    #[error("the render was cancelled")]
    Cancelled,
}

/// Traces `scene` into a picture on the threads of the current rayon pool.
///
/// The picture does not depend on the number of threads: each pixel is computed by one thread from the scene alone.
///
/// # Errors
/// When the size is 0 or too large, or the render is cancelled.
pub fn render(
    scene: &RenderScene,
    settings: RenderSettings,
    control: &RenderControl,
) -> Result<RenderOutput, RenderError> {
    render_through(scene, scene.camera(), settings, control)
}

/// Renders a scene through a camera of [`RenderScene::camera_for`].
///
/// # Errors
/// As for [`render`].
pub fn render_through(
    scene: &RenderScene,
    camera: &RenderCamera,
    settings: RenderSettings,
    control: &RenderControl,
) -> Result<RenderOutput, RenderError> {
    let mut picture = Picture::new(settings.width, settings.height)?;
    let counts = render_into(&mut picture, scene, camera, settings.samples, control)?;
    Ok(RenderOutput { picture, counts })
}

/// Renders a scene through a camera into a picture that shows anything, of the size that is wanted. The rays that were
/// traced.
///
/// # Errors
/// When the render is cancelled; then the picture shows some of both.
pub fn render_into(
    picture: &mut Picture,
    scene: &RenderScene,
    camera: &RenderCamera,
    samples: u32,
    control: &RenderControl,
) -> Result<RayCounts, RenderError> {
    let size = DVec2::new(f64::from(picture.width()), f64::from(picture.height()));
    let samples = samples.max(1);
    // Who is free takes the next tile: of two halves of a picture one may have all that takes long.
    let strips = TileStrips::new(scene, [picture.width(), picture.height()]);
    let counts = in_turns(strips.of(picture.pixels_mut()).collect())
        .par_bridge()
        .map_init(
            || (None, Vec::new()),
            |(tracer, sums), mut tile| {
                // Threads that find no tile left make no tracer.
                let tracer = tracer.get_or_insert_with(|| TileRenderer::new(scene, camera, control));
                let before = tracer.counts();
                if tile.trace(tracer, sums, size, samples) {
                    control.add_pixels(tile.place.pixels() as u64);
                }
                tracer.counts() - before
            },
        )
        .reduce(RayCounts::default, std::ops::Add::add);
    if control.is_cancelled() { Err(RenderError::Cancelled) } else { Ok(counts) }
}

/// The points that the primary rays of a picture's sample meet, row by row from the top.
#[derive(Clone, Debug)]
pub(crate) struct FirstHitBuffers {
    /// Meters, in the space of the rays. Of the background, anything.
    pub(crate) positions: Vec<[f32; 3]>,
    /// Unit normals facing the viewer. Of the background, anything.
    pub(crate) normals: Vec<[f32; 3]>,
    pub(crate) surfaces: Vec<SurfaceTexel>,
}

impl FirstHitBuffers {
    /// Finds the points of a sample through a camera, and writes their local light: what [`render`] has of one generation,
    /// but for what is seen straight through clear bodies.
    ///
    /// # Errors
    /// When the render is cancelled.
    pub(crate) fn find(
        &mut self,
        lit: &mut [[f32; 3]],
        (scene, camera): (&RenderScene, &RenderCamera),
        size: UVec2,
        sample: u32,
        control: &RenderControl,
    ) -> Result<RayCounts, RenderError> {
        let strips = TileStrips::new(scene, size.to_array());
        let of_points = strips.of(&mut self.positions).zip(strips.of(&mut self.normals));
        let all = strips.of(lit).zip(of_points.zip(strips.of(&mut self.surfaces)));
        let strips =
            all.map(|(lit, ((positions, normals), surfaces))| lit.zip(positions.zip(normals).zip(surfaces)));
        let counts = in_turns(strips.collect())
            .par_bridge()
            .map_init(
                || None,
                |tracer, (mut lit, ((positions, normals), surfaces))| {
                    let tracer =
                        tracer.get_or_insert_with(|| TileRenderer::of_first_hits(scene, camera, control));
                    let before = tracer.counts();
                    let (positions, normals, surfaces) = (positions.rows, normals.rows, surfaces.rows);
                    let mut hits = FirstHitRows { positions, normals, surfaces };
                    let rows = TileRows { light: &mut lit.rows, hits: Some(&mut hits) };
                    if tracer.trace_into(lit.place, size.as_dvec2(), sample, rows) {
                        control.add_pixels(lit.place.pixels() as u64);
                    }
                    // None of them is traced that goes straight through.
                    RayCounts { refracted: before.refracted, ..tracer.counts() } - before
                },
            )
            .reduce(RayCounts::default, std::ops::Add::add);
        if control.is_cancelled() { Err(RenderError::Cancelled) } else { Ok(counts) }
    }
}

/// The light of one pixel (column, row) as [`render_through`] has it, bit by bit, at the cost of the tiles around it;
/// `None` if the pixel is not in the picture.
///
/// # Errors
/// As for [`render`].
pub fn render_pixel(
    scene: &RenderScene,
    camera: &RenderCamera,
    settings: RenderSettings,
    pixel: UVec2,
    control: &RenderControl,
) -> Result<Option<[f32; 3]>, RenderError> {
    let RenderSettings { width, height, samples } = settings;
    Picture::check_size(width, height)?;
    let size = UVec2::new(width, height);
    if pixel.x >= width || pixel.y >= height {
        return Ok(None);
    }
    let place = TileRect::around(pixel, size, edge_for(scene, width as usize, height as usize));
    let [x, y] = [pixel.x as usize - place.x, pixel.y as usize - place.y];
    let mut tracer = TileRenderer::new(scene, camera, control);
    let mut row = vec![[0.0; 3]; place.width];
    let mut sum = DVec3::ZERO;
    for sample in 0..samples.max(1) {
        let light = tracer.trace(place, size.as_dvec2(), sample).ok_or(RenderError::Cancelled)?;
        light.each(y, &mut row, |pixel, light| *pixel = light);
        sum += row.get(x).map_or(DVec3::ZERO, |light| DVec3::from(light.map(f64::from)));
    }
    Ok(Some(mean_of(sum, samples.max(1))))
}

/// The mean of the samples of a pixel.
pub(crate) fn mean_of(sum: DVec3, samples: u32) -> [f32; 3] {
    (sum / f64::from(samples)).as_vec3().to_array()
}

/// A tile or a group of tiles and its part of each of the rows of a picture or a buffer.
struct TileTarget<'a, T> {
    place: TileRect,
    rows: Vec<&'a mut [T]>,
}

impl TileTarget<'_, [f32; 3]> {
    /// Traces all samples. False if it was cancelled midway.
    fn trace(
        &mut self,
        tracer: &mut TileRenderer<'_>,
        sums: &mut Vec<DVec3>,
        size: DVec2,
        samples: u32,
    ) -> bool {
        if samples == 1 {
            let rows = TileRows { light: &mut self.rows, hits: None };
            return tracer.trace_into(self.place, size, 0, rows);
        }
        sums.resize(self.place.pixels(), DVec3::ZERO);
        let width = self.place.width;
        for sample in 0..samples {
            let Some(light) = tracer.trace(self.place, size, sample) else { return false };
            light.sum_into(sums, width, sample == 0);
        }
        for (row, sums) in self.rows.iter_mut().zip(sums.chunks(width)) {
            for (pixel, sum) in row.iter_mut().zip(sums) {
                *pixel = mean_of(*sum, samples);
            }
        }
        true
    }
}

/// How a picture is divided into strips of tiles.
///
/// Every thread has a strip of the picture to begin in, and goes on in those of others when it is through: where two take
/// neighbors at once, the system clears the same fresh page of memory for each of them, and keeps one. Groups of tiles take
/// too long for that to count; they go row by row, since the picture's middle, which mostly takes longest, must not be last.
#[derive(Clone, Copy)]
struct TileStrips {
    width: usize,
    /// Rows of a strip.
    height: usize,
    edge: usize,
}

impl TileStrips {
    fn new(scene: &RenderScene, [width, height]: [u32; 2]) -> Self {
        let (width, height) = (width as usize, height as usize);
        let edge = edge_for(scene, width, height);
        let strips = if edge == TILE { rayon::current_num_threads() } else { 1 };
        Self { width, height: height.div_ceil(edge).div_ceil(strips) * edge, edge }
    }

    /// The strips of the pixels of a picture or a buffer, each with its tiles, made when they are asked for.
    fn of<'p, T: 'p>(
        self,
        pixels: &'p mut [T],
    ) -> impl Iterator<Item = impl Iterator<Item = TileTarget<'p, T>> + use<'p, T>> + use<'p, T> {
        let Self { width, height, edge } = self;
        let parts = pixels.chunks_mut(width * height).zip((0..).step_by(height));
        parts.map(move |(pixels, top)| tiles_of_strip(pixels, top, width, edge))
    }
}

/// What strips have, each thread taking from its own first.
fn in_turns<I: Iterator>(mut strips: Vec<I>) -> impl Iterator<Item = I::Item> {
    std::iter::from_fn(move || {
        let own = rayon::current_thread_index().unwrap_or_default() % strips.len().max(1);
        let (before, from_own_on) = strips.split_at_mut(own);
        from_own_on.iter_mut().chain(before).find_map(Iterator::next)
    })
}

/// The tiles of some rows of a picture that begin at `top`, row by row.
fn tiles_of_strip<'p, T>(
    pixels: &'p mut [T],
    top: usize,
    width: usize,
    edge: usize,
) -> impl Iterator<Item = TileTarget<'p, T>> + use<'p, T> {
    let strip = TileRect { x: 0, y: top, width, height: pixels.len() / width };
    let mut bands = pixels.chunks_mut(width * edge);
    let mut band = Vec::new();
    strip.squares(edge).map(move |place| {
        if place.x == 0 {
            let rows = bands.next().unwrap_or_default().chunks_mut(width);
            band.clear();
            band.extend(rows.map(|row| row.chunks_mut(edge)));
        }
        let mut rows = Vec::with_capacity(place.height);
        rows.extend(band.iter_mut().filter_map(Iterator::next));
        TileTarget { place, rows }
    })
}
