//! Plane and curved mirrors whose answers are known exactly.

use catoptric_scene::{Body, Color, Shape};
use catoptric_tracer::{RayKind, RenderScene};
use glam::{DVec3, EulerRot};
use proptest::prelude::*;

use crate::proof::common::{
    assert_close, assert_light, assert_vec_close, ball, block, cases, chain, direction, glow, light_along,
    mirror, plane, ray, stage_of, tree, turned, v,
};

/// A unit vector of the xy-plane.
fn at_angle(degrees: f64) -> DVec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    v(cos, sin, 0.0)
}

fn unit() -> impl Strategy<Value = DVec3> {
    (-1.0..1.0_f64, 0.0..std::f64::consts::TAU).prop_map(|(y, turn)| {
        let r = (1.0 - y * y).sqrt();
        v(r * turn.cos(), y, r * turn.sin())
    })
}

fn any_shape() -> impl Strategy<Value = Shape> {
    prop_oneof![
        Just(Shape::SPHERE),
        Just(Shape::CUBE),
        Just(Shape::CYLINDER),
        Just(Shape::CONE),
        Just(Shape::PARABOLOID),
        Just(Shape::Cone { radius: 0.5, top_radius: 0.3, height: 1.0 }),
        Just(Shape::Plane),
    ]
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn the_law_of_reflection_holds_on_every_shape(
        shape in any_shape(), turn in unit(), scale in 0.2..5.0_f64, from in unit(), at in unit(),
    ) {
        let mut body = turned(shape, DVec3::ZERO, 180.0 * turn, mirror());
        body.placement.scale = v(scale, 1.0, 1.0 / scale);
        let (origin, target) = (20.0 * from, 0.4 * at);
        let path = chain(&stage_of(vec![body]), ray(origin, target - origin));
        prop_assume!(path.len() > 1);
        let normal = path[0].hit.unwrap().normal.as_dvec3();
        let (d, mirrored) = (direction(&path[0]), direction(&path[1]));
        prop_assert!((mirrored.length() - 1.0).abs() < 2e-7);
        prop_assert!((mirrored.dot(normal) + d.dot(normal)).abs() < 1e-6);
        // In the plane of incidence: what is along the surface stays.
        let along = |d: DVec3| d - d.dot(normal) * normal;
        prop_assert!((along(d) - along(mirrored)).length() < 1e-6);
        prop_assert!(d.dot(normal) <= 0.0);
    }

    #[test]
    fn a_mirror_turned_by_a_turns_the_ray_by_2a(incidence in 0.0..70.0_f64, a in -15.0..15.0_f64) {
        let turned_by = |a: f64| {
            let path = chain(&stage_of(vec![plane(DVec3::ZERO, a, mirror())]), ray(at_angle(90.0 + incidence), -at_angle(90.0 + incidence)));
            direction(&path[1])
        };
        let cos = turned_by(0.0).dot(turned_by(a));
        let sin = turned_by(0.0).cross(turned_by(a)).z;
        prop_assert!((sin.atan2(cos).to_degrees() - 2.0 * a).abs() < 2e-5);
    }

    #[test]
    fn two_mirrors_at_b_turn_by_2b_whatever_the_incidence(b in 50.0..130.0_f64, aim in 0.0..1.0_f64) {
        // A floor and a wall that meet in the origin at the angle b.
        let render_scene = stage_of(vec![plane(DVec3::ZERO, 0.0, mirror()), plane(DVec3::ZERO, b - 180.0, mirror())]);
        let from = 2.0 * at_angle(0.5 * b);
        let start = ray(from, v(-0.3 + 1.3 * aim, 0.0, 0.0) - from);
        let path = chain(&render_scene, start);
        prop_assume!(path.len() == 3);
        let (first, last) = (direction(&path[0]), direction(&path[2]));
        let turn = first.cross(last).z.atan2(first.dot(last)).to_degrees().abs();
        let expected = if b > 90.0 { 360.0 - 2.0 * b } else { 2.0 * b };
        prop_assert!((turn - expected).abs() < 4e-5, "turned by {turn}, not {expected}");
    }

    #[test]
    fn a_corner_returns_every_ray_that_meets_all_three(
        from in (0.01..5.0_f64, 0.01..5.0_f64, 0.01..5.0_f64), d in unit(), turn in unit(),
    ) {
        // Three walls along the axes, all turned together; a ray that falls on each of them comes back.
        let walls = [v(0.0, 0.0, -90.0), v(0.0, 0.0, 0.0), v(90.0, 0.0, 0.0)];
        let rotation = glam::DQuat::from_euler(EulerRot::ZYX, turn.z, turn.y, turn.x);
        let bodies = walls.map(|degrees| {
            let wall = glam::DQuat::from_euler(
                EulerRot::ZYX, degrees.z.to_radians(), degrees.y.to_radians(), degrees.x.to_radians());
            let (z, y, x) = (rotation * wall).to_euler(EulerRot::ZYX);
            turned(Shape::Plane, DVec3::ZERO, v(x.to_degrees(), y.to_degrees(), z.to_degrees()), mirror())
        });
        let d = -d.abs();
        prop_assume!(d.max_element() < -1e-3);
        let path = chain(&stage_of(bodies.to_vec()), ray(rotation * DVec3::from(from), rotation * d));
        prop_assert_eq!(path.len(), 4);
        prop_assert!((direction(&path[3]) + direction(&path[0])).length() < 1e-6);
    }
}

