//! Bodies as faces, so many at a time that memory is bounded, and their way into the picture.

use glam::DVec2;
use rayon::prelude::*;

use crate::geometry::ray::RayOrigin;
use crate::raster::error::MethodError;
use crate::raster::pass::PassName;
use crate::raster::point_shader::{PointShader, ShadingPoint, vector};
use crate::raster::rasterizer::{
    CoveredRun, RUN, RunFilter, ScreenTriangle, TriangleCorner, VisibilityBuffer,
};
use crate::raster::sample_sums::PassTimer;
use crate::raster::shaded::clip::PartFace;
use crate::raster::shaded::faces::{FaceList, MeshCache, WorldFace, WorldVertex};
use crate::raster::shaded::fragments::BAND;
use crate::raster::shaded::{ShadingFrequency, ShadingJob};
use crate::simd::double::Mask64;
use crate::simd::vector::Vector;
use crate::simd::{Mask as _, SimdKernel, Width};
use crate::transport::counts::RayCounts;
use crate::transport::sampler::Sampler;
use crate::transport::scene::RenderScene;

/// Makes batches of the scene's bodies, one after the other.
pub(crate) struct BatchBuilder<'a> {
    job: &'a ShadingJob<'a>,
    meshes: MeshCache,
    /// The next body.
    next: u32,
}

/// Faces of some bodies, ready to be drawn.
pub(crate) struct FaceBatch {
    pub(crate) corners: Vec<TriangleCorner>,
    pub(crate) triangles: Vec<ScreenTriangle>,
    /// The triangles that each band of rows may show, in their order.
    bands: Vec<Vec<u32>>,
    bodies: u32,
    /// Whether no bodies follow.
    pub(crate) is_last: bool,
}

/// What is interpolated, of corners, and the rays that it took.
type VertexLights = (Vec<TriangleCorner>, RayCounts);

impl<'a> BatchBuilder<'a> {
    /// From so many vertices on, no further body is taken up.
    const MOST_VERTICES: usize = 1 << 17;

    pub(crate) fn new(job: &'a ShadingJob<'a>) -> Self {
        Self { job, meshes: MeshCache::default(), next: 0 }
    }

    /// Starts from the first body again.
    pub(crate) fn begin(&mut self) {
        self.next = 0;
    }

    /// The faces of the next bodies.
    pub(crate) fn batch(
        &mut self,
        clock: &mut PassTimer,
        counts: &mut RayCounts,
    ) -> Result<FaceBatch, MethodError> {
        let (job, first) = (self.job, self.next);
        let faces = clock.time(PassName::Tessellate, || self.faces());
        if job.control.is_cancelled() {
            return Err(MethodError::Cancelled);
        }
        let (corners, rays) = clock.time(PassName::Light, || match job.shading {
            ShadingFrequency::Flat => of_faces(job, &faces),
            ShadingFrequency::Gouraud | ShadingFrequency::Phong => of_vertices(job, &faces.vertices),
        });
        *counts += rays;
        let (triangles, bands) = clock.time(PassName::Rasterize, || {
            let triangles = triangles(job, &corners, &faces.faces);
            let bands = bands(job, &triangles);
            (triangles, bands)
        });
        let is_last = self.next as usize == job.scene.body_count();
        Ok(FaceBatch { corners, triangles, bands, bodies: self.next - first, is_last })
    }

    fn faces(&mut self) -> FaceList {
        let ShadingJob { scene, camera, settings, control, .. } = *self.job;
        let mut faces = FaceList::default();
        while (self.next as usize) < scene.body_count()
            && faces.vertices.len() < Self::MOST_VERTICES
            && !control.is_cancelled()
        {
            faces.add(scene, camera, self.next, settings.fineness, &mut self.meshes);
            self.next += 1;
        }
        faces
    }
}

/// The corners of flat faces, four for each: all have the light of the face's middle.
fn of_faces(job: &ShadingJob<'_>, all: &FaceList) -> VertexLights {
    in_chunks(job, &all.faces, |shader, faces, corners| {
        let middle = |face: &WorldFace| job.point(face.start, face.middle, face.normal);
        let points: Vec<ShadingPoint> = faces.iter().map(middle).collect();
        for (face, light) in faces.iter().zip(job.light_all(shader, &points)) {
            let values = [light.on_color, light.highlight];
            let vertices = face.corners.iter().filter_map(|&index| all.vertices.get(index as usize));
            corners.extend(vertices.map(|vertex| corner(job, vertex, values)));
        }
    })
}

/// The corners of other faces, which they share: two for each vertex, of the outer side and of the inner.
fn of_vertices(job: &ShadingJob<'_>, vertices: &[WorldVertex]) -> VertexLights {
    let sides = |vertex: &WorldVertex| {
        [false, true].into_iter().zip(vertex.seen).zip([vertex.normal, -vertex.normal])
    };
    in_chunks(job, vertices, |shader, vertices, corners| {
        let is_lit = |is_seen: bool| is_seen && job.shading != ShadingFrequency::Phong;
        let mut points = Vec::new();
        for vertex in vertices {
            for ((inwards, is_seen), normal) in sides(vertex) {
                if is_lit(is_seen) {
                    let start = RayOrigin { body: vertex.body, inwards };
                    points.push(job.point(start, vertex.position, normal));
                }
            }
        }
        let mut lights = job.light_all(shader, &points).into_iter();
        for vertex in vertices {
            for ((_, is_seen), normal) in sides(vertex) {
                let values = match is_lit(is_seen).then(|| lights.next()).flatten() {
                    Some(light) => [light.on_color, light.highlight],
                    None if job.shading == ShadingFrequency::Phong => {
                        [vector(vertex.position), vector(normal)]
                    }
                    None => [Vector::new(0.0, 0.0, 0.0); 2],
                };
                corners.push(corner(job, vertex, values));
            }
        }
    })
}

