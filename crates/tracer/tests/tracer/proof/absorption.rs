//! Shadow rays lose as much in media as the rays of the tree do on the same way.

use std::sync::atomic::AtomicBool;

use catoptric_scene::{Attenuation, Body, Color, Dielectric, Falloff, Light, Phong, Scene, Shape};
use catoptric_tracer::{RayRecord, RenderControl, RenderScene, RenderSettings, WhittedIntegrator, render};
use glam::{DVec3, UVec2, Vec3};
use proptest::prelude::*;

use crate::proof::common::{
    assert_close, ball, block, camera, cases, chain, chalk, light, plane, ray, render_scene, scene, turned, v,
};

/// A clear body that is seen by what it absorbs alone.
fn stained(color: [f64; 3], distance: f64, ior: f64) -> Dielectric {
    Dielectric {
        index: ior.into(),
        attenuation: Attenuation { color: Color::from(color), distance },
        ..Dielectric::default()
    }
}

/// White and a mirror: its light says what shadow rays lose, its reflection what the tree's rays lose on the same way.
fn shining_floor() -> Phong {
    Phong { reflection: Some(1.0), ..chalk() }
}

/// The share of light that the rays of a chain leave between the point `from` and one `distance` further on.
fn left_on_the_way(rays: &[RayRecord], from: DVec3, distance: f64) -> DVec3 {
    let mut left = DVec3::ONE;
    for ray in rays {
        let start = ray.ray.origin.as_dvec3().distance(from);
        let way = ray.hit.map_or(f64::INFINITY, |hit| f64::from(hit.hit.t));
        let part = ((distance - start) / way).clamp(0.0, 1.0);
        let through = ray.through.as_dvec3();
        // A ray that escapes is in air, or in a plane, where its light is lost on a way without end.
        left *= if way.is_finite() { through.powf(part) } else { DVec3::ONE };
    }
    left
}

fn clear_body() -> impl Strategy<Value = Body> {
    let shape = prop_oneof![
        (0.3..1.5_f64).prop_map(|radius| Shape::Sphere { radius }),
        prop::array::uniform3(0.4..2.0_f64).prop_map(|size| Shape::Cube { size: size.into() }),
        (0.3..1.0_f64, 0.4..2.0_f64).prop_map(|(radius, height)| Shape::Cylinder { radius, height }),
        (0.3..1.0_f64, 0.5..2.0_f64).prop_map(|(radius, height)| Shape::Cone {
            radius,
            top_radius: 0.1,
            height
        }),
    ];
    let place = (-1.0..1.0_f64, -0.5..2.0_f64, -1.0..1.0_f64).prop_map(DVec3::from);
    let turn = prop::array::uniform3(-180.0..180.0_f64).prop_map(DVec3::from);
    // Every third absorbs nothing: a bubble.
    let material = (prop::array::uniform3(0.1..1.0_f64), 0.2..3.0_f64, 0..3_u32)
        .prop_map(|(color, distance, kind)| stained(if kind == 0 { [1.0; 3] } else { color }, distance, 1.0));
    (shape, place, turn, material)
        .prop_map(|(shape, position, rotation, material)| turned(shape, position, rotation, material))
}

proptest! {
    #![proptest_config(cases(600))]

    /// Bodies of index 1 bend nothing, so that the ray that a floor mirrors goes the way of its shadow ray: nested bodies,
    /// overlapping ones, the floor and the light within some of them.
    #[test]
    fn shadow_rays_lose_what_mirrored_rays_lose(
        bodies in prop::collection::vec(clear_body(), 1..8),
        from in (-4.0..4.0_f64, 0.5..5.0_f64, -4.0..4.0_f64),
        distance in 0.3..9.0_f64,
    ) {
        let from = DVec3::from(from);
        let there = v(0.01, 0.0, 0.02);
        let direction = (there - from).normalize();
        let mirrored = v(direction.x, -direction.y, direction.z);
        let mut scene = scene(bodies);
        scene.bodies = scene.bodies.iter().cloned().chain([plane(DVec3::ZERO, 0.0, shining_floor())]).collect();
        scene.lights = vec![light(there + distance * mirrored, 1.0, Falloff::None)];
        let rays = chain(&render_scene(&scene), ray(from, direction));
        let floor = scene.bodies.iter().count() - 1;
        let place = rays.iter().position(|ray| ray.hit.is_some_and(|hit| hit.body == floor)).unwrap();
        let answer = rays[place].answer.as_ref().unwrap();
        let shadow = answer.lights[0].shadow.as_ref().unwrap();
        let at = rays[place].hit.unwrap().position;
        let exact = left_on_the_way(&rays[place + 1..], at, distance);
        let passed = shadow.passed.as_dvec3();
        let allowed = 2e-4 + 2e-3 * exact.max_element();
        prop_assert!((passed - exact).abs().max_element() < allowed, "{passed}, not {exact}");
        // The audit tells it crossing by crossing, by the rule of the eye's rays.
        let filters = shadow.crossings.iter().map(|crossing| crossing.filter.unwrap());
        let told = (filters.product::<Vec3>() * shadow.through).as_dvec3();
        prop_assert!((passed - told).abs().max_element() < 1e-4, "{passed}, but told {told}");
    }
}

