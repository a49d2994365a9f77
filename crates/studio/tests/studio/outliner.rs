//! The panel of everything in the scene.

use catoptric_scene::{Body, Scene, ScenePart};
use catoptric_studio::{FileCommand, SelectionCommand, Studio, WindowCommand};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, Pos2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use egui_kittest::{Harness, Node};

use crate::kit::studio;

type Kit = Harness<'static, Studio>;

fn settle(harness: &mut Kit) {
    harness.run_steps(4);
}

fn row<'a>(harness: &'a Kit, name: &'a str) -> Node<'a> {
    harness.get_by_role_and_label(Role::TreeItem, name)
}

fn click(harness: &mut Kit, name: &str, modifiers: Modifiers) {
    let node = harness.get_by_role_and_label(Role::TreeItem, name);
    node.click_modifiers(modifiers);
    settle(harness);
}

fn selected(harness: &Kit) -> Vec<String> {
    let editor = harness.state().editor();
    editor.selected_parts().map(|part| part.name(editor.scene()).to_owned()).collect()
}

fn names(harness: &Kit) -> Vec<String> {
    harness.state().editor().scene().bodies.iter().map(|body| body.name.clone()).collect()
}

#[test]
fn rows_are_selected_alone_together_and_in_ranges() {
    let mut harness = studio();
    settle(&mut harness);
    click(&mut harness, "cube", Modifiers::NONE);
    assert_eq!(selected(&harness), ["cube"]);
    assert!(row(&harness, "cube").accesskit_node().is_selected().unwrap());
    click(&mut harness, "cone", Modifiers::COMMAND);
    assert_eq!(selected(&harness), ["cube", "cone"]);
    click(&mut harness, "cube", Modifiers::COMMAND);
    assert_eq!(selected(&harness), ["cone"]);
    click(&mut harness, "cone", Modifiers::NONE);
    click(&mut harness, "sphere", Modifiers::SHIFT);
    assert_eq!(selected(&harness), ["cone", "cylinder", "cube", "sphere"]);
    click(&mut harness, "Camera", Modifiers::NONE);
    assert_eq!(harness.state().editor().primary_part(), Some(ScenePart::Camera));
}

#[test]
fn arrows_choose_rows_once_the_list_is_used() {
    let mut harness = studio();
    settle(&mut harness);
    click(&mut harness, "sphere", Modifiers::NONE);
    for (modifiers, key, expected) in [
        (Modifiers::NONE, Key::ArrowDown, vec!["cube"]),
        (Modifiers::SHIFT, Key::ArrowDown, vec!["cube", "cylinder"]),
        (Modifiers::SHIFT, Key::ArrowUp, vec!["cube"]),
        (Modifiers::NONE, Key::ArrowUp, vec!["sphere"]),
    ] {
        harness.key_press_modifiers(modifiers, key);
        settle(&mut harness);
        assert_eq!(selected(&harness), expected, "{key:?}");
    }
    harness.key_press(Key::Space);
    settle(&mut harness);
    assert!(harness.state().editor().scene().bodies[1].hidden);
    harness.key_press(Key::ArrowLeft);
    settle(&mut harness);
    assert!(harness.query_by_role_and_label(Role::TreeItem, "cube").is_none(), "the section is folded");
    harness.key_press(Key::ArrowRight);
    settle(&mut harness);
    assert!(harness.query_by_role_and_label(Role::TreeItem, "cube").is_some());
}

fn type_name(harness: &mut Kit, name: &str, last: Key) {
    settle(harness);
    harness.event(Event::Text(name.to_owned()));
    harness.step();
    harness.key_press(last);
    settle(harness);
}

