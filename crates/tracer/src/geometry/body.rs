//! A body as the tracer meets it.

pub(crate) mod double;

use bytemuck::{Pod, Zeroable};
use catoptric_scene::{Body, BodyContact, Contact, Shadow};
use glam::{DAffine3, DMat3, DVec3};

use crate::geometry::body::double::Body64;
use crate::geometry::bounds::Bounds;
use crate::geometry::canonical::CanonicalBody;
use crate::geometry::hull::BoundingHull;
use crate::geometry::ray::{NO_BODY, POINT_ROUNDING};
use crate::geometry::shape::plane::span as plane_span;
use crate::geometry::shape::sphere::world_span as sphere_span;
use crate::geometry::shape::{CanonicalShape, ShapeKind, ShapeSpan};
use crate::geometry::space::RenderSpace;
use crate::geometry::sphere::BoundingSphere;
use crate::simd::Float;
use crate::simd::vector::Vector;

/// A body: a canonical shape and the transforms between its frame and the world.
///
/// Transforms are kept as a linear part and the frame's origin, and points go through `M·(p - origin)`: near the body
/// the difference is exact, so that precision does not depend on the distance from the world's origin.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct RenderBody {
    /// Rows of the linear part of the transform from the world to the body's frame. The second row of a plane is its
    /// normal of length 1.
    pub body_from_world: [[f32; 3]; 3],
    /// Rows of its inverse.
    pub world_from_body: [[f32; 3]; 3],
    /// The frame's origin in the world, meters.
    pub origin: [f32; 3],
    /// How far the surface may lie from its true place by rounding, meters.
    pub error_bound: f32,
    /// Cone: ratio of the smaller to the larger radius. Sphere: radius, meters. Joined body: its place among those, as bits.
    pub parameter: f32,
    /// Index into the scene's materials.
    pub material: u32,
    /// Place in the scene's patterns of its outermost one, or [`NO_BODY`].
    pub solid: u32,
    /// [`ShapeKind`] as a number.
    pub kind: u8,
    /// 1 if each axis of the frame is parallel to the same one of the world, else 0.
    pub aligned: u8,
    /// How rays and light pass, a sum of [`TRANSPARENT`], [`SHADOWLESS`] and [`FILTERS`]; and what lies between the body and
    /// others that it touches, of [`CEMENTABLE`] and [`CEMENTS`].
    pub passes: u8,
    /// 1 if it is intersected in double precision, by a [`Body64`]; the numbers here are its rough ones.
    pub double: u8,
}

/// Rays pass through the body.
pub(crate) const TRANSPARENT: u8 = 1;
/// Light on its way to other bodies passes as if this one were not there.
pub(crate) const SHADOWLESS: u8 = 2;
/// What the surfaces and the inside of the body let through of such light passes.
pub(crate) const FILTERS: u8 = 4;
/// Nothing lies between the body and another that it touches, if both are cementable and one of them cements.
pub(crate) const CEMENTABLE: u8 = 8;
pub(crate) const CEMENTS: u8 = 16;

/// How rays and light pass a body, as [`RenderBody::passes`] has it.
pub(crate) fn passage(is_transparent: bool, shadow: Shadow) -> u8 {
    let of_rays = if is_transparent { TRANSPARENT } else { 0 };
    let of_light = match shadow {
        Shadow::Filtered if is_transparent => FILTERS,
        Shadow::None => SHADOWLESS,
        Shadow::Filtered | Shadow::Full => 0,
    };
    of_rays | of_light
}

/// What lies between a body and others that it touches, as [`RenderBody::passes`] has it: [`Contact::between`] in bits.
pub(crate) fn contact_bits(scene: Contact, body: BodyContact) -> u8 {
    match (body, scene) {
        (BodyContact::Air, _) => 0,
        (BodyContact::Scene, Contact::Air) => CEMENTABLE,
        (BodyContact::Cemented, _) | (BodyContact::Scene, Contact::Cemented) => CEMENTABLE | CEMENTS,
    }
}

