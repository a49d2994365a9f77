//! `flat`, `gouraud`, `phong`: bodies of faces, drawn with local light alone.
//!
//! What the three interpolate across a face is the light; the color that it falls on, a pattern's too, is looked up
//! at the pixel's point in all three. So the pictures differ by the way of shading and by nothing else.

pub(crate) mod batch;
pub(crate) mod clip;
pub(crate) mod faces;
pub(crate) mod fragments;

use glam::DVec3;

use crate::geometry::ray::RayOrigin;
use crate::raster::error::MethodError;
use crate::raster::output::{FirstSampleBuffers, MethodOutput};
use crate::raster::pass::PassName;
use crate::raster::point_shader::{DirectLight, PointShader, ShadingPoint, vector};
use crate::raster::projection::ScreenProjection;
use crate::raster::sample_sums::{FrameSize, PassTimer, SampleSums};
use crate::raster::settings::ShadingSettings;
use crate::raster::shaded::batch::{BatchBuilder, FaceBatch};
use crate::raster::shaded::fragments::SampleBuffers;
use crate::transport::camera::RenderCamera;
use crate::transport::control::RenderControl;
use crate::transport::counts::RayCounts;
use crate::transport::render::RenderSettings;
use crate::transport::sampling::sample_offset;
use crate::transport::scene::RenderScene;

/// Where the local terms are worked out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ShadingFrequency {
    /// At the middle of each face.
    Flat,
    /// At the vertices.
    Gouraud,
    /// In the pixels.
    Phong,
}

/// What is drawn, and how.
pub(crate) struct ShadingJob<'a> {
    scene: &'a RenderScene,
    camera: &'a RenderCamera,
    shading: ShadingFrequency,
    settings: &'a ShadingSettings,
    frame: FrameSize,
    projection: ScreenProjection,
    control: &'a RenderControl,
}

pub(crate) fn draw(
    scene: &RenderScene,
    camera: &RenderCamera,
    shading: ShadingFrequency,
    settings: &ShadingSettings,
    render: RenderSettings,
    control: &RenderControl,
) -> Result<MethodOutput, MethodError> {
    let frame = FrameSize::new(render)?;
    let projection = ScreenProjection::new(camera, frame.size());
    let job = ShadingJob { scene, camera, shading, settings, frame, projection, control };
    let samples = render.samples.max(1);
    control.expect(2 * frame.pixels() as u64 * u64::from(samples));
    let mut canvas = SampleSums::new(frame)?;
    let mut buffers = SampleBuffers::new(frame)?;
    let (mut clock, mut counts) = (PassTimer::default(), RayCounts::default());
    let mut builder = BatchBuilder::new(&job);
    let mut kept: Option<FaceBatch> = None;
    for sample in 0..samples {
        buffers.visible.clear();
        builder.begin();
        let mut is_last = false;
        while !is_last {
            // Faces do not move from sample to sample: if they all are in one batch, it serves for all.
            let batch = match kept.take() {
                Some(batch) => batch,
                None => builder.batch(&mut clock, &mut counts)?,
            };
            is_last = batch.is_last;
            let visible = &mut buffers.visible;
            clock.time(PassName::Rasterize, || batch.rasterize(&job, sample_offset(sample), visible))?;
            if is_last {
                control.add_pixels(frame.pixels() as u64);
            }
            counts += clock.time(PassName::Light, || buffers.shade(&job, &batch, sample, canvas.sums()))?;
            kept = batch.is_all(scene).then_some(batch);
        }
    }
    let picture = canvas.picture(samples)?;
    Ok(MethodOutput {
        picture,
        counts,
        passes: clock.passes,
        cube_maps: None,
        evidence: FirstSampleBuffers::Bodies(buffers.bodies),
    })
}

impl ShadingJob<'_> {
    /// The local terms at these points.
    fn light_all(&self, shader: &mut PointShader<'_>, points: &[ShadingPoint]) -> Vec<DirectLight> {
        shader.light_all(points, self.settings.model, self.settings.shadows)
    }

    /// A point of a face; what it has of lights belongs to no pixel.
    fn point(&self, start: RayOrigin, at: DVec3, normal: DVec3) -> ShadingPoint {
        let to_viewer = vector(self.camera.toward_viewer(at));
        ShadingPoint { start, position: vector(at), normal: vector(normal), to_viewer, pixel: 0 }
    }
}
