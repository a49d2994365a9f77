//! Known answers of the actions on names and materials.

use catoptric_editor::{Action, ActionError, Item};
use catoptric_scene::{Material, MaterialChoice, Phong, ScenePart};

use crate::common::{act, bodies, editor, gray, items, names, selected, selecting};

fn choice(name: &str) -> MaterialChoice {
    MaterialChoice::Named(name.to_owned())
}

fn own(ior: f64) -> MaterialChoice {
    MaterialChoice::Inline(Box::new(Material::Phong(Phong { ior, ..Phong::default() })))
}

fn materials(editor: &catoptric_editor::Editor) -> Vec<&str> {
    editor.scene().materials.iter().map(|named| named.name.as_str()).collect()
}

fn rename(item: Item, name: &str) -> Action {
    Action::Rename { item, name: name.to_owned() }
}

#[test]
fn names_stay_unique() {
    let mut editor = editor();
    let item = items(&editor);
    act(&mut editor, &rename(item(ScenePart::Body(0)), " new "));
    act(&mut editor, &rename(item(ScenePart::Body(1)), "new"));
    act(&mut editor, &rename(item(ScenePart::Light(0)), "new"));
    act(&mut editor, &rename(item(ScenePart::Body(2)), ""));
    assert_eq!(names(&editor), ["new", "new 2", "", "d"]);
    assert_eq!(editor.scene().lights[0].name, "new");
    act(&mut editor, &rename(item(ScenePart::Material(0)), "rosso"));
    assert_eq!(materials(&editor), ["rosso", "blue", "spare"]);
    let of: Vec<_> = editor.scene().bodies.iter().map(|body| body.material.clone()).collect();
    assert_eq!(of, [choice("rosso"), choice("rosso"), choice("blue"), MaterialChoice::default()]);
    act(&mut editor, &rename(item(ScenePart::Material(1)), "rosso"));
    assert_eq!(materials(&editor), ["rosso", "rosso 2", "spare"]);
    assert_eq!(editor.scene().bodies[2].material, choice("rosso 2"));
    assert_eq!(editor.undo_label().unwrap().subject, "rosso 2");
    assert!(matches!(gray(&mut editor, &rename(item(ScenePart::Material(1)), " ")), ActionError::EmptyName));
    assert!(matches!(
        gray(&mut editor, &rename(item(ScenePart::Material(1)), "rosso 2")),
        ActionError::NothingToDo
    ));
    assert!(matches!(gray(&mut editor, &rename(item(ScenePart::Body(2)), "")), ActionError::NothingToDo));
    assert!(matches!(gray(&mut editor, &rename(item(ScenePart::Body(9)), "x")), ActionError::NoSuchItem));
    assert!(matches!(gray(&mut editor, &rename(Item::Camera, "x")), ActionError::NoSuchItem));
}

#[test]
fn a_deleted_material_stays_with_its_bodies() {
    let mut editor = selecting([ScenePart::Body(3), ScenePart::Material(2), ScenePart::Material(0)]);
    let item = items(&editor);
    editor.apply(Action::SetLocked { item: item(ScenePart::Body(3)), locked: true }).unwrap();
    editor.apply(Action::SetLocked { item: item(ScenePart::Body(0)), locked: true }).unwrap();
    act(&mut editor, &Action::Delete);
    assert_eq!(materials(&editor), ["blue"]);
    let of: Vec<_> = editor.scene().bodies.iter().map(|body| body.material.clone()).collect();
    assert_eq!(of, [own(1.1), own(1.1), choice("blue"), MaterialChoice::default()]);
    assert_eq!(selected(&editor), [ScenePart::Body(3)]);
}

#[test]
fn materials_are_assigned() {
    let mut editor = selecting(bodies([0, 2]));
    let item = items(&editor);
    editor.apply(Action::SetLocked { item: item(ScenePart::Body(0)), locked: true }).unwrap();
    act(&mut editor, &Action::AssignMaterial(choice("spare")));
    assert_eq!(editor.scene().bodies[0].material, choice("red"));
    assert_eq!(editor.scene().bodies[2].material, choice("spare"));
    act(&mut editor, &Action::AssignMaterial(own(1.7)));
    assert_eq!(editor.scene().bodies[2].material, own(1.7));
    assert!(matches!(gray(&mut editor, &Action::AssignMaterial(own(1.7))), ActionError::NothingToDo));
    assert!(matches!(gray(&mut editor, &Action::AssignMaterial(choice("no"))), ActionError::NoSuchItem));
    let bad = Action::AssignMaterial(own(-1.0));
    assert!(matches!(crate::common::refuse(&mut editor, &bad), ActionError::Refused(_)));
    editor.select_parts([ScenePart::Body(0)]);
    assert!(matches!(gray(&mut editor, &Action::AssignMaterial(own(1.7))), ActionError::Locked));
}

#[test]
fn materials_are_shared_and_made_unique() {
    let mut editor = selecting(bodies([0, 1, 3]));
    act(&mut editor, &Action::ShareMaterial);
    assert_eq!(materials(&editor), ["red", "blue", "spare", "d"]);
    for index in [0, 1, 3] {
        assert_eq!(editor.scene().bodies[index].material, choice("d"));
    }
    assert!(matches!(gray(&mut editor, &Action::ShareMaterial), ActionError::NothingToDo));
    // A named one is shared as it is.
    editor.select_parts(bodies([1, 2]));
    act(&mut editor, &Action::ShareMaterial);
    assert_eq!(editor.scene().bodies[1].material, choice("blue"));
    assert_eq!(editor.scene().materials.len(), 4);
    act(&mut editor, &Action::MakeMaterialUnique);
    assert_eq!(editor.scene().bodies[1].material, own(1.2));
    assert_eq!(editor.scene().bodies[2].material, own(1.2));
    assert!(matches!(gray(&mut editor, &Action::MakeMaterialUnique), ActionError::NothingToDo));
}

#[test]
fn unused_materials_are_removed() {
    let mut editor = selecting([ScenePart::Material(2), ScenePart::Body(2), ScenePart::Material(1)]);
    act(&mut editor, &Action::MakeMaterialUnique);
    act(&mut editor, &Action::RemoveUnusedMaterials);
    assert_eq!(materials(&editor), ["red"]);
    assert_eq!(selected(&editor), [ScenePart::Body(2)]);
    assert_eq!(editor.undo_label().unwrap().subject, "");
    assert!(matches!(gray(&mut editor, &Action::RemoveUnusedMaterials), ActionError::NothingToDo));
    // The places of those that are left count.
    let mut editor = selecting([ScenePart::Material(1)]);
    let item = items(&editor);
    editor.apply(Action::Rename { item: item(ScenePart::Material(0)), name: "unused".to_owned() }).unwrap();
    for index in [0, 1] {
        editor
            .change_body(index, crate::common::label("x"), |body| body.material = MaterialChoice::default())
            .unwrap();
    }
    act(&mut editor, &Action::RemoveUnusedMaterials);
    assert_eq!((materials(&editor), selected(&editor)), (vec!["blue"], vec![ScenePart::Material(0)]));
}
