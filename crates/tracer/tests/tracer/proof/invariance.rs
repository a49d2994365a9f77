//! What must not change the picture: units of length, the place and turn of the whole scene, the order of bodies.

use catoptric_picture::Picture;
use catoptric_scene::{Anchor, Body, Color, Falloff, MaterialChoice, Projection, Scene, Shape, SolidTexture};
use glam::{DMat3, DQuat, DVec3, EulerRot};

use crate::proof::common::{
    assert_same_picture, assert_vec_close, ball, camera, chain, chalk, direction, glass, light, mirror,
    picture, ray, render_scene, scene, stage_of, turned, v,
};
use crate::proof::samples::gallery;

const SIZE: (u32, u32) = (192, 128);
/// Pixels that may differ: those on edges, which rounding may give to either side.
const SHARE: f64 = 0.0005;

fn taken(scene: &Scene) -> Picture {
    picture(scene, SIZE.0, SIZE.1)
}

/// The gallery with a checkered floor.
fn checkered() -> Scene {
    let mut scene = gallery();
    let MaterialChoice::Inline(floor) = &mut scene.bodies[0].material else { unreachable!() };
    floor.pattern_mut().unwrap().solid =
        Some(SolidTexture { color: Color::gray(0.2), size: 0.7, ..SolidTexture::default() });
    scene
}

fn anchor(body: &mut Body) -> (&mut DVec3, &mut DVec3) {
    match &mut body.placement.anchor {
        Anchor::Frame { position, rotation_degrees } => (position, rotation_degrees),
        Anchor::Axis { .. } => unreachable!("all bodies are placed by frame"),
    }
}

/// All lengths of the scene multiplied.
fn scaled(scene: &Scene, factor: f64) -> Scene {
    let mut scene = scene.clone();
    scene.camera.position *= factor;
    scene.camera.target *= factor;
    if let Projection::Parallel { height } = &mut scene.camera.projection {
        *height *= factor;
    }
    for light in &mut scene.lights {
        light.position *= factor;
    }
    for body in &mut scene.bodies {
        *anchor(body).0 *= factor;
        body.shape = body.shape.scaled(factor);
        if let MaterialChoice::Inline(material) = &mut body.material
            && let Some(checker) = material.pattern_mut().and_then(|pattern| pattern.solid.as_mut())
        {
            checker.size *= factor;
        }
    }
    scene
}

/// The scene turned about the origin and then moved.
fn moved(scene: &Scene, turn: DQuat, by: DVec3) -> Scene {
    let mut scene = scene.clone();
    let carry = |point: &mut DVec3| *point = turn * *point + by;
    carry(&mut scene.camera.position);
    carry(&mut scene.camera.target);
    scene.camera.up = turn * scene.camera.up;
    for light in &mut scene.lights {
        carry(&mut light.position);
    }
    for body in &mut scene.bodies {
        let (position, degrees) = anchor(body);
        carry(position);
        let own = DMat3::from_euler(
            EulerRot::ZYX,
            degrees.z.to_radians(),
            degrees.y.to_radians(),
            degrees.x.to_radians(),
        );
        let (z, y, x) = (DMat3::from_quat(turn) * own).to_euler(EulerRot::ZYX);
        *degrees = v(x.to_degrees(), y.to_degrees(), z.to_degrees());
    }
    scene
}

#[test]
fn a_scaled_scene_gives_the_same_picture() {
    for scene in [checkered(), parallel()] {
        let original = taken(&scene);
        for factor in [1e-3, 1e-2, 0.3, 10.0, 1e3] {
            assert_same_picture(&original, &taken(&scaled(&scene, factor)), SHARE);
        }
    }
}

#[test]
fn lengths_of_any_magnitude_can_be_used() {
    let original = taken(&checkered());
    for factor in [1e-5, 1e5] {
        assert_same_picture(&original, &taken(&scaled(&checkered(), factor)), SHARE);
    }
}

fn parallel() -> Scene {
    let mut scene = checkered();
    scene.camera.projection = Projection::Parallel { height: 5.0 };
    scene
}

#[test]
fn a_turned_scene_gives_the_same_picture() {
    let original = taken(&gallery());
    for (yaw, pitch, roll) in [(0.5, 0.0, 0.0), (0.0, 1.1, 0.0), (2.0, -0.7, 0.9), (3.0, 1.5, -2.2)] {
        let turn = DQuat::from_euler(EulerRot::YXZ, yaw, pitch, roll);
        assert_same_picture(&original, &taken(&moved(&gallery(), turn, DVec3::ZERO)), SHARE);
    }
}

#[test]
fn a_moved_scene_gives_the_same_picture() {
    let original = taken(&gallery());
    for by in [v(3.0, -4.0, 5.0), v(-60.0, 20.0, 80.0)] {
        assert_same_picture(&original, &taken(&moved(&gallery(), DQuat::IDENTITY, by)), SHARE);
    }
    // A kilometre away, single precision knows places to 0.06 mm, a tenth of a pixel here.
    let far = taken(&moved(&gallery(), DQuat::IDENTITY, v(600.0, 0.0, -800.0)));
    assert_same_picture(&original, &far, 0.01);
}

#[test]
fn the_order_of_bodies_does_not_matter() {
    let scene = checkered();
    let original = taken(&scene);
    let mut reversed = scene.clone();
    reversed.bodies.change(|bodies| bodies.reverse());
    let mut rotated = scene.clone();
    rotated.bodies.change(|bodies| bodies.rotate_left(3));
    for other in [reversed, rotated] {
        assert_same_picture(&original, &taken(&other), 0.0);
    }
}

