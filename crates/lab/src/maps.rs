//! Maps: a number for each pixel of a picture, with a scale, instead of its light.

mod legend;

use catoptric_picture::{Picture, SizeError, scale_color};
use catoptric_tracer::{
    PixelStatistics, RenderCamera, RenderControl, RenderError, RenderScene, RenderSettings,
    WhittedIntegrator, render_through,
};
use glam::{DVec3, UVec2};
use rayon::prelude::*;

/// The quantity of a map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MapKind {
    /// The last generation that any ray of the pixel has.
    #[default]
    Generations,
    /// All rays of the pixel, shadow rays included; the mean of its samples.
    Rays,
    /// The share of the pixel's light that the limit of generations leaves out, against [`DEEPEST`] generations. Rays of a
    /// weight below the scene's threshold are left out of both, at least those below [`LIGHTEST`].
    LimitLoss,
    /// The share of the pixel's light that the threshold leaves out, against one of [`LIGHTEST`] of it, at most
    /// [`LIGHTEST`].
    ThresholdLoss,
    /// The share of the pixel's light that lies beyond the display's white.
    Clipped,
}

/// How many generations the reference has.
pub const DEEPEST: u32 = catoptric_scene::Tracing::MAX_GENERATIONS;
/// The least weight of rays in a reference, 2⁻¹².
pub const LIGHTEST: f32 = 1.0 / 4096.0;
/// The most rays of a pixel's sample that are followed; pixels with more are [incomplete](Map::incomplete).
pub const MOST_RAYS: usize = 1 << 16;

impl MapKind {
    /// All kinds, in the order in which to offer them.
    pub const ALL: [Self; 5] =
        [Self::Generations, Self::Rays, Self::LimitLoss, Self::ThresholdLoss, Self::Clipped];

    /// The kind's name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Generations => "generations",
            Self::Rays => "rays",
            Self::LimitLoss => "limit-loss",
            Self::ThresholdLoss => "threshold-loss",
            Self::Clipped => "clipped",
        }
    }

    /// What its legend says.
    const fn title(self) -> &'static str {
        match self {
            Self::Generations => "GENERATIONS REACHED",
            Self::Rays => "RAYS PER PIXEL",
            Self::LimitLoss => "LIGHT LOST BY THE LIMIT OF GENERATIONS",
            Self::ThresholdLoss => "LIGHT LOST BY THE THRESHOLD",
            Self::Clipped => "LIGHT BEYOND WHITE",
        }
    }

    /// Whether its numbers are parts of the whole, 0 to 1.
    pub const fn is_share(self) -> bool {
        matches!(self, Self::LimitLoss | Self::ThresholdLoss | Self::Clipped)
    }
}

/// The settings of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapSettings {
    /// The number for each pixel.
    pub kind: MapKind,
    /// The picture's size and samples.
    pub picture: RenderSettings,
    /// The exposure that decides what is beyond white, in stops. Default 0.
    pub exposure_stops: f64,
}

/// The reason why there is no map.
pub type MapError = RenderError;

/// A number for each pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// What it shows.
    pub kind: MapKind,
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// The numbers, row by row from the top.
    pub values: Vec<f32>,
    /// How many pixels have more rays than were followed, so that their number may be too small.
    pub incomplete: usize,
}

