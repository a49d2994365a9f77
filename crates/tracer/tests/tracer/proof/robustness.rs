//! Surfaces that neither shade themselves nor leak, at any scale, place, proportion and angle.

use std::f64::consts::TAU;

use catoptric_scene::{Anchor, Body, Color, Falloff, Placement, Shape};
use catoptric_tracer::{Ray, RayOrigin};
use glam::{DMat3, DQuat, DVec3, EulerRot, Vec3};
use proptest::prelude::*;

use crate::proof::common::oracle::Oracle;
use crate::proof::common::{
    assert_close, ball, block, camera, cases, chain, chalk, glass, glow, light, light_along, mirror, picture,
    placed, plane, ray, ray_from_hit, scene, stage_of, textbook, tree, turned, v,
};

fn shape() -> impl Strategy<Value = Shape> {
    prop_oneof![
        Just(Shape::SPHERE),
        Just(Shape::CUBE),
        Just(Shape::CYLINDER),
        Just(Shape::CONE),
        Just(Shape::PARABOLOID),
        Just(Shape::Cone { radius: 0.5, top_radius: 0.2, height: 1.0 }),
        Just(Shape::Cone { radius: 0.3, top_radius: 0.6, height: 1.0 }),
    ]
}

fn unit() -> impl Strategy<Value = DVec3> {
    (-1.0..1.0_f64, 0.0..TAU).prop_map(|(y, turn)| {
        let r = (1.0 - y * y).sqrt();
        v(r * turn.cos(), y, r * turn.sin())
    })
}

/// A body anywhere up to 10⁴ from the origin, of any size from 10⁻³ to 10³, stretched by up to 1:30 each way.
fn placement() -> impl Strategy<Value = Placement> {
    let power = -0.75..0.75_f64;
    (unit(), -1.0..4.0_f64, unit(), -3.0..3.0_f64, prop::array::uniform3(power)).prop_map(
        |(towards, far, turn, size, stretch)| Placement {
            anchor: Anchor::Frame { position: towards * 10.0_f64.powf(far), rotation_degrees: 180.0 * turn },
            scale: 10.0_f64.powf(size) * DVec3::from_array(stretch.map(|power| 10.0_f64.powf(power))),
        },
    )
}

/// The ray in space that is, in the body's frame, from a place around it towards one in it.
fn ray_at(placement: &Placement, from: DVec3, at: DVec3) -> Ray {
    let world_from_body = placement.world_from_body();
    let (from, at) = (world_from_body.transform_point3(from), world_from_body.transform_point3(at));
    ray(from, at - from)
}

