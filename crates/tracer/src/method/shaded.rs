//! `flat`, `gouraud`, `phong`: bodies of faces, drawn with local light alone.
//!
//! What the three interpolate across a face is the light; the color that it falls on, a checkerboard's too, is looked up
//! at the pixel's point in all three. So the pictures differ by the way of shading and by nothing else.

use std::collections::HashMap;
use std::sync::Arc;

use catoptric_picture::Picture;
use glam::{DMat3, DVec2, DVec3};
use rayon::prelude::*;

use super::canvas::{Canvas, Clock, Frame};
use super::mesh::{Mesh, Patch};
use super::probe::{LocalLight, Point, Probe, color_of, exact, vector};
use super::raster::{Corner, Fragment, Triangle};
use super::{Drawing, Evidence, MethodError, PassName, ShadingSettings};
use crate::counts::RayCounts;
use crate::ray::Start;
use crate::render::{Control, RenderSettings};
use crate::sampling::sample_offset;
use crate::shape::ShapeKind;
use crate::stage::{Stage, StageBody, StageCamera};
use crate::vector::Vector;

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
    let mut maker = Maker { job: &job, meshes: HashMap::new(), next: 0 };
    let mut kept: Option<Batch> = None;
    for sample in 0..samples {
        let offset = sample_offset(sample);
        fragments.fill(Fragment::EMPTY);
        if let Some(batch) = &kept {
            clock.time(PassName::Rasterize, || batch.rasterize(&job, offset, &mut fragments))?;
        } else {
            maker.next = 0;
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
        counts += clock.time(PassName::Light, || job.shade(&fragments, &mut canvas))?;
    }
    let picture: Picture = canvas.picture(samples)?;
    Ok(Drawing { picture, counts, passes: clock.passes, cube_maps: None, evidence: Evidence::Bodies(bodies) })
}

impl Job<'_> {
    /// Gives the fragments their colors and adds them to the picture.
    fn shade(&self, fragments: &[Fragment], canvas: &mut Canvas) -> Result<RayCounts, MethodError> {
        let width = self.frame.width;
        let make = || Probe::new(self.stage, self.camera);
        self.frame.each_row(canvas.sums(), self.control, make, |probe, y, sums| {
            let before = probe.counts;
            let row = fragments.iter().skip(y * width);
            for (sum, fragment) in sums.iter_mut().zip(row) {
                *sum += exact(self.color(probe, fragment));
            }
            probe.counts - before
        })
    }

    fn color(&self, probe: &mut Probe<'_>, fragment: &Fragment) -> Vector<f32> {
        if fragment.is_empty() {
            return Vector::splat(0.0, self.stage.background);
        }
        let start = Start::of_word(fragment.start);
        let [first, second] = fragment.values;
        let light = if self.shading == Shading::Phong {
            let normal = second.normalize_or(Vector::splat(0.0, [0.0, 1.0, 0.0]));
            self.light(probe, start, exact(first), normal)
        } else {
            LocalLight { on_color: first, highlight: second }
        };
        light.with_color(color_of(self.stage, start.body, fragment.in_body))
    }

    fn light(&self, probe: &mut Probe<'_>, start: Start, at: DVec3, normal: Vector<f32>) -> LocalLight {
        let to_viewer = vector(self.camera.toward_viewer(at));
        let point = Point { start, position: vector(at), normal, to_viewer };
        probe.light(&point, self.settings.model, self.settings.shadows)
    }
}

/// A vertex in the world.
#[derive(Clone, Copy)]
struct WorldVertex {
    position: DVec3,
    /// Outward, of length 1.
    normal: DVec3,
    in_body: Vector<f32>,
    body: u32,
}

/// A face in the world, and the side of it that is seen.
struct WorldFace {
    corners: [u32; 4],
    /// The mean of its corners.
    middle: DVec3,
    /// Of length 1, on the side that is seen.
    normal: DVec3,
    start: Start,
}

/// Makes faces of bodies, so many at a time that memory is bounded.
struct Maker<'a> {
    job: &'a Job<'a>,
    /// Shapes that many bodies share.
    meshes: HashMap<u16, Arc<Mesh>>,
    /// The next body.
    next: u32,
}

/// Faces of some bodies, ready to be drawn.
struct Batch {
    corners: Vec<Corner>,
    triangles: Vec<Triangle>,
    bodies: u32,
}

