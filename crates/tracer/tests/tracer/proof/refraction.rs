//! Snell's law and what follows from it: slabs, prisms, lenses, total reflection.

use catoptric_scene::{Body, Color, Shape};
use catoptric_tracer::{RayKind, RayRecord};
use glam::DVec3;
use proptest::prelude::*;

use crate::proof::common::{
    assert_close, assert_vec_close, ball, block, cases, center, chain, direction, glass, glow, picture,
    plane, ray, ray_from_hit, render_scene, scene, stage_of, tree, turned, v,
};

/// The direction that falls on a floor at this angle of incidence, in degrees.
fn falling(incidence: f64) -> DVec3 {
    let (sin, cos) = incidence.to_radians().sin_cos();
    v(sin, -cos, 0.0)
}

/// The angle in degrees between a direction and the vertical.
fn tilt(d: DVec3) -> f64 {
    d.x.hypot(d.z).atan2(d.y.abs()).to_degrees()
}

/// The second ray of the path that falls at `incidence` on a half-space of glass, from above or from below.
fn across_a_floor(ior: f64, incidence: f64, from_below: bool) -> RayRecord {
    let sign = if from_below { -1.0 } else { 1.0 };
    let d = falling(incidence) * v(1.0, sign, 1.0);
    chain(&stage_of(vec![plane(DVec3::ZERO, 0.0, glass(ior))]), ray(-d, d)).swap_remove(1)
}

#[test]
fn snells_law_holds_at_all_angles_and_indices() {
    for ior in [0.7, 1.0001, 1.333, 1.5, 1.52, 2.417, 4.0] {
        for step in 0..=89 {
            let incidence = f64::from(step);
            for (from_below, ratio) in [(false, 1.0 / ior), (true, ior)] {
                let sin = incidence.to_radians().sin() * ratio;
                let next = across_a_floor(ior, incidence, from_below);
                if sin > 1.0 {
                    assert_eq!(next.kind, RayKind::Reflected, "{ior} at {incidence}");
                    continue;
                }
                assert_eq!(next.kind, RayKind::Refracted, "{ior} at {incidence}");
                let d = direction(&next);
                assert_close(d.length(), 1.0, 2e-7);
                // The sine is what Snell's law gives; near 90 degrees it fixes the angle less and less.
                assert_close(d.x, sin, 2e-6 * sin);
                assert_close(d.y.abs(), (1.0 - sin * sin).sqrt(), 2e-6 / (1.0 - sin * sin).sqrt().max(1e-3));
                assert_eq!(d.y > 0.0, from_below);
            }
        }
    }
}

#[test]
fn glass_begins_to_reflect_totally_at_41_8103_degrees() {
    for (ior, critical) in [(1.5, 41.810_314_9), (1.333, 48.606_7), (2.417, 24.439_4)] {
        assert_close(f64::asin(1.0 / ior).to_degrees(), critical, 5e-4);
        let critical = f64::asin(1.0 / ior).to_degrees();
        for off in [2e-4, 1e-3, 0.1, 1.0] {
            assert_eq!(across_a_floor(ior, critical - off, true).kind, RayKind::Refracted, "{ior} {off}");
            assert_eq!(across_a_floor(ior, critical + off, true).kind, RayKind::Reflected, "{ior} {off}");
        }
    }
}

#[test]
fn grazing_rays_enter_glass_just_below_the_critical_angle() {
    let next = across_a_floor(1.5, 89.99, false);
    assert_eq!(next.kind, RayKind::Refracted);
    assert_close(tilt(direction(&next)), 41.810_314_6, 1e-4);
}

