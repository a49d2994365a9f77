//! Open and endless bodies, squares, triangles: what they are read as, and back.

use catoptric_exchange::{Dialect, ForeignFormat, ImportOptions};
use catoptric_scene::{
    Anchor, Body, BodyShape, Color, Light, MaterialChoice, OpenCone, OpenCylinder, ParametricShape, Phong,
    Placement, Rectangle, Scene, ShapeKind, Triangle, VisibleSide,
};
use catoptric_tracer::{Ray, RenderControl, RenderScene, RenderSettings, render};
use glam::{DVec3, Vec3};
use proptest::prelude::*;

use crate::common::{bad, good, written_and_read};

const CHALLENGE: &str = "- add: camera\n  width: 40\n  height: 20\n  field-of-view: 0.7\n  from: [0, 0, -5]\n  to: [0, 0, 0]\n  \
                         up: [0, 1, 0]\n- add: light\n  at: [-10, 10, -10]\n  intensity: [1, 1, 1]\n";

fn challenge(rest: &str) -> Scene {
    good(ForeignFormat::Challenge, &format!("{CHALLENGE}{rest}"), &ImportOptions::default()).scene
}

/// The distances at which a ray of the book's axes meets bodies, each from the one before on.
fn met(scene: &RenderScene, origin: [f32; 3], direction: [f32; 3]) -> Vec<f32> {
    let ours = |[x, y, z]: [f32; 3]| Vec3::new(x, y, -z);
    let mut ray = Ray::from_point(ours(origin), ours(direction).normalize());
    let start = ours(origin);
    let mut found = Vec::new();
    while let Some(hit) = scene.closest_hit(&ray) {
        found.push(hit.position.as_vec3().distance(start));
        assert!(found.len() < 10, "a ray goes on for ever");
        let start = catoptric_tracer::RayOrigin { body: hit.hit.body, inwards: !hit.hit.leaving };
        ray = Ray { origin: hit.position.as_vec3a(), start, ..ray };
    }
    found
}

#[track_caller]
fn assert_met(found: &[f32], expected: &[f32]) {
    let is_near = found.len() == expected.len()
        && found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-3);
    assert!(is_near, "{found:?} instead of {expected:?}");
}

/// The tables of Buck 2019, chapter 13: rays and cylinders, truncated and not, and cones.
#[test]
fn cylinders_and_cones_are_those_of_the_book() {
    let endless = RenderScene::build(&challenge("- add: cylinder\n")).unwrap();
    for (origin, direction) in
        [([1.5, 0.0, 0.0], [0.0, 1.0, 0.0]), ([0.0; 3], [0.0, 1.0, 0.0]), ([1.5, 0.0, -5.0], [0.5, 1.0, 1.0])]
    {
        assert_met(&met(&endless, origin, direction), &[]);
    }
    assert_met(&met(&endless, [0.0, 0.0, -5.0], [0.0, 0.0, 1.0]), &[4.0, 6.0]);
    assert_met(&met(&endless, [0.5, 0.0, -5.0], [0.1, 1.0, 1.0]), &[6.80798, 7.08872]);
    let open = RenderScene::build(&challenge("- add: cylinder\n  min: 1\n  max: 2\n")).unwrap();
    for (origin, direction, count) in [
        ([0.0, 1.5, 0.0], [0.1, 1.0, 0.0], 0),
        ([0.0, 3.0, -5.0], [0.0, 0.0, 1.0], 0),
        ([0.0, 0.0, -5.0], [0.0, 0.0, 1.0], 0),
        ([0.0, 1.5, -2.0], [0.0, 0.0, 1.0], 2),
    ] {
        assert_eq!(met(&open, origin, direction).len(), count, "{origin:?} {direction:?}");
    }
    let closed =
        RenderScene::build(&challenge("- add: cylinder\n  min: 1\n  max: 2\n  closed: true\n")).unwrap();
    for (origin, direction) in [
        ([0.0, 3.0, 0.0], [0.0, -1.0, 0.0]),
        ([0.0, 3.0, -2.0], [0.0, -1.0, 2.0]),
        ([0.0, 0.0, -2.0], [0.0, 1.0, 2.0]),
    ] {
        assert_eq!(met(&closed, origin, direction).len(), 2, "{origin:?} {direction:?}");
    }
    let cone = RenderScene::build(&challenge("- add: cone\n")).unwrap();
    assert_met(&met(&cone, [1.0, 1.0, -5.0], [-0.5, -1.0, 1.0]), &[4.55006, 49.44994]);
    // Parallel to one of its halves.
    assert_met(&met(&cone, [0.0, 0.0, -1.0], [0.0, 1.0, 1.0]), &[0.5_f32.sqrt()]);
}

