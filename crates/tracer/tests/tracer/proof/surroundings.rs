//! Skies and pictures around the bodies, pictures on them, and checkers that turn with them.

use std::sync::Arc;

use catoptric_picture::Picture;
use catoptric_scene::{
    Anchor, Body, Camera, Color, Dielectric, Image, Light, Material, Mirror, Model, Pattern, PatternSpace,
    Phong, Placement, Projection, Scene, Shape, Sky, SolidTexture, Surroundings,
};
use glam::{DQuat, DVec3};

use crate::proof::common::{
    assert_close, assert_same_picture, ball, block, camera, chalk, glow, light_along, picture, plane, ray,
    render_scene, scene, turned, v,
};

fn image(width: u32, height: u32, color: impl FnMut(u32, u32) -> [f32; 3]) -> Image {
    Image::with_pixels("made", Arc::new(Picture::from_fn(width, height, color).unwrap()))
}

fn under(surroundings: Surroundings, bodies: Vec<Body>) -> Scene {
    let mut scene = scene(bodies);
    scene.environment.surroundings = surroundings;
    scene
}

fn mirror() -> Mirror {
    Mirror { pattern: Color::WHITE.into(), ..Mirror::default() }
}

fn around_a_bit_of_everything() -> Vec<Body> {
    vec![
        plane(v(0.0, -1.0, 0.0), 0.0, Phong { reflection: Some(0.4), ..chalk() }),
        ball(0.8, v(-1.0, 0.0, 0.0), mirror()),
        ball(0.7, v(0.8, 0.1, 0.3), Dielectric::default()),
        turned(Shape::CONE, v(0.0, -0.5, 1.5), v(20.0, 0.0, 50.0), mirror()),
    ]
}

#[test]
fn a_mirror_shows_the_sky_where_it_points() {
    let sky = Sky {
        zenith: Color::new(1.0, 0.0, 0.2),
        horizon: Color::new(0.0, 1.0, 0.4),
        nadir: Color::new(0.0, 0.0, 3.0),
    };
    let render_scene = render_scene(&under(Surroundings::Sky(sky), vec![ball(1.0, DVec3::ZERO, mirror())]));
    for step in 0..40 {
        let at = DVec3::new(0.02 * f64::from(step) - 0.4, 0.9 - 0.045 * f64::from(step), 0.0);
        let normal = at + DVec3::Z * (1.0 - at.length_squared()).max(0.0).sqrt();
        let direction = DVec3::NEG_Z - 2.0 * normal * DVec3::NEG_Z.dot(normal);
        let found = light_along(&render_scene, ray(at + DVec3::Z * 4.0, DVec3::NEG_Z)).as_dvec3();
        let (end, y) = if direction.y < 0.0 { (sky.nadir, -direction.y) } else { (sky.zenith, direction.y) };
        for ((found, horizon), end) in
            found.to_array().into_iter().zip(sky.horizon.to_array()).zip(end.to_array())
        {
            assert_close(found, horizon + (end - horizon) * y, 1e-5);
        }
    }
}

#[test]
fn surroundings_of_one_color_are_a_background() {
    let color = Color::new(0.3, 0.5, 0.7);
    let bodies = around_a_bit_of_everything();
    let mut plain = scene(bodies.clone());
    plain.environment.background = color;
    plain.camera = camera(v(0.5, 0.7, 6.0), DVec3::ZERO, 40.0);
    let expected = picture(&plain, 48, 32);
    let gray = image(3, 2, |_, _| color.to_array().map(|part| part as f32));
    for surroundings in
        [Surroundings::Sky(Sky { zenith: color, horizon: color, nadir: color }), Surroundings::Picture(gray)]
    {
        let mut scene = under(surroundings, bodies.clone());
        scene.camera = plain.camera;
        scene.environment.rotation_degrees = 77.0;
        assert_eq!(picture(&scene, 48, 32), expected);
    }
}