/// Makes a map of the picture of `render_scene` through `camera`, on the threads of the current rayon pool. `control` counts
/// each pixel once.
///
/// # Errors
/// When the size cannot be, or `control` is cancelled.
pub fn map(
    render_scene: &RenderScene,
    camera: &RenderCamera,
    settings: &MapSettings,
    control: &RenderControl,
) -> Result<Map, MapError> {
    let MapSettings { kind, picture, exposure_stops } = *settings;
    let RenderSettings { width, height, samples } = picture;
    Picture::check_size(width, height)?;
    if kind == MapKind::Clipped {
        let rendering = render_through(render_scene, camera, picture, control)?;
        let exposure = exposure_stops.exp2();
        let values = rendering.picture.pixels().iter().map(|light| clipped(*light, exposure)).collect();
        return Ok(Map { kind, width, height, values, incomplete: 0 });
    }
    let (limit, threshold) = (render_scene.generations(), render_scene.threshold());
    let reference = match kind {
        MapKind::LimitLoss => Some((DEEPEST, threshold.max(LIGHTEST))),
        MapKind::ThresholdLoss => Some((limit, (threshold * LIGHTEST).min(LIGHTEST))),
        _ => None,
    };
    let mut values = new_values(width, height)?;
    let size = UVec2::new(width, height);
    let incomplete: usize = (values.par_chunks_mut(width as usize).enumerate())
        .map_init(
            || {
                [Some((limit, threshold)), reference].map(|limits| {
                    let (limit, threshold) = limits?;
                    Some(
                        WhittedIntegrator::watched(render_scene, camera, control)
                            .with_limits(limit, threshold),
                    )
                })
            },
            |tracers, (y, row)| {
                if control.is_cancelled() {
                    return 0;
                }
                let mut incomplete = 0;
                for (x, value) in row.iter_mut().enumerate() {
                    let pixel = UVec2::new(x as u32, y as u32);
                    let [own, reference] = tracers.each_mut().map(|tracer| {
                        let tracer = tracer.as_mut()?;
                        Some(PixelSums::of(tracer, pixel, size, samples.max(1)))
                    });
                    let (Some(own), reference) = (own, reference.as_ref()) else { continue };
                    incomplete += usize::from(!reference.unwrap_or(&own).is_complete);
                    *value = number(kind, limit, &own, reference);
                }
                control.add_pixels(row.len() as u64);
                incomplete
            },
        )
        .sum();
    if control.is_cancelled() {
        return Err(RenderError::Cancelled);
    }
    Ok(Map { kind, width, height, values, incomplete })
}

fn new_values(width: u32, height: u32) -> Result<Vec<f32>, SizeError> {
    let count = width as usize * height as usize;
    let mut values = Vec::new();
    let bytes = 4 * count as u64;
    values.try_reserve_exact(count).map_err(|_| SizeError::Memory { width, height, bytes })?;
    values.resize(count, 0.0);
    Ok(values)
}

/// The sums over the samples of a pixel.
struct PixelSums {
    rays: u64,
    samples: u32,
    /// The light of each generation.
    generations: Vec<DVec3>,
    is_complete: bool,
}

impl PixelSums {
    fn of(tracer: &mut WhittedIntegrator<'_>, pixel: UVec2, size: UVec2, samples: u32) -> Self {
        let mut sums = Self { rays: 0, samples, generations: Vec::new(), is_complete: true };
        for sample in 0..samples {
            let PixelStatistics { counts, generations, is_complete } =
                tracer.pixel_tally(pixel, size, sample, MOST_RAYS);
            sums.rays += counts.total();
            sums.is_complete &= is_complete;
            if sums.generations.len() < generations.len() {
                sums.generations.resize(generations.len(), DVec3::ZERO);
            }
            sums.generations.iter_mut().zip(generations).for_each(|(sum, light)| *sum += light);
        }
        sums
    }

    fn light(&self) -> f64 {
        self.generations.iter().map(|light| light.element_sum()).sum()
    }
}

/// The number of one pixel.
fn number(kind: MapKind, limit: u32, own: &PixelSums, reference: Option<&PixelSums>) -> f32 {
    // An empty sum is -0.
    let share =
        |lost: f64, whole: f64| if whole > 0.0 && lost > 0.0 { (lost / whole).min(1.0) as f32 } else { 0.0 };
    match (kind, reference) {
        (MapKind::Generations, _) => own.generations.len() as f32,
        (MapKind::Rays, _) => own.rays as f32 / own.samples as f32,
        (MapKind::LimitLoss, Some(reference)) => {
            let lost =
                reference.generations.iter().skip(limit as usize).map(|light| light.element_sum()).sum();
            share(lost, reference.light())
        }
        (MapKind::ThresholdLoss, Some(reference)) => {
            share(reference.light() - own.light(), reference.light())
        }
        _ => 0.0,
    }
}

