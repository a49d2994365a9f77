//! `ssr` and `cube-map`: traced points with their local light, and one reflection that is not traced.

pub(crate) mod reflections;

use std::collections::BTreeSet;
use std::sync::Arc;

use catoptric_picture::{Picture, SizeError};
use rayon::prelude::*;

use crate::geometry::ray::{INWARDS, NO_START};
use crate::raster::cube_map::active::ActiveCubeMaps;
use crate::raster::cube_map::cache::{CubeMapUse, CubeMaps};
use crate::raster::cube_map::proxy::ParallaxBox;
use crate::raster::error::MethodError;
use crate::raster::gbuffer::GBuffer;
use crate::raster::mirrored::reflections::{BandLight, ReflectionKernel, Reflections};
use crate::raster::output::{FirstSampleBuffers, MethodOutput};
use crate::raster::pass::PassName;
use crate::raster::point_shader::reflection_of;
use crate::raster::sample_sums::{FrameSize, PassTimer, SampleSums};
use crate::raster::settings::{CubeMapSettings, SsrFallback, SsrSettings};
use crate::transport::camera::RenderCamera;
use crate::transport::control::RenderControl;
use crate::transport::counts::RayCounts;
use crate::transport::render::RenderSettings;
use crate::transport::scene::RenderScene;

/// How reflections are found.
#[derive(Clone, Copy)]
pub(crate) struct ReflectionSources<'a> {
    pub(crate) screen: Option<&'a SsrSettings>,
    pub(crate) maps: Option<&'a CubeMapSettings>,
}

impl<'a> ReflectionSources<'a> {
    pub(crate) fn of_screen(settings: &'a SsrSettings) -> Self {
        let maps = match &settings.fallback {
            SsrFallback::Background => None,
            SsrFallback::CubeMap(maps) => Some(maps),
        };
        Self { screen: Some(settings), maps }
    }

    pub(crate) fn of_maps(maps: &'a CubeMapSettings) -> Self {
        Self { screen: None, maps: Some(maps) }
    }
}

pub(crate) fn draw(
    scene: &RenderScene,
    camera: &RenderCamera,
    mirrors: ReflectionSources<'_>,
    render: RenderSettings,
    control: &RenderControl,
    cache: &mut CubeMaps,
) -> Result<MethodOutput, MethodError> {
    let frame = FrameSize::new(render)?;
    let samples = render.samples.max(1);
    control.expect(2 * frame.pixels() as u64 * u64::from(samples));
    let mut canvas = MirrorCanvas::new(frame, samples)?;
    let mut buffer = GBuffer::new(frame, camera)?;
    let (mut clock, mut counts) = (PassTimer::default(), RayCounts::default());
    let (mut maps, mut used) = (ActiveCubeMaps::default(), CubeMapUse::default());
    // The first sample last: its buffers are kept.
    for sample in (0..samples).rev() {
        counts +=
            clock.time(PassName::FirstHits, || buffer.find_first_hits(scene, camera, sample, control))?;
        if let Some(settings) = mirrors.maps {
            counts += clock.time(PassName::CubeMaps, || {
                take_maps(scene, &buffer, settings, control, cache, (&mut maps, &mut used))
            })?;
        }
        clock.time(PassName::Reflect, || {
            if mirrors.screen.is_some() {
                buffer.depths.find(scene.lanes, &buffer.hits.surfaces);
            }
            if sample + 1 < samples {
                buffer.reflected.fill([0.0; 3]);
            }
            reflect((scene, camera), mirrors, &mut buffer, &maps, &mut canvas, control)
        })?;
    }
    let picture = canvas.picture(samples)?;
    let cube_maps = mirrors.maps.map(|_| used);
    let evidence = FirstSampleBuffers::Buffers(Box::new(buffer), maps);
    Ok(MethodOutput { picture, counts, passes: clock.passes, cube_maps, evidence })
}

/// Where the light of the samples goes to: of a single one straight into the picture.
enum MirrorCanvas {
    Picture(Picture),
    Sums(SampleSums),
}