/// A body made ready for a scene: opaque, without a pattern, of the first material.
pub(crate) struct PreparedBody {
    pub(crate) body: RenderBody,
    /// `None` for a plane.
    pub(crate) bounds: Option<Bounds>,
    /// Its exact numbers, if those of single precision will not do.
    pub(crate) double: Option<Box<Body64>>,
}

impl RenderBody {
    /// One that no ray meets.
    pub(crate) const NONE: Self = Self {
        body_from_world: [[0.0; 3]; 3],
        world_from_body: [[0.0; 3]; 3],
        origin: [0.0; 3],
        error_bound: 0.0,
        parameter: 0.0,
        material: 0,
        solid: NO_BODY,
        kind: ShapeKind::Sphere as u8,
        aligned: 1,
        passes: 0,
        double: 0,
    };

    /// A joined body, the place of which among those is `number`, within the cube that a frame carries to the space of the
    /// rays; without one, of a body that has no end. `error_bound` is the largest of its parts.
    pub(crate) fn joined(number: u32, box_frame: Option<DAffine3>, error_bound: f32) -> Self {
        let kind = if box_frame.is_some() { ShapeKind::Joined } else { ShapeKind::JoinedEndless };
        let frame = box_frame.unwrap_or(DAffine3::ZERO);
        let world_from_body = rows(&frame.matrix3);
        Self {
            world_from_body,
            origin: frame.translation.as_vec3().to_array(),
            error_bound,
            parameter: f32::from_bits(number),
            kind: kind as u8,
            aligned: u8::from(is_diagonal(&world_from_body)),
            ..Self::NONE
        }
    }

    /// A body that is not compound in the space of a scene's rays.
    pub(crate) fn prepare(body: &Body, space: &RenderSpace) -> PreparedBody {
        Self::prepare_shape(&CanonicalBody::of(body), space)
    }

    /// A shape in the space of a scene's rays.
    pub(crate) fn prepare_shape(canonical: &CanonicalBody, space: &RenderSpace) -> PreparedBody {
        let CanonicalShape { kind, cone_ratio } = canonical.shape;
        let mut world_from_body = canonical.world_from_canonical;
        let mut is_double = space.needs_double(canonical);
        if kind == ShapeKind::Plane {
            match space.frame_near(canonical) {
                Some((near, _)) => world_from_body = near,
                None => is_double = true,
            }
        }
        // From here on the world is that of the rays.
        world_from_body.translation = space.render_from_world(world_from_body.translation);
        let double = is_double.then(|| Box::new(Body64::new(canonical.shape, &world_from_body)));
        let mut inverse = inverse_linear(&world_from_body.matrix3);
        if kind == ShapeKind::Plane {
            // How far up from it is no matter: the row is kept as the normal.
            inverse = inverse.transpose();
            inverse.y_axis = inverse.y_axis.normalize_or(DVec3::Y);
            inverse = inverse.transpose();
        }
        let extent = match kind {
            ShapeKind::Plane => 0.0,
            _ => world_from_body.matrix3.to_cols_array().iter().fold(0.0_f64, |most, x| most.max(x.abs())),
        };
        let radius = world_from_body.matrix3.x_axis.length() as f32;
        let (body_from_world, world_from_body_rows) = (rows(&inverse), rows(&world_from_body.matrix3));
        let prepared = Self {
            body_from_world,
            world_from_body: world_from_body_rows,
            origin: world_from_body.translation.as_vec3().to_array(),
            error_bound: match &double {
                Some(double) => double.error_bound() as f32,
                None => POINT_ROUNDING * (world_from_body.translation.abs().max_element() + extent) as f32,
            },
            parameter: if kind == ShapeKind::Sphere { radius } else { cone_ratio as f32 },
            material: 0,
            solid: NO_BODY,
            kind: kind as u8,
            aligned: u8::from([body_from_world, world_from_body_rows].iter().all(is_diagonal)),
            passes: 0,
            double: u8::from(is_double),
        };
        let bounds = Bounds::of_canonical(&world_from_body, kind, f64::from(cone_ratio as f32));
        PreparedBody { body: prepared, bounds, double }
    }