#[test]
fn all_turns_with_the_picture() {
    let pixels = image(64, 32, |x, y| {
        let hue = |turns: f32| 0.5 + 0.5 * (turns * x as f32 * std::f32::consts::TAU / 64.0).cos();
        [hue(1.0), hue(3.0), y as f32 / 32.0]
    });
    let mut straight = under(Surroundings::Picture(pixels), around_a_bit_of_everything());
    straight.camera = camera(v(0.5, 0.7, 6.0), DVec3::ZERO, 60.0);
    straight.environment.strength = 2.0;
    let mut turned = straight.clone();
    let turn = DQuat::from_rotation_y(70.0_f64.to_radians());
    turned.camera.position = turn * turned.camera.position;
    turned.environment.rotation_degrees = 70.0;
    for body in &mut turned.bodies {
        let Anchor::Frame { position, rotation_degrees } = &mut body.placement.anchor else { unreachable!() };
        *position = turn * *position;
        if *rotation_degrees != DVec3::ZERO {
            // The cone's own turns are about x and z: y comes before them from the right.
            let [x, _, z] = rotation_degrees.to_array().map(f64::to_radians);
            let all = turn * DQuat::from_rotation_z(z) * DQuat::from_rotation_x(x);
            let (z, y, x) = all.to_euler(glam::EulerRot::ZYX);
            *rotation_degrees = DVec3::new(x, y, z).map(f64::to_degrees);
        }
    }
    assert_same_picture(&picture(&straight, 60, 40), &picture(&turned, 60, 40), 0.002);
}

#[test]
fn a_texture_of_one_color_is_that_color() {
    let color = Color::new(0.3, 0.5, 0.7);
    let pixels = image(2, 2, |_, _| color.to_array().map(|part| part as f32));
    let shapes = [Shape::SPHERE, Shape::CUBE, Shape::CYLINDER, Shape::CONE, Shape::PARABOLOID, Shape::Plane];
    for model in [Model::Phong, Model::Mirror, Model::Matte, Model::Coated] {
        let of_pattern = |pattern: Pattern| {
            let mut material = Material::from(model);
            *material.pattern_mut().unwrap() = pattern;
            material
        };
        let material = of_pattern(color.into());
        let textured = of_pattern(Pattern { texture: Some(pixels.clone()), ..Color::BLACK.into() });
        let drawn = [material, textured].map(|material| {
            let bodies = shapes.iter().zip(-2..).map(|(shape, x)| {
                turned(*shape, v(f64::from(x), -0.3, 0.0), v(30.0, 20.0, 10.0), material.clone())
            });
            let mut scene = scene(bodies.collect());
            scene.environment.background = Color::new(0.5, 0.1, 0.9);
            scene.lights = vec![Light { position: v(2.0, 5.0, 7.0), ..Light::default() }];
            scene.camera = camera(v(0.5, 0.7, 6.0), DVec3::ZERO, 50.0);
            picture(&scene, 60, 30)
        });
        assert_eq!(drawn[0], drawn[1], "{model:?}");
    }
}

/// A ray to the middle of a pixel of a face brings that pixel.
#[test]
fn the_pixels_of_a_texture_lie_on_a_cube_as_on_a_wall() {
    let numbered = image(4, 2, |x, y| [(1 + x + 4 * y) as f32, 0.0, 0.0]);
    let material =
        Phong { pattern: Pattern { texture: Some(numbered), ..Pattern::default() }, ..glow(Color::WHITE) };
    let render_scene = render_scene(&scene(vec![block(DVec3::splat(2.0), DVec3::ZERO, material)]));
    for y in 0..2 {
        for x in 0..4 {
            let at = v(-0.75 + 0.5 * f64::from(x), 0.5 - f64::from(y), 5.0);
            let found = light_along(&render_scene, ray(at, DVec3::NEG_Z));
            assert_close(f64::from(found.x), f64::from(1 + x + 4 * y), 1e-5);
        }
    }
}