#[test]
fn triangles_are_those_of_the_book() {
    let text = "- add: triangle\n  p1: [0, 1, 0]\n  p2: [-1, 0, 0]\n  p3: [1, 0, 0]\n";
    let triangle = RenderScene::build(&challenge(text)).unwrap();
    for (origin, direction) in [
        ([0.0, -1.0, -2.0], [0.0, 1.0, 0.0]),
        ([1.0, 1.0, -2.0], [0.0, 0.0, 1.0]),
        ([-1.0, 1.0, -2.0], [0.0, 0.0, 1.0]),
        ([0.0, -1.0, -2.0], [0.0, 0.0, 1.0]),
    ] {
        assert_met(&met(&triangle, origin, direction), &[]);
    }
    assert_met(&met(&triangle, [0.0, 0.5, -2.0], [0.0, 0.0, 1.0]), &[2.0]);
    // Sheared, turned and mirrored, it is one still.
    let moved = format!("{text}  transform:\n  - [shear, 1, 0, 0, 0, 0, 0]\n  - [scale, -1, 2, 1]\n");
    let moved = RenderScene::build(&challenge(&moved)).unwrap();
    assert_met(&met(&moved, [-0.5, 1.0, -2.0], [0.0, 0.0, 1.0]), &[2.0]);
    assert_met(&met(&moved, [0.9, 1.0, -2.0], [0.0, 0.0, 1.0]), &[]);
}

#[test]
fn surfaces_are_no_operands() {
    let csg = |left: &str| {
        format!(
            "{CHALLENGE}- add: csg\n  operation: union\n  left:\n    type: {left}\n  right:\n    type: sphere\n"
        )
    };
    let found = bad(ForeignFormat::Challenge, &csg("cylinder\n    min: 0\n    max: 1"));
    assert!(found.contains("a `cylinder` with open ends has no inside"), "{found}");
    let found = bad(
        ForeignFormat::Challenge,
        &csg("triangle\n    p1: [0, 0, 0]\n    p2: [1, 0, 0]\n    p3: [0, 1, 0]"),
    );
    assert!(found.contains("a triangle has no inside"), "{found}");
}

/// In left-handed files, z points into the picture.
#[test]
fn triangles_of_left_handed_files_are_mirrored() {
    let text = "A 0.2 255,255,255\nC 0,0,-5 0,0,1 60\ntr 1,2,3 4,0,1 -2,5,7 9,9,9\nsq 1,2,3 0,0,1 4 9,9,9\n";
    for is_left_handed in [false, true] {
        let dialect = Dialect { is_left_handed, ..Dialect::default() };
        let options = ImportOptions { dialect, ..ImportOptions::default() };
        let scene = good(ForeignFormat::MiniRt, text, &options).scene;
        let body = &scene.bodies[0];
        let frame = body.placement.world_from_body();
        for (key, expected) in [
            ("a", DVec3::new(1.0, 2.0, 3.0)),
            ("b", DVec3::new(4.0, 0.0, 1.0)),
            ("c", DVec3::new(-2.0, 5.0, 7.0)),
        ] {
            let expected = if is_left_handed { expected * DVec3::new(1.0, 1.0, -1.0) } else { expected };
            let found = frame.transform_point3(body.body_shape().vector(key).unwrap());
            assert!(found.abs_diff_eq(expected, 1e-9), "{found} instead of {expected}");
        }
        assert_eq!(scene.bodies[1].body_shape().kind(), ShapeKind::Rectangle);
    }
}

fn surface() -> impl Strategy<Value = ParametricShape> {
    let number = || -2.0..2.0f64;
    let corner = move || (number(), number(), number()).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    prop_oneof![
        (0.2..1.0f64, 0.5..2.0f64)
            .prop_map(|(radius, height)| OpenCylinder { radius, height, ..OpenCylinder::default() })
            .prop_map(ParametricShape::OpenCylinder),
        (0.2..1.0f64, 0.0..1.0f64, 0.5..2.0f64).prop_map(|(radius, top_radius, height)| {
            ParametricShape::OpenCone(OpenCone { radius, top_radius, height, ..OpenCone::default() })
        }),
        (0.5..2.0f64)
            .prop_map(|side| Rectangle { width: side, length: side, ..Rectangle::default() })
            .prop_map(ParametricShape::Rectangle),
        (corner(), corner(), corner())
            .prop_map(|(a, b, c)| Triangle { a, b, c, ..Triangle::default() })
            .prop_map(ParametricShape::Triangle),
    ]
}