    /// The bounds of the body as it is kept; `None` for a plane.
    pub(crate) fn bounds(&self) -> Option<Bounds> {
        let (transform, kind, ratio) = self.frame();
        Bounds::of_canonical(&transform, kind, ratio)
    }

    /// The sphere around the body as it is kept; that of a plane is infinite.
    pub(crate) fn bounding_sphere(&self) -> BoundingSphere {
        let (transform, kind, ratio) = self.frame();
        BoundingSphere::of_canonical(&transform, kind, ratio)
    }

    /// A hull around the body as it is kept; `None` for a plane.
    pub(crate) fn hull(&self) -> Option<BoundingHull> {
        let (transform, kind, ratio) = self.frame();
        BoundingHull::of_canonical(&transform, kind, ratio)
    }

    /// The transform from the body's frame to the world, and its shape there.
    fn frame(&self) -> (DAffine3, ShapeKind, f64) {
        let transform =
            DAffine3 { matrix3: self.linear(), translation: DVec3::from(self.origin.map(f64::from)) };
        let CanonicalShape { kind, cone_ratio } = self.canonical();
        (transform, kind, f64::from(cone_ratio))
    }

    /// The linear part of the transform from the body's frame to the world.
    fn linear(&self) -> DMat3 {
        DMat3::from_cols_array_2d(&self.world_from_body.map(|row| row.map(f64::from))).transpose()
    }

    /// Volume in cubic meters, infinite for a plane; decides which of several bodies is the outer one.
    pub(crate) fn volume(&self) -> f64 {
        let CanonicalShape { kind, cone_ratio } = self.canonical();
        let canonical = kind.solid().volume(f64::from(cone_ratio));
        canonical * self.linear().determinant().abs()
    }

    /// The body's shape in its own frame.
    #[inline(always)]
    pub(crate) fn canonical(&self) -> CanonicalShape {
        let kind = match self.kind {
            0 => ShapeKind::Sphere,
            1 => ShapeKind::Cube,
            2 => ShapeKind::Cylinder,
            3 => ShapeKind::Cone,
            4 => ShapeKind::Plane,
            6 => ShapeKind::Paraboloid,
            7 => ShapeKind::Joined,
            8 => ShapeKind::JoinedEndless,
            _ => ShapeKind::Ellipsoid,
        };
        CanonicalShape { kind, cone_ratio: self.parameter }
    }

    /// The longest axis of the frame, meters; 0 for what is not [in single precision](Self::is_double) or has no end.
    pub(crate) fn extent(&self) -> f64 {
        if self.is_double() || self.canonical().kind == ShapeKind::Plane {
            return 0.0;
        }
        let DMat3 { x_axis, y_axis, z_axis } = self.linear();
        x_axis.length().max(y_axis.length()).max(z_axis.length())
    }

    /// Whether the body is joined of others: where rays meet it is asked of its parts.
    #[inline(always)]
    pub(crate) fn is_joined(&self) -> bool {
        self.kind >= ShapeKind::Joined as u8
    }

    /// Gives a joined body its place among those.
    pub(crate) fn set_joined_number(&mut self, number: u32) {
        self.parameter = f32::from_bits(number);
    }

    /// The place of a joined body among those.
    pub(crate) fn joined_number(&self) -> usize {
        self.parameter.to_bits() as usize
    }

    /// Whether the body is intersected in double precision.
    #[inline(always)]
    pub(crate) fn is_double(&self) -> bool {
        self.double != 0
    }

    /// Whether the pattern of the body looks at points of the space of the rays, not of the body's frame.
    pub(crate) fn sees_solid_in_world(&self) -> bool {
        self.is_double() && self.solid != NO_BODY
    }

    /// Whether rays pass through the body.
    #[inline(always)]
    pub(crate) fn is_transparent(&self) -> bool {
        self.passes & TRANSPARENT != 0
    }