impl MirrorCanvas {
    fn new(frame: FrameSize, samples: u32) -> Result<Self, SizeError> {
        Ok(match samples {
            1 => Self::Picture(Picture::new(frame.width as u32, frame.height as u32)?),
            _ => Self::Sums(SampleSums::new(frame)?),
        })
    }

    /// So many pixels after so many, row by row from the top.
    fn bands(&mut self, pixels: usize) -> Vec<BandLight<'_>> {
        match self {
            Self::Picture(picture) => {
                picture.pixels_mut().chunks_mut(pixels).map(BandLight::Picture).collect()
            }
            Self::Sums(sums) => sums.sums().chunks_mut(pixels).map(BandLight::Sums).collect(),
        }
    }

    /// The mean of this many samples.
    fn picture(self, samples: u32) -> Result<Picture, SizeError> {
        match self {
            Self::Picture(picture) => Ok(picture),
            Self::Sums(sums) => sums.picture(samples),
        }
    }
}

/// k_r of the surface of a [`SurfaceTexel`](crate::transport::tile::hits::SurfaceTexel), if its reflected ray would be
/// traced.
pub(crate) fn reflecting(scene: &RenderScene, start: u32) -> Option<f32> {
    if start == NO_START { None } else { reflection_of(scene, start & !INWARDS) }
}

/// Has the maps made of all bodies that reflect in the picture.
fn take_maps(
    scene: &RenderScene,
    buffer: &GBuffer,
    settings: &CubeMapSettings,
    control: &RenderControl,
    cache: &mut CubeMaps,
    (maps, used): (&mut ActiveCubeMaps, &mut CubeMapUse),
) -> Result<RayCounts, MethodError> {
    let mut bodies: BTreeSet<u32> = maps.maps.keys().copied().collect();
    let before = bodies.len();
    let mut last = NO_START;
    for texel in &buffer.hits.surfaces {
        // Neighboring pixels mostly show the same body.
        if texel.start != last {
            last = texel.start;
            if reflecting(scene, last).is_some() {
                bodies.insert(last & !INWARDS);
            }
        }
    }
    if bodies.len() == before {
        return Ok(RayCounts::default());
    }
    // Parts share the map of the whole.
    let wholes = bodies.iter().map(|&index| scene.geometry.joined.whole_of(index, false).body).collect();
    let (made, counts) = cache.prepare(scene, &wholes, settings.size, control)?;
    // Maps that an earlier sample has had made are not there from before.
    *used = CubeMapUse { built: used.built + made.built, kept: made.kept.saturating_sub(used.built), ..made };
    for index in bodies {
        let Some(map) = scene.number(index).and_then(|number| cache.get(number)) else { continue };
        let proxy = || settings.parallax.then(|| ParallaxBox::around(scene, index, map.center()));
        maps.maps.entry(index).or_insert_with(|| (Arc::clone(map), proxy()));
    }
    Ok(counts)
}

/// Finds what each reflected ray brings, and adds the light of the pixels to the picture.
fn reflect(
    (scene, camera): (&RenderScene, &RenderCamera),
    mirrors: ReflectionSources<'_>,
    buffer: &mut GBuffer,
    maps: &ActiveCubeMaps,
    canvas: &mut MirrorCanvas,
    control: &RenderControl,
) -> Result<(), MethodError> {
    let width = buffer.frame.width;
    let mut reflected = std::mem::take(&mut buffer.reflected);
    let reflections = Reflections::new((scene, camera), mirrors, buffer, maps);
    let band = ReflectionKernel::ROWS * width;
    let bands = canvas.bands(band).into_par_iter().zip(reflected.par_chunks_mut(band)).enumerate();
    bands.for_each(|(number, (light, reflected))| {
        if !control.is_cancelled() {
            let pixels = reflected.len() as u64;
            let first_row = number * ReflectionKernel::ROWS;
            let kernel = ReflectionKernel { reflections: &reflections, first_row, reflected, light };
            scene.lanes.run_in_few(kernel);
            control.add_pixels(pixels);
        }
    });
    buffer.reflected = reflected;
    if control.is_cancelled() { Err(MethodError::Cancelled) } else { Ok(()) }
}
