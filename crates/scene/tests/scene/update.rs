//! What an edited scene leaves of the user's text.

use catoptric_scene::{
    Anchor, Body, Color, Light, MaterialChoice, NamedMaterial, Scene, Shape, read, update,
};
use glam::DVec3;

const TEXT: &str = "\
# A scene
format = \"catoptric/1\"

[camera] # the eye
position = [0, 1, 5]   # meters
fov = 30

# -- materials --
[materials.red] # warm
color = \"#ff0000\"      # sRGB
ambient = 0.2          # a little

[materials.blue]
color = [0, 0, 1]

# the key light
[[lights]]
name = \"key\"
position = [ -4, 4, 4 ]

# the ball
[[bodies]]
name = \"ball\" # round
radius = 1 # one
rotation = [0, 0, 0] # not turned
material = { color = \"#00ff00\", diffuse = 0.5 } # own

# a box
[[bodies]]
shape = \"cube\"
size = 2
material = \"red\"

# the third
[[bodies]]
name = \"rod\"
shape = \"cylinder\"
position = [1, 0, 0] # right
material = \"blue\"
# end
";

/// The lines that an edit removes and adds.
fn changes(edit: impl FnOnce(&mut Scene)) -> (Vec<&'static str>, Vec<String>) {
    let mut scene = read(TEXT).into_result().unwrap().value;
    edit(&mut scene);
    assert_eq!(scene.check(), []);
    let updated = update(TEXT, &scene);
    assert_eq!(read(&updated).into_result().unwrap().value, scene, "{updated}");
    assert_eq!(update(&updated, &scene), updated);
    let removed = TEXT.lines().filter(|line| !updated.lines().any(|other| other == *line)).collect();
    let added =
        updated.lines().filter(|line| !TEXT.lines().any(|other| other == *line)).map(str::to_owned).collect();
    (removed, added)
}

#[track_caller]
fn assert_changes(edit: impl FnOnce(&mut Scene), removed: &[&str], added: &[&str]) {
    let (found_removed, found_added) = changes(edit);
    assert_eq!(found_removed, removed);
    assert_eq!(found_added, added);
}

#[test]
fn nothing_changes_without_an_edit() {
    assert_changes(|_| {}, &[], &[]);
}

#[test]
fn a_value_keeps_what_stands_around_it() {
    assert_changes(
        |scene| scene.bodies[0].shape = Shape::Sphere { radius: 1.5 },
        &["radius = 1 # one"],
        &["radius = 1.5 # one"],
    );
    assert_changes(
        |scene| scene.camera.position.x = 0.25,
        &["position = [0, 1, 5]   # meters"],
        &["position = [0.25, 1.0, 5.0]   # meters"],
    );
    assert_changes(
        |scene| *scene.materials[0].material.ambient_mut().unwrap() = 0.3,
        &["ambient = 0.2          # a little"],
        &["ambient = 0.3          # a little"],
    );
}

#[test]
fn keys_come_and_go() {
    assert_changes(|scene| scene.camera.up = DVec3::X, &[], &["up = [1.0, 0.0, 0.0]"]);
    assert_changes(
        |scene| *scene.materials[0].material.ambient_mut().unwrap() = 0.1,
        &["ambient = 0.2          # a little"],
        &[],
    );
    assert_changes(
        |scene| {
            let MaterialChoice::Inline(material) = &mut scene.bodies[0].material else { panic!() };
            material.as_phong_mut().unwrap().specular = 0.5;
        },
        &["material = { color = \"#00ff00\", diffuse = 0.5 } # own"],
        &["material = { color = \"#00ff00\", diffuse = 0.5, specular = 0.5 } # own"],
    );
    assert_changes(
        |scene| scene.bodies[0].material = MaterialChoice::Named("red".to_owned()),
        &["material = { color = \"#00ff00\", diffuse = 0.5 } # own"],
        &["material = \"red\" # own"],
    );
    assert_changes(|scene| scene.tracing.generations = 9, &[], &["[tracing]", "generations = 9"]);
}

#[test]
fn another_shape_has_other_keys() {
    assert_changes(
        |scene| scene.bodies[0].shape = Shape::CONE,
        &["radius = 1 # one"],
        &["radius = 0.5 # one", "shape = \"cone\""],
    );
    assert_changes(
        |scene| {
            let (base, top) = (DVec3::ZERO, DVec3::Y * 2.0);
            scene.bodies[2].placement.anchor = Anchor::Axis { base, top };
            scene.bodies[2].shape = Shape::Cylinder { radius: 0.5, height: 2.0 };
        },
        &["position = [1, 0, 0] # right"],
        &["base = [0.0, 0.0, 0.0]", "top = [0.0, 2.0, 0.0]"],
    );
}

#[test]
fn elements_come_and_go_with_their_comments() {
    let (removed, added) = changes(|scene| drop(scene.bodies.remove(1)));
    assert_eq!(removed, ["# a box", "shape = \"cube\"", "size = 2", "material = \"red\""]);
    assert_eq!(added, [""; 0]);
    let (removed, added) =
        changes(|scene| scene.bodies.insert(1, Body { name: "new".to_owned(), ..Body::default() }));
    assert_eq!(removed, [""; 0]);
    assert_eq!(added, ["name = \"new\"", "shape = \"sphere\"", "radius = 1.0", "position = [0.0, 0.0, 0.0]"]);
    let (removed, added) = changes(|scene| scene.lights.clear());
    assert_eq!(removed, ["# the key light", "[[lights]]", "name = \"key\"", "position = [ -4, 4, 4 ]"]);
    assert_eq!(added, [""; 0]);
    let (removed, added) = changes(|scene| scene.lights.push(Light { intensity: 0.5, ..Light::default() }));
    assert_eq!(removed, [""; 0]);
    assert_eq!(added, ["position = [-5.0, 8.0, 6.0]", "intensity = 0.5"]);
}

#[test]
fn order_and_names_may_change() {
    let (removed, added) = changes(|scene| scene.bodies.change(|bodies| bodies.reverse()));
    assert_eq!((removed.len(), added.len()), (0, 0));
    let (removed, added) = changes(|scene| scene.materials.reverse());
    assert_eq!((removed.len(), added.len()), (0, 0));
    assert_changes(
        |scene| scene.bodies[0].name = "globe".to_owned(),
        &["name = \"ball\" # round"],
        &["name = \"globe\" # round"],
    );
    assert_changes(
        |scene| {
            scene.materials[0].name = "dark red".to_owned();
            scene.bodies[1].material = MaterialChoice::Named("dark red".to_owned());
        },
        &["[materials.red] # warm", "material = \"red\""],
        &["[materials.\"dark red\"] # warm", "material = \"dark red\""],
    );
    assert_changes(
        |scene| {
            let mut material = scene.materials[0].material.clone();
            material.pattern_mut().unwrap().color = Color::BLACK;
            scene.materials.push(NamedMaterial { name: "black".to_owned(), material });
        },
        &[],
        &["[materials.black]", "color = [0.0, 0.0, 0.0]", "ambient = 0.2"],
    );
}

#[test]
fn other_notations_survive() {
    let text = "format = 'catoptric/1'\r\ncamera.fov = 20 # dotted\r\nlights = [{ intensity = 2 }, # first\r\n  { name = 'b' }]\r\n\r\n[materials]\r\nm = { ior = 1.2 } # inline\r\n";
    let mut scene = read(text).into_result().unwrap().value;
    scene.camera.up = DVec3::Z;
    scene.lights[0].intensity = 3.0;
    *scene.materials[0].material.ior_mut().unwrap() = 1.3;
    let expected = text.replace("intensity = 2", "intensity = 3.0").replace("1.2", "1.3");
    let expected = expected.replace("# dotted\r\n", "# dotted\r\ncamera.up = [0.0, 0.0, 1.0]\r\n");
    assert_eq!(update(text, &scene), expected);
}

/// A lens with a comment at every line, by headers; a pipe by a value.
const PARTS: &str = "\
format = \"catoptric/1\"

# the lens
[[bodies]] # whole
name = \"lens\" # its name
shape = \"intersection\" # both
# the front
[[bodies.parts]] # one
name = \"front\"
radius = 2 # meters
position = [0, 0, -1] # before
# the back
[[bodies.parts]] # two
shape = \"union\"
[[bodies.parts.parts]] # inner
radius = 3 # also

# the pipe
[[bodies]]
shape = \"difference\"
parts = [
    { shape = \"cube\", size = 2 }, # outside
    { radius = 0.5 }, # inside
]
# end
";

/// The text after an edit, which reads back as the edited scene.
fn edited(edit: impl FnOnce(&mut Scene)) -> String {
    let mut scene = read(PARTS).into_result().unwrap().value;
    edit(&mut scene);
    assert_eq!(scene.check(), []);
    let updated = update(PARTS, &scene);
    assert_eq!(read(&updated).into_result().unwrap().value, scene, "{updated}");
    assert_eq!(update(&updated, &scene), updated);
    updated
}

#[test]
fn an_edited_part_leaves_all_others_alone() {
    let replaced = |from: &str, to: &str| {
        assert!(PARTS.contains(from), "{from}");
        PARTS.replace(from, to)
    };
    let text = edited(|scene| scene.bodies[0].parts[0].shape = Shape::Sphere { radius: 2.5 });
    assert_eq!(text, replaced("radius = 2 # meters", "radius = 2.5 # meters"));
    let text = edited(|scene| scene.bodies[0].parts[1].parts[0].shape = Shape::Sphere { radius: 1.0 });
    assert_eq!(text, replaced("radius = 3 # also", "radius = 1.0 # also"));
    let text = edited(|scene| scene.bodies[1].parts[1].shape = Shape::Sphere { radius: 0.25 });
    assert_eq!(text, replaced("{ radius = 0.5 }, # inside", "{ radius = 0.25 }, # inside"));
    let text = edited(|scene| scene.bodies[1].parts[0].name = "case".to_owned());
    assert!(
        text.contains("# outside") && text.contains("name = \"case\"") && text.contains("# inside"),
        "{text}"
    );
}

#[test]
fn parts_come_go_and_change_places_with_their_comments() {
    let text = edited(|scene| scene.bodies[0].parts.swap(0, 1));
    let places = ["# two", "# inner", "# also", "# one", "# before", "# the pipe"];
    let found: Vec<usize> = places.iter().map(|comment| text.find(comment).unwrap()).collect();
    assert!(found.is_sorted(), "{text}");
    let text = edited(|scene| {
        let part = scene.bodies[0].parts[0].clone();
        scene.bodies[0].parts.push(catoptric_scene::BodyPart { name: "third".to_owned(), ..part });
    });
    assert!(text.find("# inner").unwrap() < text.find("\"third\"").unwrap(), "{text}");
    assert!(text.find("\"third\"").unwrap() < text.find("# the pipe").unwrap(), "{text}");
    let text = edited(|scene| drop(scene.bodies[0].parts.remove(0)));
    assert!(!text.contains("# before") && text.contains("# inner") && text.contains("# inside"), "{text}");
    let text = edited(|scene| scene.bodies.swap(0, 1));
    let places = ["# outside", "# whole", "# one", "# inner"];
    let found: Vec<usize> = places.iter().map(|comment| text.find(comment).unwrap()).collect();
    assert!(found.is_sorted(), "{text}");
    let text = edited(|scene| {
        scene.bodies[1].shape = Shape::CUBE;
        scene.bodies[1].parts.clear();
    });
    assert!(!text.contains("# inside") && text.contains("# end"), "{text}");
    let text = edited(|scene| {
        let whole = &mut scene.bodies[0].parts[0];
        whole.shape = Shape::Group;
        whole.parts = vec![catoptric_scene::BodyPart::default()];
    });
    assert!(text.contains("[[bodies.parts.parts]]\nshape = \"sphere\"\nradius = 1.0\n"), "{text}");
}