fn scene() -> impl Strategy<Value = Scene> {
    let place = (-2.0..2.0f64, -2.0..2.0f64, -2.0..2.0f64);
    let turn = (-170.0..170.0f64, -170.0..170.0f64, -170.0..170.0f64);
    let side = prop::sample::select(VisibleSide::ALL.to_vec());
    prop::collection::vec((surface(), side, place, turn), 1..5).prop_map(|surfaces| {
        let bodies = surfaces.into_iter().map(|(shape, side, position, rotation)| {
            let mut shape = BodyShape::Parametric(shape);
            shape.set_word("visible_side", side.key());
            let anchor =
                Anchor::Frame { position: DVec3::from(position), rotation_degrees: DVec3::from(rotation) };
            let phong = Phong { ambient: 0.0, diffuse: 1.0, ..Phong::default() };
            Body {
                placement: Placement { anchor, scale: DVec3::ONE },
                material: MaterialChoice::own(Phong { reflection: Some(0.0), ..phong }),
                ..Body::of_shape(shape)
            }
        });
        let mut scene = Scene { bodies: bodies.collect(), ..Scene::default() };
        scene.environment.background = Color::BLACK;
        scene.environment.ambient = Color::BLACK;
        scene.camera.position = DVec3::new(0.0, 1.0, 9.0);
        scene.camera.target = DVec3::ZERO;
        scene.lights =
            vec![Light { position: DVec3::new(3.0, 5.0, 8.0), color: Color::WHITE, ..Light::default() }];
        scene
    })
}

/// What a format can say of a surface.
fn fits(format: ForeignFormat, body: &Body) -> bool {
    let shape = body.body_shape();
    if format != ForeignFormat::Nff && shape.word("visible_side") != Some("both") {
        return false;
    }
    match (format, shape.kind()) {
        (_, ShapeKind::Triangle) | (ForeignFormat::Nff, _) => true,
        (ForeignFormat::Challenge, kind) => kind != ShapeKind::Rectangle,
        // Turned squares are told by their normal alone.
        (ForeignFormat::MiniRt, _) => false,
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// What comes back looks the same.
    #[test]
    fn surfaces_come_back(scene in scene()) {
        for format in ForeignFormat::ALL {
            let mut scene = scene.clone();
            scene.bodies.retain(|body| fits(format, body));
            let (written, mut found) = written_and_read(format, &scene);
            prop_assert_eq!(found.bodies.len(), scene.bodies.len());
            found.camera = scene.camera;
            let picture = |scene: &Scene| {
                let settings = RenderSettings { width: 48, height: 36, samples: 1 };
                render(&RenderScene::build(scene).unwrap(), settings, &RenderControl::default()).unwrap().picture
            };
            let [own, other] = [picture(&scene), picture(&found)];
            let apart = |(own, other): &(&[f32; 3], &[f32; 3])| {
                own.iter().zip(*other).any(|(own, other)| (own - other).abs() > 1e-3)
            };
            let unlike = own.pixels().iter().zip(other.pixels()).filter(apart).count();
            prop_assert!(unlike <= 4, "{format:?}: {unlike} pixels\n{written}");
        }
    }
}

#[test]
fn squares_that_stand_as_their_normal_says_come_back() {
    let text = "A 0 255,255,255\nC 0,0,5 0,0,-1 60\nL 0,4,4 1 255,255,255\nsq 1,2,3 0,0.6,0.8 4 51,102,255\n\
                tr 0,0,0 1,0,0.5 0,1,0 9,9,9\n";
    let scene = good(ForeignFormat::MiniRt, text, &ImportOptions::default()).scene;
    let (written, _) = written_and_read(ForeignFormat::MiniRt, &scene);
    let numbers = |line: &str| -> Vec<f64> {
        let words = line.split([' ', ',']).skip(1);
        words.map(|word| word.parse().unwrap()).collect()
    };
    for line in text.lines().filter(|line| line.starts_with("sq") || line.starts_with("tr")) {
        let other = written.lines().find(|other| other.starts_with(&line[..2])).unwrap();
        let pairs = numbers(line).into_iter().zip(numbers(other));
        assert!(pairs.into_iter().all(|(one, other)| (one - other).abs() < 1e-9), "{line}\n{other}");
    }
}