fn clipped(light: [f32; 3], exposure: f64) -> f32 {
    let shown = light.map(|channel| (f64::from(channel) * exposure).max(0.0));
    let (lost, whole) =
        shown.iter().fold((0.0, 0.0), |(lost, whole), &light| (lost + (light - 1.0).max(0.0), whole + light));
    match (whole.is_finite(), whole > 0.0) {
        (true, true) => (lost / whole) as f32,
        (true, false) => 0.0,
        (false, _) => 1.0,
    }
}

impl Map {
    /// The number at a pixel (column, row), if the map has it.
    pub fn value(&self, pixel: UVec2) -> Option<f32> {
        let is_inside = pixel.x < self.width && pixel.y < self.height;
        let place = pixel.y as usize * self.width as usize + pixel.x as usize;
        self.values.get(place).copied().filter(|_| is_inside)
    }

    /// The largest number.
    pub fn greatest(&self) -> f32 {
        self.values.iter().copied().fold(0.0, f32::max)
    }

    /// The mean of all numbers.
    pub fn mean(&self) -> f64 {
        let sum: f64 = self.values.iter().copied().map(f64::from).sum();
        sum / self.values.len().max(1) as f64
    }

    /// Where the scale of the legend ends: a round number that no number is above. It begins at 0.
    pub fn scale_end(&self) -> f32 {
        let greatest = self.greatest();
        match self.kind {
            MapKind::Generations => greatest.max(1.0),
            MapKind::Rays => round_up(greatest.max(1.0)),
            _ => round_up(greatest.max(1e-3)).min(1.0),
        }
    }

    /// A number as the legend writes it: a percentage, or a count.
    pub fn in_words(&self, value: f32) -> String {
        if self.kind.is_share() {
            let percent = format!("{:.2}", 100.0 * value);
            return format!("{}%", percent.trim_end_matches('0').trim_end_matches('.'));
        }
        let places = usize::from(value.fract() != 0.0);
        format!("{value:.places$}")
    }

    /// The color of a number on the scale "inferno": linear light.
    pub fn color(&self, value: f32) -> [f32; 3] {
        scale_color(f64::from(value) / f64::from(self.scale_end()))
    }

    /// The map in colors, in linear light, with a legend below.
    ///
    /// # Errors
    /// When the picture with its legend would be too large.
    pub fn to_picture(&self) -> Result<Picture, SizeError> {
        let legend = legend::Legend::new(self);
        let mut picture = Picture::new(self.width, self.height.saturating_add(legend.height()))?;
        let end = f64::from(self.scale_end());
        for (pixel, value) in picture.pixels_mut().iter_mut().zip(&self.values) {
            *pixel = scale_color(f64::from(*value) / end);
        }
        let rows = picture.rows_mut().skip(self.height as usize);
        rows.enumerate().for_each(|(y, row)| legend.draw_row(y as u32, row));
        Ok(picture)
    }
}

impl Map {
    /// The numbers themselves as a picture, alike in all channels, without a legend.
    ///
    /// # Errors
    /// When there is too little memory.
    pub fn to_numbers(&self) -> Result<Picture, SizeError> {
        let mut picture = Picture::new(self.width, self.height)?;
        let pixels = picture.pixels_mut().iter_mut();
        pixels.zip(&self.values).for_each(|(pixel, value)| *pixel = [*value; 3]);
        Ok(picture)
    }
}

/// The next of 1, 2, 5 times a power of ten.
fn round_up(number: f32) -> f32 {
    let power = 10.0_f64.powf(f64::from(number).log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| (step * power) as f32);
    steps.into_iter().find(|step| *step >= number * (1.0 - 1e-6)).unwrap_or(number)
}