    /// Whether light on its way to other bodies passes as if this one were not there.
    #[inline(always)]
    pub(crate) fn is_shadowless(&self) -> bool {
        self.passes & SHADOWLESS != 0
    }

    /// Whether the body may take light on its way to others along the way within it.
    #[inline(always)]
    pub(crate) fn takes_light_within(&self) -> bool {
        self.passes & FILTERS != 0
    }

    /// Whether light on its way to other bodies ends at this one.
    #[inline(always)]
    pub(crate) fn stops_light(&self) -> bool {
        self.passes & (SHADOWLESS | FILTERS) == 0
    }

    /// Whether nothing lies between the body and others that it touches, unless they want air.
    pub(crate) fn cements(&self) -> bool {
        self.passes & CEMENTS != 0
    }

    /// Whether nothing may lie between the body and another that it touches.
    pub(crate) fn is_cementable(&self) -> bool {
        self.passes & CEMENTABLE != 0
    }

    /// Whether nothing lies between the body and another where they touch.
    pub(crate) fn is_cemented_to(&self, other: &Self) -> bool {
        self.passes & other.passes & CEMENTABLE != 0 && (self.passes | other.passes) & CEMENTS != 0
    }

    /// Where a line of the world, of a direction of length 1, crosses the body.
    #[inline(always)]
    pub(crate) fn span<R: Float>(&self, origin: Vector<R>, direction: Vector<R>) -> ShapeSpan<R> {
        let canonical = self.canonical();
        let local = self.relative(origin);
        match canonical.kind {
            ShapeKind::Sphere => sphere_span(self.parameter, local, direction),
            ShapeKind::Plane => {
                let [_, up, _] = self.body_from_world;
                plane_span(along(up, local), along(up, direction))
            }
            _ => canonical.like(local.x).span(self.vector_in_body(local), self.vector_in_body(direction)),
        }
    }

    /// The lines, if the body is a half-space, that run within it along its surface: they never leave it.
    #[inline(always)]
    pub(crate) fn holds_parallel<R: Float>(
        &self,
        origin: Vector<R>,
        direction: Vector<R>,
    ) -> Option<R::Mask> {
        let [_, up, _] = self.body_from_world;
        let zero = origin.x.like(0.0);
        let is_plane = self.kind == ShapeKind::Plane as u8;
        is_plane.then(|| along(up, direction).eq(zero) & along(up, self.relative(origin)).le(zero))
    }

    /// |cos| of the angle between a line of the world and the normal of the face that it crosses at `t`.
    #[inline(always)]
    pub(crate) fn cosine<R: Float>(&self, origin: Vector<R>, direction: Vector<R>, t: R, face: R) -> R {
        let point = self.point_in_body(origin).plus_times(self.vector_in_body(direction), t);
        let normal = self.normal_in_world(self.canonical().like(face).normal(face, point));
        normal.normalize_or(Vector::splat(t, [0.0; 3])).dot(direction).abs()
    }

    /// Whether a point of the world lies in the body.
    pub(crate) fn contains(&self, point: Vector<f32>) -> bool {
        self.canonical().contains(self.point_in_body(point))
    }

    #[inline(always)]
    fn relative<R: Float>(&self, point: Vector<R>) -> Vector<R> {
        let [x, y, z] = self.origin;
        Vector::new(point.x - x, point.y - y, point.z - z)
    }

    #[inline(always)]
    pub(crate) fn point_in_body<R: Float>(&self, point: Vector<R>) -> Vector<R> {
        self.vector_in_body(self.relative(point))
    }

    /// The linear part of the way into the body's frame.
    #[inline(always)]
    fn vector_in_body<R: Float>(&self, v: Vector<R>) -> Vector<R> {
        if self.aligned == 1 { scale(&self.body_from_world, v) } else { mul(&self.body_from_world, v) }
    }

    #[inline(always)]
    fn vector_in_world<R: Float>(&self, v: Vector<R>) -> Vector<R> {
        if self.aligned == 1 { scale(&self.world_from_body, v) } else { mul(&self.world_from_body, v) }
    }