#[test]
fn names_are_typed_in_place() {
    let mut harness = studio();
    settle(&mut harness);
    click(&mut harness, "sphere", Modifiers::NONE);
    harness.key_press(Key::F2);
    type_name(&mut harness, "Mirror ball", Key::Enter);
    assert_eq!(names(&harness)[1], "Mirror ball");
    harness.key_press(Key::F2);
    type_name(&mut harness, "Nothing", Key::Escape);
    assert_eq!(names(&harness)[1], "Mirror ball");
    let center = row(&harness, "cube").rect().center();
    // Both clicks in one frame: the frames of tests are long.
    let button = |pressed| Event::PointerButton {
        pos: center,
        button: egui::PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    harness.hover_at(center);
    harness.step();
    harness.input_mut().events.extend([true, false, true, false].map(button));
    type_name(&mut harness, "Box", Key::Enter);
    assert_eq!(names(&harness)[2], "Box");
    harness.key_press(Key::Enter);
    type_name(&mut harness, "Cube", Key::Tab);
    assert_eq!(names(&harness)[2], "Cube", "leaving the field keeps the name");
    assert_eq!(harness.state().editor().steps().len(), 3);
}

#[test]
fn a_name_is_not_given_to_another_document() {
    let mut harness = studio();
    settle(&mut harness);
    click(&mut harness, "sphere", Modifiers::NONE);
    harness.key_press(Key::F2);
    settle(&mut harness);
    harness.event(Event::Text("Ball".to_owned()));
    harness.step();
    harness.state_mut().run(FileCommand::OpenExample("whitted"));
    settle(&mut harness);
    let before = names(&harness);
    harness.key_press(Key::Enter);
    settle(&mut harness);
    assert_eq!(names(&harness), before);
    assert!(!before.contains(&"Ball".to_owned()), "{before:?}");
}

#[test]
fn renaming_opens_a_folded_list_and_a_hidden_panel() {
    let mut harness = studio();
    settle(&mut harness);
    row(&harness, "Bodies").click();
    settle(&mut harness);
    harness.state_mut().editor_mut().select_parts([ScenePart::Body(1)]);
    harness.state_mut().run(WindowCommand::TogglePane(catoptric_studio::Pane::Outliner));
    settle(&mut harness);
    harness.state_mut().run(SelectionCommand::Rename);
    settle(&mut harness);
    type_name(&mut harness, "Ball", Key::Enter);
    assert_eq!(names(&harness)[1], "Ball");
}

#[test]
fn eyes_and_locks_work_on_their_row_alone() {
    let mut harness = studio();
    settle(&mut harness);
    click(&mut harness, "cone", Modifiers::NONE);
    harness.get_by_label("Hide “cube”").click();
    settle(&mut harness);
    let scene = harness.state().editor().scene().clone();
    assert!(scene.bodies[2].hidden && !scene.bodies[4].hidden);
    harness.get_by_label("Show “cube”").click();
    settle(&mut harness);
    harness.get_by_label("Lock “key”").click();
    settle(&mut harness);
    let scene = harness.state().editor().scene().clone();
    assert!(!scene.bodies[2].hidden && scene.lights[0].locked);
    assert_eq!(selected(&harness), ["cone"]);
    harness.get_by_label("Unlock “key”").click();
    settle(&mut harness);
    assert!(!harness.state().editor().scene().lights[0].locked);
}

fn drag(harness: &mut Kit, from: Pos2, to: Pos2) {
    harness.drag_at(from);
    harness.step();
    for part in 1..=4 {
        harness.hover_at(from + (to - from) * (part as f32 / 4.0));
        harness.step();
    }
    harness.drop_at(to);
    settle(harness);
}

#[test]
fn rows_are_dragged_to_other_places() {
    let mut harness = studio();
    settle(&mut harness);
    assert_eq!(names(&harness), ["floor", "sphere", "cube", "cylinder", "cone"]);
    let (from, to) = (row(&harness, "cone").rect().center(), row(&harness, "sphere").rect().center_top());
    drag(&mut harness, from, to + egui::vec2(0.0, 2.0));
    assert_eq!(names(&harness), ["floor", "cone", "sphere", "cube", "cylinder"]);
    click(&mut harness, "cone", Modifiers::NONE);
    click(&mut harness, "cube", Modifiers::COMMAND);
    let (from, to) =
        (row(&harness, "cone").rect().center(), row(&harness, "cylinder").rect().center_bottom());
    drag(&mut harness, from, to - egui::vec2(0.0, 2.0));
    assert_eq!(names(&harness), ["floor", "sphere", "cylinder", "cone", "cube"]);
    assert_eq!(harness.state().editor().steps().len(), 2);
}

#[test]
fn a_material_dragged_onto_a_body_is_what_it_is_made_of() {
    let mut harness = studio();
    settle(&mut harness);
    let (from, to) = (row(&harness, "yellow").rect().center(), row(&harness, "sphere").rect().center());
    drag(&mut harness, from, to);
    let body: &Body = &harness.state().editor().scene().bodies[1];
    assert_eq!(body.material, catoptric_scene::MaterialChoice::Named("yellow".to_owned()));
}

#[test]
fn the_menu_of_a_row_duplicates_and_deletes() {
    let mut harness = studio();
    settle(&mut harness);
    row(&harness, "sphere").click_secondary();
    settle(&mut harness);
    harness.get_by_label("Duplicate").click();
    settle(&mut harness);
    assert_eq!(names(&harness).len(), 6);
    assert_eq!(selected(&harness), ["sphere 2"]);
    row(&harness, "cube").click_secondary();
    settle(&mut harness);
    harness.get_by_label("Delete").click();
    settle(&mut harness);
    assert!(!names(&harness).contains(&"cube".to_owned()));
}

#[test]
fn the_buttons_at_the_heads_add() {
    let mut harness = studio();
    settle(&mut harness);
    harness.get_by_label("Add light").click();
    settle(&mut harness);
    harness.get_by_label("Add material").click();
    settle(&mut harness);
    harness.get_by_label("Add body").click();
    settle(&mut harness);
    harness.get_by_role_and_label(Role::Button, "Bodies").click();
    harness.run_steps(4);
    harness.get_by_role_and_label(Role::Button, "Cone").click();
    settle(&mut harness);
    let scene = harness.state().editor().scene();
    assert_eq!((scene.lights.len(), scene.bodies.len(), scene.materials.len()), (3, 6, 6));
    assert_eq!(selected(&harness), ["Cone"]);
}

#[test]
fn the_filter_shows_what_bears_the_name() {
    let mut harness = studio();
    settle(&mut harness);
    harness.get_by_label("Filter by name").focus();
    settle(&mut harness);
    harness.event(Event::Text("CYL".to_owned()));
    settle(&mut harness);
    assert!(harness.query_by_role_and_label(Role::TreeItem, "cylinder").is_some());
    assert!(harness.query_by_role_and_label(Role::TreeItem, "cube").is_none());
    harness.get_by_label("Clear the filter").click();
    settle(&mut harness);
    assert!(harness.query_by_role_and_label(Role::TreeItem, "cube").is_some());
}

#[test]
fn ten_thousand_rows_are_as_quick_as_ten_and_the_selected_one_comes_into_view() {
    let mut harness = studio();
    settle(&mut harness);
    let body = |place: usize| {
        let mut body = Body { name: format!("ball {place}"), ..Body::default() };
        body.shape = catoptric_scene::Shape::Sphere { radius: 0.1 };
        body
    };
    let scene = Scene { bodies: (0..10_000).map(body).collect(), ..Scene::default() };
    *harness.state_mut().editor_mut() = catoptric_editor::Editor::new(scene);
    settle(&mut harness);
    let rows = harness.get_all_by_role(Role::TreeItem).count();
    assert!((10..80).contains(&rows), "{rows} rows are drawn");
    assert!(harness.query_by_role_and_label(Role::TreeItem, "ball 9000").is_none());
    harness.state_mut().editor_mut().select_parts([ScenePart::Body(9000)]);
    harness.run_steps(60);
    let rect = row(&harness, "ball 9000").rect();
    assert!(rect.min.y > 60.0 && rect.max.y < 775.0, "{rect:?}");
}

#[test]
fn things_without_a_name_are_called_what_they_are() {
    let mut harness = studio();
    settle(&mut harness);
    let scene = Scene { bodies: vec![Body::default(); 2].into(), ..Scene::default() };
    *harness.state_mut().editor_mut() = catoptric_editor::Editor::new(scene);
    settle(&mut harness);
    assert!(harness.query_by_role_and_label(Role::TreeItem, "Sphere 2").is_some());
}