impl Maker<'_> {
    /// From so many vertices on, no further body is taken up.
    const MOST_VERTICES: usize = 1 << 17;

    /// The faces of the next bodies; `None` after the last.
    fn batch(&mut self, clock: &mut Clock, counts: &mut RayCounts) -> Result<Option<Batch>, MethodError> {
        let job = self.job;
        let (first, count) = (self.next, job.stage.body_count() as u32);
        if first == count {
            return Ok(None);
        }
        let (mut vertices, mut faces) = (Vec::new(), Vec::new());
        clock.time(PassName::Tessellate, || {
            while self.next < count && vertices.len() < Self::MOST_VERTICES && !job.control.is_cancelled() {
                self.add(self.next, &mut vertices, &mut faces);
                self.next += 1;
            }
        });
        if job.control.is_cancelled() {
            return Err(MethodError::Cancelled);
        }
        let mut batch = Batch { corners: Vec::new(), triangles: Vec::new(), bodies: self.next - first };
        *counts += clock.time(PassName::Light, || batch.light(job, &vertices, &faces));
        clock.time(PassName::Rasterize, || batch.set_up(job, &faces));
        Ok(Some(batch))
    }

    fn mesh(&mut self, body: &StageBody) -> Arc<Mesh> {
        let shape = body.canonical();
        let make =
            || Arc::new(Mesh::of(shape, self.job.settings.fineness, Patch::seen(body, self.job.camera)));
        match shape.kind {
            // Each plane and each cone has faces of its own.
            ShapeKind::Plane | ShapeKind::Cone => make(),
            _ => Arc::clone(self.meshes.entry(body.kind).or_insert_with(make)),
        }
    }

    fn add(&mut self, index: u32, vertices: &mut Vec<WorldVertex>, faces: &mut Vec<WorldFace>) {
        let (job, body) = (self.job, *self.job.stage.body(index));
        let mesh = self.mesh(&body);
        let matrix = |rows: [[f32; 3]; 3]| DMat3::from_cols_array_2d(&rows.map(|row| row.map(f64::from)));
        let world_from_body = matrix(body.world_from_body).transpose();
        // Normals go back by the inverse transpose.
        let normal_from_body = matrix(body.body_from_world);
        let origin = DVec3::from(body.origin.map(f64::from));
        let first = vertices.len() as u32;
        vertices.extend(mesh.vertices.iter().map(|vertex| WorldVertex {
            position: origin + world_from_body * vertex.point,
            normal: (normal_from_body * vertex.normal).normalize_or(DVec3::Y),
            in_body: vector(vertex.point),
            body: index,
        }));
        // Of a body that is seen from outside only the side that faces the eye is seen.
        let hides_inside = job.camera.eye().is_some_and(|eye| !body.contains(eye))
            && body.canonical().kind != ShapeKind::Plane;
        for corners in &mesh.faces {
            let corners = corners.map(|corner| corner + first);
            let points = corners.map(|corner| vertices.get(corner as usize).copied());
            let [Some(a), Some(b), Some(c), Some(d)] = points else { continue };
            let is_triangle = corners[2] == corners[3];
            let three = a.position + b.position + c.position;
            let middle = if is_triangle { three / 3.0 } else { (three + d.position) / 4.0 };
            let across = (c.position - a.position).cross(d.position - b.position);
            let mean = a.normal + b.normal + c.normal;
            let normal = (across * across.dot(mean).signum()).normalize_or(a.normal);
            let inwards = normal.dot(job.camera.toward_viewer(middle)) < 0.0;
            if !(inwards && hides_inside) {
                let normal = if inwards { -normal } else { normal };
                faces.push(WorldFace { corners, middle, normal, start: Start { body: index, inwards } });
            }
        }
    }
}

impl Batch {
    fn is_all(&self, stage: &Stage) -> bool {
        self.bodies as usize == stage.body_count()
    }

    /// The place of a face's corner in [`Self::corners`]: flat faces have corners of their own, others share vertices
    /// with the faces around that show the same side.
    fn corner(shading: Shading, face: usize, corners: &[u32; 4], side: usize, number: usize) -> u32 {
        match shading {
            Shading::Flat => (4 * face + number) as u32,
            _ => 2 * corners[number] + side as u32,
        }
    }

