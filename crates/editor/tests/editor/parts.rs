//! Known answers of acts on the parts of joined bodies.

use catoptric_editor::{Action, ActionError, Editor, Item, PartPath, PartSlot, Selection};
use catoptric_scene::{
    Anchor, Body, BodyPart, MaterialChoice, Placement, Scene, ScenePart, Shape, ShapeKind,
};
use glam::{DAffine3, DVec3};

use crate::common::{act, bodies, gray, items, label, names, refuse, selecting};

fn path(places: &[usize]) -> PartPath {
    PartPath::by(places.iter().copied()).unwrap()
}

fn body(editor: &Editor, index: usize) -> Item {
    items(editor)(ScenePart::Body(index))
}

fn focus(editor: &mut Editor, index: usize, places: &[usize]) {
    editor.select(Selection::of_part(body(editor, index), path(places)));
}

fn slot(whole: Item, within: &[usize], place: usize) -> Option<PartSlot> {
    Some(PartSlot { whole, within: path(within), place })
}

/// The names of the parts of a body, those of joined ones with theirs.
fn tree(parts: &[BodyPart]) -> String {
    let name = |part: &BodyPart| match part.parts.is_empty() {
        true => part.name.clone(),
        false => format!("{}({})", part.name, tree(&part.parts)),
    };
    parts.iter().map(name).collect::<Vec<_>>().join(" ")
}

/// The simple parts of all bodies in the world: shape, frame, material.
fn pieces(scene: &Scene) -> Vec<(Shape, DAffine3, MaterialChoice)> {
    let mut found = Vec::new();
    for body in &scene.bodies {
        body.form().each_simple(DAffine3::IDENTITY, &mut |part| {
            found.push((part.shape, part.frame, part.material.unwrap_or(&body.material).clone()));
        });
    }
    found.sort_by(|a, b| a.1.translation.x.total_cmp(&b.1.translation.x));
    found
}

fn assert_same_world(one: &Scene, other: &Scene) {
    let (one, other) = (pieces(one), pieces(other));
    assert_eq!(one.len(), other.len());
    for (a, b) in one.iter().zip(&other) {
        assert_eq!((a.0, &a.2), (b.0, &b.2));
        assert!(a.1.abs_diff_eq(b.1, 1e-9), "{a:?} is not {b:?}");
    }
}

/// The bodies w = a ∪ b and v = c − d, each turned, moved and evenly scaled.
fn two_wholes() -> Editor {
    let mut editor = selecting(bodies([0, 1]));
    editor.apply(Action::Join { shape: ShapeKind::Union, name: "w".to_owned() }).unwrap();
    editor.select_parts(bodies([1, 2]));
    editor.apply(Action::Join { shape: ShapeKind::Difference, name: "v".to_owned() }).unwrap();
    for (index, turn) in [(0, DVec3::new(10.0, 20.0, 30.0)), (1, DVec3::new(-70.0, 5.0, 130.0))] {
        let place = |body: &mut Body| {
            let anchor = Anchor::Frame { position: body.placement.origin(), rotation_degrees: turn };
            body.placement = Placement { anchor, scale: DVec3::splat(1.5 + index as f64) };
        };
        editor.change_body(index, label("edit-a"), place).unwrap();
        editor.settle();
    }
    assert_eq!(names(&editor), ["w", "v"]);
    editor
}

#[test]
fn a_part_is_meant_beside_its_body_as_long_as_both_are_there() {
    let mut editor = two_wholes();
    focus(&mut editor, 0, &[1]);
    assert_eq!(editor.selected_part(), Some((0, path(&[1]))));
    assert_eq!(editor.selected_bodies().collect::<Vec<_>>(), [0]);
    focus(&mut editor, 0, &[2]);
    assert_eq!((editor.selected_part(), editor.selection().part()), (None, None));
    focus(&mut editor, 1, &[1]);
    editor.change_body(1, label("edit-b"), |body| body.parts.truncate(1)).unwrap();
    assert_eq!(editor.selection(), &Selection::one(body(&editor, 1)));
    editor.check_invariants().unwrap();
    focus(&mut editor, 1, &[0]);
    let mut selection = editor.selection().clone();
    selection.add(body(&editor, 0));
    assert_eq!(selection.part(), None);
}