proptest! {
    #![proptest_config(cases(3000))]

    /// However a ray leaves a convex body outwards, it never meets that body again.
    #[test]
    fn a_ray_that_leaves_never_returns(
        shape in shape(), placement in placement(), from in unit(), at in unit(), out in unit(),
    ) {
        let render_scene = stage_of(vec![placed(shape, placement, mirror())]);
        let hit = render_scene.closest_hit(&ray_at(&placement, 4.0 * from, 0.3 * at));
        prop_assume!(hit.is_some());
        let hit = hit.unwrap();
        let out = out.as_vec3().normalize();
        let out = if out.dot(hit.normal) < 0.0 { -out } else { out };
        prop_assert!(!hit.hit.leaving);
        prop_assert_eq!(render_scene.closest_hit(&ray_from_hit(&hit, out)), None);
        // Nor does one that grazes the surface.
        let grazing = out.reject_from(hit.normal).normalize_or(Vec3::X);
        prop_assert_eq!(render_scene.closest_hit(&ray_from_hit(&hit, grazing)), None);
        // The mirrored one in particular: one reflection and off.
        prop_assert_eq!(chain(&render_scene, ray_at(&placement, 4.0 * from, 0.3 * at)).len(), 2);
    }

    /// A ray that heads into a body always meets its far side, exactly once.
    #[test]
    fn a_ray_that_enters_always_leaves(
        shape in shape(), placement in placement(), from in unit(), at in unit(), ior in 0.5..2.5_f64,
    ) {
        let mut clear = glass(ior);
        clear.reflection = Some(0.0);
        let render_scene = stage_of(vec![placed(shape, placement, clear)]);
        let path = chain(&render_scene, ray_at(&placement, 4.0 * from, 0.3 * at));
        prop_assume!(path.len() > 1);
        // Total reflections keep it inside; all rays but the first and last run inside.
        prop_assume!(path.last().unwrap().hit.is_none());
        for inner in &path[1..path.len() - 1] {
            prop_assert!(inner.hit.unwrap().hit.leaving);
        }
        prop_assert!(path[0].hit.is_none_or(|hit| !hit.hit.leaving));
    }

    /// A lit point is not shaded by its own body: k_d = 1 gives the cosine itself.
    #[test]
    fn no_body_shades_its_own_lit_side(
        shape in shape(), placement in placement(), from in unit(), at in unit(), towards in unit(),
    ) {
        let mut scene = scene(vec![placed(shape, placement, chalk())]);
        let far = placement.world_from_body().transform_point3(DVec3::ZERO)
            + 1e3 * placement.scale.max_element() * towards;
        scene.lights = vec![light(far, 1.0, Falloff::None)];
        let render_scene = crate::proof::common::render_scene(&scene);
        let start = ray_at(&placement, 4.0 * from, 0.3 * at);
        let hit = render_scene.closest_hit(&start);
        prop_assume!(hit.is_some());
        let hit = hit.unwrap();
        let to_light = (far - hit.position).normalize();
        let cos = to_light.dot(hit.normal.as_dvec3());
        let expected = cos.max(0.0);
        // The light's own place is rounded: to 1e-7 of its distance from the world's origin.
        let rounding = 4e-7 * (1.0 + far.length() / far.distance(hit.position));
        let light = f64::from(light_along(&render_scene, start).x);
        prop_assert!((light - expected).abs() < 1e-5 + rounding, "{light} instead of {expected}");
    }

    /// Points that the tracer calls hits lie on the surface as the textbook has it.
    #[test]
    fn hits_lie_on_the_surface(shape in shape(), placement in placement(), from in unit(), at in unit()) {
        let render_scene = stage_of(vec![placed(shape, placement, mirror())]);
        let start = ray_at(&placement, 4.0 * from, 0.3 * at);
        let Anchor::Frame { position, .. } = placement.anchor else { unreachable!() };
        if let Some(hit) = render_scene.closest_hit(&start) {
            let body_from_world = placement.world_from_body().inverse();
            let own = body_from_world.transform_point3(hit.position);
            let off = textbook::implicit(&shape, own).abs() * placement.scale.min_element();
            let rounding = 1e-7 * (position.length() + placement.scale.length());
            prop_assert!(off < 2.0 * rounding, "off the surface by {off:e}, rounding {rounding:e}");
        }
    }
}

#[test]
fn rays_that_are_not_finite_meet_nothing() {
    let shapes = [Shape::SPHERE, Shape::CUBE, Shape::CYLINDER, Shape::CONE, Shape::PARABOLOID, Shape::Plane];
    let few: Vec<Body> =
        shapes.map(|shape| turned(shape, DVec3::ZERO, v(10.0, 20.0, 30.0), glass(1.5))).to_vec();
    let many: Vec<Body> = (0..20).flat_map(|_| few.clone()).collect();
    for render_scene in [stage_of(few), stage_of(many)] {
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            for place in 0..6 {
                for (origin, direction) in
                    [(Vec3::Y * 3.0, Vec3::NEG_Y), (Vec3::ZERO, Vec3::Z), (Vec3::ONE, -Vec3::ONE)]
                {
                    let mut numbers = [origin.to_array(), direction.to_array()].concat();
                    numbers[place] = bad;
                    let bad =
                        Ray::from_point(Vec3::from_slice(&numbers[..3]), Vec3::from_slice(&numbers[3..]));
                    assert_eq!(render_scene.closest_hit(&bad), None, "{bad:?}");
                }
            }
        }
    }
}

