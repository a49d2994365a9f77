//! Instances of bodies: they follow them through every kind of change, and back.

use catoptric_editor::{Action, Editor};
use catoptric_scene::{Body, MaterialChoice, Scene, ScenePart, Shape, ShapeKind, read, write};
use glam::DVec3;

use crate::common::{act, bodies, label, names, selected, selecting};

/// The first body with an instance of it, which is selected.
fn with_instance() -> Editor {
    let mut editor = selecting(bodies([0]));
    act(&mut editor, &Action::DuplicateAsInstance);
    editor
}

fn of(body: &Body) -> Option<&str> {
    body.instance.as_ref().map(|instance| instance.of.as_str())
}

/// Undoes and redoes everything, and reads the scene as its file.
fn assert_sound(editor: &mut Editor, before: &Scene) {
    let after = editor.scene().clone();
    assert_eq!(after.check(), []);
    assert_eq!(read(&write(&after)).into_result().unwrap().value, *after);
    let mut steps = 0;
    while **editor.scene() != *before {
        editor.apply(Action::Undo).unwrap();
        steps += 1;
    }
    (0..steps).for_each(|_| editor.apply(Action::Redo).unwrap());
    assert_eq!(*editor.scene(), after);
}

#[test]
fn an_instance_stands_beside_its_body_and_follows_it() {
    let mut editor = selecting(bodies([0]));
    let before = Scene::clone(editor.scene());
    act(&mut editor, &Action::DuplicateAsInstance);
    assert_eq!(selected(&editor), [ScenePart::Body(4)]);
    assert_eq!(of(&editor.scene().bodies[4]), Some("a"));
    assert_ne!(editor.scene().bodies[4].placement, editor.scene().bodies[0].placement);
    let shape = Shape::Sphere { radius: 0.125 };
    editor.change_body(0, label("edit-a"), |body| body.shape = shape).unwrap();
    assert_eq!(editor.scene().bodies[4].shape, shape);
    let red = MaterialChoice::default();
    editor.change_body(0, label("edit-b"), |body| body.material = red.clone()).unwrap();
    assert_eq!(editor.scene().bodies[4].material, red);
    // Its own material stays when that of the body changes.
    let own = MaterialChoice::Named("blue".to_owned());
    editor.change_body(4, label("edit-c"), |body| body.material = own.clone()).unwrap();
    assert_eq!(editor.scene().bodies[0].material, red);
    editor
        .change_body(0, label("edit-d"), |body| body.material = MaterialChoice::Named("blue".to_owned()))
        .unwrap();
    editor.change_body(0, label("edit-e"), |body| body.material = red.clone()).unwrap();
    assert_eq!(editor.scene().bodies[4].material, own);
    assert_sound(&mut editor, &before);
}

#[test]
fn a_refused_change_leaves_instances_as_they_were() {
    let mut editor = with_instance();
    let before = editor.scene().clone();
    let broken = |body: &mut Body| body.shape = Shape::Sphere { radius: -1.0 };
    editor.change_body(0, label("edit-a"), broken).unwrap_err();
    assert_eq!(*editor.scene(), before);
}

#[test]
fn instances_outlive_names_and_bodies() {
    let mut editor = with_instance();
    let before = Scene::clone(editor.scene());
    let body = editor.edited().item(ScenePart::Body(0)).unwrap();
    act(&mut editor, &Action::Rename { item: body, name: "ball".to_owned() });
    assert_eq!(of(&editor.scene().bodies[4]), Some("ball"));
    // An instance of an instance is one of the same body.
    act(&mut editor, &Action::DuplicateAsInstance);
    assert_eq!(of(&editor.scene().bodies[5]), Some("ball"));
    let shape = editor.scene().bodies[0].shape;
    editor.select_parts([ScenePart::Body(0)]);
    act(&mut editor, &Action::Delete);
    assert_eq!(editor.scene().bodies.len(), 5);
    assert_eq!((of(&editor.scene().bodies[3]), editor.scene().bodies[3].shape), (None, shape));
    assert_sound(&mut editor, &before);
}

#[test]
fn a_body_that_loses_its_name_loses_its_instances() {
    let mut editor = with_instance();
    let before = Scene::clone(editor.scene());
    for place in [1, 0] {
        let body = editor.edited().item(ScenePart::Body(place)).unwrap();
        act(&mut editor, &Action::Rename { item: body, name: String::new() });
    }
    let [body, instance] = [0, 4].map(|place| editor.scene().bodies[place].clone());
    assert_eq!((of(&instance), instance.shape, &instance.material), (None, body.shape, &body.material));
    assert_sound(&mut editor, &before);
}

#[test]
fn an_instance_is_made_its_own() {
    let mut editor = with_instance();
    let before = Scene::clone(editor.scene());
    act(&mut editor, &Action::MakeOwn);
    editor.change_body(0, label("edit-a"), |body| body.shape = Shape::CUBE).unwrap();
    assert_ne!(editor.scene().bodies[4].shape, Shape::CUBE);
    assert!(!editor.can(&Action::MakeOwn));
    assert_sound(&mut editor, &before);
}

#[test]
fn copies_and_wholes_keep_what_their_instances_look_like() {
    let mut editor = with_instance();
    let before = Scene::clone(editor.scene());
    // Alone it is copied as a body of its own, with its body as an instance of the copy.
    let text = editor.copy().unwrap();
    assert!(!text.contains("instance_of"), "{text}");
    editor.select_parts([ScenePart::Body(0), ScenePart::Body(4)]);
    let text = editor.copy().unwrap();
    act(&mut editor, &Action::Paste(text));
    let copies = [5, 6].map(|at| editor.scene().bodies[at].clone());
    assert_eq!(of(&copies[1]), Some(copies[0].name.as_str()));
    // Joined, the body is gone: its instances stay.
    editor.select_parts([ScenePart::Body(0), ScenePart::Body(1)]);
    act(&mut editor, &Action::Join { shape: ShapeKind::Union, name: "a".to_owned() });
    let free: Vec<&str> = editor.scene().bodies.iter().filter_map(of).collect();
    assert_eq!(free, [copies[0].name.as_str()], "{:?}", names(&editor));
    assert_sound(&mut editor, &before);
}

#[test]
fn an_instance_of_parts_comes_apart() {
    let mut editor = selecting(bodies([0, 1]));
    act(&mut editor, &Action::Join { shape: ShapeKind::Group, name: "pair".to_owned() });
    act(&mut editor, &Action::DuplicateAsInstance);
    let last = editor.scene().bodies.len() - 1;
    editor
        .change_body(last, label("edit-a"), |body| body.placement = body.placement.moved_by(DVec3::Z))
        .unwrap();
    let before = Scene::clone(editor.scene());
    act(&mut editor, &Action::TakeApart);
    assert_eq!(editor.scene().bodies.len(), last + 2);
    assert!(!editor.scene().has_instances());
    assert_sound(&mut editor, &before);
}
