//! Instances in files and at addresses: they follow what they are instances of.

use catoptric_scene::{Language, MaterialChoice, Scene, SceneEdit, Shape, read, update, write};

const CELLS: &str = r#"format = "catoptric/1"

[materials.red]
color = [1, 0, 0]

# A corner of three mirrors.
[[bodies]]
name = "corner"
shape = "difference"
material = "red"
hidden = true
[[bodies.parts]]
shape = "cube"
[[bodies.parts]]
shape = "cube"
position = [0.5, 0.5, 0.5]
material.color = [0, 1, 0]

[[bodies]]
instance_of = "corner" # stands apart
position = [2, 0, 0]

[[bodies]]
name = "row"
shape = "group"
[[bodies.parts]]
instance_of = "corner"
[[bodies.parts]]
name = "other"
instance_of = "post"
position = [1, 0, 0]
material.color = [0, 0, 1]

[[bodies]]
name = "post"
shape = "cylinder"
base = [0, 0, 0]
top = [0, 3, 0]
"#;

fn scene(text: &str) -> Scene {
    read(text).into_result().unwrap().value
}

fn edit(scene: &mut Scene, edits: &[&str]) -> Result<(), String> {
    let edits: Vec<SceneEdit> = edits.iter().map(|edit| edit.parse().unwrap()).collect();
    scene.edit(&edits).map_err(|error| error.to_string())
}

/// The errors of a file in one language.
fn errors(text: &str, language: Language) -> Vec<String> {
    read(text).diagnostics.iter().map(|found| found.message(language)).collect()
}

#[test]
fn instances_have_what_the_other_body_has() {
    let scene = scene(CELLS);
    let [corner, apart, row, post] = [0, 1, 2, 3].map(|index| &scene.bodies[index]);
    assert_eq!((apart.shape, apart.form().parts), (Shape::Difference, corner.parts.as_slice()));
    assert_eq!(apart.material, MaterialChoice::Named("red".to_owned()));
    assert!(apart.parts.is_empty() && !apart.hidden);
    let [first, other] = row.parts.as_slice() else { panic!() };
    assert_eq!(
        (first.form().parts, first.material.as_ref()),
        (corner.parts.as_slice(), Some(&corner.material))
    );
    // With the height that the points give.
    assert_eq!(other.shape, Shape::Cylinder { radius: 0.5, height: 3.0 });
    assert_ne!(other.material.as_ref(), Some(&post.material));
    let mut simple = 0;
    row.form().each_simple(glam::DAffine3::IDENTITY, &mut |_| simple += 1);
    assert_eq!(simple, 3);
    assert_eq!(row.form().extent().map(|[min, max]| (min.y, max.y)), Some((-0.5, 3.0)));
}

#[test]
fn files_keep_instances() {
    let mut scene = scene(CELLS);
    assert_eq!(update(CELLS, &scene), CELLS);
    let text = write(&scene);
    assert_eq!(text.matches("instance_of").count(), 3);
    assert_eq!(text.matches("[[bodies.parts]]").count(), 4);
    assert_eq!(read(&text).into_result().unwrap().value, scene);
    edit(&mut scene, &["bodies.1.position.x = 3"]).unwrap();
    assert_eq!(update(CELLS, &scene), CELLS.replace("[2, 0, 0]", "[3.0, 0.0, 0.0]"));
}

#[test]
fn a_change_of_the_other_body_reaches_its_instances() {
    let mut scene = scene(CELLS);
    edit(&mut scene, &["bodies.corner.parts.0.size = 2", "bodies.post.radius = 0.25"]).unwrap();
    assert_eq!(scene.bodies[1].form().parts, scene.bodies[0].parts);
    assert_eq!(scene.bodies[2].parts[1].shape, Shape::Cylinder { radius: 0.25, height: 3.0 });
    // A name takes its instances along.
    edit(&mut scene, &["bodies.corner.name = trihedral"]).unwrap();
    assert_eq!(scene.bodies[1].instance.as_ref().map(|instance| instance.of.as_str()), Some("trihedral"));
    assert_eq!(scene.check(), []);
    assert_eq!(read(&write(&scene)).into_result().unwrap().value, scene);
    // Materials: of its own, and back.
    edit(&mut scene, &["bodies.1.material = red", "bodies.trihedral.material.color = [0, 0, 0]"])
        .unwrap_err();
    edit(&mut scene, &["bodies.1.material.color = [0, 0, 0]"]).unwrap_err();
    edit(&mut scene, &["bodies.1.instance_of = post"]).unwrap();
    assert_eq!(scene.bodies[1].shape, Shape::Cylinder { radius: 0.25, height: 3.0 });
    assert_eq!(scene.bodies[1].material, MaterialChoice::default());
}