#[test]
fn equal_indices_change_nothing() {
    let behind = ball(0.3, v(0.2, 0.1, -4.0), glow(Color::new(0.2, 0.7, 0.4)));
    let clear = [
        ball(1.0, DVec3::ZERO, glass(1.0)),
        turned(Shape::CUBE, v(1.5, 0.0, 0.0), v(20.0, 30.0, 40.0), glass(1.0)),
        turned(Shape::CONE, v(-1.5, 0.0, 0.0), v(20.0, 30.0, 40.0), glass(1.0)),
    ];
    let path = chain(&stage_of(clear.to_vec()), ray(v(3.0, 0.3, 0.1), v(-1.0, -0.05, 0.02)));
    assert!(path.len() >= 5);
    for ray in &path {
        assert_eq!(ray.ray.direction, path[0].ray.direction);
    }
    let bare = scene(vec![behind.clone()]);
    let mut with = scene(clear.into_iter().chain([behind]).collect());
    with.camera = bare.camera;
    let (bare, with) = (picture(&bare, 96, 64), picture(&with, 96, 64));
    crate::proof::common::assert_same_picture(&bare, &with, 0.0005);
}

#[test]
fn a_slab_shifts_and_never_turns() {
    for (ior, thickness) in [(1.5, 0.5), (1.333, 3.0), (2.4, 0.01)] {
        let render_scene = stage_of(vec![block(v(200.0, thickness, 200.0), DVec3::ZERO, glass(ior))]);
        for incidence in [0.0, 1.0, 15.0, 30.0, 56.0, 75.0, 85.0] {
            let d = falling(incidence);
            let path = chain(&render_scene, ray((thickness + 1.0) / d.y * d, d));
            assert_eq!(path.len(), 3);
            assert_vec_close(direction(&path[2]), direction(&path[0]), 8e-7 / d.y.abs());
            let offset = path[2].ray.origin.as_dvec3() - path[0].ray.origin.as_dvec3();
            let shift = (offset - offset.dot(d) * d).length();
            let i = incidence.to_radians();
            let r = (i.sin() / ior).asin();
            let expected = thickness * i.sin() * (1.0 - i.cos() / (ior * r.cos()));
            assert_close(shift, expected, 1e-5 * thickness + 1e-6);
        }
    }
}

/// A prism: glass below its first face and not yet below its second, behind which a body of index 1 begins.
fn prism(apex: f64, ior: f64) -> Vec<Body> {
    vec![plane(DVec3::ZERO, 0.0, glass(ior)), plane(v(1.0, 0.0, 0.0), apex, glass(1.0))]
}

#[test]
fn the_least_deviation_of_a_60_degree_prism_is_37_180756_degrees() {
    let render_scene = stage_of(prism(60.0, 1.5));
    let deviation = |incidence: f64| {
        // The apex is at (1, 0, 0) and the glass on its left.
        let d = falling(incidence);
        let path = chain(&render_scene, ray(v(0.8, 0.0, 0.0) - 0.3 * d, d));
        assert!(path.len() >= 3, "{incidence}");
        assert!(path[1..3].iter().all(|ray| ray.kind == RayKind::Refracted), "{incidence}");
        direction(&path[0]).angle_between(direction(&path[2])).to_degrees()
    };
    let least = (300..800).map(|step| deviation(0.1 * f64::from(step))).fold(f64::INFINITY, f64::min);
    assert_close(least, 37.180_756, 2e-4);
    assert_close(deviation((1.5 * 30.0_f64.to_radians().sin()).asin().to_degrees()), 37.180_756, 2e-5);
    // Away from it, by the formula i + e - apex.
    for incidence in [30.0_f64, 40.0, 60.0, 80.0] {
        let r = (incidence.to_radians().sin() / 1.5).asin();
        let e = (1.5 * (60.0_f64.to_radians() - r).sin()).asin();
        assert_close(deviation(incidence), incidence + e.to_degrees() - 60.0, 1e-4);
    }
}

#[test]
fn a_right_angle_prism_turns_light_by_total_reflection() {
    // In through the upper face, off the hypotenuse, out through the left one.
    let mut bodies = prism(45.0, 1.5);
    bodies.push(plane(v(-0.5, 0.0, 0.0), -90.0, glass(1.0)));
    let path = chain(&stage_of(bodies), ray(v(0.5, 1.0, 0.0), DVec3::NEG_Y));
    let kinds: Vec<RayKind> = path.iter().take(4).map(|ray| ray.kind).collect();
    assert_eq!(kinds, [RayKind::Primary, RayKind::Refracted, RayKind::Reflected, RayKind::Refracted]);
    assert_vec_close(direction(&path[2]), DVec3::NEG_X, 1e-6);
    assert_vec_close(direction(&path[3]), DVec3::NEG_X, 1e-6);
    assert_eq!(path[3].weight, glam::Vec3::ONE);
}

