//! Every way of writing TOML is understood.

use catoptric_scene::{
    Anchor, Color, Falloff, LONGEST_TEXT, Language, MaterialChoice, PatternSpace, Projection, Scene, Shape,
    SolidKind, SolidTexture, read,
};
use glam::DVec3;

const SMALL: &str = include_str!("small.toml");

#[track_caller]
fn scene(text: &str) -> Scene {
    read(text).into_result().unwrap_or_else(|found| panic!("{found}")).value
}

#[test]
fn a_scene_with_everything_is_read() {
    let scene = scene(SMALL);
    assert_eq!(scene.tracing.generations, 5);
    assert_eq!(scene.camera.position, DVec3::new(0.0, 2.2, 8.0));
    assert_eq!(scene.camera.projection, Projection::Parallel { height: 5.0 });
    assert_eq!(scene.environment.background, Color::from_srgb8([0x33, 0x66, 0x99]));
    let [red, glass] = scene.materials.as_slice() else { panic!() };
    assert_eq!((red.name.as_str(), red.material.reflection()), ("red", Some(0.3)));
    assert_eq!(red.material.pattern().unwrap().solid.as_ref().unwrap().size, 0.5);
    assert_eq!((glass.name.as_str(), glass.material.ior()), ("glass ball", Some(1.33)));
    assert_eq!(scene.lights[0].falloff, Falloff::Linear { constant: 2.0 });
    let [ball, cube, cone, cylinder, floor] = &scene.bodies.to_vec()[..] else { panic!() };
    assert_eq!((ball.name.as_str(), ball.shape), ("ball", Shape::Sphere { radius: 2.0 }));
    assert_eq!(ball.material, MaterialChoice::Named("red".to_owned()));
    assert_eq!(cube.shape, Shape::Cube { size: DVec3::new(1.0, 2.0, 3.0) });
    assert_eq!(cube.placement.scale, DVec3::splat(0.5));
    let frame = Anchor::Frame { position: DVec3::ZERO, rotation_degrees: DVec3::Y * 30.0 };
    assert_eq!(cube.placement.anchor, frame);
    assert_eq!(
        scene.material(&cube.material).unwrap().pattern().unwrap().solid.as_ref().unwrap().color,
        Color::BLACK
    );
    assert_eq!(cone.placement.anchor, Anchor::Axis { base: DVec3::ZERO, top: DVec3::Y * 10.5 });
    assert_eq!(cone.shape, Shape::Cone { radius: 0.5, top_radius: 0.1, height: 10.5 });
    assert_eq!(scene.material(&cone.material).unwrap().as_phong().unwrap().diffuse, 0.4);
    assert_eq!(cylinder.shape, Shape::CYLINDER);
    assert_eq!((floor.name.as_str(), floor.shape), ("floor", Shape::Plane));
}

#[test]
fn line_ends_and_byte_order_marks_do_not_matter() {
    assert_eq!(scene(&SMALL.replace('\n', "\r\n")), scene(SMALL));
    assert_eq!(scene(&format!("\u{feff}{SMALL}")), scene(SMALL));
    assert_eq!(scene(SMALL.trim_end()), scene(SMALL));
}

#[test]
fn notations_of_one_scene_are_equal() {
    let headers = "format = 'catoptric/1'\n[materials.a.checker]\nsize = 2\n[materials.a]\nior = 2\n[[bodies]]\n\
        material = 'a'\n[[lights]]\n[camera]\nfov = 30\n[[bodies]]\n[bodies.material.checker]\n[bodies.material]\ndiffuse = 0.5\n";
    let inline = "format = \"catoptric/1\"\nmaterials = { a = { checker.size = 2.0, ior = 2e0 } }\nlights = [{}]\n\
        camera = { fov = 0b11110 }\nbodies = [\n { \"material\" = '''a''' }, # one\n { material = { diffuse = +0.5, checker = {} } },\n]\n";
    let dotted = "'format' = 'catoptric\u{2f}1'\nmaterials.a.ior = 2\nmaterials.\"a\".checker.size = 2\n\
        camera . fov = 30.0\n[[bodies]]\nmaterial = \"\\u0061\"\n[ [ \"bodies\" ] ]\n[[lights]]\n"
        .replace("[ [ \"bodies\" ] ]", "[[ \"bodies\" ]]\nmaterial.diffuse = 0.5\nmaterial.checker = { }");
    assert_eq!(scene(inline), scene(headers));
    assert_eq!(scene(&dotted), scene(headers));
}

