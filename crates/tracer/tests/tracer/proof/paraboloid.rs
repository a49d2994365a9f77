//! The paraboloid's known answers: everything along its axis goes through its focus.

use catoptric_scene::{Anchor, Body, ParaboloidDepth, Placement, Shape};
use catoptric_tracer::{RayRecord, RenderScene};
use glam::{DAffine3, DVec3};
use proptest::prelude::*;

use crate::proof::common::{
    assert_vec_close, cases, chain, direction, mirror, placed, ray, stage_of, textbook, turned, v,
};

fn dish(radius: f64, length: f64) -> Shape {
    Shape::Paraboloid { radius, depth: ParaboloidDepth::FocalLength(length) }
}

/// A mirror, its frame, and its focus in the world.
struct Mirror {
    body: Body,
    frame: DAffine3,
    focus: DVec3,
    scene: RenderScene,
}

impl Mirror {
    fn new(radius: f64, length: f64, at: DVec3, turn: DVec3) -> Self {
        let body = turned(dish(radius, length), at, turn, mirror());
        let frame = body.placement.world_from_body();
        let focus = frame.transform_point3(length * DVec3::Y);
        let scene = stage_of(vec![body.clone()]);
        Self { body, frame, focus, scene }
    }

    /// A point at a share of the height and of the radius there.
    fn inside(&self, share: f64, out: f64, around: f64) -> DVec3 {
        let height = self.body.height().unwrap();
        let radius = self.body.shape.number("radius").unwrap() * share.sqrt() * out;
        self.frame.transform_point3(v(radius * around.cos(), share * height, radius * around.sin()))
    }
}

/// How far a point is from the line of a ray that leaves a surface.
fn distance_from(path: &[RayRecord], number: usize, point: DVec3) -> f64 {
    let from = path[number - 1].hit.unwrap().position;
    let d = direction(&path[number]).normalize();
    (point - from).cross(d).length()
}

