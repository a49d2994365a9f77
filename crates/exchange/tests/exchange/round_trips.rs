//! Scenes that a format can say come back from it.

use catoptric_exchange::{ExportOptions, ForeignFormat, ImportOptions, read, write};
use catoptric_scene::{
    Anchor, Body, BodyPart, Camera, Color, Light, Material, MaterialChoice, Pattern, PatternSpace, Phong,
    Placement, Projection, Scene, Shape, SolidKind, SolidTexture,
};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings, render};
use glam::DVec3;
use proptest::prelude::*;

use crate::common::written_and_read;

fn share() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), Just(0.5), 0.01..0.99f64]
}

fn color() -> impl Strategy<Value = Color> {
    (share(), share(), share()).prop_map(|(r, g, b)| Color::new(r, g, b))
}

fn point() -> impl Strategy<Value = DVec3> {
    let number = || prop_oneof![Just(0.0), Just(-2.0), -50.0..50.0f64];
    (number(), number(), number()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn turn() -> impl Strategy<Value = DVec3> {
    let angle = || prop_oneof![Just(0.0), Just(90.0), -170.0..170.0f64];
    (angle(), angle(), angle()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
}

fn length() -> impl Strategy<Value = f64> {
    prop_oneof![Just(1.0), 0.1..9.0f64]
}

fn shape() -> impl Strategy<Value = Shape> {
    (length(), length(), length(), 0..6u8).prop_map(|(a, b, c, kind)| match kind {
        0 => Shape::Sphere { radius: a },
        1 => Shape::Plane,
        2 => Shape::Cylinder { radius: a, height: b },
        3 => Shape::Cone { radius: a, top_radius: 0.0, height: b },
        4 => Shape::Cone { radius: a, top_radius: c, height: b },
        _ => Shape::Cube { size: DVec3::new(a, b, c) },
    })
}

fn phong() -> impl Strategy<Value = Phong> {
    (color(), share(), share(), length(), share(), proptest::option::of((color(), length()))).prop_map(
        |(color, diffuse, specular, shininess, reflection, checker)| {
            let checker = checker.map(|(color, size)| SolidTexture {
                size,
                space: PatternSpace::Body,
                ..SolidTexture::new(SolidKind::Checker, color)
            });
            let pattern = Pattern { solid: checker, ..Pattern::from(color) };
            Phong {
                pattern,
                ambient: 0.0,
                diffuse,
                specular,
                shininess,
                reflection: Some(reflection),
                ..Phong::default()
            }
        },
    )
}

fn body() -> impl Strategy<Value = Body> {
    (shape(), point(), turn(), phong()).prop_map(|(shape, position, rotation_degrees, phong)| {
        let placement = Placement { anchor: Anchor::Frame { position, rotation_degrees }, scale: DVec3::ONE };
        let material = MaterialChoice::Inline(Box::new(Material::Phong(phong)));
        Body { shape, placement, material, ..Body::default() }
    })
}

prop_compose! {
    fn scene()(
        from in point(), to in point().prop_map(|point| point + DVec3::new(200.0, 3.0, -7.0)), fov in 5.0..100.0f64,
        lights in prop::collection::vec((point(), color(), share()), 1..4),
        bodies in prop::collection::vec(body(), 0..6),
    ) -> Scene {
        let mut scene = Scene { camera: Camera {
            position: from, target: to, up: DVec3::Y, projection: Projection::Perspective { fov_degrees: fov },
        }, bodies: bodies.into_iter().collect(), ..Scene::default() };
        scene.environment.background = Color::BLACK;
        scene.environment.ambient = Color::BLACK;
        scene.lights = lights
            .into_iter()
            .map(|(position, color, intensity)| Light { position, color, intensity, ..Light::default() })
            .collect();
        scene
    }
}

/// What a format can say of a body: others are left out before.
fn fits(format: ForeignFormat, body: &Body) -> bool {
    let Some(phong) = phong_of(body) else { return false };
    match format {
        ForeignFormat::MiniRt => {
            let brightest = phong.pattern.brightest().to_array().into_iter().fold(0.0, f64::max);
            let is_shape = !matches!(body.shape, Shape::Cube { .. })
                && !matches!(body.shape, Shape::Cone { top_radius, .. } if top_radius != 0.0);
            is_shape && phong.reflection() < 1.0 && brightest * phong.diffuse <= 1.0 - phong.reflection()
        }
        ForeignFormat::Challenge => true,
        ForeignFormat::Nff => {
            matches!(body.shape, Shape::Sphere { .. })
                && phong.reflection() == phong.specular
                && phong.pattern.solid.is_none()
        }
    }
}

fn phong_of(body: &Body) -> Option<&Phong> {
    match &body.material {
        MaterialChoice::Inline(material) => material.as_phong(),
        MaterialChoice::Named(_) => None,
    }
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-7 * (1.0 + a.abs())
}

/// Corners of the box around a body in the world, in an order of their own.
fn corners(body: &Body) -> Vec<DVec3> {
    let mut corners = body.box_corners().map_or_else(
        || {
            vec![
                body.placement.rotation() * DVec3::Y,
                DVec3::splat((body.placement.rotation() * DVec3::Y).dot(body.placement.origin())),
            ]
        },
        Vec::from,
    );
    let key = |corner: &DVec3| corner.to_array().map(|value| (value * 1e4).round() as i64);
    corners.sort_by_key(key);
    corners
}

fn assert_equal(format: ForeignFormat, scene: &Scene, found: &Scene) {
    prop_assert_eq_sizes(scene, found);
    let direction = |camera: &Camera| (camera.target - camera.position).normalize();
    assert!(scene.camera.position.abs_diff_eq(found.camera.position, 1e-9));
    assert!(direction(&scene.camera).abs_diff_eq(direction(&found.camera), 1e-9));
    let (Projection::Perspective { fov_degrees: a }, Projection::Perspective { fov_degrees: b }) =
        (scene.camera.projection, found.camera.projection)
    else {
        panic!()
    };
    assert!(near(a, b), "{a} {b}");
    for (light, other) in scene.lights.iter().zip(&found.lights) {
        assert!(light.position.abs_diff_eq(other.position, 1e-9));
        for (a, b) in light.color.to_array().into_iter().zip(other.color.to_array()) {
            assert!(near(a * light.intensity, b * other.intensity));
        }
    }
    for (body, other) in scene.bodies.iter().zip(&found.bodies) {
        let is_ball = matches!(body.shape, Shape::Sphere { .. });
        if is_ball {
            assert!(near(body.shape.number("radius").unwrap(), other.shape.number("radius").unwrap()));
            assert!(body.middle().abs_diff_eq(other.middle(), 1e-9));
        } else if !matches!(body.shape, Shape::Cylinder { .. } | Shape::Cone { .. }) {
            for (a, b) in corners(body).into_iter().zip(corners(other)) {
                assert!(a.abs_diff_eq(b, 1e-3), "{format:?} {body:?} {other:?}");
            }
        } else {
            // The frames may be turned about the axis, and the wider end may be the lower one.
            assert!(body.middle().abs_diff_eq(other.middle(), 1e-6), "{body:?} {other:?}");
            let up = |body: &Body| body.placement.rotation() * DVec3::Y;
            assert!(near(up(body).dot(up(other)).abs(), 1.0));
            assert!(near(body.height().unwrap(), other.height().unwrap()));
            let widest = |body: &Body| {
                let size = |key| body.shape.number(key).unwrap_or_default();
                size("radius").max(size("top_radius"))
            };
            assert!(near(widest(body), widest(other)));
        }
        let (a, b) = (phong_of(body).unwrap(), phong_of(other).unwrap());
        let values = |phong: &Phong| {
            let shininess = if phong.specular > 0.0 { phong.shininess } else { 0.0 };
            let color = phong.pattern.color.to_array().map(|value| value * phong.diffuse);
            [phong.specular, shininess, phong.reflection(), color[0], color[1], color[2]]
        };
        let mut b = b.clone();
        assert_eq!(a.pattern.solid.is_some(), b.pattern.solid.is_some());
        if let Some((own, other)) = a.pattern.solid.as_ref().zip(b.pattern.solid.as_mut()) {
            assert!(near(own.size, other.size));
            let is_even = |color: Color| {
                color.to_array().into_iter().zip(a.pattern.color.to_array()).all(|(a, b)| near(a, b))
            };
            // In the other space, cells may have the other parity.
            if own.space != other.space && !is_even(b.pattern.color) {
                std::mem::swap(&mut other.color, &mut b.pattern.color);
            }
            let colors = own.color.to_array().into_iter().zip(other.color.to_array());
            assert!(colors.into_iter().all(|(own, other)| near(own * a.diffuse, other * b.diffuse)));
        }
        assert!(values(a).into_iter().zip(values(&b)).all(|(a, b)| near(a, b)), "{format:?} {a:?} {b:?}");
    }
}

fn prop_assert_eq_sizes(scene: &Scene, found: &Scene) {
    assert_eq!((scene.lights.len(), scene.bodies.len()), (found.lights.len(), found.bodies.len()));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn scenes_come_back(mut scene in scene(), equal_reflection in any::<bool>()) {
        if equal_reflection {
            for body in &mut scene.bodies {
                if let MaterialChoice::Inline(material) = &mut body.material
                    && let Material::Phong(phong) = &mut **material
                {
                    phong.reflection = Some(phong.specular);
                    phong.pattern.solid = None;
                }
            }
        }
        for format in ForeignFormat::ALL {
            let mut scene = scene.clone();
            scene.bodies.retain(|body| fits(format, body));
            let (_, found) = written_and_read(format, &scene);
            assert_equal(format, &scene, &found);
        }
    }
}

#[test]
fn what_a_format_cannot_say_is_told_or_left_out() {
    let scene = catoptric_scene::Example::find("whitted").unwrap().load().unwrap().scene;
    for format in ForeignFormat::ALL {
        let error = write(format, &scene, &ExportOptions::default()).unwrap_err();
        assert!(!error.lost.is_empty() && error.to_string().lines().count() == error.lost.len());
        let options = ExportOptions { is_approximate: true, ..ExportOptions::default() };
        let written = write(format, &scene, &options).unwrap();
        assert_eq!(written.lost, error.lost);
        let found = read(format, &written.text, &ImportOptions::default());
        assert!(found.is_ok(), "{format:?}: {}\n{}", found.unwrap_err(), written.text);
    }
}

#[test]
fn bodies_of_parts_come_back_as_what_they_look_like() {
    let text = r#"
format = "catoptric/1"
camera = { position = [1, 4, 9], target = [0, 0, 0] }
environment = { background = [0, 0, 0], ambient = [0, 0, 0] }
lights = [{ position = [4, 9, 6] }]

[[bodies]]
shape = "difference"
position = [-2, 0.5, 0]
rotation = [20, 30, 10]
scale = [1, 1.5, 1]
material = { color = [0.9, 0.2, 0.1], ambient = 0.0 }

[[bodies.parts]]
shape = "cube"
size = [2, 2, 2]
material = { checker = { color = [0.1, 0.1, 0.8], size = 0.4 }, ambient = 0.0 }

[[bodies.parts]]
shape = "cylinder"
radius = 0.5
height = 4
position = [0, -2, 0]
rotation = [0, 40, 0]

[[bodies.parts]]
shape = "intersection"
position = [1, 1, 1]

[[bodies.parts.parts]]
shape = "sphere"
radius = 0.9

[[bodies.parts.parts]]
shape = "cube"
size = [1.2, 1.2, 1.2]
rotation = [0, 45, 0]

[[bodies]]
shape = "group"
position = [2, 0, 0]

[[bodies.parts]]
shape = "cone"
radius = 1
height = 2

[[bodies.parts]]
shape = "tube"
radius = 0.6
inner_radius = 0.4
height = 1
position = [0, -1.5, 1]
material = { color = [0.1, 0.9, 0.2], ambient = 0.0 }
"#;
    let scene = catoptric_scene::read(text).into_result().unwrap().value;
    let size = [64, 48];
    let options = ExportOptions { size: Some(size), ..ExportOptions::default() };
    let written = write(ForeignFormat::Challenge, &scene, &options).unwrap().text;
    let found = read(ForeignFormat::Challenge, &written, &ImportOptions::default()).unwrap();
    let picture = |scene: &Scene| {
        let scene = RenderScene::build(scene).unwrap();
        let settings = RenderSettings { width: size[0], height: size[1], samples: 1 };
        render(&scene, settings, &RenderControl::default()).unwrap().picture
    };
    let pictures = [picture(&scene), picture(&found.scene)];
    let (mut lit, mut unlike) = (0, 0);
    for (x, y) in (0..size[0]).flat_map(|x| (0..size[1]).map(move |y| (x, y))) {
        let [own, other] = pictures.each_ref().map(|picture| picture.pixel(x, y).unwrap());
        lit += usize::from(own.iter().any(|&light| light > 0.01));
        unlike += usize::from(own.iter().zip(other).any(|(own, other)| (own - other).abs() > 1e-3));
    }
    assert!(lit > 400 && unlike <= 3, "{unlike} of {lit} differ:\n{written}");
}

#[test]
fn bodies_of_many_parts_come_back_as_deep_as_they_are() {
    let ball = |x: usize| {
        let anchor = Anchor::Frame { position: DVec3::X * x as f64, rotation_degrees: DVec3::ZERO };
        BodyPart {
            shape: Shape::SPHERE,
            placement: Placement { anchor, ..Placement::default() },
            ..BodyPart::default()
        }
    };
    for shape in [Shape::Union, Shape::Intersection, Shape::Difference] {
        for count in [0, 1, 2, 3, 22, Shape::MAX_PARTS] {
            let mut scene = Scene::default();
            scene.environment.background = Color::BLACK;
            scene.environment.ambient = Color::BLACK;
            let material = MaterialChoice::Inline(Box::new(Material::Phong(Phong::default())));
            let parts = (0..count).map(ball).collect();
            scene.bodies = vec![Body { shape, parts, material, ..Body::default() }].into();
            let written = write(ForeignFormat::Challenge, &scene, &ExportOptions::default()).unwrap().text;
            let found = read(ForeignFormat::Challenge, &written, &ImportOptions::default())
                .unwrap_or_else(|errors| panic!("{errors}\n{written}"));
            let bodies = found.scene.bodies.to_vec();
            assert_eq!(bodies.len(), count.min(1));
            if count > 1 {
                assert_eq!((bodies[0].shape, bodies[0].parts.len()), (shape, count));
                let places = bodies[0].parts.iter().map(|part| part.placement.origin().x);
                assert!(places.eq((0..count).map(|x| x as f64)));
            }
        }
    }
}

#[test]
fn a_plane_is_written_in_a_group_and_not_as_an_operand() {
    let scene = |shape: &str| {
        let text = format!(
            "format = \"catoptric/1\"\nenvironment = {{ background = [0, 0, 0], ambient = [0, 0, 0] }}\n[[bodies]]\nshape = \"{shape}\"\n[[bodies.parts]]\nshape = \"plane\"\n[[bodies.parts]]\nshape = \"sphere\"\n"
        );
        catoptric_scene::read(&text).into_result().unwrap().value
    };
    let options = ExportOptions::default();
    assert!(write(ForeignFormat::Challenge, &scene("group"), &options).is_ok());
    let error = write(ForeignFormat::Challenge, &scene("intersection"), &options).unwrap_err();
    assert_eq!(error.lost.len(), 1, "{error}");
}