#[test]
fn a_broken_file_gives_what_can_be_understood() {
    let reading = read(
        "format = 'catoptric/1'\ncamera.fov = -1\n[[bodies]]\nshape = 'torus'\n[[bodies]]\nradius = 'big'\nname = 'ball'\n",
    );
    assert_eq!(reading.diagnostics.len(), 3);
    assert_eq!(reading.scene.camera, Scene::default().camera);
    let [ball] = &reading.scene.bodies.to_vec()[..] else { panic!() };
    assert_eq!((ball.name.as_str(), ball.shape), ("ball", Shape::SPHERE));
    assert!(reading.into_result().is_err());
}

#[test]
fn too_much_is_refused() {
    let text = format!("format = 'catoptric/1'\nbodies = [{}]\n[camera]\nfov = 0\n", "{},".repeat(700_000));
    let found = read(&text).diagnostics;
    assert_eq!(
        found.to_string(),
        "2:1: error: this value is too long\n4:7: error: `fov` is `0`, but must be at least 0.001"
    );
    assert!(found.render("a.toml", &text, true).len() < 3000);
    let text = format!("format = 'catoptric/1'\n{}", "[[bodies]]\nradius = 0\n".repeat(1500));
    let found = read(&text).diagnostics;
    assert_eq!((found.len(), found.omitted()), (1000, 500));
    assert_eq!(LONGEST_TEXT, 1_073_741_824);
}

#[test]
fn flags_are_true_or_false() {
    let text =
        "format = \"catoptric/1\"\n[[lights]]\nhidden = true\n[[bodies]]\nlocked = true\nhidden = false\n";
    let scene = read(text).into_result().unwrap().value;
    assert_eq!((scene.lights[0].hidden, scene.lights[0].locked), (true, false));
    assert_eq!((scene.bodies[0].hidden, scene.bodies[0].locked), (false, true));
    let standard = catoptric_scene::write(&scene);
    assert_eq!(standard.matches("hidden = true\n").count(), 1);
    assert_eq!(standard.matches("locked = true\n").count(), 1);
    assert!(!standard.contains("false"), "{standard}");
    let mut edited = scene.clone();
    (edited.bodies[0].locked, edited.bodies[0].hidden) = (false, true);
    let updated = catoptric_scene::update(text, &edited);
    assert_eq!(updated, text.replace("locked = true\n", "").replace("hidden = false", "hidden = true"));
    let found = read("format = \"catoptric/1\"\n[[bodies]]\nhidden = 1\n").diagnostics;
    let messages: Vec<String> =
        found.iter().map(|diagnostic| diagnostic.message(Language::English)).collect();
    assert_eq!(messages, ["`hidden` is a number, but must be `true` or `false`"]);
}

#[test]
fn patterns_lie_within_patterns() {
    let material = "format = 'catoptric/1'\n[[bodies]]\n[bodies.material]\ncolor = [1, 0, 0]\n";
    let inline = "stripes = { color = [0, 1, 0], size = 2, space = 'body', second.rings = {}, \
                  first = { gradient = { color = [0, 0, 1], scale = [1, 2, 3], rotation = [0, 90, 0] } } }\n";
    let headers = "[bodies.material.stripes]\nsize = 2\nspace = 'body'\ncolor = [0, 1, 0]\n\
                   [bodies.material.stripes.second.rings]\n[bodies.material.stripes.first.gradient]\n\
                   color = [0, 0, 1]\nrotation = [0, 90, 0]\nscale = [1, 2, 3]\n";
    let found = scene(&format!("{material}{inline}"));
    assert_eq!(found, scene(&format!("{material}{headers}")));
    let gradient = SolidTexture {
        scale: DVec3::new(1.0, 2.0, 3.0),
        rotation_degrees: DVec3::new(0.0, 90.0, 0.0),
        ..SolidTexture::new(SolidKind::Gradient, Color::new(0.0, 0.0, 1.0))
    };
    let rings = SolidTexture { kind: SolidKind::Rings, ..SolidTexture::default() };
    let stripes = SolidTexture {
        size: 2.0,
        space: PatternSpace::Body,
        first: Some(Box::new(gradient)),
        second: Some(Box::new(rings)),
        ..SolidTexture::new(SolidKind::Stripes, Color::new(0.0, 1.0, 0.0))
    };
    let own = found.material(&found.bodies[0].material).unwrap();
    assert_eq!(own.pattern().unwrap().solid.as_ref(), Some(&stripes));
    assert_eq!(scene(&catoptric_scene::write(&found)), found);
}

#[test]
fn hidden_lights_do_not_light() {
    let text = |hidden| {
        format!(
            "format = \"catoptric/1\"\n[environment]\nambient = [0, 0, 0]\n\
             [[lights]]\nposition = [0, 5, 0]\nhidden = {hidden}\n[[bodies]]\nshape = \"sphere\"\n"
        )
    };
    let warnings = |hidden| read(&text(hidden)).diagnostics.iter().count();
    assert_eq!((warnings(false), warnings(true)), (0, 1));
}
