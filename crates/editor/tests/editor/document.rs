//! Gestures, refusals, saving.

use std::path::Path;
use std::sync::Arc;

use catoptric_editor::{Editor, Item};
use catoptric_scene::{MaterialChoice, Scene, ScenePart, Shape, read};
use glam::DVec3;

use crate::common::{ball, bodies, editor, items, label, named, save, selected, selecting};

fn move_a_bit(editor: &mut Editor, key: &'static str) -> bool {
    editor.change_body(0, label(key), |body| body.placement = body.placement.moved_by(DVec3::X)).unwrap()
}

#[test]
fn a_gesture_is_one_step() {
    let mut editor = editor();
    let start = editor.scene().clone();
    for step in 1..=3 {
        assert!(move_a_bit(&mut editor, "edit-move"));
        assert_eq!(editor.revision(), step);
        assert!(editor.is_in_gesture() && editor.can_undo());
    }
    assert_eq!(editor.steps().len(), 0);
    assert!(editor.settle());
    assert!(!editor.settle() && !editor.is_in_gesture());
    assert_eq!(editor.steps().len(), 1);
    assert_eq!(editor.scene().bodies[0].placement.origin(), DVec3::X * 3.0);
    assert!(editor.undo());
    assert_eq!(editor.scene(), &start);
    assert_eq!(editor.revision(), 4);
    assert!(!editor.undo() && editor.redo() && !editor.redo());
    assert_eq!(editor.revision(), 5);
}

#[test]
fn another_label_settles_and_undo_takes_the_open_gesture() {
    let mut editor = editor();
    let start = editor.scene().clone();
    move_a_bit(&mut editor, "edit-move");
    let moved = editor.scene().clone();
    editor.change_light(1, label("edit-color"), |light| light.intensity = 2.0).unwrap();
    assert_eq!(editor.steps().map(|label| label.key).collect::<Vec<_>>(), ["edit-move"]);
    assert_eq!(editor.undo_label().unwrap().key, "edit-color");
    assert!(editor.undo());
    assert_eq!(editor.scene(), &moved);
    assert!(editor.undo());
    assert_eq!(editor.scene(), &start);
    assert_eq!(editor.redo_label().unwrap().key, "edit-move");
    editor.go_to_step(2);
    assert_eq!(editor.steps_done(), 2);
    editor.go_to_step(0);
    assert_eq!(editor.scene(), &start);
    // A new edit forgets what was undone.
    move_a_bit(&mut editor, "edit-turn");
    assert!(!editor.can_redo());
    editor.settle();
    assert_eq!(editor.steps().map(|label| label.key).collect::<Vec<_>>(), ["edit-turn"]);
}

#[test]
fn a_gesture_that_comes_back_is_no_step_and_escape_restores() {
    let mut editor = selecting(bodies([0]));
    let start = editor.scene().clone();
    move_a_bit(&mut editor, "edit-move");
    editor.change_body(0, label("edit-move"), |body| body.placement = ball("", 0.0).placement).unwrap();
    assert!(!editor.can_undo());
    assert!(!editor.settle());
    assert_eq!(editor.steps().len(), 0);
    move_a_bit(&mut editor, "edit-move");
    editor.select(Item::Camera);
    let revision = editor.revision();
    assert!(editor.abandon());
    assert_eq!(editor.scene(), &start);
    assert_eq!(editor.revision(), revision + 1);
    assert_eq!(selected(&editor), [ScenePart::Body(0)]);
    assert!(!editor.abandon());
    // A change of nothing opens no gesture.
    assert_eq!(editor.change_body(0, label("edit-move"), |_| {}), Ok(false));
    assert_eq!(editor.change_body(99, label("edit-move"), |body| body.name.clear()), Ok(false));
    assert_eq!(editor.change(label("edit-move"), |_| {}), Ok(false));
    assert!(!editor.is_in_gesture());
}

