//! `flat`, `gouraud`, `phong`: bodies of faces, drawn with local light alone.
//!
//! What the three interpolate across a face is the light; the color that it falls on, a checkerboard's too, is looked up
//! at the pixel's point in all three. So the pictures differ by the way of shading and by nothing else.

pub(crate) mod batch;
pub(crate) mod faces;

use glam::{DVec2, DVec3};

use crate::geometry::ray::RayOrigin;
use crate::raster::error::MethodError;
use crate::raster::output::{FirstSampleBuffers, MethodOutput};
use crate::raster::pass::PassName;
use crate::raster::point_shader::{DirectLight, PointShader, ShadingPoint, color_of, exact, vector};
use crate::raster::rasterizer::Fragment;
use crate::raster::sample_sums::{FrameSize, PassTimer, SampleSums};
use crate::raster::settings::ShadingSettings;
use crate::raster::shaded::batch::{BatchBuilder, FaceBatch};
use crate::simd::vector::Vector;
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
    let job = ShadingJob { scene, camera, shading, settings, frame, control };
    let samples = render.samples.max(1);
    control.expect(2 * frame.pixels() as u64 * u64::from(samples));
    let mut canvas = SampleSums::new(frame)?;
    let mut fragments = frame.buffer(Fragment::EMPTY)?;
    let mut bodies = frame.buffer(u32::MAX)?;
    let (mut clock, mut counts) = (PassTimer::default(), RayCounts::default());
    let mut maker = BatchBuilder::new(&job);
    let mut kept: Option<FaceBatch> = None;
    for sample in 0..samples {
        let offset = sample_offset(sample);
        fragments.fill(Fragment::EMPTY);
        if let Some(batch) = &kept {
            clock.time(PassName::Rasterize, || batch.rasterize(&job, offset, &mut fragments))?;
        } else {
            maker.begin();
            while let Some(batch) = maker.batch(&mut clock, &mut counts)? {
                clock.time(PassName::Rasterize, || batch.rasterize(&job, offset, &mut fragments))?;
                // Faces do not move from sample to sample: if they all are in one batch, it serves for all.
                kept = batch.is_all(scene).then_some(batch);
            }
        }
        control.add_pixels(frame.pixels() as u64);
        if sample == 0 {
            let both = bodies.iter_mut().zip(&fragments);
            both.for_each(|(body, fragment)| *body = RayOrigin::of_word(fragment.start).body);
        }
        counts += clock.time(PassName::Light, || job.shade(&fragments, offset, &mut canvas))?;
    }
    let picture = canvas.picture(samples)?;
    Ok(MethodOutput {
        picture,
        counts,
        passes: clock.passes,
        cube_maps: None,
        evidence: FirstSampleBuffers::Bodies(bodies),
    })
}

impl ShadingJob<'_> {
    /// Gives the fragments their colors and adds them to the picture.
    fn shade(
        &self,
        fragments: &[Fragment],
        offset: DVec2,
        canvas: &mut SampleSums,
    ) -> Result<RayCounts, MethodError> {
        let width = self.frame.width;
        let make = || PointShader::new(self.scene, self.camera);
        self.frame.each_row(canvas.sums(), self.control, make, |probe, y, sums| {
            let before = probe.counts;
            let row = fragments.iter().skip(y * width);
            for (x, (sum, fragment)) in sums.iter_mut().zip(row).enumerate() {
                let at = || DVec2::new(x as f64, y as f64) + offset;
                *sum += exact(self.color(probe, fragment, at));
            }
            probe.counts - before
        })
    }

    /// `at` is the place of the picture.
    fn color(&self, probe: &mut PointShader<'_>, fragment: &Fragment, at: impl Fn() -> DVec2) -> Vector<f32> {
        if fragment.is_empty() {
            let ray = self.camera.ray(at(), self.frame.size());
            return self.scene.sky.along(ray.alone().direction);
        }
        let start = RayOrigin::of_word(fragment.start);
        let [first, second] = fragment.values;
        let light = if self.shading == ShadingFrequency::Phong {
            let normal = second.normalize_or(Vector::splat(0.0, [0.0, 1.0, 0.0]));
            self.light(probe, start, exact(first), normal)
        } else {
            DirectLight { on_color: first, highlight: second }
        };
        light.with_color(color_of(self.scene, start.body, fragment.in_body, fragment.in_body))
    }

    fn light(
        &self,
        probe: &mut PointShader<'_>,
        start: RayOrigin,
        at: DVec3,
        normal: Vector<f32>,
    ) -> DirectLight {
        let to_viewer = vector(self.camera.toward_viewer(at));
        let point = ShadingPoint { start, position: vector(at), normal, to_viewer };
        probe.light(&point, self.settings.model, self.settings.shadows)
    }
}
