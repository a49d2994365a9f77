//! The cube [-1, 1]³.
//!
//! ```toml
//! [[bodies]]
//! shape = "cube"
//! size = 1.6                      # or [x, y, z]
//! ```

use glam::{DAffine3, DMat3, DVec3};

use crate::geometry::shape::solid::{PicturePlace, RevolutionRing, Solid, to_box};
use crate::geometry::shape::{ShapeSpan, slab};
use crate::simd::Float;
use crate::simd::vector::Vector;

/// The common part of the three layers. Face 2·axis is the one at -1, face 2·axis + 1 the one at +1.
#[inline(always)]
pub(crate) fn span<R: Float>(origin: Vector<R>, direction: Vector<R>) -> ShapeSpan<R> {
    let x = slab::half_open(origin.x, direction.x, (-1.0, 0.0), (1.0, 1.0));
    let y = slab::half_open(origin.y, direction.y, (-1.0, 2.0), (1.0, 3.0));
    let z = slab::half_open(origin.z, direction.z, (-1.0, 4.0), (1.0, 5.0));
    x.intersect(y).intersect(z)
}

#[inline(always)]
pub(crate) fn pull_to_surface<R: Float>(face: R, point: Vector<R>) -> Vector<R> {
    let normal = normal(face);
    Vector::new(pulled(normal.x, point.x), pulled(normal.y, point.y), pulled(normal.z, point.z))
}

/// A coordinate on the face whose normal has this one.
#[inline(always)]
fn pulled<R: Float>(normal: R, point: R) -> R {
    let one = point.like(1.0);
    R::select(normal.eq(point.like(0.0)), point.max(-one).min(one), normal)
}

#[inline(always)]
pub(crate) fn normal<R: Float>(face: R) -> Vector<R> {
    let axis = (face * 0.5).floor();
    let sign = (face - axis * 2.0) * 2.0 - 1.0;
    Vector::new(along(axis, 0.0, sign), along(axis, 1.0, sign), along(axis, 2.0, sign))
}

/// `sign` where the face looks along axis `number`, else 0.
#[inline(always)]
fn along<R: Float>(axis: R, number: f32, sign: R) -> R {
    R::select(axis.eq(axis.like(number)), sign, axis.like(0.0))
}

/// The cube, of whatever scale.
pub(crate) struct UnitCube;

impl Solid for UnitCube {
    fn bounds(&self, frame: &DAffine3, _ratio: f64) -> Option<[DVec3; 2]> {
        let DMat3 { x_axis: x, y_axis: y, z_axis: z } = frame.matrix3;
        let reach = x.abs() + y.abs() + z.abs();
        Some([frame.translation - reach, frame.translation + reach])
    }

    fn bounding_sphere(&self, linear: &DMat3, _ratio: f64) -> (DVec3, f64) {
        let DMat3 { x_axis: x, y_axis: y, z_axis: z } = linear;
        (DVec3::ZERO, (x.length_squared() + y.length_squared() + z.length_squared()).sqrt())
    }

    fn hull(&self, frame: &DAffine3, _ratio: f64) -> Option<(Vec<DVec3>, f64)> {
        let sign = |corner: u32, axis: u32| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
        let corners = (0..8).map(|corner| [0, 1, 2].map(|axis| sign(corner, axis)));
        Some((corners.map(|corner| frame.transform_point3(corner.into())).collect(), 0.0))
    }

    fn volume(&self, _ratio: f64) -> f64 {
        8.0
    }

    fn middle(&self) -> Option<DVec3> {
        Some(DVec3::ZERO)
    }

    /// Of planes nothing depends on the other axes.
    fn flatness(&self, _axes: DVec3) -> f64 {
        1.0
    }

    fn distance(&self, _ratio: f64, axes: DVec3, at: DVec3) -> f64 {
        to_box(at.abs() - axes).abs()
    }

    fn picture_place(&self, _ratio: f32, [x, y, z]: [f32; 3]) -> PicturePlace {
        let [far_x, far_y, far_z] = [x, y, z].map(f32::abs);
        if far_x > far_y.max(far_z) {
            PicturePlace::flat(-z * x.signum(), -y)
        } else if far_y > far_z {
            PicturePlace::flat(x, z * y.signum())
        } else {
            PicturePlace::flat(x * z.signum(), -y)
        }
    }

    fn profile(&self, _ratio: f64, _fineness: u32) -> Option<Vec<Vec<RevolutionRing>>> {
        None
    }
}
