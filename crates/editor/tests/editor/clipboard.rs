//! Copies as text, and what pasting makes of them.

use catoptric_editor::{Action, ActionError, Editor, Selection};
use catoptric_scene::{Example, MaterialChoice, Scene, ScenePart, read};
use glam::DVec3;

use crate::common::{act, bodies, editor, gray, items, label, names, refuse, selected, selecting};

#[test]
fn a_copy_is_a_scene_file() {
    let editor = selecting([
        ScenePart::Body(2),
        ScenePart::Light(1),
        ScenePart::Body(0),
        ScenePart::Material(2),
        ScenePart::Camera,
    ]);
    let text = editor.copy().unwrap();
    assert!(text.starts_with("format = \"catoptric/1\"\n"));
    assert!(!text.contains("camera") && !text.contains("tracing"), "{text}");
    let copied = read(&text).into_result().unwrap().value;
    let scene = editor.scene();
    assert_eq!(copied.materials, scene.materials);
    assert_eq!(copied.lights, scene.lights[1..]);
    assert_eq!(copied.bodies, [scene.bodies[0].clone(), scene.bodies[2].clone()]);
    assert_eq!(selecting([ScenePart::Camera, ScenePart::Tracing]).copy(), None);
    assert_eq!(selecting(bodies([3])).copy().unwrap().matches("[materials").count(), 0);
}

#[test]
fn pasted_things_are_named_moved_and_selected() {
    let mut editor = selecting([ScenePart::Body(1), ScenePart::Light(0)]);
    let item = items(&editor);
    editor.apply(Action::SetLocked { item: item(ScenePart::Body(1)), locked: true }).unwrap();
    let text = editor.copy().unwrap();
    act(&mut editor, &Action::Paste(text.clone()));
    act(&mut editor, &Action::Paste(text.clone()));
    let scene = editor.scene();
    assert_eq!(names(&editor)[4..], ["b 2", "b 3"]);
    assert_eq!(scene.lights[3].name, "left 3");
    assert_eq!(scene.materials.len(), 3);
    assert_eq!(scene.bodies[5].material, MaterialChoice::Named("red".to_owned()));
    assert!(!scene.bodies[5].locked);
    assert_eq!(selected(&editor), [ScenePart::Light(3), ScenePart::Body(5)]);
    assert_eq!(scene.bodies[4].placement.origin(), DVec3::new(3.5, 0.0, 0.5));
    assert_eq!(scene.bodies[5].placement.origin(), DVec3::new(4.0, 0.0, 1.0));
    // Where nothing stands they keep their place and name.
    let mut empty = Editor::new(Scene::default());
    act(&mut empty, &Action::Paste(text));
    assert_eq!((names(&empty), empty.scene().bodies[0].placement.origin()), (vec!["b"], DVec3::X * 3.0));
    assert_eq!(empty.scene().materials.len(), 1);
}

#[test]
fn materials_of_one_name_and_another_value_are_renamed() {
    let mut editor = selecting(bodies([0, 2]));
    let text = editor.copy().unwrap();
    editor.change_material(0, label("x"), |material| *material.ior_mut().unwrap() = 3.0).unwrap();
    act(&mut editor, &Action::Paste(text.clone()));
    let scene = editor.scene();
    assert_eq!(scene.materials.len(), 4);
    assert_eq!((scene.materials[3].name.as_str(), scene.materials[3].material.ior()), ("red 2", Some(1.1)));
    assert_eq!(scene.bodies[4].material, MaterialChoice::Named("red 2".to_owned()));
    assert_eq!(scene.bodies[5].material, MaterialChoice::Named("blue".to_owned()));
    act(&mut editor, &Action::Paste(text));
    assert_eq!(editor.scene().materials.len(), 4, "the same is shared");
    assert_eq!(editor.scene().bodies[6].material, MaterialChoice::Named("red 2".to_owned()));
}

#[test]
fn whole_files_can_be_pasted() {
    for example in Example::ALL {
        let mut editor = editor();
        let theirs = example.load().unwrap().scene;
        act(&mut editor, &Action::Paste(example.text.to_owned()));
        assert_eq!(editor.scene().bodies.len(), 4 + theirs.bodies.len());
        assert_eq!(editor.scene().lights.len(), 2 + theirs.lights.len());
        assert_eq!(editor.scene().camera, Scene::default().camera);
        // Undone, the clipboard of all that was pasted says the same bodies.
        let copied = read(&editor.copy().unwrap()).into_result().unwrap().value;
        assert_eq!(copied.bodies.len(), theirs.bodies.len());
    }
}

#[test]
fn bad_texts_are_refused() {
    let mut editor = editor();
    let error =
        refuse(&mut editor, &Action::Paste("format = \"catoptric/1\"\n[[bodies]]\nradius = -1\n".to_owned()));
    let ActionError::BadText(found) = error else { panic!("{error}") };
    assert_eq!(found.iter().count(), 1);
    for text in ["just words", "format = \"catoptric/1\"\n[[bodies]]\nmaterial = \"red\"\n"] {
        assert!(matches!(refuse(&mut editor, &Action::Paste(text.to_owned())), ActionError::BadText(_)));
    }
    let camera = Action::Paste("format = \"catoptric/1\"\n[camera]\nfov = 50.0\n".to_owned());
    assert!(matches!(refuse(&mut editor, &camera), ActionError::NothingToPaste));
    let nothing = Action::Paste(" \n".to_owned());
    assert!(matches!(gray(&mut editor, &nothing), ActionError::NothingToPaste));
    editor.select_parts([ScenePart::Material(1)]);
    let shared = editor.copy().unwrap();
    assert!(matches!(refuse(&mut editor, &Action::Paste(shared)), ActionError::NothingToPaste));
}

#[test]
fn copied_planes_do_not_lie_in_each_other() {
    let mut editor = Editor::new(Scene::default());
    act(
        &mut editor,
        &Action::AddBody {
            shape: catoptric_scene::ShapeKind::Plane,
            placement: catoptric_editor::NewBodyPlacement::at(DVec3::ZERO),
            name: String::new(),
        },
    );
    act(&mut editor, &Action::Duplicate);
    assert_eq!(editor.scene().bodies[1].placement.origin(), DVec3::Y * 0.5);
    editor.select(Selection::none());
    gray(&mut editor, &Action::Duplicate);
}
