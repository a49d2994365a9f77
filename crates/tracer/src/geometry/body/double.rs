//! Bodies in double precision: those whose numbers do not fit single precision, as [`RenderSpace`] finds.
//!
//! They are met as all others are, by the same formulas, but lane by lane in double precision, from the rays in single: a
//! ray's start is exact beside the eye, and only the body's own numbers are too large or too small.
//!
//! [`RenderSpace`]: crate::geometry::space::RenderSpace

use glam::{DAffine3, DMat3, DVec3};

use crate::geometry::body::{SurfacePoint, inverse_linear};
use crate::geometry::shape::{CanonicalShape, ShapeSpan};
use crate::simd::double::Float64;
use crate::simd::vector::Vector;
use crate::simd::{Float as _, Float32, MOST_LANES, Mask as _, Width};

/// So many lanes are looked at together.
const CHUNK: usize = 8;

/// A body's shape and its transforms, in double precision.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Body64 {
    shape: CanonicalShape<f64>,
    /// Rows of the linear part of the transform from the space of the rays to the body's frame, and of its inverse.
    body_from_world: [[f64; 3]; 3],
    world_from_body: [[f64; 3]; 3],
    /// The frame's origin in the space of the rays, meters.
    origin: [f64; 3],
}

/// How far its surface may lie from its true place by rounding, as a share of its largest coordinate.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

impl Body64 {
    /// The shape that `render_from_canonical` carries to the space of the rays.
    pub(crate) fn new(shape: CanonicalShape<f64>, render_from_canonical: &DAffine3) -> Self {
        let rows = |matrix: &DMat3| matrix.transpose().to_cols_array_2d();
        Self {
            shape,
            body_from_world: rows(&inverse_linear(&render_from_canonical.matrix3)),
            world_from_body: rows(&render_from_canonical.matrix3),
            origin: render_from_canonical.translation.to_array(),
        }
    }

    /// How far the surface may lie from its true place by rounding, meters.
    pub(crate) fn error_bound(&self) -> f64 {
        let extent = self.world_from_body.as_flattened().iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        ROUNDING * (DVec3::from(self.origin).abs().max_element() + extent)
    }

    /// Whether a point lies in the body.
    pub(crate) fn contains(&self, point: Vector<f32>) -> bool {
        let point = self.point_in_body(&Vector::new(
            Float64([f64::from(point.x)]),
            Float64([f64::from(point.y)]),
            Float64([f64::from(point.z)]),
        ));
        self.shape().contains(point).any()
    }

    /// Where lines cross the body, as [`RenderBody::span`](super::RenderBody::span).
    #[cold]
    #[inline(never)]
    pub(crate) fn span<W: Width>(
        &self,
        w: W,
        origin: Vector<W::R>,
        direction: Vector<W::R>,
    ) -> ShapeSpan<W::R> {
        let rays = LineRows::of(&origin, &direction);
        let mut found = ShapeSpanRows::default();
        w.run(
            #[inline(always)]
            || match W::LANES {
                1 => self.span_of::<1>(&rays, 0, &mut found),
                4 => self.span_of::<4>(&rays, 0, &mut found),
                lanes => (0..lanes).step_by(CHUNK).for_each(
                    #[inline(always)]
                    |at| self.span_of::<CHUNK>(&rays, at, &mut found),
                ),
            },
        );
        ShapeSpan {
            enter: w.load(&found.enter),
            exit: w.load(&found.exit),
            enter_face: w.load(&found.enter_face),
            exit_face: w.load(&found.exit_face),
            hit: w.mask(found.hit),
        }
    }

    /// |cos| of the angles between lines and the normals where they enter and where they leave.
    #[cold]
    #[inline(never)]
    pub(crate) fn cosines<W: Width>(&self, w: W, origin: Vector<W::R>, direction: Vector<W::R>) -> [W::R; 2] {
        let rays = LineRows::of(&origin, &direction);
        let mut found = [[0.0; MOST_LANES]; 2];
        for lane in 0..W::LANES {
            let (origin, direction) = rays.take::<1>(lane);
            let span = self.local_span(&origin, &direction);
            for (found, (t, face)) in
                found.iter_mut().zip([(span.enter, span.enter_face), (span.exit, span.exit_face)])
            {
                let normal = self.surface(&origin, &direction, t, face).1;
                found[lane] = normal.dot(direction).abs().0[0] as f32;
            }
        }
        found.map(|found| w.load(&found))
    }

    /// The points where lines cross the surface, on the way out where they are `leaving`; as
    /// [`RenderBody::point_on_face`](super::RenderBody::point_on_face), but that it finds parameters and faces anew: in
    /// single precision they are not exact enough.
    #[cold]
    #[inline(never)]
    pub(crate) fn surface_point<W: Width>(
        &self,
        w: W,
        origin: Vector<W::R>,
        direction: Vector<W::R>,
        leaving: W::M,
    ) -> SurfacePoint<W::R> {
        let rays = LineRows::of(&origin, &direction);
        let mut found = [[[0.0; MOST_LANES]; 3]; 3];
        let leaving = leaving.bits();
        for lane in 0..W::LANES {
            let (origin, direction) = rays.take::<1>(lane);
            let span = self.local_span(&origin, &direction);
            let leaves = leaving >> lane & 1 == 1;
            let (t, face) = if leaves { (span.exit, span.exit_face) } else { (span.enter, span.enter_face) };
            let (in_body, normal) = self.surface(&origin, &direction, t, face);
            let in_world = self.point_in_world(&in_body);
            let normal = if leaves { -normal } else { normal };
            for (rows, Vector { x, y, z }) in found.iter_mut().zip([in_body, in_world, normal]) {
                for (row, number) in rows.iter_mut().zip([x, y, z]) {
                    row[lane] = number.0[0] as f32;
                }
            }
        }
        let [in_body, in_world, normal] =
            found.map(|[x, y, z]| Vector::new(w.load(&x), w.load(&y), w.load(&z)));
        SurfacePoint { in_body, in_world, normal }
    }

