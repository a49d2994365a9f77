//! `ssr` and `cube-map`: traced points with their local light, and one reflection that is not traced.

pub(crate) mod reflections;

use std::collections::BTreeSet;
use std::sync::Arc;

use rayon::prelude::*;

use crate::geometry::ray::NO_BODY;
use crate::raster::cube_map::active::ActiveCubeMaps;
use crate::raster::cube_map::cache::{CubeMapUse, CubeMaps};
use crate::raster::cube_map::proxy::ParallaxBox;
use crate::raster::error::MethodError;
use crate::raster::gbuffer::{GBuffer, GBufferTexel};
use crate::raster::mirrored::reflections::{ReflectionKernel, Reflections};
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
    let mut canvas = SampleSums::new(frame)?;
    let mut buffer = GBuffer::new(frame)?;
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
                buffer.depths.find(&buffer.texels);
            }
            reflect((scene, camera), mirrors, &mut buffer, &maps, &mut canvas, control)
        })?;
    }
    let picture = canvas.picture(samples)?;
    let cube_maps = mirrors.maps.map(|_| used);
    let evidence = FirstSampleBuffers::Buffers(Box::new(buffer), maps);
    Ok(MethodOutput { picture, counts, passes: clock.passes, cube_maps, evidence })
}

/// k_r of what a texel shows, if its reflected ray would be traced.
pub(crate) fn reflecting(scene: &RenderScene, texel: &GBufferTexel) -> Option<f32> {
    if texel.is_empty() { None } else { reflection_of(scene, texel.start.body) }
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
    let mut last = NO_BODY;
    for texel in &buffer.texels {
        // Neighboring pixels mostly show the same body.
        if texel.start.body != last {
            last = texel.start.body;
            if reflecting(scene, texel).is_some() {
                bodies.insert(last);
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
    canvas: &mut SampleSums,
    control: &RenderControl,
) -> Result<(), MethodError> {
    let width = buffer.frame.width;
    let mut reflected = std::mem::take(&mut buffer.reflected);
    let reflections = Reflections::new((scene, camera), mirrors, buffer, maps);
    let rows = reflected.par_chunks_mut(width).zip(canvas.sums().par_chunks_mut(width)).enumerate();
    rows.for_each(|(row, (reflected, sums))| {
        if !control.is_cancelled() {
            scene.lanes.run_in_few(ReflectionKernel { reflections: &reflections, row, reflected, sums });
            control.add_pixels(width as u64);
        }
    });
    buffer.reflected = reflected;
    if control.is_cancelled() { Err(MethodError::Cancelled) } else { Ok(()) }
}