    /// Normals go back by the inverse transpose.
    #[inline(always)]
    fn normal_in_world<R: Float>(&self, v: Vector<R>) -> Vector<R> {
        if self.aligned == 1 {
            scale(&self.body_from_world, v)
        } else {
            mul_transposed(&self.body_from_world, v)
        }
    }

    /// The point where a line of the world, of a direction of length 1, crosses this face of the body at parameter `t`, on
    /// the way out where it is `leaving`, pulled onto the surface, and the normal there, facing the line's start.
    ///
    /// All is computed in the body's frame, where numbers are small.
    #[inline(always)]
    pub(crate) fn point_on_face<R: Float>(
        &self,
        (origin, direction): (Vector<R>, Vector<R>),
        t: R,
        leaving: R::Mask,
        face: R,
    ) -> SurfacePoint<R> {
        let canonical = self.canonical();
        if canonical.kind == ShapeKind::Sphere {
            let up = Vector::splat(t, [0.0, 1.0, 0.0]);
            let normal = self.relative(origin).plus_times(direction, t).normalize_or(up);
            let around = normal * t.like(self.parameter);
            let in_body = self.vector_in_body(around);
            let normal = Vector::select(leaving, -normal, normal);
            return SurfacePoint { in_body, in_world: around.plus_all(self.origin), normal };
        }
        let origin = self.point_in_body(origin);
        let direction = self.vector_in_body(direction);
        if canonical.kind == ShapeKind::Plane {
            let zero = t.like(0.0);
            let in_body = origin.plus_times(direction, t);
            let in_body = Vector::new(in_body.x, zero, in_body.z);
            let in_world = self.vector_in_world(in_body).plus_all(self.origin);
            let normal = Vector::splat(t, self.body_from_world[1]);
            return SurfacePoint { in_body, in_world, normal: Vector::select(leaving, -normal, normal) };
        }
        let canonical = canonical.like(t);
        let in_body = canonical.pull_to_surface(face, origin.plus_times(direction, t));
        let in_world = self.vector_in_world(in_body).plus_all(self.origin);
        let normal = self.normal_in_world(canonical.normal(face, in_body));
        let normal = normal.normalize_or(Vector::splat(t, [0.0, 1.0, 0.0]));
        SurfacePoint { in_body, in_world, normal: Vector::select(leaving, -normal, normal) }
    }
}

/// A point on a body's surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfacePoint<R> {
    pub in_body: Vector<R>,
    pub in_world: Vector<R>,
    /// Unit normal in the world, facing where the line came from.
    pub normal: Vector<R>,
}

impl<R: Float> SurfacePoint<R> {
    /// The point as the pattern of its body wants it.
    #[inline(always)]
    pub(crate) fn on_solid(&self, body: &RenderBody) -> Vector<R> {
        if body.is_double() { self.in_world } else { self.in_body }
    }
}

/// The product of a matrix given by rows with a vector.
#[inline(always)]
pub(crate) fn mul<R: Float>(rows: &[[f32; 3]; 3], v: Vector<R>) -> Vector<R> {
    Vector::new(along(rows[0], v), along(rows[1], v), along(rows[2], v))
}

/// The product of a diagonal matrix, given by rows, with a vector. Adding 0 takes the sign from a zero, as the other terms would: a line along a layer
/// has one side of it only.
#[inline(always)]
pub(crate) fn scale<R: Float>([a, b, c]: &[[f32; 3]; 3], v: Vector<R>) -> Vector<R> {
    scale_plus([a[0], b[1], c[2]], v, [0.0; 3])
}

/// The product with these factors, component by component, and a vector added to it.
#[inline(always)]
pub(crate) fn scale_plus<R: Float>(factors: [f32; 3], v: Vector<R>, term: [f32; 3]) -> Vector<R> {
    let (factors, term) = (Vector::splat(v.x, factors), Vector::splat(v.x, term));
    Vector::new(
        v.x.times_plus(factors.x, term.x),
        v.y.times_plus(factors.y, term.y),
        v.z.times_plus(factors.z, term.z),
    )
}

