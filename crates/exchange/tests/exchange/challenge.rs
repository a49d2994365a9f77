//! The Ray Tracer Challenge: the book's own numbers, transforms, definitions, limits.

use catoptric_exchange::{ForeignFormat, ImportOptions};
use catoptric_scene::{PatternSpace, Severity, Shape};
use catoptric_tracer::RenderScene;
use glam::{DMat3, DVec2, DVec3};

use crate::common::{assert_light, bad, count, good, pixel};

const FORMAT: ForeignFormat = ForeignFormat::Challenge;
const CAMERA: &str = "- add: camera\n  width: 4\n  height: 2\n  field-of-view: 1.5707963267948966\n  from: [0, 0, -5]\n  to: [0, 0, 0]\n  up: [0, 1, 0]\n";

fn scene(rest: &str) -> String {
    format!("{CAMERA}{rest}")
}

fn read(rest: &str) -> catoptric_exchange::ImportedScene {
    good(FORMAT, &scene(rest), &ImportOptions::default())
}

#[test]
fn a_pixel_has_the_light_of_the_book() {
    let light = |at: &str| {
        let found = read(&format!("- add: light\n  at: {at}\n  intensity: [1, 1, 1]\n- add: sphere\n"));
        pixel(&found, [1, 1], [0, 0])
    };
    // Chapter 6, "Lighting with the eye between the light and the surface" and "… light offset 45°".
    assert_light(light("[0, 0, -10]"), [1.9; 3]);
    assert_light(light("[0, 10, -11]"), [0.736_396_1; 3]);
    // "… eye in the path of the reflection vector" needs an eye elsewhere; behind the surface only ambient is left.
    assert_light(light("[0, 0, 10]"), [0.1; 3]);
}

#[test]
fn x_points_to_the_right_and_ambient_light_is_of_all_lights() {
    let lights = "- add: light\n  at: [0, 0, 50]\n  intensity: [1, 0.5, 0]\n".repeat(2);
    let found = read(&format!("{lights}- add: sphere\n  transform:\n  - [translate, 5, 0, 0]\n"));
    assert_light(pixel(&found, [5, 1], [3, 0]), [0.2, 0.1, 0.0]);
    assert_light(pixel(&found, [5, 1], [1, 0]), [0.0; 3]);
    assert_eq!(found.size, Some([4, 2]));
}

#[test]
fn transforms_are_applied_one_after_another() {
    let found = read(
        "- add: cube\n  transform:\n  - [scale, 1, 2, 3]\n  - [rotate-y, 1.5707963267948966]\n  - [translate, 5, 0, 1]\n",
    );
    let body = found.scene.bodies.to_vec()[0].clone();
    assert_eq!(body.shape, Shape::Cube { size: DVec3::new(2.0, 4.0, 6.0) });
    let frame = body.placement.world_from_body();
    assert!(frame.translation.abs_diff_eq(DVec3::new(5.0, 0.0, -1.0), 1e-12));
    // The long side, along z, turns to x.
    assert!(frame.transform_vector3(DVec3::Z).abs().abs_diff_eq(DVec3::X, 1e-9));
}

#[test]
fn definitions_are_extended_and_groups_carry_their_children() {
    let found = read(
        "- define: white\n  value:\n    color: [1, 1, 1]\n    diffuse: 0.7\n- define: red\n  extend: white\n  value:\n    color: [1, 0, 0]\n\
         - define: far\n  value:\n  - [translate, 0, 0, 4]\n- define: ball\n  value:\n    add: sphere\n    material: red\n    transform:\n    - [scale, 2, 2, 2]\n\
         - add: group\n  transform:\n  - far\n  children:\n  - add: ball\n    transform:\n    - [translate, 1, 0, 0]\n  - add: cube\n    material: white\n",
    );
    let bodies = found.scene.bodies.to_vec();
    assert_eq!(bodies[0].shape, Shape::Sphere { radius: 2.0 });
    assert_eq!(bodies[0].middle(), DVec3::new(1.0, 0.0, -4.0));
    let red = found.scene.material(&bodies[0].material).unwrap().as_phong().unwrap();
    assert_eq!((red.pattern.color.to_array(), red.diffuse, red.specular), ([1.0, 0.0, 0.0], 0.7, 0.9));
    assert_eq!(bodies[1].middle(), DVec3::new(0.0, 0.0, -4.0));
}