#[test]
fn what_no_file_can_say_is_refused() {
    let mut editor = editor();
    move_a_bit(&mut editor, "edit-move");
    let before = editor.scene().clone();
    let revision = editor.revision();
    let nan = |body: &mut catoptric_scene::Body| body.shape = Shape::Sphere { radius: f64::NAN };
    let refused = editor.change_body(0, label("edit-move"), nan).unwrap_err();
    assert_eq!(refused.to_string(), "body `a`: `radius` is NaN, but must be a finite number");
    let refusals = [
        editor.change_body(1, label("edit-move"), |body| body.name = "a".to_owned()),
        editor.change_body(1, label("edit-move"), |body| {
            body.material = MaterialChoice::Named("no".to_owned());
        }),
        // All or none, though two of three are fine.
        editor.change_bodies(0..3, label("edit-move"), |index, body| {
            body.shape = Shape::Sphere { radius: 1.5 - index as f64 };
        }),
        editor.change_light(0, label("edit-move"), |light| light.intensity = -1.0),
        editor.change_material(0, label("edit-move"), |material| *material.ior_mut().unwrap() = 0.0),
        editor.change_camera(label("edit-move"), |camera| camera.target = camera.position),
        editor.change_environment(label("edit-move"), |environment| environment.ambient.g = f64::INFINITY),
        editor.change_tracing(label("edit-move"), |tracing| tracing.generations = 65),
        editor.change(label("edit-move"), |scene| scene.materials.clear()),
        editor.change(label("edit-move"), |scene| scene.lights[1].name = "left".to_owned()),
    ];
    for (index, refusal) in refusals.iter().enumerate() {
        assert!(refusal.is_err(), "number {index}");
    }
    assert_eq!(editor.scene(), &before);
    assert_eq!((editor.revision(), editor.is_in_gesture()), (revision, true));
    editor.check_invariants().unwrap();
    // A place that is given twice is changed twice, and restored when it must be.
    let grow = |factor: f64| {
        move |_: usize, body: &mut catoptric_scene::Body| {
            if let Shape::Sphere { radius } = &mut body.shape {
                *radius *= factor;
            }
        }
    };
    assert_eq!(editor.change_bodies([2, 2], label("edit-move"), grow(2.0)), Ok(true));
    assert_eq!(editor.scene().bodies[2].shape, Shape::Sphere { radius: 4.0 });
    assert!(editor.change_bodies([2, 2], label("edit-move"), grow(1e5)).is_err());
    assert_eq!(editor.scene().bodies[2].shape, Shape::Sphere { radius: 4.0 });
}

#[test]
fn what_changes_nothing_leaves_the_scene_itself() {
    let grow = |body: &mut catoptric_scene::Body| body.shape = Shape::Sphere { radius: 3.0 };
    let bad = |body: &mut catoptric_scene::Body| body.shape = Shape::Sphere { radius: -1.0 };
    let mut editor = editor();
    for is_open in [false, true] {
        // As an engine does that shows it.
        let shown = Arc::clone(editor.scene());
        assert_eq!(editor.change_body(0, label("edit-size"), |_| {}), Ok(false));
        assert_eq!(editor.change_camera(label("edit-size"), |_| {}), Ok(false));
        assert!(editor.change_body(0, label("edit-size"), bad).is_err());
        assert!(editor.change_tracing(label("edit-size"), |tracing| tracing.generations = 65).is_err());
        assert!(Arc::ptr_eq(&shown, editor.scene()));
        assert_eq!(editor.is_in_gesture(), is_open);
        assert_eq!(editor.change_body(0, label("edit-size"), grow), Ok(!is_open));
        assert_eq!(shown.bodies[0].shape == editor.scene().bodies[0].shape, is_open);
    }
}

#[test]
fn a_scene_with_an_old_problem_can_be_edited() {
    let mut bad = crate::common::scene();
    bad.bodies[3].shape = Shape::Sphere { radius: -1.0 };
    bad.materials.push(named("red", 1.0));
    let mut editor = Editor::new(bad);
    assert!(editor.check_invariants().is_err());
    assert_eq!(editor.change(label("edit-move"), |scene| scene.bodies[0].name = "new".to_owned()), Ok(true));
    assert_eq!(editor.change_body(3, label("edit-rename"), |body| body.name = "x".to_owned()), Ok(true));
    assert_eq!(editor.change(label("edit-delete"), |scene| drop(scene.lights.pop())), Ok(true));
    assert!(
        editor
            .change_body(2, label("edit-size"), |body| body.shape = Shape::Sphere { radius: -1.0 })
            .is_err()
    );
    let two = |scene: &mut Scene| scene.bodies[2].shape = Shape::Sphere { radius: -1.0 };
    assert!(editor.change(label("edit-size"), two).is_err());
    assert_eq!(
        editor.change_body(3, label("edit-move"), |body| body.placement = body.placement.moved_by(DVec3::Y)),
        Ok(true)
    );
    assert_eq!(editor.scene().bodies[3].placement.origin(), DVec3::new(9.0, 1.0, 0.0));
}

#[test]
fn selections_stay_valid_and_in_order() {
    let mut editor = selecting(bodies([3, 1, 1, 77]));
    assert_eq!(editor.selected_bodies().collect::<Vec<_>>(), [3, 1]);
    let mut selection = editor.selection().clone();
    let [light, one, three] =
        [ScenePart::Light(0), ScenePart::Body(1), ScenePart::Body(3)].map(items(&editor));
    selection.toggle(light);
    selection.toggle(three);
    selection.add(one);
    assert_eq!(selection.iter().collect::<Vec<_>>(), [light, one]);
    assert_eq!(selection.primary(), Some(one));
    editor.select_parts(bodies([3, 1]));
    editor.change(label("edit-cut"), |scene| scene.bodies.truncate(2)).unwrap();
    assert_eq!(editor.selected_bodies().collect::<Vec<_>>(), [1]);
    editor.undo();
    assert_eq!(editor.selected_bodies().collect::<Vec<_>>(), [3, 1]);
    editor.redo();
    assert_eq!(editor.selected_bodies().collect::<Vec<_>>(), [1]);
}