#[test]
fn parts_are_walked_and_left() {
    let mut editor = two_wholes();
    editor.select(body(&editor, 0));
    for (action, part) in [
        (Action::SelectPart, Some(path(&[0]))),
        (Action::SelectNext, Some(path(&[1]))),
        (Action::SelectNext, Some(path(&[0]))),
        (Action::SelectPrevious, Some(path(&[1]))),
        (Action::SelectWhole, None),
    ] {
        editor.apply(action).unwrap();
        assert_eq!(editor.selection().part(), part);
    }
    gray(&mut editor, &Action::SelectWhole);
    editor.apply(Action::SelectPart).unwrap();
    gray(&mut editor, &Action::SelectPart);
}

#[test]
fn parts_are_copied_deleted_renamed_and_reordered() {
    let mut editor = two_wholes();
    focus(&mut editor, 1, &[1]);
    act(&mut editor, &Action::Duplicate);
    assert_eq!(tree(&editor.scene().bodies[1].parts), "c d d 2");
    assert_eq!(editor.selection().part(), Some(path(&[2])));
    let origin = |at: usize| editor.scene().bodies[1].parts[at].placement.origin();
    assert!((origin(2) - origin(1)).distance(DVec3::new(0.5, 0.0, 0.5)) < 1e-12);
    act(&mut editor, &Action::MoveUp);
    assert_eq!(tree(&editor.scene().bodies[1].parts), "c d 2 d");
    act(&mut editor, &Action::MoveUp);
    gray(&mut editor, &Action::MoveUp);
    assert_eq!(
        (tree(&editor.scene().bodies[1].parts).as_str(), editor.selection().part()),
        ("d 2 c d", Some(path(&[0])))
    );
    let whole = body(&editor, 1);
    act(&mut editor, &Action::RenamePart { whole, part: path(&[0]), name: " c ".to_owned() });
    assert_eq!(tree(&editor.scene().bodies[1].parts), "c 2 c d");
    act(&mut editor, &Action::MoveDown);
    act(&mut editor, &Action::Delete);
    assert_eq!(
        (tree(&editor.scene().bodies[1].parts).as_str(), editor.selection().part()),
        ("c d", Some(path(&[1])))
    );
    act(&mut editor, &Action::Delete);
    // The last part but one: the whole stays joined, of one part.
    assert_eq!(
        (tree(&editor.scene().bodies[1].parts).as_str(), editor.selection().part()),
        ("c", Some(path(&[0])))
    );
    act(&mut editor, &Action::Delete);
    assert_eq!((names(&editor), editor.selection().is_empty()), (vec!["w"], true));
}

#[test]
fn a_part_has_a_material_as_the_whole_or_its_own() {
    let mut editor = two_wholes();
    focus(&mut editor, 0, &[0]);
    let part = |editor: &Editor| editor.scene().bodies[0].parts[0].material.clone();
    assert_eq!(part(&editor), None);
    gray(&mut editor, &Action::MaterialOfWhole);
    act(&mut editor, &Action::AssignMaterial(MaterialChoice::Named("blue".to_owned())));
    assert_eq!(part(&editor), Some(MaterialChoice::Named("blue".to_owned())));
    assert_eq!(editor.scene().bodies[0].material, MaterialChoice::Named("red".to_owned()));
    act(&mut editor, &Action::MakeMaterialUnique);
    assert!(matches!(part(&editor), Some(MaterialChoice::Inline(_))));
    act(&mut editor, &Action::ShareMaterial);
    assert_eq!(part(&editor), Some(MaterialChoice::Named("a".to_owned())));
    act(&mut editor, &Action::MaterialOfWhole);
    assert_eq!(part(&editor), None);
    act(&mut editor, &Action::MakeMaterialUnique);
    let whole = editor.scene().material(&editor.scene().bodies[0].material).unwrap().clone();
    assert_eq!(part(&editor), Some(MaterialChoice::Inline(Box::new(whole))));
}