#[test]
fn closed_cylinders_and_cones_stand_between_their_ends() {
    let found = read(
        "- add: cylinder\n  min: 1\n  max: 3\n  closed: true\n- add: cone\n  min: -1\n  max: 0\n  closed: true\n\
         - add: cone\n  min: 1\n  max: 2\n  closed: true\n- add: cone\n  min: -1\n  max: 2\n  closed: true\n",
    );
    let extents: Vec<_> = found
        .scene
        .bodies
        .iter()
        .map(|body| {
            let corners = body.box_corners().unwrap();
            let [low, high] = [DVec3::min, DVec3::max].map(|pick| corners.into_iter().reduce(pick).unwrap());
            [low.y, high.y, high.x].map(|value| (value * 1e9).round() / 1e9)
        })
        .collect();
    assert_eq!(
        extents,
        [[1.0, 3.0, 1.0], [-1.0, 0.0, 1.0], [1.0, 2.0, 2.0], [-1.0, 0.0, 1.0], [0.0, 2.0, 2.0]]
    );
    let bodies = found.scene.bodies.to_vec();
    assert_eq!(bodies[2].shape, Shape::Cone { radius: 1.0, top_radius: 2.0, height: 1.0 });
    // The upper half of the last stands on its apex, which is the top of its own frame.
    assert_eq!(bodies[4].shape, Shape::Cone { radius: 2.0, top_radius: 0.0, height: 2.0 });
    assert!((bodies[4].placement.world_from_body().translation.y - 2.0).abs() < 1e-12);
}

#[test]
fn checkers_are_those_of_the_book() {
    let plane = |transform: &str, pattern: &str| {
        let text = format!(
            "- add: light\n  at: [0, 50, 0]\n- add: plane\n{transform}  material:\n    ambient: 1\n    diffuse: 0\n    specular: 0\n    pattern:\n      type: checkers\n      colors:\n      - [1, 1, 1]\n      - [0, 0, 0]\n{pattern}"
        );
        read(&text)
    };
    let checker = |found: &catoptric_exchange::ImportedScene| {
        let body = found.scene.bodies.to_vec()[0].clone();
        let material = found.scene.material(&body.material).unwrap().as_phong().unwrap().clone();
        (material.pattern.color.r, material.pattern.solid.clone().unwrap())
    };
    // ⌊x⌋ + ⌊z⌋ is even for x and z in 0…1 of the book: white there, thus black at (0.5, −0.5) mirrored back.
    let (even, cells) = checker(&plane("", ""));
    assert_eq!((even, cells.size, cells.space), (0.0, 1.0, PatternSpace::World));
    let (even, cells) = checker(&plane(
        "",
        "      transform:\n      - [scale, 0.5, 0.5, 0.5]\n      - [translate, 0.5, 0, 0]\n",
    ));
    assert_eq!((even, cells.size), (1.0, 0.5));
    let (_, cells) = checker(&plane("  transform:\n  - [rotate-y, 0.5]\n", ""));
    assert_eq!(cells.space, PatternSpace::Body);
    let blended = scene(
        "- add: sphere\n  material:\n    pattern:\n      type: blended\n      colors: [[1, 1, 1], [0, 0, 0]]\n",
    );
    assert_eq!(bad(FORMAT, &blended), "11:13: error: the pattern `blended` is not drawn");
    let found = good(FORMAT, &blended, &ImportOptions { is_approximate: true, ..ImportOptions::default() });
    let material = found.scene.material(&found.scene.bodies.to_vec()[0].material).unwrap().clone();
    assert_eq!(material.as_phong().unwrap().pattern.color.r, 0.5);
}