const TEXT: &str =
    "# mine\nformat = \"catoptric/1\" # one\n\n[[bodies]]\nname = 'ball' # round\nradius = 2\n";

#[test]
fn saving_keeps_comments_and_tells_what_has_changed() {
    let scene = read(TEXT).into_result().unwrap().value;
    let mut editor = Editor::open("/some/where/mine.toml", TEXT, scene.clone());
    assert_eq!((editor.path(), editor.title()), (Some(Path::new("/some/where/mine.toml")), "mine.toml"));
    assert!(!editor.is_changed());
    assert_eq!(editor.writing().text(), TEXT);
    editor.change_body(0, label("edit-size"), |body| body.shape = Shape::Sphere { radius: 3.0 }).unwrap();
    assert!(editor.is_changed());
    let writing = editor.writing();
    let text = writing.text();
    assert_eq!(text, TEXT.replace("radius = 2", "radius = 3.0"));
    editor.undo();
    assert!(!editor.is_changed());
    editor.redo();
    save(&mut editor, "other.toml", &text);
    assert!(!editor.is_changed());
    assert_eq!((editor.path(), editor.title()), (Some(Path::new("other.toml")), "other.toml"));
    assert_eq!(editor.writing().text(), text);
    editor.undo();
    assert!(editor.is_changed());
    // What was edited while a thread wrote is not saved.
    editor.mark_written(&writing, "other.toml", text.clone());
    assert!(editor.is_changed());
    editor.redo();
    assert!(!editor.is_changed());

    editor.revert(TEXT, scene.clone()).unwrap();
    assert_eq!(editor.scene().as_ref(), &scene);
    assert!(!editor.is_changed());
    assert_eq!(editor.undo_label().unwrap().key, "edit-revert");
    editor.undo();
    assert!(editor.is_changed());
    assert_eq!(editor.writing().text(), text);
}

#[test]
fn what_is_selected_stays_so_by_name_when_the_file_is_read_again() {
    let unnamed = |x| ball("", x);
    let mut start = crate::common::scene();
    start.bodies.extend([unnamed(20.0), unnamed(30.0)]);
    let mut editor = Editor::open("mine.toml", "", start.clone());
    let chosen = [
        ScenePart::Body(5),
        ScenePart::Light(1),
        ScenePart::Body(3),
        ScenePart::Camera,
        ScenePart::Material(2),
        ScenePart::Body(4),
        ScenePart::Body(1),
        ScenePart::Body(0),
    ];
    editor.select_parts(chosen);
    // Body `b` is gone and a `new` one before all; of the two without a name the second one is another now.
    let mut scene = start.clone();
    scene.bodies[1] = scene.bodies[0].clone();
    scene.bodies[0] = ball("new", 50.0);
    scene.bodies[5] = unnamed(31.0);
    scene.lights.swap(0, 1);
    scene.materials.insert(0, named("green", 1.4));
    editor.revert("", scene).unwrap();
    let expected = [
        ScenePart::Body(5),
        ScenePart::Light(0),
        ScenePart::Body(3),
        ScenePart::Camera,
        ScenePart::Material(3),
        ScenePart::Body(4),
        ScenePart::Body(1),
    ];
    assert_eq!(selected(&editor), expected);
    editor.undo();
    assert_eq!(selected(&editor), chosen);
    editor.redo();
    assert_eq!(selected(&editor), expected);
    editor.check_invariants().unwrap();
}

#[test]
fn new_documents_are_written_in_the_standard_form() {
    let mut editor = Editor::new(Scene::default());
    assert_eq!((editor.path(), editor.title(), editor.is_changed()), (None, "", false));
    assert_eq!(editor.writing().text(), catoptric_scene::write(&Scene::default()));
    let example = Editor::untitled("Four bodies", TEXT, read(TEXT).scene);
    assert_eq!(
        (example.path(), example.title(), example.writing().text().as_str()),
        (None, "Four bodies", TEXT)
    );
    let text = editor.writing().text();
    save(&mut editor, "a/b.toml", &text);
    assert_eq!(editor.title(), "b.toml");
}