#[test]
fn a_corner_of_solid_boxes_returns_rays() {
    let render_scene = stage_of(vec![
        block(v(0.1, 10.0, 10.0), v(-0.05, 5.0, 5.0), mirror()),
        block(v(10.0, 0.1, 10.0), v(5.0, -0.05, 5.0), mirror()),
        block(v(10.0, 10.0, 0.1), v(5.0, 5.0, -0.05), mirror()),
    ]);
    let d = v(-0.5, -0.7, -0.9);
    for target in [v(1.0, 0.0, 1.3), v(0.0, 0.4, 0.4), v(1.0, 2.0, 0.0)] {
        let path = chain(&render_scene, ray(target - 3.0 * d, d));
        assert_eq!(path.len(), 4);
        assert_vec_close(direction(&path[3]), -direction(&path[0]), 1e-6);
    }
}

/// Two mirrors that face each other at the distance `gap` along x.
fn corridor(gap: f64, rho: f64, glow: f64) -> Vec<Body> {
    let mut wall = mirror();
    (wall.pattern.color, wall.ambient, wall.reflection) = (Color::WHITE, glow, Some(rho));
    vec![plane(DVec3::ZERO, -90.0, wall.clone()), plane(v(gap, 0.0, 0.0), 90.0, wall)]
}

/// The light of the corridor's walls, each of emission 1, cut after `generations`.
fn corridor_light(rho: f64, generations: u32, d: DVec3) -> f64 {
    let render_scene = stage_of(corridor(2.0, rho, 1.0)).with_generations(generations);
    f64::from(light_along(&render_scene, ray(v(0.7, 0.3, -0.4), d)).x)
}

#[test]
fn generations_cut_the_series_of_a_corridor_exactly_there() {
    for rho in [0.5_f64, 0.8, 0.9, 0.95, 0.99] {
        for generations in 1..=64 {
            let expected = (1.0 - rho.powi(generations as i32)) / (1.0 - rho);
            // Straight across, and askew.
            for d in [DVec3::X, v(1.0, 0.02, 0.01)] {
                assert_close(corridor_light(rho, generations, d), expected, 1e-5 * expected);
            }
        }
    }
}

#[test]
fn depths_for_a_loss_below_one_in_512() {
    for (rho, depth) in [(0.5_f64, 9), (0.8, 28), (0.9, 60)] {
        let loss = |generations| 1.0 - corridor_light(rho, generations, DVec3::X) * (1.0 - rho);
        // For one half the loss is 1/512 itself.
        assert!(loss(depth) <= 1.0 / 512.0 + 1e-7, "{rho}: {}", loss(depth));
        assert!(loss(depth - 1) > 1.0 / 512.0, "{rho}: {}", loss(depth - 1));
    }
    // Beyond 64 generations only the law that the test above established can be asked.
    for (rho, depth) in [(0.95_f64, 122), (0.99, 621)] {
        assert!(rho.powi(depth) < 1.0 / 512.0 && rho.powi(depth - 1) > 1.0 / 512.0);
    }
}