#[test]
fn what_is_made_its_own_looks_the_same() {
    let mut scene = scene(CELLS);
    let before = scene.bodies[1].form().parts.to_vec();
    scene.bodies.retain(|body| body.name != "corner");
    scene.free_lost_instances();
    assert_eq!(scene.bodies[0].parts, before);
    assert!(scene.bodies[1].parts[0].instance.is_none() && scene.bodies[1].parts[1].instance.is_some());
    assert_eq!(scene.check(), []);
    assert_eq!(read(&write(&scene)).into_result().unwrap().value, scene);
}

#[test]
fn a_million_bodies_are_a_short_file() {
    let mut text = "format = 'catoptric/1'\n[[bodies]]\nname = 'l0'\nhidden = true\n".to_owned();
    for level in 1..=6 {
        text.push_str(&format!("[[bodies]]\nname = 'l{level}'\nshape = 'group'\nhidden = true\n"));
        for part in 0..10 {
            let below = level - 1;
            text.push_str(&format!(
                "[[bodies.parts]]\ninstance_of = 'l{below}'\nposition = [{part}, 0, 0]\n"
            ));
        }
    }
    text.push_str("[[bodies]]\ninstance_of = 'l6'\n");
    let scene = scene(&text);
    let mut simple = 0;
    scene.bodies[7].form().each_simple(glam::DAffine3::IDENTITY, &mut |_| simple += 1);
    assert_eq!(simple, 1_000_000);
    assert_eq!(scene.check(), []);
}

#[test]
fn impossible_instances_are_refused_with_words() {
    let body = |keys: &str| format!("format = 'catoptric/1'\n{keys}");
    for (keys, english) in [
        ("[[bodies]]\nname = 'ball'\n[[bodies]]\ninstance_of = 'bal'", "the body `bal` is not defined"),
        ("[[bodies]]\ninstance_of = ''", "the body `` is not defined"),
        (
            "[[bodies]]\nname = 'a'\ninstance_of = 'a'",
            "with this instance of `a` the body would be made of itself",
        ),
        (
            "[[bodies]]\nname = 'a'\nshape = 'group'\n[[bodies.parts]]\n[[bodies.parts]]\ninstance_of = 'b'\n\
             [[bodies]]\nname = 'b'\ninstance_of = 'a'\n[[bodies]]\ninstance_of = 'a'",
            "with this instance of `b` the body would be made of itself",
        ),
        (
            "[[bodies]]\nname = 'a'\n[[bodies]]\ninstance_of = 'a'\nradius = 2",
            "`radius` cannot stand beside `instance_of`",
        ),
        (
            "[[bodies]]\nname = 'a'\n[[bodies]]\nshape = 'cube'\ninstance_of = 'a'",
            "`shape` cannot stand beside `instance_of`",
        ),
    ] {
        let found = errors(&body(keys), Language::English);
        assert_eq!(found.first().map(String::as_str), Some(english), "{keys}");
        assert_eq!(found.len(), errors(&body(keys), Language::Russian).len());
    }
    // Joined bodies have as many parts with instances as without.
    let ten = "[[bodies.parts]]\n".repeat(10);
    let eight = "[[bodies.parts]]\ninstance_of = 'ten'\n".repeat(8);
    let many =
        body(&format!("[[bodies]]\nname='ten'\nshape='union'\n{ten}[[bodies]]\nshape='union'\n{eight}"));
    assert_eq!(errors(&many, Language::English), ["this union has 80 simple parts, but can have at most 64"]);
    // Ten to the power of ten bodies; too deep.
    let mut deep = body("[[bodies]]\nname = 'l0'\n");
    for level in 1..=10 {
        let part = format!("[[bodies.parts]]\ninstance_of = 'l{}'\n", level - 1);
        deep.push_str(&format!("[[bodies]]\nname = 'l{level}'\nshape = 'group'\n{}", part.repeat(10)));
    }
    let found = errors(&deep, Language::English);
    assert_eq!(
        found.first().map(String::as_str),
        Some("with its instances the scene has 111111110 simple bodies, but can have at most 16777216")
    );
    let mut deep = body("[[bodies]]\nname = 'l0'\n");
    for level in 1..=10 {
        let below = level - 1;
        deep.push_str(&format!(
            "[[bodies]]\nname = 'l{level}'\nshape = 'group'\n[[bodies.parts]]\ninstance_of = 'l{below}'\n"
        ));
    }
    assert_eq!(errors(&deep, Language::English), ["parts are nested too deep"]);
}
