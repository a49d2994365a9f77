//! `ssr` and `cube-map`: traced points with their local light, and one reflection that is not traced.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec3;

use crate::geometry::ray::NO_BODY;
use crate::raster::cube_map::active::ActiveCubeMaps;
use crate::raster::cube_map::cache::{CubeMapUse, CubeMaps};
use crate::raster::cube_map::proxy::ParallaxBox;
use crate::raster::error::MethodError;
use crate::raster::gbuffer::{GBuffer, GBufferTexel};
use crate::raster::output::{FirstSampleBuffers, MethodOutput};
use crate::raster::pass::PassName;
use crate::raster::point_shader::{exact, reflection_of, vector};
use crate::raster::sample_sums::{FrameSize, PassTimer, SampleSums};
use crate::raster::screen::{MarchOutcome, ScreenMarcher};
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
                buffer.fronts.find(&buffer.texels);
            }
            reflect(scene, camera, mirrors, &mut buffer, &maps, control)?;
            let both = canvas.sums().iter_mut().zip(buffer.lit.iter().zip(&buffer.reflected));
            for ((sum, (lit, reflected)), texel) in both.zip(&buffer.texels) {
                let share = reflecting(scene, texel).unwrap_or(0.0);
                *sum += exact(*lit + *reflected * share);
            }
            Ok::<(), MethodError>(())
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
    let (made, counts) = cache.prepare(scene, &bodies, settings.size, control)?;
    // Maps that an earlier sample has had made are not there from before.
    *used = CubeMapUse { built: used.built + made.built, kept: made.kept.saturating_sub(used.built), ..made };
    for index in bodies {
        let Some(map) = scene.scene_index(index).and_then(|place| cache.get(place)) else { continue };
        let proxy = || settings.parallax.then(|| ParallaxBox::around(scene, index, map.center()));
        maps.maps.entry(index).or_insert_with(|| (Arc::clone(map), proxy()));
    }
    Ok(counts)
}

/// Finds what each reflected ray brings.
fn reflect(
    scene: &RenderScene,
    camera: &RenderCamera,
    mirrors: ReflectionSources<'_>,
    buffer: &mut GBuffer,
    maps: &ActiveCubeMaps,
    control: &RenderControl,
) -> Result<(), MethodError> {
    let frame = buffer.frame;
    let mut reflected = std::mem::take(&mut buffer.reflected);
    let shown = &*buffer;
    let screen = mirrors.screen.map(|settings| ScreenMarcher { buffer: shown, camera, settings });
    let find = |texel: &GBufferTexel| {
        let direction = texel.reflected(camera);
        let met = screen.as_ref().and_then(|screen| match screen.march(texel, exact(direction)) {
            MarchOutcome::Met(at) => Some(screen.light(at)),
            MarchOutcome::LeftScreen | MarchOutcome::OutOfRange => None,
        });
        met.or_else(|| maps.light(texel, direction)).unwrap_or_else(|| scene.sky.along(direction))
    };
    let done = frame.each_row(
        &mut reflected,
        control,
        || (),
        |(), y, row| {
            for (found, texel) in row.iter_mut().zip(shown.texels.iter().skip(y * frame.width)) {
                let reflects = reflecting(scene, texel).is_some();
                *found = if reflects { find(texel) } else { vector(DVec3::ZERO) };
            }
            RayCounts::default()
        },
    );
    buffer.reflected = reflected;
    done.map(|_| ())
}