#[test]
fn bodies_become_parts_and_parts_bodies_where_they_stand() {
    let mut editor = two_wholes();
    editor.select(body(&editor, 1));
    let before = editor.scene().clone();
    let (whole, other) = (body(&editor, 0), body(&editor, 1));
    act(&mut editor, &Action::Nest(slot(whole, &[], 1)));
    assert_eq!((names(&editor), tree(&editor.scene().bodies[0].parts)), (vec!["w"], "a v(c d) b".to_owned()));
    assert_eq!(editor.selection(), &Selection::of_part(whole, path(&[1])));
    assert_same_world(&before, editor.scene());
    assert!(!editor.edited().contains(other));
    act(&mut editor, &Action::TakeOut(Some(0)));
    assert_eq!((names(&editor), tree(&editor.scene().bodies[0].parts)), (vec!["v", "w"], "c d".to_owned()));
    assert_same_world(&before, editor.scene());
    assert_eq!(editor.selection(), &Selection::one(body(&editor, 0)));
    assert_eq!(body(&editor, 1), whole);
}

#[test]
fn parts_go_from_whole_to_whole_and_keep_place_and_looks() {
    let mut editor = two_wholes();
    let before = editor.scene().clone();
    let (w, v) = (body(&editor, 0), body(&editor, 1));
    focus(&mut editor, 0, &[1]);
    act(&mut editor, &Action::Nest(slot(v, &[], 0)));
    let trees =
        |editor: &Editor| editor.scene().bodies.iter().map(|body| tree(&body.parts)).collect::<Vec<_>>();
    assert_eq!(trees(&editor), ["a", "b c d"]);
    assert_same_world(&before, editor.scene());
    // The last part takes its whole along.
    focus(&mut editor, 0, &[0]);
    act(&mut editor, &Action::Nest(slot(v, &[], usize::MAX)));
    assert_eq!((names(&editor), trees(&editor)), (vec!["v"], vec!["b c d a".to_owned()]));
    assert_same_world(&before, editor.scene());
    assert!(!editor.edited().contains(w));
    // Within one whole only the order changes, to the last bit.
    let parts = editor.scene().bodies[0].parts.clone();
    act(&mut editor, &Action::Nest(slot(v, &[], 1)));
    assert_eq!(trees(&editor), ["b a c d"]);
    assert_eq!(editor.scene().bodies[0].parts[1], parts[3]);
    refuse(&mut editor, &Action::Nest(slot(v, &[], 2)));
}

#[test]
fn parts_go_deeper_and_come_up_within_a_body() {
    let mut editor = two_wholes();
    let before = editor.scene().clone();
    let w = body(&editor, 0);
    editor.select(body(&editor, 1));
    act(&mut editor, &Action::Nest(slot(w, &[], 0)));
    focus(&mut editor, 0, &[2]);
    act(&mut editor, &Action::Nest(slot(w, &[0], 1)));
    let now = |editor: &Editor| tree(&editor.scene().bodies[0].parts);
    assert_eq!((now(&editor).as_str(), editor.selection().part()), ("v(c b d) a", Some(path(&[0, 1]))));
    assert_same_world(&before, editor.scene());
    // What it was within goes when nothing else is in it.
    for place in [0, 0, 0] {
        focus(&mut editor, 0, &[0, 0]);
        let end = editor.scene().bodies[0].parts.len() + place;
        act(&mut editor, &Action::Nest(slot(w, &[], end)));
        assert_same_world(&before, editor.scene());
    }
    assert_eq!((now(&editor).as_str(), editor.selection().part()), ("a c b d", Some(path(&[3]))));
}