#[test]
fn a_ball_lens_focuses_at_its_known_length() {
    for scale in [1e-2, 1.0, 100.0] {
        let render_scene = stage_of(vec![ball(scale, DVec3::ZERO, glass(1.5))]);
        let crossing = |h: f64| {
            let path = chain(&render_scene, ray(v(-3.0 * scale, h * scale, 0.0), DVec3::X));
            let (from, d) = (path[2].ray.origin.as_dvec3(), direction(&path[2]));
            (from.x - from.y * d.x / d.y) / scale
        };
        // Paraxial: nD / (4(n - 1)).
        assert_close(crossing(0.01), 1.5, 3e-4);
        // Exact: sin i / sin 2(i - r) from the center.
        for h in [0.05_f64, 0.2, 0.5, 0.8, 0.95] {
            let (i, r) = (h.asin(), (h / 1.5).asin());
            assert_close(crossing(h), i.sin() / (2.0 * (i - r)).sin(), 1e-5 / h);
        }
    }
}

#[test]
fn a_ball_never_reflects_light_from_outside_totally() {
    let render_scene = stage_of(vec![ball(1.0, DVec3::ZERO, glass(1.333))]);
    for step in 0..1000 {
        let h = f64::from(step) / 1000.0;
        let path = chain(&render_scene, ray(v(-3.0, h, 0.0), DVec3::X));
        assert_eq!(path.len(), 3, "at height {h}");
        assert!(path[1..].iter().all(|ray| ray.kind == RayKind::Refracted));
    }
}

/// The kinds of the rays on the way from the root of the tree to `ray`, without the primary one.
fn kinds_down_to<'a>(rays: &'a [RayRecord], mut ray: &'a RayRecord) -> Vec<RayKind> {
    let mut kinds = Vec::new();
    while let Some(parent) = ray.parent {
        kinds.push(ray.kind);
        ray = &rays[parent];
    }
    kinds.reverse();
    kinds
}

#[test]
fn rainbows_stand_at_their_angles() {
    // One and two inner reflections in a drop that also reflects.
    let mut water = glass(1.333);
    water.reflection = Some(0.5);
    let render_scene = stage_of(vec![ball(1.0, DVec3::ZERO, water)]).with_generations(6);
    let out_after = |bounces: usize, h: f64| {
        let rays = tree(&render_scene, ray(v(-3.0, h, 0.0), DVec3::X));
        let mut wanted = vec![RayKind::Reflected; bounces + 2];
        (wanted[0], wanted[bounces + 1]) = (RayKind::Refracted, RayKind::Refracted);
        let found = rays.iter().find(|ray| kinds_down_to(&rays, ray) == wanted).unwrap();
        direction(found).angle_between(DVec3::NEG_X).to_degrees()
    };
    let heights = || (0..2000).map(|step| f64::from(step) / 2000.0);
    let bow = heights().map(|h| out_after(1, h)).fold(0.0, f64::max);
    assert_close(bow, 42.078_1, 2e-3);
    let second = heights().filter(|h| *h > 0.8).map(|h| out_after(2, h)).fold(180.0, f64::min);
    assert_close(second, 50.890_8, 2e-3);
}

#[test]
fn total_reflection_carries_everything_and_replaces_both_terms() {
    let mut material = glass(1.5);
    (material.transmission, material.tint) = (0.5, Color::new(1.0, 0.5, 0.2));
    (material.reflection, material.ambient) = (Some(0.3), 0.0);
    let render_scene = stage_of(vec![plane(DVec3::ZERO, 0.0, material)]);
    let up = |incidence: f64| falling(incidence) * v(1.0, -1.0, 1.0);
    // Beyond the critical angle one child, undiminished.
    let rays = tree(&render_scene, ray(-up(50.0), up(50.0)));
    assert_eq!(rays.len(), 2);
    assert_eq!((rays[1].kind, rays[1].weight), (RayKind::Reflected, glam::Vec3::ONE));
    assert_vec_close(direction(&rays[1]), falling(50.0), 1e-6);
    // Below it both, each with its coefficient.
    let rays = tree(&render_scene, ray(-up(30.0), up(30.0)));
    assert_eq!(rays.len(), 3);
    assert_eq!((rays[1].kind, rays[1].weight), (RayKind::Reflected, glam::Vec3::splat(0.3)));
    assert_eq!((rays[2].kind, rays[2].weight), (RayKind::Refracted, glam::Vec3::new(0.5, 0.25, 0.1)));
}

