//! Paraboloids as mirrors.

use catoptric_scene::{Body, BodyShape, DishProfile, Material, MirrorDish, ParametricShape, Shape};
use glam::DVec3;

use super::probe::{Line, Probe};
use super::{ExactAnswer, ExactDeviation, ExactSetup, LEAST_MIRROR, MARGINAL, PlacedBody};

/// How far from the axis the inner ray of [`ExactAnswer::ParabolicFocus`] runs, in radii of the rim.
const NEAR: f64 = 0.1;

/// A smooth paraboloid of revolution in the world.
struct Dish {
    vertex: DVec3,
    /// The unit direction in which it opens.
    axis: DVec3,
    /// A unit vector across the axis.
    across: DVec3,
    /// The radius of the rim, meters.
    radius: f64,
    /// From the vertex to the rim's plane, meters.
    depth: f64,
    /// Whether it is a dish that mirrors by its hollow side, not a solid that does by its outside or from within.
    is_hollow: bool,
}

impl Dish {
    fn of(body: &Body) -> Option<Self> {
        let (radius, height, is_hollow) = match (body.body_shape(), body.sized_shape(), body.height()) {
            (_, Shape::Paraboloid { radius, .. }, Some(height)) => (radius, height, false),
            (BodyShape::Parametric(ParametricShape::MirrorDish(dish)), ..)
                if dish.profile == DishProfile::Parabolic =>
            {
                let MirrorDish { radius, .. } = dish;
                (radius, dish.rim(), true)
            }
            _ => return None,
        };
        let scale = body.placement.scale.abs();
        let is_even = (scale.x - scale.z).abs() <= 1e-12 * scale.x;
        let rotation = body.placement.rotation();
        is_even.then(|| Self {
            vertex: body.placement.world_from_body().translation,
            axis: rotation.y_axis,
            across: rotation.x_axis,
            radius: radius * scale.x,
            depth: height * scale.y,
            is_hollow,
        })
    }
}

/// Whether a body is a paraboloid whose side mirrors light that comes straight along its axis: from outside, or from
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
    let Dish { vertex, axis, across, radius, depth, is_hollow } = Dish::of(mirror.body)?;
    let material = setting.scene.material(&mirror.body.material)?;
    let is_virtual = !is_hollow && material.lets_through().most <= 0.0;
    let focal_length = radius * radius / (4.0 * depth);
    let probe = Probe::of(setting.scene, [mirror.body], None, mirror.center)?;
    let middle = Line { point: vertex, direction: axis };
    let exact = vertex + focal_length * axis;
    let ray = |height: f64| {
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
    Some(ExactAnswer::ParabolicFocus {
        mirror: mirror.index,
        focal_length,
        is_virtual,
        near: ray(NEAR),
        marginal: ray(MARGINAL),
    })
}
