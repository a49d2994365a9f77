//! The ways of drawing reflections: the traced picture and what is drawn instead of it where tracing is too dear.
//!
//! [`draw`] makes a picture of a scene by any [`Method`], all with the same camera and the same local terms, so that
//! pictures can be held against each other pixel by pixel. What a method gets wrong, [`reasons()`] tells by tracing.

pub(crate) mod cube_map;
pub(crate) mod error;
pub(crate) mod gbuffer;
pub(crate) mod mesh;
pub(crate) mod method;
pub(crate) mod mirrored;
pub(crate) mod output;
pub(crate) mod pass;
pub(crate) mod point_shader;
pub(crate) mod projection;
pub(crate) mod rasterizer;
pub(crate) mod reasons;
pub(crate) mod sample_sums;
pub(crate) mod screen;
pub(crate) mod settings;
pub(crate) mod shaded;
pub(crate) mod tile_sample;

use catoptric_picture::Picture;
use catoptric_platform::time::Instant;

use crate::raster::mirrored::ReflectionSources;
use crate::raster::shaded::ShadingFrequency;
use crate::transport::camera::RenderCamera;
use crate::transport::control::RenderControl;
use crate::transport::render::{RenderSettings, render_into};
use crate::transport::scene::RenderScene;

pub use crate::raster::cube_map::CubeMap;
pub use crate::raster::cube_map::cache::{CubeMapUse, CubeMaps};
pub use crate::raster::error::MethodError;
pub use crate::raster::gbuffer::GBufferLayer;
pub use crate::raster::method::{Method, MethodAbilities, MethodKind};
pub use crate::raster::output::MethodOutput;
pub use crate::raster::pass::PassName;
pub use crate::raster::reasons::{Reason, ReasonMap, reasons};
pub use crate::raster::settings::{
    CubeMapSettings, LightModel, SettingError, ShadingSettings, SsrFallback, SsrSettings,
};

/// Draws `scene` by `method`, on the threads of the current rayon pool. The picture does not depend on their number.
///
/// # Errors
/// When a setting is out of its range, the size is 0 or too large, memory is short, or the drawing is cancelled.
pub fn draw(
    scene: &RenderScene,
    method: &Method,
    settings: RenderSettings,
    control: &RenderControl,
) -> Result<MethodOutput, MethodError> {
    draw_through(scene, scene.camera(), method, settings, control, &mut CubeMaps::new())
}

/// Draws `scene` by `method` through a camera of [`RenderScene::camera_for`], with cube maps that are kept in `maps` from
/// picture to picture.
///
/// # Errors
/// As for [`draw`].
pub fn draw_through(
    scene: &RenderScene,
    camera: &RenderCamera,
    method: &Method,
    settings: RenderSettings,
    control: &RenderControl,
    maps: &mut CubeMaps,
) -> Result<MethodOutput, MethodError> {
    method.check()?;
    let shade = |shading, how: &ShadingSettings| shaded::draw(scene, camera, shading, how, settings, control);
    match method {
        Method::Whitted => trace(scene, camera, settings, control),
        Method::Flat(how) => shade(ShadingFrequency::Flat, how),
        Method::Gouraud(how) => shade(ShadingFrequency::Gouraud, how),
        Method::Phong(how) => shade(ShadingFrequency::Phong, how),
        Method::Ssr(how) => {
            mirrored::draw(scene, camera, ReflectionSources::of_screen(how), settings, control, maps)
        }
        Method::CubeMap(how) => {
            mirrored::draw(scene, camera, ReflectionSources::of_maps(how), settings, control, maps)
        }
    }
}

fn trace(
    scene: &RenderScene,
    camera: &RenderCamera,
    settings: RenderSettings,
    control: &RenderControl,
) -> Result<MethodOutput, MethodError> {
    let RenderSettings { width, height, samples } = settings;
    let mut picture = Picture::new(width, height)?;
    control.expect(u64::from(width) * u64::from(height));
    // As by other methods, memory that has to be cleared is no part of a pass.
    let start = Instant::now();
    let counts = render_into(&mut picture, scene, camera, samples, control)?;
    Ok(MethodOutput::traced(picture, counts, start.elapsed()))
}