/// The largest difference of pixels that have both a left and a right neighbour much nearer to each other than to them.
fn outliers(picture: &catoptric_picture::Picture) -> usize {
    picture
        .rows()
        .flat_map(|row| row.windows(3))
        .filter(|pixels| {
            let [a, b, c] = [pixels[0][1], pixels[1][1], pixels[2][1]];
            (b - a).abs().min((b - c).abs()) > 0.02 + 4.0 * (a - c).abs()
        })
        .count()
}

/// Lit shapes squashed or stretched to 1:1000, as the oracle sees them.
#[test]
fn sheets_and_needles_show_neither_acne_nor_leaks() {
    for shape in [Shape::SPHERE, Shape::CUBE, Shape::CYLINDER, Shape::CONE, Shape::PARABOLOID] {
        for scale in [v(2.0, 0.002, 2.0), v(0.002, 2.0, 0.002), v(2.0, 2.0, 0.002)] {
            for material in [chalk(), glass(1.5)] {
                let rotation_degrees = v(25.0, 40.0, 15.0);
                let anchor = Anchor::Frame { position: v(0.0, 0.1, 0.0), rotation_degrees };
                let mut scene = scene(vec![
                    placed(shape, Placement { anchor, scale }, material),
                    plane(v(0.0, -1.5, 0.0), 0.0, chalk()),
                ]);
                scene.camera = camera(v(0.0, 0.6, 5.0), DVec3::ZERO, 25.0);
                scene.lights = vec![light(v(2.0, 5.0, 4.0), 1.0, Falloff::None)];
                scene.environment.background = Color::new(0.2, 0.3, 0.4);
                let ours = picture(&scene, 120, 80);
                let truth = Oracle::new(&scene, 100.0).picture(120, 80);
                crate::proof::common::assert_same_picture(&ours, &truth, 0.0003);
                assert!(outliers(&ours) <= outliers(&truth) + 2, "{shape:?} {scale}");
            }
        }
    }
}

#[test]
fn a_body_seen_from_10_000_sizes_away_is_whole() {
    for shape in [Shape::SPHERE, Shape::CUBE, Shape::CYLINDER, Shape::CONE, Shape::PARABOLOID] {
        let mut scene = scene(vec![turned(shape, DVec3::ZERO, v(20.0, 30.0, 10.0), chalk())]);
        let from = 1e4 * v(0.48, 0.6, 0.64);
        scene.camera = camera(from, DVec3::ZERO, 0.012);
        scene.lights = vec![light(1e4 * v(0.64, 0.6, 0.48), 1.0, Falloff::None)];
        let ours = picture(&scene, 96, 96);
        let truth = Oracle::new(&scene, 1e3).picture(96, 96);
        crate::proof::common::assert_same_picture(&ours, &truth, 0.001);
        assert!(outliers(&ours) <= outliers(&truth) + 2, "{shape:?}");
    }
}

#[test]
fn a_plane_is_seen_up_to_its_horizon() {
    let render_scene = stage_of(vec![plane(DVec3::ZERO, 0.0, glow(Color::WHITE))]);
    for slope in [1.0, 1e-3, 1e-6, 1e-12, 1e-20, 1e-30] {
        let hit = render_scene.closest_hit(&ray(v(0.0, 1.0, 0.0), v(0.3, -slope, -1.0)));
        assert_eq!(hit.map(|hit| hit.body), Some(0), "slope {slope}");
        assert!(render_scene.closest_hit(&ray(v(0.0, 1.0, 0.0), v(0.3, slope, -1.0))).is_none());
    }
    assert!(render_scene.closest_hit(&ray(v(0.0, 1.0, 0.0), DVec3::NEG_Z)).is_none());
    let light = light_along(&render_scene, ray(v(0.0, 1.0, 0.0), v(0.3, -1e-20, -1.0)));
    assert_eq!(light, Vec3::ONE);
}