#[test]
fn csg_is_a_joined_body() {
    let found = read(
        "- add: csg\n  operation: difference\n  transform:\n  - [scale, 2, 2, 2]\n  left:\n    type: cube\n    material: {color: [0, 1, 0], ambient: 1}\n\
         \x20 right:\n    add: csg\n    operation: union\n    left:\n      type: sphere\n      transform:\n      - [scale, 0.5, 0.5, 0.5]\n      - [translate, 0, 0, -1]\n      material: {color: [1, 0, 0], ambient: 1}\n\
         \x20   right:\n      type: group\n      children:\n      - add: sphere\n      - add: cube\n\
         - add: light\n  at: [0, 0, -50]\n",
    );
    let body = found.scene.bodies.to_vec()[0].clone();
    assert_eq!(body.shape, Shape::Difference);
    assert_eq!(body.parts[0].shape, Shape::Cube { size: DVec3::splat(4.0) });
    // What the first part is made of, the whole is.
    assert_eq!(body.parts[0].material, None);
    // A − (B ∪ (C ∪ D)) = A − B − C − D.
    let [_, ball, second, third] = body.parts.as_slice() else { panic!("{body:?}") };
    assert_eq!(ball.shape, Shape::Sphere { radius: 1.0 });
    assert!(ball.placement.origin().abs_diff_eq(DVec3::new(0.0, 0.0, 2.0), 1e-12));
    assert_eq!(second.shape, Shape::Sphere { radius: 2.0 });
    assert_eq!(third.shape, Shape::Cube { size: DVec3::splat(4.0) });

    // In the hole of the cube, the ball that made it is seen, from inside.
    let holed = |eye: f64| {
        let text = format!(
            "- add: camera\n  width: 1\n  height: 1\n  field-of-view: 0.01\n  from: [{eye}, 0, -5]\n  to: [{eye}, 0, 0]\n  up: [0, 1, 0]\n\
             - add: light\n  at: [0, 50, 0]\n  intensity: [1, 1, 1]\n\
             - add: csg\n  operation: difference\n  left:\n    type: cube\n    material: {{color: [0, 1, 0], ambient: 1, diffuse: 0, specular: 0}}\n\
             \x20 right:\n    type: sphere\n    transform:\n    - [scale, 0.5, 0.5, 0.5]\n    - [translate, 0, 0, -1]\n    material: {{color: [1, 0, 0], ambient: 1, diffuse: 0, specular: 0}}\n"
        );
        pixel(&good(FORMAT, &text, &ImportOptions::default()), [1, 1], [0, 0])
    };
    assert_light(holed(0.4), [1.0, 0.0, 0.0]);
    assert_light(holed(0.6), [0.0, 1.0, 0.0]);
}

#[test]
fn csg_that_is_none_is_refused() {
    let csg = |rest: &str| scene(&format!("- add: csg\n{rest}"));
    let ball = "{add: sphere}";
    assert_eq!(
        bad(FORMAT, &csg(&format!("  operation: xor\n  left: {ball}\n  right: {ball}\n"))),
        "9:14: error: there is no operation `xor`"
    );
    let missing = bad(FORMAT, &csg(&format!("  operation: union\n  left: {ball}\n")));
    assert!(missing.contains("`right`"), "{missing}");
    let plane = csg(&format!("  operation: difference\n  left: {ball}\n  right: {{add: plane}}\n"));
    assert!(bad(FORMAT, &plane).contains("a plane has no inside in the book"));
    let options = ImportOptions { is_approximate: true, ..ImportOptions::default() };
    assert_eq!(good(FORMAT, &plane, &options).scene.bodies.to_vec()[0].parts[1].shape, Shape::Plane);
    // Within itself, many times over.
    let deep = format!(
        "- define: x0\n  value: {ball}\n{}{CAMERA}- add: x40\n",
        (0..40)
            .map(|n| format!(
                "- define: x{}\n  value: {{add: csg, operation: union, left: x{n}, right: x{n}}}\n",
                n + 1
            ))
            .collect::<String>()
    );
    assert!(!bad(FORMAT, &deep).is_empty());
}

#[test]
fn sheared_spheres_are_ellipsoids_and_sheared_cubes_are_refused() {
    let shape = |name: &str| scene(&format!("- add: {name}\n  transform:\n  - [shear, 1, 0, 0, 0, 0, 0]\n"));
    assert_eq!(good(FORMAT, &shape("sphere"), &ImportOptions::default()).scene.bodies.len(), 1);
    assert_eq!(bad(FORMAT, &shape("cube")), "8:8: error: a sheared `cube` is not drawn");
}

