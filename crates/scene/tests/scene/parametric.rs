//! Lenses, tubes and others in files and at addresses: they stay what they are.

use catoptric_scene::{
    BodyShape, Lens, LensCurvature, ParametricShape, Scene, SceneEdit, Shape, read, update, write,
};

const BENCH: &str = r#"format = "catoptric/1"

# The bench.
[[bodies]]
name = "lens"
shape = "lens" # thin
radius = 0.2
thickness = 0.1
focal_length = 1.0

[[bodies]]
name = "optics"
shape = "group"
[[bodies.parts]]
name = "stop"
shape = "ring"
[[bodies.parts]]
name = "mirror"
shape = "mirror-dish"
profile = "spherical"
curvature_radius = 4.0
[[bodies.parts]]
name = "prism"
shape = "prism"
sides = 6
"#;

fn bench() -> Scene {
    read(BENCH).into_result().unwrap().value
}

fn set(scene: &mut Scene, path: &str, value: f64) {
    scene.set(&path.parse().unwrap(), value).unwrap();
}

fn edit(scene: &mut Scene, edits: &[&str]) {
    let edits: Vec<SceneEdit> = edits.iter().map(|edit| edit.parse().unwrap()).collect();
    scene.edit(&edits).unwrap();
}

#[test]
fn a_lens_is_read_changed_and_written_as_a_lens() {
    let mut scene = bench();
    let curvature = LensCurvature::FocalLength { focal_length: 1.0, ior: 1.5, front: None };
    let lens = ParametricShape::Lens(Lens { radius: 0.2, thickness: 0.1, curvature });
    assert_eq!(scene.bodies[0].body_shape(), BodyShape::Parametric(lens));
    assert_eq!(scene.bodies[0].shape, Shape::Intersection);
    assert_eq!(update(BENCH, &scene), BENCH);
    let before = scene.bodies[0].parts.clone();
    set(&mut scene, "bodies.lens.focal_length", 2.0);
    assert_ne!(scene.bodies[0].parts, before);
    let changed = update(BENCH, &scene);
    assert_eq!(changed, BENCH.replace("focal_length = 1.0", "focal_length = 2.0"));
    assert_eq!(read(&changed).into_result().unwrap().value, scene);
    // The radius of the back stands in the place of the focal length.
    let back = "bodies.lens.back_radius".parse().unwrap();
    let error = scene.set(&back, 0.0).unwrap_err().to_string();
    assert!(error.contains("`back_radius` cannot stand beside `focal_length`"), "{error}");
    edit(&mut scene, &["bodies.lens.focal_length=", "bodies.lens.back_radius=0"]);
    assert!(scene.get(&"bodies.lens.focal_length".parse().unwrap()).is_err());
    assert_eq!(scene.get(&"bodies.lens.front_radius".parse().unwrap()), Ok(1.0.into()));
    let error = scene.set(&"bodies.lens.radius".parse().unwrap(), 1.5).unwrap_err().to_string();
    assert!(error.contains("a face with a radius of curvature of 1 meters is too small"), "{error}");
}

#[test]
fn parts_are_what_they_are_too() {
    let mut scene = bench();
    let text = write(&scene);
    assert_eq!(read(&text).into_result().unwrap().value, scene);
    for line in ["shape = \"ring\"", "shape = \"mirror-dish\"", "curvature_radius = 4.0", "sides = 6"] {
        assert!(text.contains(line), "{line} in {text}");
    }
    assert!(!text.contains("[[bodies.parts.parts]]"), "{text}");
    set(&mut scene, "bodies.optics.parts.prism.sides", 4.0);
    assert_eq!(scene.bodies[1].parts[2].parts.len(), 1);
    let mirror = "bodies.optics.parts.mirror";
    edit(&mut scene, &[&format!("{mirror}.curvature_radius="), &format!("{mirror}.focal_length=1")]);
    assert!(write(&scene).contains("profile = \"spherical\"\nfocal_length = 1.0"));
    let inside = "bodies.optics.parts.stop.parts.0.radius".parse().unwrap();
    let error = scene.set(&inside, 1.0).unwrap_err().to_string();
    assert!(error.contains("`parts` is only for `shape`"), "{error}");
    // What another part of the program has changed is a body of parts.
    scene.bodies[0].parts[0].shape.set_number("radius", 0.1);
    assert!(write(&scene).contains("shape = \"intersection\""));
    assert_eq!(read(&write(&scene)).into_result().unwrap().value.bodies[0].parts, scene.bodies[0].parts);
}