pub(crate) fn is_diagonal(rows: &[[f32; 3]; 3]) -> bool {
    let off = |(row, numbers): (usize, &[f32; 3])| {
        numbers.iter().enumerate().all(|(column, &number)| row == column || number == 0.0)
    };
    rows.iter().enumerate().all(off)
}

#[inline(always)]
fn along<R: Float>([x, y, z]: [f32; 3], v: Vector<R>) -> R {
    v.dot(Vector::splat(v.x, [x, y, z]))
}

/// The product of the transpose of a matrix given by rows with a vector.
#[inline(always)]
fn mul_transposed<R: Float>([a, b, c]: &[[f32; 3]; 3], v: Vector<R>) -> Vector<R> {
    let column = |axis: usize| along([a[axis], b[axis], c[axis]], v);
    Vector::new(column(0), column(1), column(2))
}

pub(crate) fn rows(matrix: &DMat3) -> [[f32; 3]; 3] {
    matrix.transpose().to_cols_array_2d().map(|row| row.map(|number| number as f32))
}

/// The inverse, computed on columns scaled to length 1, so that neither tiny nor huge bodies overflow on the way.
pub(crate) fn inverse_linear(matrix: &DMat3) -> DMat3 {
    let scale = DVec3::new(matrix.x_axis.length(), matrix.y_axis.length(), matrix.z_axis.length());
    let unit = DMat3::from_cols(matrix.x_axis / scale.x, matrix.y_axis / scale.y, matrix.z_axis / scale.z);
    DMat3::from_diagonal(scale.recip()) * unit.inverse()
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{Anchor, Placement, Shape};
    use proptest::prelude::*;

    use super::*;

    fn point(extent: f64) -> impl Strategy<Value = DVec3> {
        [-extent..extent, -extent..extent, -extent..extent].prop_map(DVec3::from)
    }

    fn body(shape: Shape, position: DVec3, scale: DVec3, rotation_degrees: DVec3) -> RenderBody {
        let anchor = Anchor::Frame { position, rotation_degrees };
        let body = Body { shape, placement: Placement { anchor, scale }, ..Body::default() };
        RenderBody::prepare(&body, &RenderSpace::default()).body
    }

    proptest! {
        /// The shorter way through a frame along the world's axes leads to the same points.
        #[test]
        fn aligned_frames_are_frames(
            shape in 0..5_usize,
            position in point(10.0),
            scale in [0.1..5.0_f64, 0.1..5.0, 0.1..5.0].prop_map(DVec3::from),
            eye in point(20.0),
            aim in point(1.0),
        ) {
            let shape = [
                Shape::Sphere { radius: 1.0 },
                Shape::Cube { size: DVec3::splat(2.0) },
                Shape::Cylinder { radius: 1.0, height: 2.0 },
                Shape::Cone { radius: 1.0, top_radius: 0.5, height: 2.0 },
                Shape::PARABOLOID,
            ][shape];
            let aligned = body(shape, position, scale, DVec3::ZERO);
            prop_assert_eq!(aligned.aligned, 1);
            prop_assert_eq!(body(shape, position, scale, DVec3::new(0.0, 30.0, 0.0)).aligned, 0);
            let any = RenderBody { aligned: 0, ..aligned };
            let direction = (position + aim - eye).normalize().as_vec3().into();
            let eye = eye.as_vec3().into();
            let [span, other] = [aligned, any].map(|body| body.span(eye, direction));
            prop_assert_eq!(span.hit, other.hit);
            if span.hit {
                let all = |span: ShapeSpan| [span.enter, span.exit, span.enter_face, span.exit_face];
                prop_assert_eq!(all(span), all(other));
                let [here, there] = [aligned, any].map(|body| {
                    let point = body.point_on_face((eye, direction), span.enter, false, span.enter_face);
                    [point.in_body, point.in_world, point.normal].map(|v| [v.x, v.y, v.z])
                });
                prop_assert_eq!(here, there);
            }
        }
    }
}