    /// Works out what is to be interpolated, and where the corners lie in the picture.
    fn light(&mut self, job: &Job<'_>, vertices: &[WorldVertex], faces: &[WorldFace]) -> RayCounts {
        let size = job.frame.size();
        let corner = |vertex: &WorldVertex, values| Corner {
            seen: job.camera.homogeneous(vertex.position.extend(1.0), size),
            in_body: vertex.in_body,
            values,
        };
        let nothing = [Vector { x: 0.0, y: 0.0, z: 0.0 }; 2];
        let make = || Probe::new(job.stage, job.camera);
        // One counts each thread's rays where it ends, so rows of some length are worked on together.
        const CHUNK: usize = 256;
        let parts: Vec<(Vec<Corner>, RayCounts)> = if job.shading == Shading::Flat {
            let of_face = |probe: &mut Probe<'_>, face: &WorldFace| {
                let light = job.light(probe, face.start, face.middle, vector(face.normal));
                let values = [light.on_color, light.highlight];
                face.corners.map(|index| vertices.get(index as usize).map(|vertex| corner(vertex, values)))
            };
            let chunks = faces.par_chunks(CHUNK).map_init(make, |probe, faces| {
                let before = probe.counts;
                let corners = faces.iter().flat_map(|face| of_face(probe, face)).flatten().collect();
                (corners, probe.counts - before)
            });
            chunks.collect()
        } else {
            let used = sides_seen(vertices.len(), faces);
            let sides: Vec<usize> = (0..used.len()).collect();
            let of_side = |probe: &mut Probe<'_>, side: usize| {
                let vertex = vertices.get(side / 2)?;
                let inwards = side % 2 == 1;
                let normal = vector(if inwards { -vertex.normal } else { vertex.normal });
                let values = match job.shading {
                    _ if !*used.get(side)? => nothing,
                    Shading::Phong => [vector(vertex.position), normal],
                    _ => {
                        let start = Start { body: vertex.body, inwards };
                        let light = job.light(probe, start, vertex.position, normal);
                        [light.on_color, light.highlight]
                    }
                };
                Some(corner(vertex, values))
            };
            let chunks = sides.par_chunks(CHUNK).map_init(make, |probe, sides| {
                let before = probe.counts;
                let corners = sides.iter().filter_map(|&side| of_side(probe, side)).collect();
                (corners, probe.counts - before)
            });
            chunks.collect()
        };
        let mut counts = RayCounts::default();
        for (corners, more) in parts {
            self.corners.extend(corners);
            counts += more;
        }
        counts
    }

    /// Cuts the faces into triangles.
    fn set_up(&mut self, job: &Job<'_>, faces: &[WorldFace]) {
        let corners = &self.corners;
        let triangles = faces.par_iter().enumerate().flat_map_iter(|(index, face)| {
            let side = usize::from(face.start.inwards);
            let at = |number| Self::corner(job.shading, index, &face.corners, side, number);
            let halves = [[0, 1, 2], [0, 2, 3]].map(|half| half.map(at));
            halves.into_iter().filter_map(|half| Triangle::new(corners, half, face.start.word(), job.frame))
        });
        self.triangles = triangles.collect();
    }

    fn rasterize(&self, job: &Job<'_>, offset: DVec2, fragments: &mut [Fragment]) -> Result<(), MethodError> {
        /// Each band of rows looks at all triangles.
        const BANDS: usize = 256;
        let height = job.frame.height.div_ceil(BANDS).max(8);
        let width = job.frame.width;
        fragments.par_chunks_mut(width * height).enumerate().for_each(|(band, rows)| {
            let top = band * height;
            for triangle in &self.triangles {
                if job.control.is_cancelled() {
                    return;
                }
                for y in triangle.rows_within(top..top + height) {
                    let row = rows.chunks_mut(width).nth(y - top);
                    row.into_iter().for_each(|row| triangle.draw(&self.corners, y, offset, row));
                }
            }
        });
        if job.control.is_cancelled() { Err(MethodError::Cancelled) } else { Ok(()) }
    }
}

/// For each vertex, whether faces show its outer side and its inner side.
fn sides_seen(vertices: usize, faces: &[WorldFace]) -> Vec<bool> {
    let mut seen = vec![false; 2 * vertices];
    for face in faces {
        for corner in face.corners {
            let side = 2 * corner as usize + usize::from(face.start.inwards);
            seen.get_mut(side).into_iter().for_each(|seen| *seen = true);
        }
    }
    seen
}
