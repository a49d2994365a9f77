//! Things keep their identities whatever is done to them.

use std::collections::HashMap;

use catoptric_editor::{Action, Editor, Item, NewBodyPlacement};
use catoptric_scene::{Scene, ScenePart, ShapeKind, read};
use glam::DVec3;
use proptest::prelude::*;

use crate::common::{editor, label, save, scene, selected};

#[derive(Clone, Debug)]
enum Edit {
    Add,
    AddLight,
    Copy,
    Delete,
    Up,
    Down,
    To(usize),
    Rename(usize, &'static str),
    Move(usize, f64),
    Select(Vec<(bool, usize)>),
    Undo,
    Redo,
    Reload,
}

fn edit() -> impl Strategy<Value = Edit> {
    let name = prop_oneof![Just(""), Just("a"), Just("new")];
    prop_oneof![
        Just(Edit::Add),
        Just(Edit::AddLight),
        Just(Edit::Copy),
        Just(Edit::Delete),
        Just(Edit::Up),
        Just(Edit::Down),
        (0usize..9).prop_map(Edit::To),
        (0usize..9, name).prop_map(|(place, name)| Edit::Rename(place, name)),
        (0usize..9, -9.0..9.0f64).prop_map(|(place, x)| Edit::Move(place, x)),
        proptest::collection::vec((any::<bool>(), 0usize..9), 1..4).prop_map(Edit::Select),
        Just(Edit::Undo),
        Just(Edit::Redo),
        Just(Edit::Reload),
    ]
}

fn perform(editor: &mut Editor, edit: &Edit) {
    let action = match edit.clone() {
        Edit::Add => Action::AddBody {
            shape: ShapeKind::Sphere,
            placement: NewBodyPlacement::at(DVec3::Y),
            name: String::new(),
        },
        Edit::AddLight => Action::AddLight { at: DVec3::Y, name: String::new() },
        Edit::Copy => Action::Duplicate,
        Edit::Delete => Action::Delete,
        Edit::Up => Action::MoveUp,
        Edit::Down => Action::MoveDown,
        Edit::To(place) => Action::MoveToIndex(place),
        Edit::Rename(place, name) => {
            let Some(item) = editor.edited().item(ScenePart::Body(place)) else { return };
            Action::Rename { item, name: name.to_owned() }
        }
        Edit::Move(place, x) => {
            let moved =
                |body: &mut catoptric_scene::Body| body.placement = body.placement.moved_by(DVec3::X * x);
            editor.change_body(place, label("edit-move"), moved).unwrap();
            _ = editor.settle();
            return;
        }
        Edit::Select(parts) => {
            let part = |(is_light, at)| if is_light { ScenePart::Light(at) } else { ScenePart::Body(at) };
            return editor.select_parts(parts.into_iter().map(part));
        }
        Edit::Undo => Action::Undo,
        Edit::Redo => Action::Redo,
        Edit::Reload => {
            let text = editor.writing().text();
            save(editor, "mine.toml", &text);
            let read = read(&text).into_result().unwrap().value;
            return editor.revert(text, read).unwrap();
        }
    };
    // What cannot be done changes nothing.
    let _ = editor.apply(action);
}

/// The serial number of a body or light, which no edit changes: a part of a value that the test does not touch.
fn serial(scene: &Scene, part: ScenePart) -> f64 {
    match part {
        ScenePart::Body(at) => scene.bodies[at].placement.scale.x,
        ScenePart::Light(at) => scene.lights[at].intensity,
        _ => unreachable!(),
    }
}

/// Gives each new thing a serial number; remembered is also the one that it was made with, which undo brings back.
fn number_new_things(editor: &mut Editor, known: &mut HashMap<Item, [f64; 2]>) {
    let things: Vec<Item> = editor.edited().lights().chain(editor.edited().bodies()).collect();
    for item in things {
        if known.contains_key(&item) {
            continue;
        }
        let number = 100.0 + known.len() as f64;
        let part = editor.edited().part(item).unwrap();
        known.insert(item, [serial(editor.scene(), part), number]);
        let changed = match part {
            ScenePart::Body(at) => {
                editor.change_body(at, label("number"), |body| body.placement.scale.x = number)
            }
            ScenePart::Light(at) => {
                editor.change_light(at, label("number"), |light| light.intensity = number)
            }
            _ => unreachable!(),
        };
        changed.unwrap();
    }
    editor.settle();
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn an_identity_stays_with_its_thing(edits in proptest::collection::vec(edit(), 0..60)) {
        let mut editor = editor();
        let mut known = HashMap::new();
        number_new_things(&mut editor, &mut known);
        for edit in &edits {
            perform(&mut editor, edit);
            if matches!(edit, Edit::Add | Edit::AddLight | Edit::Copy) {
                number_new_things(&mut editor, &mut known);
            }
            prop_assert_eq!(editor.check_invariants(), Ok(()));
            let edited = editor.edited();
            for item in edited.lights().chain(edited.bodies()) {
                let found = serial(editor.scene(), edited.part(item).unwrap());
                let numbers = known.get(&item);
                prop_assert!(numbers.is_some_and(|numbers| numbers.contains(&found)), "{:?} by {:?}", item, edit);
            }
        }
    }
}

#[test]
fn the_selection_follows_its_things() {
    let mut editor = editor();
    let [b, d] = [1, 3].map(|at| editor.edited().item(ScenePart::Body(at)).unwrap());
    editor.select(d);
    editor.apply(Action::MoveToIndex(0)).unwrap();
    assert_eq!(selected(&editor), [ScenePart::Body(0)]);
    // What is selected after the step is at another place after its undo.
    editor.select([b, d].into_iter().collect::<catoptric_editor::Selection>());
    assert_eq!(selected(&editor), [ScenePart::Body(2), ScenePart::Body(0)]);
    editor.undo();
    assert_eq!(selected(&editor), [ScenePart::Body(3)]);
    assert_eq!(editor.edited().part(b), Some(ScenePart::Body(1)));
    // A deleted thing is no more, and when it is restored it is selected again.
    editor.select(b);
    editor.apply(Action::Delete).unwrap();
    assert!(editor.selection().is_empty() && editor.edited().part(b).is_none());
    editor.undo();
    assert_eq!((selected(&editor), editor.selection().primary()), (vec![ScenePart::Body(1)], Some(b)));
    editor.redo();
    assert!(editor.selection().is_empty());
}

#[test]
fn copies_are_other_things_and_other_documents_share_none() {
    let mut editor = editor();
    let before: Vec<Item> = editor.edited().bodies().collect();
    editor.select(before[0]);
    editor.apply(Action::Duplicate).unwrap();
    let copy = editor.selection().primary().unwrap();
    assert!(!before.contains(&copy));
    editor.undo();
    assert!(!editor.edited().contains(copy));
    editor.redo();
    assert_eq!(editor.selection().primary(), Some(copy));
    let other = crate::common::editor();
    assert!(other.edited().bodies().all(|item| !editor.edited().contains(item)));
}

#[test]
fn a_file_that_is_opened_again_has_the_same_things_by_name() {
    let open = |path: &str| Editor::open(path, "", scene());
    let first = open("/scenes/a.toml");
    let items = |editor: &Editor| editor.edited().bodies().collect::<Vec<_>>();
    assert_eq!(items(&open("/scenes/a.toml").succeeding(&first)), items(&first));
    assert_ne!(items(&open("/scenes/b.toml").succeeding(&first)), items(&first));
}