/// The book's view transform (Buck 2019, chapter 7) does not take the length from its left: the picture shows more, the
/// nearer `up` is to the direction of view. Held against its own formula for the ray through a pixel.
#[test]
fn the_camera_is_that_of_the_book_whatever_is_up() {
    for up in ["[0, 1, 0]", "[-0.45, 1, 0]", "[0.3, 0.2, 0.9]"] {
        let text = format!(
            "- add: camera\n  width: 200\n  height: 100\n  field-of-view: 0.785\n  from: [-6, 6, -10]\n  to: [6, 0, 6]\n  up: {up}\n"
        );
        let scene = good(FORMAT, &text, &ImportOptions::default()).scene;
        let numbers: Vec<f64> =
            up.trim_matches(['[', ']']).split(", ").map(|number| number.parse().unwrap()).collect();
        let from = DVec3::new(-6.0, 6.0, -10.0);
        let forward = (DVec3::new(6.0, 0.0, 6.0) - from).normalize();
        let left = forward.cross(DVec3::from_slice(&numbers).normalize());
        let true_up = left.cross(forward);
        let view = DMat3::from_cols(left, true_up, -forward).transpose();
        let half = 0.3925_f64.tan();
        let camera = RenderScene::build(&scene).unwrap();
        for (x, y) in [(0.5, 0.5), (150.5, 20.5), (99.5, 90.5)] {
            let pixel = DVec3::new(half - x * half / 100.0, 0.5 * half - y * half / 100.0, -1.0);
            let expected = (view.inverse() * pixel).normalize() * DVec3::new(1.0, 1.0, -1.0);
            let found = camera.camera().ray(DVec2::new(x, y), DVec2::new(200.0, 100.0)).direction.as_dvec3();
            assert!(found.distance(expected) < 1e-6, "{up}: {found} instead of {expected}");
        }
    }
}

#[test]
fn errors_have_their_places_and_come_all_at_once() {
    for (rest, expected) in [
        ("- add: spere\n", "8:8: error: there is no shape, and no definition, called `spere`"),
        ("- add: smooth-triangle\n  p1: [0, 0, 0]\n", "8:8: error: `smooth-triangle` is not drawn"),
        (
            "- add: triangle\n  p1: [0, 0, 0]\n  p2: [0, 1]\n",
            "8:3: error: `triangle` lacks `p3`\n10:7: error: `p2` is a list",
        ),
        (
            "- add: sphere\n  size: 3\n- add: csg\n  operation: union\n  left: {type: cube, shadow: false}\n  right: {type: sphere}\n",
            "9:3: error: `sphere` has no key `size`\n12:30: error: an operand of a `csg` has its shadow",
        ),
        ("- add: sphere\n  transform:\n  - [rotate, 1]\n", "10:5: error: there is no transform `rotate`"),
        (
            "- add: sphere\n  transform:\n  - [scale, 0, 1, 1]\n",
            "8:8: error: the transform leaves nothing of the shape, or takes it to infinity",
        ),
        (
            "- add: sphere\n  material: gold\n",
            "9:13: error: `material` is a text, but must be a table of keys",
        ),
        (
            "- add: sphere\n  material:\n    color: [1, 2]\n",
            "10:12: error: `color` is a list, but must be three numbers: `[0, 1, 0]`",
        ),
        (
            "- add: light\n  at: [0, 0, 0]\n  intensity: [-1, 0, 0]\n",
            "10:14: error: `intensity` is -1, but must be from 0 to 1e6",
        ),
        ("- add: [\n", "9:1: error: the YAML cannot be read:"),
        ("- add: camera\n", "8:3: error: the scene has two cameras"),
        ("- remove: sphere\n", "8:3: error: this is neither `add` nor `define`"),
    ] {
        let found = bad(FORMAT, &scene(rest));
        assert!(found.starts_with(expected), "{rest}\n{found}");
    }
    for (text, expected) in [
        ("", "1:1: error: a scene is a list"),
        ("- add: sphere\n", "1:1: error: the scene has no camera"),
        ("camera: 1\n", "1:1: error: a scene is a list"),
        ("- [\u{416}, *a]\n", "1:"),
    ] {
        let found = bad(FORMAT, text);
        assert!(found.starts_with(expected), "{text}\n{found}");
    }
}