#[test]
fn snapshots_are_not_touched_by_later_edits() {
    let mut editor = editor();
    let snapshot = editor.scene().clone();
    let copy = Scene::clone(&snapshot);
    move_a_bit(&mut editor, "edit-move");
    editor.change_tracing(label("edit-tracing"), |tracing| tracing.generations = 2).unwrap();
    editor.undo();
    assert_eq!(snapshot.as_ref(), &copy);
}

#[test]
fn a_recovered_document_is_changed_until_it_is_saved() {
    let scene = read(TEXT).scene;
    let mut editor = Editor::unsaved(Some("a/lost.toml".into()), "", TEXT, scene.clone());
    assert_eq!((editor.title(), editor.path()), ("lost.toml", Some(Path::new("a/lost.toml"))));
    assert!(editor.is_changed() && !editor.can_undo());
    assert_eq!(editor.writing().text(), TEXT);
    save(&mut editor, "a/lost.toml", TEXT);
    assert!(!editor.is_changed());
    let untitled = Editor::unsaved(None, "Lens", TEXT, scene);
    assert_eq!((untitled.title(), untitled.path(), untitled.is_changed()), ("Lens", None, true));
    let revision = editor.revision();
    assert!(Editor::open("mine.toml", TEXT, read(TEXT).scene).succeeding(&editor).revision() > revision);
    editor.mark_unsaved();
    assert!(editor.is_changed());
}

/// A camera that looks from elsewhere.
fn seen_from(x: f64) -> catoptric_scene::Camera {
    catoptric_scene::Camera { position: DVec3::new(x, 2.0, 9.0), ..Default::default() }
}

#[test]
fn looking_around_without_a_file_is_no_work() {
    let mut editor = editor();
    editor.navigate(label("edit-orbit"), seen_from(1.0)).unwrap();
    assert!(editor.is_changed() && !editor.has_unsaved_work(), "in the gesture");
    editor.settle();
    editor.navigate(label("edit-pan"), seen_from(2.0)).unwrap();
    editor.settle();
    assert!(editor.is_changed() && !editor.has_unsaved_work());
    assert_eq!(editor.steps_done(), 2);
    // Anything else is work, and taken back it is none again.
    move_a_bit(&mut editor, "edit-move");
    assert!(editor.has_unsaved_work());
    editor.settle();
    editor.navigate(label("edit-orbit"), seen_from(3.0)).unwrap();
    editor.settle();
    assert!(editor.has_unsaved_work(), "navigation after work");
    editor.undo();
    editor.undo();
    assert!(editor.is_changed() && !editor.has_unsaved_work());
    editor.redo();
    assert!(editor.has_unsaved_work());
    editor.undo();
    editor.undo();
    editor.undo();
    assert!(!editor.is_changed() && !editor.has_unsaved_work());
    editor.redo();
    assert!(!editor.has_unsaved_work());
}

#[test]
fn a_camera_that_is_set_on_purpose_is_work() {
    let mut editor = editor();
    editor.navigate(label("edit-orbit"), seen_from(1.0)).unwrap();
    editor.settle();
    editor.change_camera(label("edit-camera-position"), |own| *own = seen_from(2.0)).unwrap();
    assert!(editor.has_unsaved_work());
    editor.settle();
    editor.navigate(label("edit-orbit"), seen_from(3.0)).unwrap();
    editor.settle();
    assert!(editor.has_unsaved_work(), "it still lies under the navigation");
    editor.go_to_step(1);
    assert!(!editor.has_unsaved_work());
    // One label for both is one gesture, and no mere navigation.
    editor.navigate(label("edit-both"), seen_from(4.0)).unwrap();
    editor.change_camera(label("edit-both"), |own| *own = seen_from(5.0)).unwrap();
    editor.navigate(label("edit-both"), seen_from(6.0)).unwrap();
    assert!(editor.has_unsaved_work());
    editor.abandon();
    assert!(!editor.has_unsaved_work());
}

#[test]
fn a_file_has_its_camera_and_a_recovered_document_is_work() {
    let scene = read(TEXT).scene;
    let mut own = Editor::open("mine.toml", TEXT, scene.clone());
    own.navigate(label("edit-orbit"), seen_from(1.0)).unwrap();
    own.settle();
    assert!(own.has_unsaved_work());
    own.undo();
    assert!(!own.has_unsaved_work());
    assert!(Editor::unsaved(None, "Lens", TEXT, scene.clone()).has_unsaved_work());
    // An example that was saved has a file from then on.
    let mut example = Editor::untitled("Lens", TEXT, scene);
    example.navigate(label("edit-orbit"), seen_from(1.0)).unwrap();
    let text = example.writing().text();
    save(&mut example, "lens.toml", &text);
    assert!(!example.has_unsaved_work());
    example.navigate(label("edit-orbit"), seen_from(2.0)).unwrap();
    assert!(example.has_unsaved_work());
}
