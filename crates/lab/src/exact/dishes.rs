//! Paraboloids and spherical dishes as mirrors.

use catoptric_scene::{Body, BodyShape, DishProfile, Material, ParametricShape, Shape};
use glam::DVec3;

use super::probe::{Line, Probe};
use super::{ExactAnswer, ExactDeviation, ExactSetup, LEAST_MIRROR, MARGINAL, PlacedBody};

/// How far from the axis the inner ray of [`ExactAnswer::DishFocus`] runs, in radii of the rim.
const NEAR: f64 = 0.1;

/// A smooth paraboloid of revolution, or a cap of a sphere, in the world.
struct Dish {
    profile: DishProfile,
    vertex: DVec3,
    /// The unit direction in which it opens.
    axis: DVec3,
    /// A unit vector across the axis.
    across: DVec3,
    /// The radius of the rim, meters.
    radius: f64,
    /// From the vertex to the rim's plane, meters.
    depth: f64,
    /// The distance of the focus of rays near the axis from the vertex, meters.
    focal_length: f64,
    /// Whether it is a dish that mirrors by its hollow side, not a solid that does by its outside or from within.
    is_hollow: bool,
}

impl Dish {
    fn of(body: &Body) -> Option<Self> {
        let (profile, radius, height, is_hollow) =
            match (body.body_shape(), body.sized_shape(), body.height()) {
                (_, Shape::Paraboloid { radius, .. }, Some(height)) => {
                    (DishProfile::Parabolic, radius, height, false)
                }
                (BodyShape::Parametric(ParametricShape::MirrorDish(dish)), ..) => {
                    (dish.profile, dish.radius, dish.rim(), true)
                }
                _ => return None,
            };
        let scale = body.placement.scale.abs();
        let is_alike = |other: f64| (scale.x - other).abs() <= 1e-12 * scale.x;
        let is_even = is_alike(scale.z) && (profile == DishProfile::Parabolic || is_alike(scale.y));
        let rotation = body.placement.rotation();
        let (radius, depth) = (radius * scale.x, height * scale.y);
        let square = radius * radius;
        is_even.then(|| Self {
            profile,
            vertex: body.placement.world_from_body().translation,
            axis: rotation.y_axis,
            across: rotation.x_axis,
            radius,
            depth,
            focal_length: match profile {
                DishProfile::Parabolic => square / (4.0 * depth),
                DishProfile::Spherical => (square + depth * depth) / (4.0 * depth),
            },
            is_hollow,
        })
    }

    /// How far from the vertex the mirrored ray crosses the axis that came along it at a distance `height`, meters. By a
    /// sphere of radius R it is R − R/(2 cos θ), sin θ = `height`/R.
    fn crossing(&self, height: f64) -> f64 {
        let curvature = 2.0 * self.focal_length;
        match self.profile {
            DishProfile::Parabolic => self.focal_length,
            DishProfile::Spherical => {
                curvature - 0.5 * curvature / (1.0 - (height / curvature).powi(2)).sqrt()
            }
        }
    }
}

/// Whether a body is a paraboloid or a dish whose side mirrors light that comes straight along its axis: from outside, or from
/// within, where the cap lets it in unbent.
pub(super) fn is_mirror(body: &Body, material: &Material) -> bool {
    let is_clear = material.lets_through().most > 0.0;
    let is_strong = material.reflects().straight >= LEAST_MIRROR;
    let is_open = |dish: Dish| !is_clear || (!dish.is_hollow && material.ior() == Some(1.0));
    is_strong && !material.is_rough() && Dish::of(body).is_some_and(is_open)
}

pub(super) fn answer(setting: &ExactSetup<'_>, found: &mut Vec<ExactAnswer>) {
    found.extend(setting.dishes.iter().filter_map(|dish| focus(setting, dish)));
}

fn focus(setting: &ExactSetup<'_>, mirror: &PlacedBody<'_>) -> Option<ExactAnswer> {
    let dish = Dish::of(mirror.body)?;
    let Dish { profile, vertex, axis, across, radius, depth, focal_length, is_hollow } = dish;
    let material = setting.scene.material(&mirror.body.material)?;
    let is_virtual = !is_hollow && material.lets_through().most <= 0.0;
    let probe = Probe::of(setting.scene, [mirror.body], None, mirror.center)?;
    let middle = Line { point: vertex, direction: axis };
    let ray = |height: f64| {
        let exact = vertex + dish.crossing(height * radius) * axis;
        let beside = vertex + height * radius * across;
        let mirrored = if is_hollow {
            probe.reflected(beside + 2.0 * depth * axis, -axis, 1)
        } else if is_virtual {
            probe.reflected(beside - depth * axis, axis, 1)
        } else {
            probe.reflected_within(beside + 2.0 * depth * axis, -axis)
        };
        ExactDeviation { exact, found: mirrored.and_then(|mirrored| middle.nearest_to(&mirrored)) }
    };
    Some(ExactAnswer::DishFocus {
        mirror: mirror.index,
        profile,
        focal_length,
        is_virtual,
        near: ray(NEAR),
        marginal: ray(MARGINAL),
    })
}