#[test]
fn two_equal_bodies_can_be_swapped() {
    let mut scene = gallery();
    let twins = [v(-1.0, 2.0, 0.5), v(1.1, 2.1, 0.3)].map(|at| ball(0.4, at, glass(1.4)));
    scene.bodies.extend(twins);
    let original = taken(&scene);
    let last = scene.bodies.len() - 1;
    scene.bodies.swap(last, last - 1);
    assert_eq!(original.pixels(), taken(&scene).pixels());
    // Two at the same place.
    let mut doubled = scene.clone();
    doubled.bodies[last] = doubled.bodies[last - 1].clone();
    let original = taken(&doubled);
    doubled.bodies.swap(last, last - 1);
    assert_eq!(original.pixels(), taken(&doubled).pixels());
}

#[test]
fn few_and_many_bodies_are_searched_alike() {
    // Bodies behind the camera and out of every reflection change the method of search and nothing else.
    let mut scene = gallery();
    scene.bodies.remove(0);
    let few = taken(&scene);
    scene.bodies.extend((0..80).map(|k| ball(1e-3, v(f64::from(k), 500.0, 300.0), chalk())));
    assert_same_picture(&few, &taken(&scene), 0.0);
}

#[test]
fn a_mirrored_scene_gives_the_mirrored_picture() {
    let mut scene = scene(vec![
        ball(1.0, v(-1.5, 0.0, 0.0), mirror()),
        turned(Shape::CONE, v(0.5, -0.5, 0.4), v(0.0, 0.0, 20.0), chalk()),
        ball(0.5, v(1.6, 0.2, -0.4), glass(1.5)),
    ]);
    scene.environment.background = Color::new(0.1, 0.2, 0.3);
    scene.camera = camera(v(0.0, 0.0, 9.0), DVec3::ZERO, 25.0);
    scene.lights = vec![light(v(3.0, 4.0, 5.0), 1.0, Falloff::None)];
    let mut mirrored = scene.clone();
    mirrored.lights[0].position.x *= -1.0;
    for body in &mut mirrored.bodies {
        let (position, degrees) = anchor(body);
        position.x *= -1.0;
        degrees.z *= -1.0;
    }
    let mut picture = taken(&mirrored);
    picture.rows_mut().for_each(<[_]>::reverse);
    assert_same_picture(&taken(&scene), &picture, SHARE);
}

#[test]
fn sizes_and_scales_are_the_same_thing() {
    let stage_a = stage_of(vec![turned(
        Shape::Cube { size: v(1.0, 2.0, 3.0) },
        DVec3::X,
        v(10.0, 20.0, 30.0),
        glass(1.5),
    )]);
    let mut body = turned(Shape::CUBE, DVec3::X, v(10.0, 20.0, 30.0), glass(1.5));
    body.placement.scale = v(1.0, 2.0, 3.0);
    let stage_b = render_scene(&scene(vec![body]));
    let start = ray(v(4.0, 3.0, 5.0), v(-3.2, -2.8, -5.1));
    let (a, b) = (chain(&stage_a, start), chain(&stage_b, start));
    assert!(a.len() > 2);
    assert_vec_close(direction(&a[1]), direction(&b[1]), 1e-7);
}

#[test]
fn axis_points_place_cylinders_and_cones_like_a_frame() {
    for shape in [Shape::CYLINDER, Shape::Cone { radius: 0.5, top_radius: 0.2, height: 1.0 }] {
        let (base, top) = (v(0.3, -0.4, 0.2), v(0.3, -0.4, 2.2));
        let mut by_axis = turned(shape, DVec3::ZERO, DVec3::ZERO, mirror());
        by_axis.placement.anchor = Anchor::Axis { base, top };
        // +Y is carried to +Z by a quarter turn about X.
        let mut by_frame = turned(shape, base, v(90.0, 0.0, 0.0), mirror());
        by_frame.placement.scale = v(1.0, 2.0, 1.0);
        let [a, b] = [by_axis, by_frame].map(|body| {
            let mut scene = scene(vec![body]);
            scene.environment.background = Color::new(0.3, 0.5, 0.7);
            scene.lights = vec![light(v(3.0, 4.0, 5.0), 1.0, Falloff::None)];
            taken(&scene)
        });
        assert_same_picture(&a, &b, SHARE);
    }
}

#[test]
fn what_is_hidden_takes_no_part() {
    let shown = checkered();
    let mut scene = shown.clone();
    // In front of everything: a dark ball, glass that would make the scene transparent, a plane and a light.
    let middle = 0.5 * (scene.camera.position + scene.camera.target);
    for (place, body) in [
        (0, ball(1.0, middle, chalk())),
        (3, ball(2.0, middle, glass(1.5))),
        (4, turned(Shape::Plane, middle, v(90.0, 0.0, 0.0), mirror())),
    ] {
        scene.bodies.insert(place, Body { hidden: true, ..body });
    }
    // It names no material of the scene, and is not asked for one.
    scene.bodies.push(Body {
        hidden: true,
        material: MaterialChoice::Named("none".to_owned()),
        ..Body::default()
    });
    let mut lamp = light(middle, 50.0, Falloff::None);
    lamp.hidden = true;
    scene.lights.insert(0, lamp);
    let (with, without) = (render_scene(&scene), render_scene(&shown));
    assert_eq!((with.body_count(), with.light_count()), (without.body_count(), without.light_count()));
    for index in 0..with.body_count() as u32 {
        let (at, expected) = (with.scene_index(index).unwrap(), without.scene_index(index).unwrap());
        assert_eq!(scene.bodies[at], shown.bodies[expected]);
    }
    assert_eq!(with.scene_index(with.body_count() as u32), None);
    assert!(taken(&scene) == taken(&shown), "the pictures differ");
    // The same things, seen, change the picture.
    scene.bodies.pop();
    for body in &mut scene.bodies {
        body.hidden = false;
    }
    assert!(taken(&scene) != taken(&shown));
}