#[test]
fn bombs_end_in_an_error() {
    let mut doubling = String::from("- define: d0\n  value:\n    add: sphere\n");
    for step in 1..30 {
        let last = step - 1;
        doubling += &format!(
            "- define: d{step}\n  value:\n    add: group\n    children:\n    - add: d{last}\n    - add: d{last}\n"
        );
    }
    let found = bad(FORMAT, &scene(&format!("{doubling}- add: d29\n")));
    assert!(found.contains("the scene becomes too large"), "{found}");
    let mut moves = String::from("- define: m0\n  value:\n  - [translate, 1, 0, 0]\n");
    for step in 1..60 {
        let last = step - 1;
        moves += &format!("- define: m{step}\n  value:\n  - m{last}\n  - m{last}\n");
    }
    let found = bad(FORMAT, &scene(&format!("{moves}- add: sphere\n  transform:\n  - m59\n")));
    assert!(found.contains("the scene becomes too large"), "{found}");
    let itself = "- define: a\n  value:\n    add: a\n- add: a\n";
    assert!(bad(FORMAT, &scene(itself)).contains("nested more than 64 deep"));
    let mut laughs = String::from("- define: a0\n  value: &a0 [1, 1]\n");
    for step in 1..40 {
        let last = step - 1;
        laughs += &format!("- define: a{step}\n  value: &a{step} [*a{last}, *a{last}]\n");
    }
    // Aliases share what they stand for; nothing uses it.
    assert_eq!(good(FORMAT, &scene(&laughs), &ImportOptions::default()).scene.bodies.len(), 0);
    for deep in ["[", "{a: ", "- "] {
        let found = bad(FORMAT, &deep.repeat(50_000));
        assert!(
            found.contains("nested more than 64 deep") || found.contains("YAML cannot be read"),
            "{found}"
        );
    }
}

/// Chapter 11, "shade_hit() with a transparent material" and "… with a reflective, transparent material": refraction,
/// Schlick's formula, and no light that passes what is clear.
#[test]
fn clear_bodies_have_the_light_of_the_book() {
    let world = "- add: light\n  at: [-10, 10, -10]\n  intensity: [1, 1, 1]\n\
         - add: sphere\n  material: {color: [0.8, 1.0, 0.6], diffuse: 0.7, specular: 0.2}\n\
         - add: sphere\n  transform:\n  - [scale, 0.5, 0.5, 0.5]\n\
         - add: sphere\n  material: {color: [1, 0, 0], ambient: 0.5}\n  transform:\n  - [translate, 0, -3.5, -0.5]\n";
    for (reflective, expected) in [("0", [0.93642, 0.68642, 0.68642]), ("0.5", [0.93391, 0.69643, 0.69243])] {
        let text = format!(
            "- add: camera\n  width: 1\n  height: 1\n  field-of-view: 0.1\n  from: [0, 0, -3]\n  to: [0, -1, -2]\n  \
             up: [0, 1, 0]\n{world}- add: plane\n  transform:\n  - [translate, 0, -1, 0]\n  \
             material: {{reflective: {reflective}, transparency: 0.5, refractive-index: 1.5}}\n"
        );
        let found = good(FORMAT, &text, &ImportOptions::default());
        assert_eq!(count(&found.report, Severity::Warning), 0, "{}", found.report);
        let light = pixel(&found, [1, 1], [0, 0]);
        let is_near = light.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 2e-5);
        assert!(is_near, "{light:?}, not {expected:?}");
    }
}

/// Chapter 8: what is clear shades as what is not, and what has no shadow not at all.
#[test]
fn shadows_are_those_of_the_book() {
    for (of_ball, lit) in [
        ("  material: {transparency: 1, ambient: 0}\n", 0.0),
        ("  shadow: false\n", 1.0),
        ("  material: {transparency: 1}\n  shadow: false\n", 1.0),
        ("", 0.0),
    ] {
        let found = read(&format!(
            "- add: light\n  at: [0, 0, -10]\n  intensity: [1, 1, 1]\n- add: group\n  children:\n  - add: sphere\n    \
             transform:\n    - [translate, 0, 0, -7.5]\n{}- add: plane\n  transform:\n  - [rotate-x, 1.5707963267948966]\n  \
             material: {{ambient: 0, diffuse: 1, specular: 0}}\n",
            of_ball.replace("  ", "    ")
        ));
        // The ball is behind the eye.
        assert_light(pixel(&found, [1, 1], [0, 0]), [lit; 3]);
    }
}