#[test]
fn what_cannot_be_a_part_says_why() {
    let mut editor = two_wholes();
    let (w, v) = (body(&editor, 0), body(&editor, 1));
    editor.select(v);
    act(&mut editor, &Action::Nest(slot(w, &[], 2)));
    focus(&mut editor, 0, &[2]);
    assert!(matches!(gray(&mut editor, &Action::Nest(slot(w, &[2], 0))), ActionError::WithinItself));
    assert!(matches!(gray(&mut editor, &Action::Nest(slot(w, &[0], 0))), ActionError::NotJoined));
    editor.select(w);
    assert!(matches!(gray(&mut editor, &Action::Nest(slot(w, &[], 0))), ActionError::WithinItself));
    assert!(matches!(gray(&mut editor, &Action::TakeOut(None)), ActionError::NothingSelected));
    // Stretched and turned within.
    focus(&mut editor, 0, &[2]);
    editor.change_body(0, label("edit-a"), |body| body.placement.scale = DVec3::new(1.0, 3.0, 1.0)).unwrap();
    editor.settle();
    let error = refuse(&mut editor, &Action::TakeOut(None));
    assert!(matches!(error, ActionError::Sheared { name } if name == "v"));
    assert!(editor.try_out(&Action::TakeOut(None)).is_err());
    editor.apply(Action::SetLocked { item: w, locked: true }).unwrap();
    assert!(matches!(gray(&mut editor, &Action::Delete), ActionError::Locked));
}

#[test]
fn depth_and_number_of_parts_are_limited() {
    let mut editor = selecting(bodies([0, 1]));
    let many = |body: &mut Body| {
        body.shape = Shape::Union;
        body.parts = vec![BodyPart::default(); Shape::MAX_PARTS];
    };
    editor.change_body(1, label("edit-a"), many).unwrap();
    let deep = |body: &mut Body| {
        let mut part = BodyPart::default();
        for _ in 1..Shape::MAX_DEPTH {
            part = BodyPart { shape: Shape::Group, parts: vec![part], ..BodyPart::default() };
        }
        body.shape = Shape::Group;
        body.parts = vec![part];
    };
    editor.change_body(2, label("edit-b"), deep).unwrap();
    editor.settle();
    let (many, deep) = (body(&editor, 1), body(&editor, 2));
    editor.select(body(&editor, 0));
    assert!(matches!(refuse(&mut editor, &Action::Nest(slot(many, &[], 0))), ActionError::TooManyParts));
    assert!(editor.try_out(&Action::Nest(slot(deep, &[0; 7], 0))).is_ok());
    editor.select(many);
    assert!(matches!(refuse(&mut editor, &Action::Nest(slot(deep, &[0; 7], 0))), ActionError::TooDeep));
}

#[test]
fn parts_are_copied_as_bodies_and_pasted_beside_a_part() {
    let mut editor = two_wholes();
    let before = pieces(editor.scene());
    focus(&mut editor, 1, &[1]);
    let text = editor.copy().unwrap();
    act(&mut editor, &Action::Paste(text.clone()));
    assert_eq!(tree(&editor.scene().bodies[1].parts), "c d d 2");
    assert_eq!(editor.selection().part(), Some(path(&[2])));
    assert_ne!(editor.scene().bodies[1].parts[1].placement, editor.scene().bodies[1].parts[2].placement);
    editor.select_parts([]);
    act(&mut editor, &Action::Paste(text));
    assert_eq!(names(&editor), ["w", "v", "d"]);
    let pasted = editor.scene().bodies[2].clone();
    let own =
        before.iter().find(|piece| piece.1.translation.distance(pasted.placement.origin()) < 1e-9).unwrap();
    assert_eq!(own.2, pasted.material);
    focus(&mut editor, 1, &[2]);
    act(&mut editor, &Action::Cut);
    assert_eq!(tree(&editor.scene().bodies[1].parts), "c d");
}