#[test]
fn grazing_rays_reflect_off_planes_and_balls() {
    let floor = stage_of(vec![plane(DVec3::ZERO, 0.0, mirror())]);
    let ball = stage_of(vec![ball(1.0, v(0.0, -1.0, 0.0), mirror())]);
    for slope in [0.1, 1e-2, 1e-3, 1e-4] {
        let path = chain(&floor, ray(v(-10.0, 10.0 * slope, 0.0), v(1.0, -slope, 0.0)));
        assert_eq!(path.len(), 2);
        assert_close(f64::from(path[1].ray.direction.y), slope / slope.hypot(1.0), 1e-6);
        let path = chain(&ball, ray(v(-10.0, 10.0 * slope, 0.0), v(1.0, -slope, 0.0)));
        assert_eq!(path.len(), 2, "slope {slope}");
        // The ray is known to 10⁻⁶ across, so the point it grazes, and with it the normal, to the root of that.
        let sin = slope / slope.hypot(1.0);
        assert_close(f64::from(path[1].ray.direction.y), sin, 4e-3_f64.min(4e-6 / slope));
    }
}

#[test]
fn a_closed_mirror_room_does_not_leak() {
    // Rays reflected 63 times from within: not one may slip out, even through edges and corners.
    let rooms = [
        block(v(2.0, 3.0, 4.0), DVec3::ZERO, mirror()),
        ball(1.5, DVec3::ZERO, mirror()),
        turned(Shape::Cylinder { radius: 1.0, height: 2.0 }, v(0.0, -1.0, 0.0), DVec3::ZERO, mirror()),
        turned(
            Shape::Cone { radius: 2.0, top_radius: 0.0, height: 3.0 },
            v(0.0, -1.0, 0.0),
            DVec3::ZERO,
            mirror(),
        ),
        turned(
            Shape::Cone { radius: 1.0, top_radius: 2.0, height: 2.0 },
            v(0.0, -1.0, 0.0),
            DVec3::ZERO,
            mirror(),
        ),
    ];
    for offset in [DVec3::ZERO, v(1e3, -2e3, 3e3)] {
        for mut room in rooms.clone() {
            let Anchor::Frame { position, .. } = &mut room.placement.anchor else { unreachable!() };
            *position += offset;
            let render_scene = stage_of(vec![room.clone()]);
            for step in 0..2000 {
                // Directions spread evenly, aimed exactly along axes and diagonals now and then.
                let turn = f64::from(step) * 2.399_963;
                let y = 1.0 - f64::from(step) / 1000.0;
                let r = (1.0 - y * y).max(0.0).sqrt();
                let d = if step % 100 == 0 { v(1.0, 1.0, 1.0) } else { v(r * turn.cos(), y, r * turn.sin()) };
                let rays = tree(&render_scene, ray(offset + v(0.1, 0.2, 0.1) * f64::from(step % 2), d));
                assert_eq!(rays.len(), 64, "{:?}, ray {step} escaped", room.shape);
                assert!(rays.iter().all(|ray| ray.hit.is_some_and(|hit| hit.hit.t >= 0.0)));
            }
        }
    }
}

#[test]
fn a_room_of_six_blocks_does_not_leak() {
    let wall = glow(Color::WHITE);
    let render_scene = stage_of(vec![
        block(v(6.0, 1.0, 6.0), v(0.0, -1.5, 0.0), wall.clone()),
        block(v(6.0, 1.0, 6.0), v(0.0, 1.5, 0.0), wall.clone()),
        block(v(1.0, 2.0, 6.0), v(-2.5, 0.0, 0.0), wall.clone()),
        block(v(1.0, 2.0, 6.0), v(2.5, 0.0, 0.0), wall.clone()),
        block(v(4.0, 2.0, 1.0), v(0.0, 0.0, -2.5), wall.clone()),
        block(v(4.0, 2.0, 1.0), v(0.0, 0.0, 2.5), wall),
    ]);
    for step in 0..20_000 {
        // Straight at the seams.
        let along = 4.0 * (f64::from(step) / 20_000.0 - 0.5);
        for seam in [v(along, -1.0, -2.0), v(2.0, 1.0, along), v(-2.0, 0.5 * along, 2.0)] {
            let hit = render_scene.closest_hit(&ray(v(0.1, 0.2, 0.3), seam - v(0.1, 0.2, 0.3)));
            let t = f64::from(hit.expect("the seam is closed").hit.t);
            assert!(t < seam.distance(v(0.1, 0.2, 0.3)) + 1e-4, "through the seam at {seam}");
        }
    }
}

