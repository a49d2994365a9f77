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
use crate::raster::projection::ScreenProjection;
use crate::raster::rasterizer::Fragment;
use crate::raster::sample_sums::{FrameSize, PassTimer, SampleSums};
use crate::raster::settings::ShadingSettings;
use crate::raster::shaded::batch::{BatchBuilder, FaceBatch};
use crate::simd::vector::Vector;
use crate::transport::camera::RenderCamera;
use crate::transport::control::RenderControl;
use crate::transport::counts::RayCounts;
use crate::transport::render::RenderSettings;
use crate::transport::sampler::Sampler;
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
        counts += clock.time(PassName::Light, || job.shade(&fragments, sample, &mut canvas))?;
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
    /// Gives the fragments of a sample their colors and adds them to the picture.
    fn shade(
        &self,
        fragments: &[Fragment],
        sample: u32,
        canvas: &mut SampleSums,
    ) -> Result<RayCounts, MethodError> {
        let (width, offset) = (self.frame.width, sample_offset(sample));
        let make = || {
            let mut shader = PointShader::new(self.scene, self.camera);
            shader.begin_sample(Sampler::new(sample, [0, 0], [1, 1], width));
            shader
        };
        self.frame.each_row(canvas.sums(), self.control, make, |shader, y, sums| {
            let before = shader.counts();
            let row = fragments.iter().skip(y * width).take(width);
            let mut lights = self.lights(shader, row.clone().zip(y * width..)).into_iter();
            for (x, (sum, fragment)) in sums.iter_mut().zip(row).enumerate() {
                if fragment.is_empty() {
                    let ray = self.camera.ray(DVec2::new(x as f64, y as f64) + offset, self.frame.size());
                    *sum += exact(self.scene.sky.along(ray.alone().direction));
                } else if let Some(light) = lights.next() {
                    let body = RayOrigin::of_word(fragment.start).body;
                    let color = color_of(self.scene, body, fragment.in_body, fragment.in_body);
                    *sum += exact(light.with_color(color));
                }
            }
            shader.counts() - before
        })
    }

    /// The light of each fragment that is not empty; with the numbers of their pixels.
    fn lights<'f>(
        &self,
        shader: &mut PointShader<'_>,
        row: impl Iterator<Item = (&'f Fragment, usize)>,
    ) -> Vec<DirectLight> {
        let seen = row.filter(|(fragment, _)| !fragment.is_empty());
        if self.shading != ShadingFrequency::Phong {
            let interpolated = |fragment: &Fragment| {
                let [on_color, highlight] = fragment.values;
                DirectLight { on_color, highlight }
            };
            return seen.map(|(fragment, _)| interpolated(fragment)).collect();
        }
        let point = |(fragment, pixel): (&Fragment, usize)| {
            let [position, normal] = fragment.values;
            let normal = normal.normalize_or(Vector::splat(0.0, [0.0, 1.0, 0.0]));
            self.point(RayOrigin::of_word(fragment.start), exact(position), normal, pixel as u32)
        };
        let points: Vec<ShadingPoint> = seen.map(point).collect();
        self.light_all(shader, &points)
    }

    /// The local terms at these points.
    fn light_all(&self, shader: &mut PointShader<'_>, points: &[ShadingPoint]) -> Vec<DirectLight> {
        shader.light_all(points, self.settings.model, self.settings.shadows)
    }

    fn point(&self, start: RayOrigin, at: DVec3, normal: Vector<f32>, pixel: u32) -> ShadingPoint {
        let to_viewer = vector(self.camera.toward_viewer(at));
        ShadingPoint { start, position: vector(at), normal, to_viewer, pixel }
    }
}