#[test]
fn a_lamp_in_a_corridor_is_seen_in_images_of_falling_brightness() {
    let (gap, rho, lamp, radius) = (2.0, 0.8, v(0.5, 0.0, 0.0), 0.05);
    let mut bodies = corridor(gap, rho, 0.0);
    bodies.push(ball(radius, lamp, glow(Color::WHITE)));
    let render_scene = stage_of(bodies);
    let eye = v(1.2, 0.0, 3.0);
    for k in 0..=30 {
        // Unfolding carries the lamp to x = k·gap + its place, mirrored for odd k.
        let within = if k % 2 == 0 { lamp.x } else { gap - lamp.x };
        let image = v(f64::from(k) * gap + within, 0.0, 0.0);
        let path = chain(&render_scene, ray(eye, image - eye));
        assert_eq!(path.len(), k as usize + 1);
        assert_eq!(path.last().unwrap().hit.unwrap().body, 2);
        let length: f64 = path.iter().map(|ray| f64::from(ray.hit.unwrap().hit.t)).sum();
        let distance = eye.distance(image) - radius;
        assert_close(length, distance, 1e-5 * distance);
        let light: f64 = path.iter().map(|ray| f64::from(ray.light.x)).sum();
        assert_close(light, rho.powi(k), 1e-5 * rho.powi(k));
    }
}

#[test]
fn a_plane_mirror_shows_the_mirrored_point_in_its_own_size() {
    let lamp = v(0.6, 1.5, -2.0);
    let radius = 0.25;
    let render_scene =
        stage_of(vec![plane(DVec3::ZERO, 0.0, mirror()), ball(radius, lamp, glow(Color::WHITE))]);
    let image = v(lamp.x, -lamp.y, lamp.z);
    for eye in [v(0.0, 1.0, 4.0), v(-3.0, 0.2, 1.0), v(9.0, 5.0, -7.0)] {
        let towards = (image - eye).normalize();
        let aside = towards.any_orthonormal_vector();
        // The silhouette of a ball at distance a subtends the angle asin(r/a).
        let half_angle = (radius / eye.distance(image)).asin();
        for (share, seen) in [(0.0, true), (0.999, true), (1.001, false)] {
            let angle = share * half_angle;
            let d = angle.cos() * towards + angle.sin() * aside;
            let path = chain(&render_scene, ray(eye, d));
            assert_eq!(path.last().unwrap().hit.is_some_and(|hit| hit.body == 1), seen, "{eye} {share}");
            assert_eq!(path[1].kind, RayKind::Reflected);
        }
    }
}

/// The number of separate images of a lamp in the angle between two mirrors, by a ring of rays from the eye.
fn images_between_mirrors(angle: f64, lamp: DVec3, eye: DVec3) -> usize {
    let render_scene = stage_of(vec![
        plane(DVec3::ZERO, 0.0, mirror()),
        plane(DVec3::ZERO, angle - 180.0, mirror()),
        ball(0.01, lamp, glow(Color::WHITE)),
    ]);
    let seen = |step: i32| {
        let path = chain(&render_scene, ray(eye, at_angle(f64::from(step) * 0.05)));
        let reflections = path.len() - 1;
        (path.last().unwrap().hit.is_some_and(|hit| hit.body == 2) && reflections > 0).then_some(reflections)
    };
    (0..7200).filter(|&step| seen(step).is_some() && seen(step - 1).is_none()).count()
}

#[test]
fn two_mirrors_at_360_over_m_make_m_minus_1_images() {
    for m in [4_u32, 6, 8, 10, 12] {
        let angle = 360.0 / f64::from(m);
        let count = images_between_mirrors(angle, 1.95 * at_angle(0.45 * angle), at_angle(0.52 * angle));
        assert_eq!(count, m as usize - 1, "at {angle} degrees");
    }
}

/// Where the line of a ray in the xy-plane crosses the x axis.
fn crossing_of_axis(from: DVec3, d: DVec3) -> f64 {
    from.x - from.y * d.x / d.y
}

/// A ball mirror of radius `radius` about the origin.
fn mirror_ball(radius: f64) -> RenderScene {
    stage_of(vec![ball(radius, DVec3::ZERO, mirror())])
}