#[test]
fn touching_bodies_shade_the_floor_up_to_the_contact() {
    // A box on the floor: under its edge there is no strip of light, and beside it no strip of shadow.
    for (scale, offset) in [(1.0, DVec3::ZERO), (1e-3, DVec3::ZERO), (1.0, v(500.0, 0.0, 700.0))] {
        let mut scene = scene(vec![
            plane(DVec3::ZERO, 0.0, chalk()),
            block(scale * DVec3::ONE, scale * v(0.0, 0.5, 0.0) + offset, chalk()),
        ]);
        scene.lights = vec![light(scale * v(-30.0, 30.0, 0.0) + offset, 1.0, Falloff::None)];
        let render_scene = crate::proof::common::render_scene(&scene);
        for step in 1..1000 {
            let z = scale * 0.9 * (f64::from(step) / 1000.0 - 0.5);
            let floor_at = |x: f64| {
                let at = v(scale * x, 0.0, z) + offset;
                let from = at + scale * v(if x > 0.0 { 3.0 } else { -3.0 }, 3.0, 0.0);
                light_along(&render_scene, ray(from, at - from)).x
            };
            assert_eq!(floor_at(0.501), 0.0, "a strip of light");
            assert!(floor_at(-0.501) > 0.6, "a strip of shadow");
        }
    }
}

#[test]
fn starts_within_a_mirror_image_are_told_apart_from_hits() {
    // The same point and direction, with and without knowledge of the surface.
    let render_scene = stage_of(vec![ball(1.0, DVec3::ZERO, glass(1.5))]);
    let inwards =
        Ray { start: RayOrigin { body: 0, inwards: true }, ..Ray::from_point(Vec3::Z, Vec3::NEG_Z) };
    assert_close(f64::from(render_scene.closest_hit(&inwards).unwrap().hit.t), 2.0, 1e-6);
    let outwards = Ray { start: RayOrigin { body: 0, inwards: false }, ..inwards };
    assert_eq!(render_scene.closest_hit(&outwards), None);
}

#[test]
fn turned_transforms_agree_with_the_textbook_in_space() {
    let mut runner = proptest::test_runner::TestRunner::new(cases(2000));
    let strategy = (shape(), unit(), unit(), unit(), prop::array::uniform3(-1.5..1.5_f64));
    runner
        .run(&strategy, |(shape, turn, from, at, stretch)| {
            let scale = DVec3::from_array(stretch.map(|power| 10.0_f64.powf(power)));
            let rotation_degrees = 180.0 * turn;
            let placement = Placement { anchor: Anchor::Frame { position: at, rotation_degrees }, scale };
            let start = ray_at(&placement, 3.0 * from, 0.25 * at);
            let [x, y, z] = rotation_degrees.to_array().map(f64::to_radians);
            let turn = DMat3::from_quat(DQuat::from_euler(EulerRot::ZYX, z, y, x));
            let own = |vector: DVec3| (turn.transpose() * vector) / scale;
            let (o, d) = (own(start.origin.as_dvec3() - at), own(start.direction.as_dvec3()));
            let hits = textbook::crossings(&shape, o, d);
            let found = stage_of(vec![placed(shape, placement, mirror())]).closest_hit(&start);
            let Some(&(t, normal)) = hits.first() else { return Ok(()) };
            // Only clear hits: through the middle, not along a surface.
            let normal = (turn * (normal / scale)).normalize();
            let cos = -normal.dot(start.direction.as_dvec3());
            let chord = hits.last().map_or(0.0, |last| last.0 - t);
            prop_assume!(cos > 0.1 && chord > 1e-2 * t);
            let found = found.ok_or_else(|| TestCaseError::fail("missed"))?;
            prop_assert!((f64::from(found.hit.t) - t).abs() < 1e-4 * t, "{} {t}", found.hit.t);
            Ok(())
        })
        .unwrap();
}
