//! `flat`, `gouraud`, `phong`: bodies of faces, drawn with local light alone.
//!
//! What the three interpolate across a face is the light; the color that it falls on, a checkerboard's too, is looked up
//! at the pixel's point in all three. So the pictures differ by the way of shading and by nothing else.

mod batch;
mod faces;

use glam::{DVec2, DVec3};

use super::canvas::{Canvas, Clock, Frame};
use super::probe::{LocalLight, Point, Probe, color_of, exact, vector};
use super::raster::Fragment;
use super::{Drawing, Evidence, MethodError, PassName, ShadingSettings};
use crate::counts::RayCounts;
use crate::ray::Start;
use crate::render::{Control, RenderSettings};
use crate::sampling::sample_offset;
use crate::stage::{Stage, StageCamera};
use crate::vector::Vector;
use batch::{Batch, Maker};

/// Where the local terms are worked out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shading {
    /// At the middle of each face.
    Flat,
    /// At the vertices.
    Gouraud,
    /// In the pixels.
    Phong,
}

/// What is drawn, and how.
struct Job<'a> {
    stage: &'a Stage,
    camera: &'a StageCamera,
    shading: Shading,
    settings: &'a ShadingSettings,
    frame: Frame,
    control: &'a Control,
}

pub(super) fn draw(
    stage: &Stage,
    camera: &StageCamera,
    shading: Shading,
    settings: &ShadingSettings,
    render: RenderSettings,
    control: &Control,
) -> Result<Drawing, MethodError> {
    let frame = Frame::new(render)?;
    let job = Job { stage, camera, shading, settings, frame, control };
    let samples = render.samples.max(1);
    control.expect(2 * frame.pixels() as u64 * u64::from(samples));
    let mut canvas = Canvas::new(frame)?;
    let mut fragments = frame.buffer(Fragment::EMPTY)?;
    let mut bodies = frame.buffer(u32::MAX)?;
    let (mut clock, mut counts) = (Clock::default(), RayCounts::default());
    let mut maker = Maker::new(&job);
    let mut kept: Option<Batch> = None;
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
                kept = batch.is_all(stage).then_some(batch);
            }
        }
        control.add_pixels(frame.pixels() as u64);
        if sample == 0 {
            let both = bodies.iter_mut().zip(&fragments);
            both.for_each(|(body, fragment)| *body = Start::of_word(fragment.start).body);
        }
        counts += clock.time(PassName::Light, || job.shade(&fragments, offset, &mut canvas))?;
    }
    let picture = canvas.picture(samples)?;
    Ok(Drawing { picture, counts, passes: clock.passes, cube_maps: None, evidence: Evidence::Bodies(bodies) })
}

impl Job<'_> {
    /// Gives the fragments their colors and adds them to the picture.
    fn shade(
        &self,
        fragments: &[Fragment],
        offset: DVec2,
        canvas: &mut Canvas,
    ) -> Result<RayCounts, MethodError> {
        let width = self.frame.width;
        let make = || Probe::new(self.stage, self.camera);
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
    fn color(&self, probe: &mut Probe<'_>, fragment: &Fragment, at: impl Fn() -> DVec2) -> Vector<f32> {
        if fragment.is_empty() {
            let ray = self.camera.ray(at(), self.frame.size());
            return self.stage.sky.along(ray.alone().direction);
        }
        let start = Start::of_word(fragment.start);
        let [first, second] = fragment.values;
        let light = if self.shading == Shading::Phong {
            let normal = second.normalize_or(Vector::splat(0.0, [0.0, 1.0, 0.0]));
            self.light(probe, start, exact(first), normal)
        } else {
            LocalLight { on_color: first, highlight: second }
        };
        light.with_color(color_of(self.stage, start.body, fragment.in_body, fragment.in_body))
    }

    fn light(&self, probe: &mut Probe<'_>, start: Start, at: DVec3, normal: Vector<f32>) -> LocalLight {
        let to_viewer = vector(self.camera.toward_viewer(at));
        let point = Point { start, position: vector(at), normal, to_viewer };
        probe.light(&point, self.settings.model, self.settings.shadows)
    }
}