#[test]
fn cells_of_a_body_move_and_turn_with_it_and_keep_their_size() {
    let checker =
        |space| Some(SolidTexture { color: Color::gray(0.2), size: 0.37, space, ..SolidTexture::default() });
    let body = |space, anchor, scale| Body {
        shape: Shape::Cube { size: v(1.1, 0.7, 0.9) },
        placement: Placement { anchor, scale },
        material: catoptric_scene::MaterialChoice::own(Phong {
            pattern: Pattern { solid: checker(space), ..Color::WHITE.into() },
            ..glow(Color::WHITE)
        }),
        ..Body::default()
    };
    let frame = |position, rotation_degrees| Anchor::Frame { position, rotation_degrees };
    let seen_from = |body: Body, turn: DQuat, shift: DVec3| {
        let mut scene = scene(vec![body]);
        scene.camera = camera(turn * v(2.0, 1.5, 4.0) + shift, shift, 30.0);
        scene.camera.up = turn * DVec3::Y;
        picture(&scene, 60, 40)
    };
    let at_origin = |space, scale| body(space, frame(DVec3::ZERO, DVec3::ZERO), scale);
    let straight = seen_from(at_origin(PatternSpace::World, DVec3::ONE), DQuat::IDENTITY, DVec3::ZERO);
    let own = seen_from(at_origin(PatternSpace::Body, DVec3::ONE), DQuat::IDENTITY, DVec3::ZERO);
    assert_eq!(straight, own, "at rest in the world both are the same");
    let scale = v(2.0, 0.5, 1.3);
    let [stretched, cut] = [PatternSpace::World, PatternSpace::Body]
        .map(|space| seen_from(at_origin(space, scale), DQuat::IDENTITY, DVec3::ZERO));
    assert_eq!(stretched, cut, "cells keep their size");
    let (degrees, shift) = (v(0.0, 40.0, 0.0), v(0.123, -4.0, 7.7));
    let turn = DQuat::from_rotation_y(degrees.y.to_radians());
    let moved = |space| seen_from(body(space, frame(shift, degrees), DVec3::ONE), turn, shift);
    assert_same_picture(&moved(PatternSpace::Body), &straight, 0.002);
    assert_ne!(moved(PatternSpace::World), straight);
}

/// A picture of this size on the plane y = 0, which repeats every meter both ways, mixed between the four pixels around a place.
fn tiled(pixel: impl Fn(i64, i64) -> f64, [width, height]: [i64; 2], at: DVec3) -> f64 {
    let (x, y) = (at.x * width as f64 - 0.5, at.z * height as f64 - 0.5);
    let (left, top) = (x.floor(), y.floor());
    let of = |column: i64, row: i64| pixel(column.rem_euclid(width), row.rem_euclid(height));
    let row = |row: i64| {
        let column = left as i64;
        of(column, row) + (of(column + 1, row) - of(column, row)) * (x - left)
    };
    let (upper, lower) = (row(top as i64), row(top as i64 + 1));
    upper + (lower - upper) * (y - top)
}

#[test]
fn a_picture_on_a_plane_has_no_seams() {
    let pixel = |x: i64, y: i64| ((x * 31 + y * 57 + 11) % 17) as f64 / 16.0;
    let size = [4, 3];
    let texture = image(4, 3, |x, y| [pixel(x.into(), y.into()) as f32; 3]);
    let pattern = Pattern { texture: Some(texture), ..Pattern::default() };
    let floor = plane(DVec3::ZERO, 0.0, Phong { pattern, ..glow(Color::WHITE) });
    for corner in [DVec3::ZERO, v(-3.0, 0.0, 2.0), v(1.0, 0.0, -1.0), v(250.0, 0.0, -100.0)] {
        let mut scene = scene(vec![floor.clone()]);
        scene.camera = Camera {
            position: corner + 5.0 * DVec3::Y,
            target: corner,
            up: DVec3::NEG_Z,
            projection: Projection::Parallel { height: 2.5 },
        };
        let found = picture(&scene, 40, 40);
        let exact = Picture::from_fn(40, 40, |x, y| {
            let place = [x, y].map(|at| 2.5 * ((f64::from(at) + 0.5) / 40.0 - 0.5));
            [tiled(pixel, size, corner + v(place[0], 0.0, place[1])) as f32; 3]
        });
        assert_same_picture(&found, &exact.unwrap(), 0.0);
    }
}