#[test]
fn paraxial_rays_obey_the_mirror_equation() {
    // Concave: the ball's inner side, vertex at (2, 0, 0), 1/do + 1/di = 2/R.
    let (radius, object) = (2.0, 3.0);
    let path = tree(&mirror_ball(radius), ray(v(radius - object, 0.0, 0.0), v(1.0, 0.004, 0.0)));
    let image = radius - crossing_of_axis(path[1].ray.origin.as_dvec3(), direction(&path[1]));
    assert_close(image, 1.5, 1e-3);
    // Convex: vertex at (-2, 0, 0); the image lies 0.75 behind it, a quarter as high.
    let render_scene = mirror_ball(radius);
    let tip = v(-radius - object, 0.02, 0.0);
    let lines = [0.004, -0.003].map(|slope| {
        let path = chain(&render_scene, ray(tip, v(1.0, slope, 0.0)));
        (path[1].ray.origin.as_dvec3(), direction(&path[1]))
    });
    let [(p, d), (q, e)] = lines;
    let s = (q - p).cross(e).z / d.cross(e).z;
    let image = p + s * d;
    assert_close(image.x + radius, 0.75, 1e-3);
    assert_close(image.y / tip.y, 0.25, 1e-3);
}

#[test]
fn axial_rays_cross_the_axis_of_a_concave_mirror_at_half_the_radius_over_the_cosine() {
    for radius in [0.01, 1.0, 300.0] {
        let render_scene = mirror_ball(radius);
        for t in [1.0_f64, 5.0, 20.0, 30.0, 45.0, 59.0] {
            let (sin, cos) = t.to_radians().sin_cos();
            let path = tree(&render_scene, ray(v(0.0, radius * sin, 0.0), DVec3::X));
            let crossing = crossing_of_axis(path[1].ray.origin.as_dvec3(), direction(&path[1]));
            // The crossing is known no better than the direction allows.
            assert_close(crossing, radius / (2.0 * cos), 3e-6 * radius / sin);
        }
        let path = tree(&render_scene, ray(v(0.0, 0.5 * radius, 0.0), DVec3::X));
        let crossing = crossing_of_axis(path[1].ray.origin.as_dvec3(), direction(&path[1]));
        assert_close(crossing / radius, 0.577_350_27, 1e-5);
    }
}

/// Alhazen's problem: where on the unit circle does light from (2, 0) reach an eye at (0, 3)?
#[test]
fn alhazens_point_is_found_by_tracing() {
    let (eye, lamp) = (v(0.0, 3.0, 0.0), v(2.0, 0.0, 0.0));
    let render_scene = mirror_ball(1.0);
    let aim = |degrees: f64| {
        let path = chain(&render_scene, ray(eye, at_angle(degrees) - eye));
        let at = path[0].hit.unwrap().position;
        (at, direction(&path[1]).cross(lamp - at).z)
    };
    // The reflected ray passes the lamp on one side for points too high, on the other for those too low.
    let (mut low, mut high) = (25.0, 65.0);
    assert!(aim(low).1 * aim(high).1 < 0.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        let same = aim(middle).1 * aim(low).1 > 0.0;
        (low, high) = if same { (middle, high) } else { (low, middle) };
    }
    let (at, _) = aim(low);
    assert_vec_close(at, v(0.763_785, 0.645_470, 0.0), 2e-6);
    assert_close(at.y.atan2(at.x).to_degrees(), 40.200_957, 1e-4);
}

#[test]
fn a_mirror_box_glows_like_its_series() {
    // A closed room of six walls: every ray meets exactly one wall per generation.
    let mut wall = mirror();
    (wall.pattern.color, wall.ambient, wall.reflection) = (Color::new(1.0, 0.5, 0.25), 0.3, Some(0.7));
    let render_scene = stage_of(vec![block(v(3.0, 2.0, 5.0), v(0.1, 0.2, 0.3), wall)]).with_generations(12);
    let sum = 0.3 * (1.0 - 0.7_f64.powi(12)) / 0.3;
    for d in [v(1.0, 2.0, 3.0), v(-3.0, 0.1, 0.2), DVec3::Y] {
        assert_light(light_along(&render_scene, ray(v(0.3, -0.2, 1.0), d)), [sum, 0.5 * sum, 0.25 * sum]);
    }
}