fn coordinates() -> impl Strategy<Value = DVec3> {
    (-3.0..3.0_f64, -3.0..3.0_f64, -3.0..3.0_f64).prop_map(DVec3::from)
}

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn rays_along_the_axis_within_the_mirror_pass_through_the_focus(
        radius in 0.1..3.0_f64, length in 0.1..3.0_f64, at in coordinates(), turn in coordinates(),
        share in 0.5..0.99_f64, out in 0.0..0.98_f64, around in 0.0..6.3_f64,
    ) {
        let mirror = Mirror::new(radius, length, at, 60.0 * turn);
        let down = mirror.frame.transform_vector3(DVec3::NEG_Y);
        let path = chain(&mirror.scene, ray(mirror.inside(share, out, around), down));
        // The rounding of places is that of the distance from the origin.
        let size = radius + length + at.length();
        let miss = distance_from(&path, 1, mirror.focus);
        prop_assert!(miss < 1e-6 * size, "{miss:e} of {size}");
    }

    #[test]
    fn light_at_the_focus_leaves_along_the_axis(
        radius in 0.5..3.0_f64, at in coordinates(), turn in coordinates(), toward in coordinates(),
    ) {
        // The focus in the middle of the depth.
        let length = radius / 8_f64.sqrt();
        let mirror = Mirror::new(radius, length, at, 60.0 * turn);
        let path = chain(&mirror.scene, ray(mirror.focus, toward));
        let hit = path[0].hit.unwrap();
        let on_mirror = mirror.frame.inverse().transform_point3(hit.position);
        prop_assume!(on_mirror.y < mirror.body.height().unwrap() * (1.0 - 1e-5));
        let axis = mirror.frame.transform_vector3(DVec3::Y);
        prop_assert!(direction(&path[1]).distance(axis) < 1e-6 * (1.0 + at.length() / radius));
    }

    /// Mirrored from outside, what came along the axis seems to come from the focus.
    #[test]
    fn the_outer_side_spreads_rays_as_if_from_the_focus(
        radius in 0.1..3.0_f64, length in 0.1..3.0_f64, turn in coordinates(),
        out in 0.0..0.99_f64, around in 0.0..6.3_f64,
    ) {
        let mirror = Mirror::new(radius, length, DVec3::ZERO, 60.0 * turn);
        let up = mirror.frame.transform_vector3(DVec3::Y);
        let below = mirror.inside(1.0, out, around) - (mirror.body.height().unwrap() + 1.0) * up;
        let path = chain(&mirror.scene, ray(below, up));
        prop_assert_eq!(path.len(), 2);
        let miss = distance_from(&path, 1, mirror.focus);
        prop_assert!(miss < 1e-6 * (radius + length + below.length()), "{miss:e}");
    }

    /// Turned, scaled unevenly, tiny, huge and flat, against the quadratic as it stands, in double precision.
    #[test]
    fn hits_agree_with_the_textbook(
        radius in 0.2..2.0_f64, height in 0.2..2.0_f64, turn in coordinates(), scale in coordinates(),
        power in -6..7_i32, from in coordinates(), aim in coordinates(),
    ) {
        let shape = Shape::Paraboloid { radius, depth: ParaboloidDepth::Height(height) };
        let unit = 10_f64.powi(power);
        let scale = scale.map(|exponent| 10_f64.powf(0.4 * exponent)) * unit;
        let anchor = Anchor::Frame { position: DVec3::ZERO, rotation_degrees: 60.0 * turn };
        let placement = Placement { anchor, scale };
        let frame = placement.world_from_body();
        let target = frame.transform_point3(0.3 * aim * v(radius, height, radius) + 0.5 * height * DVec3::Y);
        let origin = (4.0 * scale.max_element() * from.normalize_or(DVec3::X)).as_vec3().as_dvec3();
        let start = ray(origin, target - origin);
        let (o, d) = (frame.inverse().transform_point3(origin), frame.inverse().transform_vector3(start.direction.as_dvec3()));
        let mut ahead = textbook::crossings(&shape, o, d).into_iter().filter(|(t, _)| *t > 0.0);
        let found = stage_of(vec![placed(shape, placement, mirror())]).closest_hit(&start);
        let (Some((t, _)), Some(hit)) = (ahead.next(), found) else {
            // Rounding decides only about rays that graze the surface.
            let chord = textbook::span(&shape, o, d).map_or(0.0, |(enter, exit)| exit - enter);
            prop_assert!(chord < 1e-2 * scale.max_element() || (ahead.next().is_none() && found.is_none()));
            return Ok(());
        };
        let off = (f64::from(hit.hit.t) - t).abs() / scale.max_element();
        let cosine = f64::from(hit.normal.dot(start.direction.into())).abs();
        prop_assert!(off * cosine < 2e-5, "{off:e}, cosine {cosine}");
        // Points are pulled onto the surface along the axis, which moves them along a steep surface: by rounding in the
        // units of the shortest axis, as far as bodies are that flat in single precision.
        let axes = scale * v(radius, height, radius);
        let flat = (axes.max_element() / axes.min_element()).min(1024.0);
        let exact = frame.transform_point3(o + t * d);
        prop_assert!(hit.position.distance(exact) * cosine < (2e-5 + 1e-6 * flat) * axes.max_element());
    }
}

#[test]
fn base_and_top_place_vertex_and_rim() {
    let anchor = Anchor::Axis { base: v(1.0, 2.0, 3.0), top: v(1.0, 2.0, 5.0) };
    let shape = Shape::Paraboloid { radius: 1.0, depth: ParaboloidDepth::Height(7.0) };
    let scene = stage_of(vec![placed(shape, Placement { anchor, scale: DVec3::ONE }, mirror())]);
    let hit = |from, d| scene.closest_hit(&ray(from, d)).unwrap().position;
    assert_vec_close(hit(v(1.0, 2.0, 0.0), DVec3::Z), v(1.0, 2.0, 3.0), 1e-6);
    assert_vec_close(hit(v(1.5, 2.0, 9.0), DVec3::NEG_Z), v(1.5, 2.0, 5.0), 1e-6);
    assert_vec_close(hit(v(1.5, 2.0, 0.0), DVec3::Z), v(1.5, 2.0, 3.5), 1e-6);
}

/// Near the vertex of a mirror as large as a country, and on one that is as flat as paper.
#[test]
fn huge_and_flat_mirrors_gather_in_double_precision() {
    for (radius, length) in [(1e6, 4e6), (1.0, 1e5), (1e-5, 1.0)] {
        let mirror = Mirror::new(radius, length, DVec3::ZERO, v(20.0, 30.0, 40.0));
        for out in [0.1, 0.5, 0.9] {
            let beyond = mirror.frame.transform_vector3(DVec3::Y) * length;
            let target = mirror.inside(1.0, out, 1.0);
            let path = chain(&mirror.scene, ray(target - beyond, beyond));
            // From outside, as if from the focus; the ray's direction has single precision.
            let miss = distance_from(&path, 1, mirror.focus);
            assert!(miss < 1e-6 * length, "{radius} {length}: {miss:e}");
        }
    }
}
