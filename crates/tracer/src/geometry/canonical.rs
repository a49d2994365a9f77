//! How the shapes of a scene become canonical ones.

use catoptric_scene::{Body, Shape};
use glam::{DAffine3, DVec3};

use crate::geometry::bounds::Bounds;
use crate::geometry::shape::solid::is_oblique;
use crate::geometry::shape::{CanonicalShape, ShapeKind};

/// A body as a canonical shape, and the transform that carries it to the world, sizes included.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CanonicalBody {
    pub(crate) shape: CanonicalShape<f64>,
    pub(crate) world_from_canonical: DAffine3,
}

impl CanonicalBody {
    /// Of a body that is not compound.
    pub(crate) fn of(body: &Body) -> Self {
        Self::placed(body.sized_shape(), body.placement.world_from_body())
    }

    /// Of a simple shape that `frame` carries to the world.
    pub(crate) fn placed(shape: Shape, frame: DAffine3) -> Self {
        let (kind, cone_ratio, sizes) = match shape {
            Shape::Sphere { radius } => (ShapeKind::Sphere, 0.0, DVec3::splat(radius)),
            Shape::Cube { size } => (ShapeKind::Cube, 0.0, 0.5 * size),
            Shape::Cylinder { radius, height } => {
                (ShapeKind::Cylinder, 1.0, DVec3::new(radius, height, radius))
            }
            Shape::Cone { radius, top_radius, height } => {
                let widest = radius.max(top_radius);
                (ShapeKind::Cone, radius.min(top_radius) / widest, DVec3::new(widest, height, widest))
            }
            Shape::Paraboloid { radius, depth } => {
                let height = depth.height(radius);
                (ShapeKind::Paraboloid, 0.0, DVec3::new(radius, height, radius))
            }
            Shape::Plane
            | Shape::Union
            | Shape::Intersection
            | Shape::Difference
            | Shape::Surface { .. }
            | Shape::Group => (ShapeKind::Plane, 0.0, DVec3::ONE),
        };
        let body_from_canonical = match shape {
            // A frustum that widens is a narrowing one upside down: the canonical base is the larger one.
            Shape::Cone { radius, top_radius, .. } if top_radius > radius => {
                DAffine3::from_translation(DVec3::Y * sizes.y)
                    * DAffine3::from_scale(sizes * DVec3::new(1.0, -1.0, 1.0))
            }
            _ => DAffine3::from_scale(sizes),
        };
        let world_from_canonical = frame * body_from_canonical;
        let kind = match kind {
            ShapeKind::Sphere if !is_even(&world_from_canonical) => ShapeKind::Ellipsoid,
            kind => kind,
        };
        Self { shape: CanonicalShape { kind, cone_ratio }, world_from_canonical }
    }

    pub(crate) fn is_plane(&self) -> bool {
        self.shape.kind == ShapeKind::Plane
    }

    /// The lengths of the frame's axes in the world; they are perpendicular, but for parts that are turned within what is
    /// stretched.
    pub(crate) fn axes(&self) -> DVec3 {
        axes_of(&self.world_from_canonical)
    }

    /// The box around it; `None` for a plane.
    pub(crate) fn bounds(&self) -> Option<Bounds> {
        Bounds::of_canonical(&self.world_from_canonical, self.shape.kind, self.shape.cone_ratio)
    }

    /// About how far a point is from the surface, meters: exactly for spheres, boxes and planes, and within a factor of a
    /// few for bodies that are scaled unevenly.
    pub(crate) fn distance(&self, point: DVec3) -> f64 {
        let DAffine3 { matrix3, translation } = self.world_from_canonical;
        let lengths = self.axes();
        let along = |axis: DVec3, length: f64| (point - translation).dot(axis / length);
        let at = DVec3::new(
            along(matrix3.x_axis, lengths.x),
            along(matrix3.y_axis, lengths.y),
            along(matrix3.z_axis, lengths.z),
        );
        self.shape.kind.solid().distance(self.shape.cone_ratio, lengths, at)
    }
}

fn axes_of(transform: &DAffine3) -> DVec3 {
    let axes = transform.matrix3;
    DVec3::new(axes.x_axis.length(), axes.y_axis.length(), axes.z_axis.length())
}

/// Whether a transform scales alike in all directions, but for the rounding of double precision.
fn is_even(transform: &DAffine3) -> bool {
    const ROUNDING: f64 = 1e-12;
    let axes = axes_of(transform);
    (axes.y - axes.x).abs().max((axes.z - axes.x).abs()) <= ROUNDING * axes.x
        && !is_oblique(&transform.matrix3)
}

#[cfg(test)]
mod tests {
    use catoptric_scene::ParaboloidDepth;

    use super::*;

    #[test]
    fn distances_are_those_to_surfaces() {
        let far =
            |shape: Shape, at: DVec3| CanonicalBody::of(&Body { shape, ..Body::default() }).distance(at);
        let cube = Shape::Cube { size: DVec3::splat(2.0) };
        let cylinder = Shape::Cylinder { radius: 1.0, height: 4.0 };
        let cases = [
            (Shape::SPHERE, DVec3::new(0.0, 3.0, 0.0), 2.0),
            (Shape::SPHERE, DVec3::new(0.0, 0.25, 0.0), 0.75),
            (cube, DVec3::new(4.0, 5.0, 0.0), 5.0),
            (cube, DVec3::new(0.5, 0.0, 0.0), 0.5),
            (cylinder, DVec3::new(3.0, 1.0, 0.0), 2.0),
            (cylinder, DVec3::new(0.0, 5.0, 0.0), 1.0),
            (cylinder, DVec3::new(0.5, 2.0, 0.0), 0.5),
            // A deep bowl of the focal length 1, from beside, from below and from within the rim.
            (
                Shape::Paraboloid { radius: 4.0, depth: ParaboloidDepth::Height(4.0) },
                DVec3::new(2.001, 1.0, 0.0),
                7.071e-4,
            ),
            (Shape::Paraboloid { radius: 4.0, depth: ParaboloidDepth::Height(4.0) }, DVec3::NEG_Y, 1.0),
            (Shape::Paraboloid { radius: 4.0, depth: ParaboloidDepth::Height(4.0) }, DVec3::Y * 5.0, 1.0),
            (Shape::Plane, DVec3::new(7.0, -2.0, 1.0), 2.0),
        ];
        for (shape, at, exact) in cases {
            assert!((far(shape, at) - exact).abs() < 1e-6, "{shape:?} from {at}: {}", far(shape, at));
        }
    }
}