#[test]
fn glass_is_tinted_once_per_surface() {
    let mut material = glass(1.5);
    (material.transmission, material.tint) = (0.8, Color::new(1.0, 0.5, 0.25));
    let mut scene = scene(vec![ball(1.0, DVec3::ZERO, material)]);
    scene.environment.background = Color::new(0.5, 0.6, 0.7);
    scene.camera.target = DVec3::ZERO;
    let through = [0.8_f64, 0.4, 0.2].map(|filter| filter * filter);
    let light = center(&scene).to_array();
    for (light, (filter, background)) in light.iter().zip(through.into_iter().zip([0.5, 0.6, 0.7])) {
        assert_close(f64::from(*light), filter * background, 1e-6);
    }
}

proptest! {
    #![proptest_config(cases(600))]

    /// Light goes the same way back: the ray that left a glass body, turned round, retraces its path.
    #[test]
    fn a_reversed_ray_through_glass_retraces(
        shape in prop_oneof![
            Just(Shape::SPHERE), Just(Shape::CUBE), Just(Shape::CYLINDER), Just(Shape::CONE), Just(Shape::PARABOLOID),
            Just(Shape::Cone { radius: 0.5, top_radius: 0.3, height: 1.0 }),
        ],
        turn in prop::array::uniform3(-180.0..180.0_f64), ior in 1.05..2.5_f64,
        from in prop::array::uniform3(-1.0..1.0_f64), at in prop::array::uniform3(-0.4..0.4_f64),
    ) {
        let render_scene = stage_of(vec![turned(shape, DVec3::ZERO, DVec3::from(turn), glass(ior))]);
        let from = 3.0 * DVec3::from(from).try_normalize().unwrap_or(DVec3::X);
        let there = chain(&render_scene, ray(from, DVec3::from(at) - from));
        // Curved mirrors in a row make it so too.
        prop_assume!((2..6).contains(&there.len()) && there.last().unwrap().hit.is_none());
        // Grazing on either side makes the way back arbitrarily sensitive.
        let grazing = there.iter().filter_map(|ray| {
            ray.hit.map(|hit| hit.normal.dot(ray.ray.direction.into()).abs())
        });
        prop_assume!(grazing.fold(1.0, f32::min) > 0.05);
        let last = there.last().unwrap();
        let start = last.ray.origin.as_dvec3() + direction(last);
        let back = chain(&render_scene, ray(start, -direction(last)));
        prop_assert_eq!(back.len(), there.len());
        for (a, b) in there.iter().rev().zip(&back) {
            let error = (direction(a) + direction(b)).length();
            prop_assert!(error < 2e-4, "turned by {error:e}");
        }
        let end = back.last().unwrap();
        prop_assert!(end.origin.distance(there[0].hit.unwrap().position) < 2e-4);
    }
}

#[test]
fn a_ray_from_a_hit_starts_on_its_side() {
    let render_scene = render_scene(&scene(vec![ball(1.0, DVec3::ZERO, glass(1.5))]));
    let hit = render_scene.closest_hit(&ray(v(0.0, 0.0, 5.0), DVec3::NEG_Z)).unwrap();
    assert!(!hit.hit.leaving && render_scene.closest_hit(&ray_from_hit(&hit, hit.normal)).is_none());
    let inner = render_scene.closest_hit(&ray(DVec3::ZERO, DVec3::Z)).unwrap();
    assert!(inner.hit.leaving);
    let across = render_scene.closest_hit(&ray_from_hit(&inner, inner.normal)).unwrap();
    assert_close(f64::from(across.hit.t), 2.0, 1e-6);
    assert!(across.hit.leaving);
}
