//! A body as the tracer meets it.

use bytemuck::{Pod, Zeroable};
use catoptric_scene::{Body, Shape};
use glam::{DAffine3, DMat3, DVec3, Vec3A, Vec3Swizzles, Vec4};

use super::Bounds;
use crate::ray::{NO_BODY, POINT_ROUNDING};
use crate::shape::{Canonical, Face, ShapeKind, Span};

/// A body: a canonical shape and the transforms between its frame and the world.
///
/// Transforms are kept as a linear part and the frame's origin, and points go through `M·(p - origin)`: near the body
/// the difference is exact, so that precision does not depend on the distance from the world's origin.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C, align(16))]
pub(crate) struct StageBody {
    /// Columns of the linear part of the transform from the world to the body's frame; the fourth numbers are 0.
    pub body_from_world: [[f32; 4]; 3],
    /// Columns of its inverse.
    pub world_from_body: [[f32; 4]; 3],
    /// The frame's origin in the world, meters.
    pub origin: [f32; 4],
    /// [`ShapeKind`] as a number.
    pub kind: u32,
    /// Ratio of the smaller to the larger radius; cones only.
    pub cone_ratio: f32,
    /// Index into the stage's materials.
    pub material: u32,
    /// Index into the stage's checkers, or [`NO_BODY`].
    pub checker: u32,
    /// 1 if light passes through, else 0.
    pub transparent: u32,
    /// How far the surface may lie from its true place by rounding, meters.
    pub slack: f32,
    /// Volume in cubic meters, infinite for a plane; decides which of several bodies is the outer one.
    pub volume: f32,
    /// Zero; makes the size a multiple of 16 bytes.
    pub unused: u32,
}

impl StageBody {
    /// An opaque body without a checker, of the first material; and its bounds, if it has any.
    pub(super) fn new(body: &Body) -> (Self, Option<Bounds>) {
        let world_from_body = world_from_canonical(body);
        let inverse = inverse_linear(&world_from_body.matrix3);
        let (kind, cone_ratio) = canonical(&body.shape);
        let extent = match kind {
            ShapeKind::Plane => 0.0,
            _ => world_from_body.matrix3.to_cols_array().iter().fold(0.0_f64, |most, x| most.max(x.abs())),
        };
        let prepared = Self {
            body_from_world: columns(&inverse),
            world_from_body: columns(&world_from_body.matrix3),
            origin: world_from_body.translation.as_vec3().extend(0.0).to_array(),
            kind: kind as u32,
            cone_ratio,
            material: 0,
            checker: NO_BODY,
            transparent: 0,
            slack: POINT_ROUNDING * (world_from_body.translation.abs().max_element() + extent) as f32,
            volume: volume(kind, f64::from(cone_ratio), world_from_body.matrix3.determinant()) as f32,
            unused: 0,
        };
        (prepared, Bounds::of_canonical(&world_from_body, kind, f64::from(cone_ratio)))
    }

    /// The bounds of the body as it is kept; `None` for a plane.
    pub(super) fn bounds(&self) -> Option<Bounds> {
        let [x, y, z] = self.world_from_body.map(|column| vec3a(column).as_dvec3());
        let transform = DAffine3::from_cols(x, y, z, vec3a(self.origin).as_dvec3());
        let Canonical { kind, cone_ratio } = self.canonical();
        Bounds::of_canonical(&transform, kind, f64::from(cone_ratio))
    }

    /// The body's shape in its own frame.
    #[inline]
    pub(crate) fn canonical(&self) -> Canonical {
        let kind = match self.kind {
            0 => ShapeKind::Sphere,
            1 => ShapeKind::Cube,
            2 => ShapeKind::Cylinder,
            3 => ShapeKind::Cone,
            _ => ShapeKind::Plane,
        };
        Canonical { kind, cone_ratio: self.cone_ratio }
    }

    /// Whether light passes through the body.
    #[inline]
    pub(crate) fn is_transparent(&self) -> bool {
        self.transparent != 0
    }

    /// Where a line of the world crosses the body.
    #[inline(always)]
    pub(crate) fn span(&self, origin: Vec3A, direction: Vec3A) -> Span {
        self.canonical().span(self.point_in_body(origin), mul(&self.body_from_world, direction))
    }

    /// |cos| of the angle between a line of the world and the normal of the face that it crosses at `t`.
    pub(crate) fn cosine(&self, origin: Vec3A, direction: Vec3A, t: f32, face: Face) -> f32 {
        let canonical = self.canonical();
        let point = self.point_in_body(origin) + t * mul(&self.body_from_world, direction);
        let normal = mul_transposed(&self.body_from_world, canonical.normal(face, point));
        normal.normalize_or_zero().dot(direction).abs()
    }

    /// Whether a point of the world lies in the body.
    pub(crate) fn contains(&self, point: Vec3A) -> bool {
        self.canonical().contains(self.point_in_body(point))
    }

    #[inline(always)]
    fn point_in_body(&self, point: Vec3A) -> Vec3A {
        mul(&self.body_from_world, point - vec3a(self.origin))
    }

