//! Affine maps as placements of bodies: scale, rotation, translation.

use glam::{DAffine3, DMat3, DQuat, DVec3, EulerRot};

use crate::placement::{Anchor, Placement};
use crate::shape::Shape;

/// The turns of its own frame that leave a shape as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Symmetry {
    /// None: a cuboid.
    None,
    /// Those about its y axis: a cylinder or a cone.
    AboutY,
    /// All: a sphere.
    All,
}

/// Columns whose cosine is below this are perpendicular: rotations of files are written with six digits or more.
const PERPENDICULAR: f64 = 1e-6;

impl Shape {
    /// The placement of the shape where a frame carries it; `None` if the frame is flat, endless, or sheared in a way
    /// that position, rotation and scale cannot say. A sheared ball is an ellipsoid, and a plane is never sheared. The
    /// mirror image of a simple shape is one that is turned.
    ///
    /// ```
    /// use catoptric_scene::Shape;
    /// use glam::{DAffine3, DMat3, DVec3};
    /// let shear = DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::new(0.5, 1.0, 0.0), DVec3::Z));
    /// assert!(Shape::SPHERE.placed(shear).is_some() && Shape::CUBE.placed(shear).is_none());
    /// ```
    pub fn placed(&self, frame: DAffine3) -> Option<Placement> {
        let symmetry = match self {
            Self::Sphere { .. } => Symmetry::All,
            Self::Cylinder { .. } | Self::Cone { .. } | Self::Paraboloid { .. } => Symmetry::AboutY,
            Self::Cube { .. }
            | Self::Union
            | Self::Intersection
            | Self::Difference
            | Self::Surface { .. }
            | Self::Group => Symmetry::None,
            Self::Plane => {
                let found = placement(frame, Symmetry::None).or_else(|| plane(frame));
                return found.map(|found| Placement { scale: DVec3::ONE, ..found });
            }
        };
        placement(frame, symmetry)
    }
}

/// Where the plane y = 0 of a sheared frame stands.
fn plane(frame: DAffine3) -> Option<Placement> {
    let normal = (frame.matrix3.inverse().transpose() * DVec3::Y).try_normalize()?;
    let rotation_degrees = rotation_degrees(DQuat::from_rotation_arc(DVec3::Y, normal));
    let anchor = Anchor::Frame { position: frame.translation, rotation_degrees };
    Some(Placement { anchor, scale: DVec3::ONE })
}

/// The placement of a shape that `world_from_body` carries to the world, or `None` if only a sheared frame could do
/// that. The shape must be symmetric in x, for a mirrored frame is turned into one that is not.
///
/// One-sided Jacobi rotations (Hestenes 1958) turn the shape within itself until the axes of its frame stay
/// perpendicular.
fn placement(world_from_body: DAffine3, symmetry: Symmetry) -> Option<Placement> {
    let pairs: &[(usize, usize)] = match symmetry {
        Symmetry::None => &[],
        Symmetry::AboutY => &[(0, 2)],
        Symmetry::All => &[(0, 1), (0, 2), (1, 2)],
    };
    let mut axes = world_from_body.matrix3.to_cols_array_2d().map(DVec3::from_array);
    for _ in 0..30 {
        for &(p, q) in pairs {
            (axes[p], axes[q]) = perpendicular(axes[p], axes[q]);
        }
    }
    let scale = DVec3::from_array(axes.map(DVec3::length));
    let is_regular =
        scale.is_finite() && scale.min_element() > 0.0 && world_from_body.translation.is_finite();
    let cosine = |p: usize, q: usize| (axes[p].dot(axes[q]) / (scale[p] * scale[q])).abs();
    if !is_regular
        || [cosine(0, 1), cosine(0, 2), cosine(1, 2)].into_iter().any(|cosine| cosine > PERPENDICULAR)
    {
        return None;
    }
    let mut turn = DMat3::from_cols(axes[0] / scale.x, axes[1] / scale.y, axes[2] / scale.z);
    if turn.determinant() < 0.0 {
        turn.x_axis = -turn.x_axis;
    }
    let rotation_degrees = rotation_degrees(DQuat::from_mat3(&turn).normalize());
    Some(Placement {
        anchor: Anchor::Frame { position: world_from_body.translation, rotation_degrees },
        scale,
    })
}

/// The two columns after the Jacobi rotation that makes them perpendicular.
fn perpendicular(p: DVec3, q: DVec3) -> (DVec3, DVec3) {
    let product = p.dot(q);
    if product.abs() <= f64::EPSILON * p.length() * q.length() {
        return (p, q);
    }
    let zeta = (q.length_squared() - p.length_squared()) / (2.0 * product);
    let tangent = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
    let cosine = 1.0 / tangent.hypot(1.0);
    let sine = cosine * tangent;
    (cosine * p - sine * q, sine * p + cosine * q)
}

/// Turns about the fixed X, then Y, then Z axis, degrees, without the noise of the last digits.
pub fn rotation_degrees(turn: DQuat) -> DVec3 {
    let (z, y, x) = turn.to_euler(EulerRot::ZYX);
    // Adding 0 makes −0 a 0.
    DVec3::new(x, y, z).map(|angle| (angle.to_degrees() * 1e10).round() / 1e10 + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rebuilt(map: DAffine3, symmetry: Symmetry) -> DAffine3 {
        placement(map, symmetry).unwrap().world_from_body()
    }

    #[test]
    fn rotations_come_back() {
        let turn = DQuat::from_euler(EulerRot::ZYX, 0.3, -1.2, 2.5);
        let map = DAffine3::from_scale_rotation_translation(
            DVec3::new(1.0, 2.0, 3.0),
            turn,
            DVec3::new(4.0, 5.0, 6.0),
        );
        assert!(rebuilt(map, Symmetry::None).abs_diff_eq(map, 1e-8));
    }

    #[test]
    fn a_sheared_sphere_is_an_ellipsoid() {
        let shear = DAffine3::from_mat3(DMat3::from_cols(DVec3::X, DVec3::new(0.7, 1.0, 0.2), DVec3::Z));
        assert_eq!(placement(shear, Symmetry::None), None);
        assert_eq!(placement(shear, Symmetry::AboutY), None);
        let ellipsoid = rebuilt(shear, Symmetry::All).matrix3;
        // M Mᵀ is the ellipsoid, whatever turns stand before M.
        let shape = |matrix: DMat3| matrix * matrix.transpose();
        assert!(shape(ellipsoid).abs_diff_eq(shape(shear.matrix3), 1e-8));
    }

    #[test]
    fn flat_and_endless_frames_have_no_placement() {
        for matrix in [
            DMat3::ZERO,
            DMat3::from_diagonal(DVec3::new(1.0, 0.0, 1.0)),
            DMat3::from_diagonal(DVec3::splat(f64::NAN)),
        ] {
            assert_eq!(placement(DAffine3::from_mat3(matrix), Symmetry::All), None);
        }
    }
}