    /// The point of a face at a parameter of a line, pulled onto the surface, in the body's frame; and the normal of length 1
    /// there, in the space of the rays.
    fn surface(
        &self,
        origin: &Vector<Float64<1>>,
        direction: &Vector<Float64<1>>,
        t: Float64<1>,
        face: Float64<1>,
    ) -> (Vector<Float64<1>>, Vector<Float64<1>>) {
        let shape = self.shape();
        let at = self.point_in_body(origin).plus_times(product(&self.body_from_world, direction), t);
        let at = shape.pull_to_surface(face, at);
        let Vector { x, y, z } = shape.normal(face, at);
        // Normals go back by the inverse transpose.
        let normal = DMat3::from_cols_array_2d(&self.body_from_world) * DVec3::new(x.0[0], y.0[0], z.0[0]);
        let normal = normal.normalize_or(DVec3::Y);
        (at, Vector::new(Float64([normal.x]), Float64([normal.y]), Float64([normal.z])))
    }

    #[inline(always)]
    fn shape<const N: usize>(&self) -> CanonicalShape<Float64<N>> {
        let CanonicalShape { kind, cone_ratio } = self.shape;
        CanonicalShape { kind, cone_ratio: Float64([cone_ratio; N]) }
    }

    #[inline(always)]
    fn local_span<const N: usize>(
        &self,
        origin: &Vector<Float64<N>>,
        direction: &Vector<Float64<N>>,
    ) -> ShapeSpan<Float64<N>> {
        let origin = self.point_in_body(origin);
        self.shape().span(origin, product(&self.body_from_world, direction))
    }

    #[inline(always)]
    fn span_of<const N: usize>(&self, rays: &LineRows, at: usize, found: &mut ShapeSpanRows) {
        let (origin, direction) = rays.take::<N>(at);
        let span = self.local_span(&origin, &direction);
        let rows = [
            (&mut found.enter, span.enter),
            (&mut found.exit, span.exit),
            (&mut found.enter_face, span.enter_face),
            (&mut found.exit_face, span.exit_face),
        ];
        for (row, numbers) in rows {
            for lane in 0..N {
                row[at + lane] = numbers.0[lane] as f32;
            }
        }
        found.hit |= span.hit.bits() << at;
    }

    #[inline(always)]
    fn point_in_body<const N: usize>(&self, point: &Vector<Float64<N>>) -> Vector<Float64<N>> {
        let [x, y, z] = self.origin.map(|number| Float64([number; N]));
        product(&self.body_from_world, &(*point - Vector::new(x, y, z)))
    }

    fn point_in_world(&self, point: &Vector<Float64<1>>) -> Vector<Float64<1>> {
        let [x, y, z] = self.origin.map(|number| Float64([number]));
        product(&self.world_from_body, point) + Vector::new(x, y, z)
    }
}

/// The product of a matrix given by rows with vectors.
#[inline(always)]
fn product<const N: usize>(rows: &[[f64; 3]; 3], v: &Vector<Float64<N>>) -> Vector<Float64<N>> {
    let [x, y, z] = [0, 1, 2].map(
        #[inline(always)]
        |row| {
            let [a, b, c] = rows[row].map(|number| Float64([number; N]));
            a * v.x + b * v.y + c * v.z
        },
    );
    Vector::new(x, y, z)
}

/// Lines side by side: the components of their origins and directions.
struct LineRows([[f32; MOST_LANES]; 6]);

impl LineRows {
    #[inline(always)]
    fn of<R: Float32>(origin: &Vector<R>, direction: &Vector<R>) -> Self {
        let mut rows = [[0.0; MOST_LANES]; 6];
        let numbers = [origin.x, origin.y, origin.z, direction.x, direction.y, direction.z];
        for (row, numbers) in rows.iter_mut().zip(numbers) {
            numbers.store(row);
        }
        Self(rows)
    }

    /// The origins and directions of so many lines from number `at` on.
    #[inline(always)]
    fn take<const N: usize>(&self, at: usize) -> (Vector<Float64<N>>, Vector<Float64<N>>) {
        let number = |row: usize| {
            let mut numbers = Float64([0.0; N]);
            for lane in 0..N {
                numbers.0[lane] = f64::from(self.0[row][at + lane]);
            }
            numbers
        };
        let vector = |row: usize| Vector::new(number(row), number(row + 1), number(row + 2));
        (vector(0), vector(3))
    }
}

#[derive(Default)]
struct ShapeSpanRows {
    enter: [f32; MOST_LANES],
    exit: [f32; MOST_LANES],
    enter_face: [f32; MOST_LANES],
    exit_face: [f32; MOST_LANES],
    hit: u32,
}

/// Bodies of a scene in double precision, by their places there, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bodies64(Vec<(u32, Body64)>);

impl Bodies64 {
    /// Of a list in the order of the places.
    pub(crate) fn new(bodies: Vec<(u32, Body64)>) -> Self {
        Self(bodies)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn get(&self, scene_index: u32) -> Option<&Body64> {
        let at = self.0.binary_search_by_key(&scene_index, |body| body.0).ok()?;
        self.0.get(at).map(|body| &body.1)
    }
}