/// A light in the middle of each cell, of an equal share of the whole.
#[test]
fn an_area_light_is_a_grid_of_lights() {
    let found = read(
        "- add: light\n  corner: [-1, 2, -4]\n  uvec: [2, 0, 0]\n  vvec: [0, 2, 0]\n  usteps: 4\n  vsteps: 2\n  \
         jitter: true\n  intensity: [1.5, 1.5, 1.5]\n",
    );
    let lights = &found.scene.lights;
    assert_eq!(lights.len(), 8);
    assert_eq!(lights[0].position, DVec3::new(-0.75, 2.5, 4.0));
    assert_eq!(lights[7].position, DVec3::new(0.75, 3.5, 4.0));
    assert!(lights.iter().all(|light| light.intensity == 0.125));
    assert_eq!(found.scene.environment.ambient.to_array(), [1.5; 3]);
    let found = bad(
        FORMAT,
        &scene("- add: light\n  corner: [0, 0, 0]\n  uvec: [1, 0, 0]\n  vvec: [0, 1, 0]\n  usteps: 99\n"),
    );
    assert!(found.contains("`usteps` is 99"), "{found}");
    assert!(found.contains("lacks `vsteps`"), "{found}");
}

fn approximately(text: &str) -> catoptric_exchange::ImportedScene {
    good(FORMAT, text, &ImportOptions { is_approximate: true, ..ImportOptions::default() })
}

#[test]
fn without_a_camera_all_bodies_are_in_view() {
    let text = "- add: light\n  at: [-5, 5, -5]\n- add: sphere\n  transform: [[translate, 0, 0, 3]]\n\
                - add: cylinder\n- add: plane\n- add: triangle\n  p1: [90, 0, 0]\n  p2: [91, 0, 0]\n  p3: [92, 0, 0]\n";
    assert!(bad(FORMAT, text).starts_with("1:1: error: the scene has no camera"), "{}", bad(FORMAT, text));
    let found = approximately(text);
    // Neither what has no end nor what is left out counts.
    let camera = found.scene.camera;
    assert_eq!(
        (camera.target, found.scene.bodies.len()),
        (DVec3::new(0.0, 0.0, -3.0), 3),
        "{}",
        found.report
    );
    let distance = camera.position.distance(camera.target);
    assert!((distance - 1.1 / 13.5_f64.to_radians().sin()).abs() < 1e-9, "{distance}");
    assert!(pixel(&found, [9, 9], [4, 4]).iter().sum::<f32>() > 0.0);
    // A camera that cannot be read is none.
    let found = approximately("- add: camera\n  from: [0, 0, 1]\n- add: sphere\n");
    assert_eq!(found.scene.camera.target, DVec3::ZERO);
}

/// What would be an error of one object leaves out that object.
#[test]
fn one_object_does_not_stop_a_scene() {
    let text = scene(
        "- options:\n  depth: 3\n- add: point-light\n- add: triangle\n  p1: [0, 0, 0]\n  p2: [1, 0, 0]\n  p3: [2, 0, 0]\n\
         - add: sphere\n  transform: [[scale, 0, 1, 1]]\n- add: cylinder\n  min: 2\n  max: 1\n- add: cube\n  transform: [[twist, 3]]\n\
         - define: m\n- add: sphere\n  material: m\n- add: cone\n  min: low\n  max: 1\n- add: group\n  children:\n  - add: cube\n  - 7\n",
    );
    assert!(bad(FORMAT, &text).lines().count() > 7, "{}", bad(FORMAT, &text));
    let shapes: Vec<_> = approximately(&text).scene.bodies.iter().map(|body| body.shape).collect();
    let cube = Shape::Cube { size: DVec3::splat(2.0) };
    assert!(shapes.contains(&Shape::SPHERE) && shapes.contains(&cube) && shapes.len() == 4, "{shapes:?}");
}
