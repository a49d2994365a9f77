//! How the canonical shapes become those of a scene.

use catoptric_scene::{Body, Shape};
use glam::{DAffine3, DVec3};

/// The transform that carries the canonical shape to the body in the world, sizes included.
pub(crate) fn world_from_canonical(body: &Body) -> DAffine3 {
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

/// The ratio of the smaller to the larger radius of a cone; 1 for a cylinder, 0 for others.
pub(crate) fn canonical_ratio(body: &Body) -> f64 {
    match body.shape {
        Shape::Cylinder { .. } => 1.0,
        Shape::Cone { radius, top_radius, .. } => radius.min(top_radius) / radius.max(top_radius),
        Shape::Sphere { .. } | Shape::Cube { .. } | Shape::Plane => 0.0,
    }
}