/// The place of a face's corner among those of [`of_faces`] or [`of_vertices`].
fn place(shading: ShadingFrequency, number: usize, face: &WorldFace, corner: usize) -> u32 {
    match shading {
        ShadingFrequency::Flat => (4 * number + corner) as u32,
        ShadingFrequency::Gouraud | ShadingFrequency::Phong => {
            2 * face.corners[corner] + u32::from(face.start.inwards)
        }
    }
}

fn corner(job: &ShadingJob<'_>, vertex: &WorldVertex, values: [Vector<f32>; 2]) -> TriangleCorner {
    let seen = job.projection.point(vertex.position);
    TriangleCorner { seen, values: [values[0], values[1], vertex.in_body].map(Vector::into) }
}

/// What `make` appends for the items, in their order, made on all threads. Lights are seen as if from no pixel.
fn in_chunks<T: Sync>(
    job: &ShadingJob<'_>,
    items: &[T],
    make: impl Fn(&mut PointShader<'_>, &[T], &mut Vec<TriangleCorner>) + Sync,
) -> VertexLights {
    /// Small enough to balance, large enough to be worth a task.
    const CHUNK: usize = 256;
    let chunks = items.par_chunks(CHUNK).map_init(
        || {
            let mut shader = PointShader::new(job.scene, job.camera);
            shader.begin_sample(Sampler::centered());
            shader
        },
        |shader, items| {
            let before = shader.counts();
            let mut corners = Vec::with_capacity(4 * items.len());
            make(shader, items, &mut corners);
            (corners, shader.counts() - before)
        },
    );
    let mut all = VertexLights::default();
    for (corners, counts) in chunks.collect::<Vec<VertexLights>>() {
        all.0.extend(corners);
        all.1 += counts;
    }
    all
}

/// Cuts the faces into triangles.
fn triangles(job: &ShadingJob<'_>, corners: &[TriangleCorner], faces: &[WorldFace]) -> Vec<ScreenTriangle> {
    let triangles = faces.par_iter().enumerate().flat_map_iter(|(number, face)| {
        let at = |corner| place(job.shading, number, face, corner);
        let halves = [[0, 1, 2], [0, 2, 3]].map(|half| half.map(at));
        let new = |half| ScreenTriangle::new(corners, half, face.start.word(), job.frame);
        let of_part = |mut triangle: ScreenTriangle| {
            triangle.outward = face.outward;
            triangle
        };
        halves.into_iter().filter_map(new).map(of_part)
    });
    triangles.collect()
}

/// The triangles that each band of rows may show.
fn bands(job: &ShadingJob<'_>, triangles: &[ScreenTriangle]) -> Vec<Vec<u32>> {
    let mut bands = vec![Vec::new(); job.frame.height.div_ceil(BAND)];
    for (triangle, number) in triangles.iter().zip(0..) {
        let rows = triangle.rows();
        let reached = bands.get_mut(rows.start / BAND..rows.end.div_ceil(BAND));
        reached.into_iter().flatten().for_each(|band| band.push(number));
    }
    bands
}

impl FaceBatch {
    /// Whether it has all bodies of the scene.
    pub(crate) fn is_all(&self, scene: &RenderScene) -> bool {
        self.bodies as usize == scene.body_count()
    }

    /// Draws the faces into the buffer of a sample, in which no others have numbers then.
    pub(crate) fn rasterize(
        &self,
        job: &ShadingJob<'_>,
        offset: DVec2,
        visible: &mut VisibilityBuffer,
    ) -> Result<(), MethodError> {
        visible.forget_triangles();
        let stride = visible.stride;
        let rows = visible.depths.par_chunks_mut(BAND * stride);
        let rows = rows.zip(visible.triangles.par_chunks_mut(BAND * stride));
        rows.zip(&self.bands).enumerate().for_each(|(band, ((depths, triangles), numbers))| {
            let kernel =
                BandKernel { job, batch: self, numbers, top: band * BAND, offset, stride, depths, triangles };
            job.scene.lanes.run_in_few(kernel);
        });
        if job.control.is_cancelled() { Err(MethodError::Cancelled) } else { Ok(()) }
    }
}

/// Draws some of the triangles of a batch into a band of rows.
struct BandKernel<'k> {
    job: &'k ShadingJob<'k>,
    batch: &'k FaceBatch,
    /// Of the triangles.
    numbers: &'k [u32],
    /// The first row.
    top: usize,
    offset: DVec2,
    stride: usize,
    depths: &'k mut [f64],
    triangles: &'k mut [u32],
}

impl SimdKernel for BandKernel<'_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Width>(self, _: W) {
        let Self { job, batch, numbers, top, offset, stride, depths, triangles } = self;
        for &number in numbers {
            if job.control.is_cancelled() {
                return;
            }
            let Some(triangle) = batch.triangles.get(number as usize) else { continue };
            let rows = triangle.rows();
            let part = PartFace::of(job.scene, triangle, &batch.corners, job.settings.fineness);
            let keep = part.as_ref().map(|part| {
                |run: &CoveredRun, nearer: Mask64<RUN>| Mask64::of_bits(part.kept(run, nearer.bits()))
            });
            let keep = keep.as_ref().map(|keep| keep as &RunFilter<'_>);
            for y in rows.start.max(top)..rows.end.min(top + BAND) {
                let row = (y - top) * stride..(y - top + 1) * stride;
                if let (Some(depths), Some(triangles)) = (depths.get_mut(row.clone()), triangles.get_mut(row))
                {
                    triangle.draw(number, (y, offset), depths, triangles, keep);
                }
            }
        }
    }
}