    /// The point where a line of the world crosses the body's surface at parameter `t`, on the way out if `leaving`,
    /// pulled onto the surface, and the normal there, facing the line's start.
    ///
    /// All is computed in the body's frame, where numbers are small.
    #[inline]
    pub(crate) fn surface_point(
        &self,
        origin: Vec3A,
        direction: Vec3A,
        t: f32,
        leaving: bool,
    ) -> SurfacePoint {
        let canonical = self.canonical();
        let origin = self.point_in_body(origin);
        let direction = mul(&self.body_from_world, direction);
        let span = canonical.span(origin, direction);
        let face = if leaving { span.exit_face } else { span.enter_face };
        let in_body = canonical.pull_to_surface(face, origin + t * direction);
        let in_world = mul(&self.world_from_body, in_body) + vec3a(self.origin);
        // Normals go back by the inverse transpose.
        let normal = mul_transposed(&self.body_from_world, canonical.normal(face, in_body));
        let normal = normal.normalize();
        SurfacePoint { in_body, in_world, normal: if leaving { -normal } else { normal } }
    }
}

/// A point on a body's surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfacePoint {
    pub in_body: Vec3A,
    pub in_world: Vec3A,
    /// Unit normal in the world, facing where the line came from.
    pub normal: Vec3A,
}

#[inline(always)]
fn vec3a(numbers: [f32; 4]) -> Vec3A {
    Vec3A::from_vec4(Vec4::from_array(numbers))
}

/// The product of a matrix given by columns with a vector.
#[inline(always)]
fn mul(columns: &[[f32; 4]; 3], v: Vec3A) -> Vec3A {
    vec3a(columns[0]) * v.xxx() + vec3a(columns[1]) * v.yyy() + vec3a(columns[2]) * v.zzz()
}

/// The product of the transpose of a matrix given by columns with a vector.
#[inline(always)]
fn mul_transposed(columns: &[[f32; 4]; 3], v: Vec3A) -> Vec3A {
    Vec3A::new(vec3a(columns[0]).dot(v), vec3a(columns[1]).dot(v), vec3a(columns[2]).dot(v))
}

fn columns(matrix: &DMat3) -> [[f32; 4]; 3] {
    [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|column| column.as_vec3().extend(0.0).to_array())
}

/// The inverse, computed on columns scaled to length 1, so that neither tiny nor huge bodies overflow on the way.
fn inverse_linear(matrix: &DMat3) -> DMat3 {
    let scale = DVec3::new(matrix.x_axis.length(), matrix.y_axis.length(), matrix.z_axis.length());
    let unit = DMat3::from_cols(matrix.x_axis / scale.x, matrix.y_axis / scale.y, matrix.z_axis / scale.z);
    DMat3::from_diagonal(scale.recip()) * unit.inverse()
}

/// The transform that carries the canonical shape to the body in the world, sizes included.
pub(super) fn world_from_canonical(body: &Body) -> DAffine3 {
    let sizes = match body.shape {
        Shape::Sphere { radius } => DVec3::splat(radius),
        Shape::Cube { size } => 0.5 * size,
        Shape::Cylinder { radius, height } | Shape::Cone { radius, height, .. } => {
            DVec3::new(radius, body.height().unwrap_or(height), radius)
        }
        Shape::Plane => DVec3::ONE,
    };
    let world_from_body = body.placement.world_from_body();
    match body.shape {
        // A frustum that widens is a narrowing one upside down: the canonical base is the larger one.
        Shape::Cone { radius, top_radius, .. } if top_radius > radius => {
            world_from_body
                * DAffine3::from_translation(DVec3::Y * sizes.y)
                * DAffine3::from_scale(DVec3::new(top_radius, -sizes.y, top_radius))
        }
        _ => world_from_body * DAffine3::from_scale(sizes),
    }
}

fn canonical(shape: &Shape) -> (ShapeKind, f32) {
    match *shape {
        Shape::Sphere { .. } => (ShapeKind::Sphere, 0.0),
        Shape::Cube { .. } => (ShapeKind::Cube, 0.0),
        Shape::Cylinder { .. } => (ShapeKind::Cylinder, 1.0),
        Shape::Cone { radius, top_radius, .. } => {
            (ShapeKind::Cone, (radius.min(top_radius) / radius.max(top_radius)) as f32)
        }
        Shape::Plane => (ShapeKind::Plane, 0.0),
    }
}

fn volume(kind: ShapeKind, ratio: f64, determinant: f64) -> f64 {
    use std::f64::consts::PI;
    let canonical = match kind {
        ShapeKind::Sphere => 4.0 / 3.0 * PI,
        ShapeKind::Cube => 8.0,
        ShapeKind::Cylinder => PI,
        ShapeKind::Cone => PI * (1.0 + ratio + ratio * ratio) / 3.0,
        ShapeKind::Plane => f64::INFINITY,
    };
    canonical * determinant.abs()
}