/// What arrives under a hollow ball straight below the light: only its wall absorbs.
#[test]
fn only_the_wall_of_a_hollow_ball_shades() {
    for (inner, absorbing) in [(0.99, true), (0.5, true), (0.9, false)] {
        let left = if absorbing { 0.1 } else { 1.0 };
        let mut scene = scene(vec![
            plane(DVec3::ZERO, 0.0, chalk()),
            ball(inner, v(0.0, 1.5, 0.0), stained([1.0; 3], 1.0, 1.0)),
            ball(1.0, v(0.0, 1.5, 0.0), stained([left; 3], 1.0, 1.5)),
        ]);
        scene.environment.ambient = Color::BLACK;
        scene.lights = vec![light(v(0.0, 5.0, 0.0), 1.0, Falloff::None)];
        let render_scene = render_scene(&scene);
        let found = chain(&render_scene, ray(v(3.0, 0.3, 0.0), v(-3.0, -0.3, 0.0)));
        let light = found[0].local.x;
        let exact = 0.96 * 0.96 * f64::powf(left, 2.0 * (1.0 - inner));
        assert_close(light.into(), exact, 1e-4);
    }
}

/// A room full of fog, with the lamp in it: no surface is crossed, and yet light is lost.
#[test]
fn fog_that_holds_point_and_light_absorbs() {
    let fog = stained([0.5, 0.8, 0.1], 1.0, 1.0);
    let rooms = [
        block(v(20.0, 20.0, 20.0), v(0.0, 5.0, 0.0), fog.clone()),
        ball(30.0, v(1.0, 2.0, 3.0), fog.clone()),
        // Below a plane.
        plane(v(0.0, 40.0, 0.0), 0.0, fog),
    ];
    for room in rooms {
        let mut scene = scene(vec![room, plane(DVec3::ZERO, 0.0, chalk())]);
        scene.environment.ambient = Color::BLACK;
        scene.lights = vec![light(v(0.0, 2.0, 0.0), 1.0, Falloff::None)];
        let lit = chain(&render_scene(&scene), ray(v(0.0, 1.0, 0.0), -DVec3::Y))[0].local;
        for (lit, left) in lit.to_array().into_iter().zip([0.5_f64, 0.8, 0.1]) {
            assert_close(lit.into(), left.powi(2), 1e-4);
        }
    }
}

/// Very many bodies: rays go through a hierarchy, those that were reflected as streams.
fn crowd(count: usize) -> Scene {
    let nested = |index: usize| {
        let turn = index as f64 * 2.399_963;
        let out = (index as f64 / count as f64).sqrt() * 3.0;
        let at = v(out * turn.cos(), 0.4 + 0.9 * (index % 5) as f64 / 5.0, out * turn.sin());
        let color = [0.2 + 0.1 * (index % 7) as f64, 0.9, 0.3 + 0.1 * (index % 3) as f64];
        [
            ball(0.4, at, stained(color, 0.5, 1.0 + 0.1 * (index % 4) as f64)),
            ball(0.3, at, stained([1.0; 3], 1.0, 1.0)),
        ]
    };
    let mut bodies: Vec<Body> = (0..count).flat_map(nested).collect();
    bodies.push(plane(DVec3::ZERO, 0.0, shining_floor()));
    bodies.push(plane(v(0.0, 0.2, 0.0), 0.0, stained([0.7, 0.9, 0.8], 1.0, 1.0)));
    let mut scene = scene(bodies);
    scene.environment.background = Color::new(0.4, 0.5, 0.6);
    scene.tracing.generations = 3;
    scene.camera = camera(v(0.0, 3.0, 8.0), v(0.0, 0.5, 0.0), 40.0);
    let lamp = |x: f64| Light { position: v(x, 6.0, 2.0), intensity: 0.5, ..Light::default() };
    scene.lights = vec![lamp(-3.0), lamp(2.0)];
    scene
}

#[test]
fn packets_streams_and_single_rays_absorb_alike() {
    let size = UVec2::new(96, 64);
    for count in [3, 20, 200] {
        let render_scene: RenderScene = render_scene(&crowd(count));
        let settings = RenderSettings { width: size.x, height: size.y, samples: 1 };
        let picture = render(&render_scene, settings, &RenderControl::default()).unwrap().picture;
        let cancel = AtomicBool::new(false);
        let mut tracer = WhittedIntegrator::new(&render_scene, &cancel);
        for (place, pixel) in (0..).zip(picture.pixels()).step_by(7) {
            let at = UVec2::new(place % size.x, place / size.x);
            let alone = tracer.pixel_tally(at, size, 0, 1 << 16);
            assert!(alone.is_complete);
            let sum = alone.light().as_vec3();
            let off = (Vec3::from(*pixel) - sum).abs().max_element();
            assert!(off <= 1e-6 * (1.0 + sum.max_element()), "{count}: {pixel:?} at {at}, alone {sum}");
        }
    }
}
