//! Parts of joined bodies: rows that unfold, values, drags into a whole and out of it.

use catoptric_editor::{Action, PartPath, Selection};
use catoptric_scene::{MaterialChoice, ScenePart, ShapeKind};
use catoptric_studio::{Command, Studio};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, Pos2, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use egui_kittest::{Harness, Node};

use crate::kit::{item_at, studio};

type Kit = Harness<'static, Studio>;

fn settle(harness: &mut Kit) {
    harness.run_steps(4);
}

fn path(places: &[usize]) -> PartPath {
    PartPath::by(places.iter().copied()).unwrap()
}

/// The example of four bodies, in which the cube is cut out of the sphere: floor, whole, cylinder, cone.
fn joined() -> Kit {
    let mut harness = studio();
    harness.set_size(vec2(1280.0, 1700.0));
    settle(&mut harness);
    let editor = harness.state_mut().editor_mut();
    editor.select_parts([1, 2].map(ScenePart::Body));
    editor.apply(Action::Join { shape: ShapeKind::Difference, name: "whole".to_owned() }).unwrap();
    settle(&mut harness);
    harness
}

fn find<'a>(harness: &'a Kit, name: &'a str) -> Option<Node<'a>> {
    harness.query_by_role_and_label(Role::TreeItem, name)
}

fn click_row(harness: &mut Kit, name: &str) {
    harness.get_by_role_and_label(Role::TreeItem, name).click();
    settle(harness);
}

fn meant(harness: &Kit) -> Option<PartPath> {
    harness.state().editor().selection().part()
}

fn parts(harness: &Kit) -> Vec<String> {
    harness.state().editor().scene().bodies[1].parts.iter().map(|part| part.name.clone()).collect()
}

fn bodies(harness: &Kit) -> Vec<String> {
    harness.state().editor().scene().bodies.iter().map(|body| body.name.clone()).collect()
}

#[test]
fn joined_bodies_unfold_and_arrows_walk_through_them() {
    let mut harness = joined();
    assert!(find(&harness, "cube").is_none());
    harness.get_by_label("Show the parts of whole").click();
    settle(&mut harness);
    assert!(find(&harness, "cube").is_some());
    click_row(&mut harness, "cube");
    assert_eq!(meant(&harness), Some(path(&[1])));
    assert!(find(&harness, "cube").unwrap().accesskit_node().is_selected().unwrap());
    for (key, expected) in [
        (Key::ArrowUp, Some(path(&[0]))),
        (Key::ArrowDown, Some(path(&[1]))),
        (Key::ArrowLeft, None),
        (Key::ArrowRight, Some(path(&[0]))),
        (Key::ArrowUp, None),
    ] {
        harness.key_press(key);
        settle(&mut harness);
        assert_eq!(meant(&harness), expected, "{key:?}");
    }
    harness.key_press(Key::ArrowLeft);
    settle(&mut harness);
    assert!(find(&harness, "cube").is_none(), "the whole is folded");
    harness.key_press(Key::ArrowRight);
    settle(&mut harness);
    assert!(find(&harness, "cube").is_some());
}

#[test]
fn the_filter_finds_parts_and_a_selected_part_comes_into_view() {
    let mut harness = joined();
    let whole = item_at(harness.state(), ScenePart::Body(1));
    harness.get_by_label("Filter by name").focus();
    settle(&mut harness);
    harness.event(Event::Text("cub".to_owned()));
    settle(&mut harness);
    assert!(find(&harness, "cube").is_some() && find(&harness, "whole").is_some());
    assert!(find(&harness, "sphere").is_none() && find(&harness, "cone").is_none());
    harness.get_by_label("Clear the filter").click();
    settle(&mut harness);
    assert!(find(&harness, "cube").is_none());
    harness.state_mut().editor_mut().select(Selection::of_part(whole, path(&[1])));
    settle(&mut harness);
    assert!(find(&harness, "cube").is_some());
}

#[test]
fn parts_are_renamed_reordered_copied_and_deleted_by_keys() {
    let mut harness = joined();
    harness.get_by_label("Show the parts of whole").click();
    settle(&mut harness);
    click_row(&mut harness, "cube");
    harness.key_press(Key::F2);
    settle(&mut harness);
    harness.event(Event::Text("hole".to_owned()));
    harness.step();
    harness.key_press(Key::Enter);
    settle(&mut harness);
    assert_eq!(parts(&harness), ["sphere", "hole"]);
    harness.key_press_modifiers(Modifiers::ALT, Key::ArrowUp);
    settle(&mut harness);
    assert_eq!(parts(&harness), ["hole", "sphere"]);
    harness.key_press_modifiers(Modifiers::COMMAND, Key::D);
    settle(&mut harness);
    assert_eq!(parts(&harness), ["hole", "hole 2", "sphere"]);
    harness.key_press(Key::Delete);
    settle(&mut harness);
    assert_eq!((parts(&harness), bodies(&harness).len()), (vec!["hole".to_owned(), "sphere".to_owned()], 4));
}

#[test]
fn the_inspector_shows_and_changes_the_part() {
    let mut harness = joined();
    let whole = item_at(harness.state(), ScenePart::Body(1));
    harness.state_mut().editor_mut().select(Selection::of_part(whole, path(&[1])));
    settle(&mut harness);
    let part = |harness: &Kit| harness.state().editor().scene().bodies[1].parts[1].clone();
    let before = harness.state().editor().scene().bodies[1].clone();
    harness.get_by_role_and_label(Role::SpinButton, "Position Y").click();
    settle(&mut harness);
    harness.event(Event::Text("0.25".to_owned()));
    harness.run_steps(2);
    harness.key_press(Key::Enter);
    settle(&mut harness);
    assert_eq!(part(&harness).placement.origin().y, 0.25);
    assert_eq!(harness.state().editor().scene().bodies[1].placement, before.placement);
    assert_eq!(harness.state().editor().undo_label().unwrap().subject, "cube");
    harness.state_mut().run(Command::Edit(Action::MaterialOfWhole));
    settle(&mut harness);
    assert_eq!(part(&harness).material, None);
    harness.get_by_label_contains("The part is made of what the whole");
    harness.state_mut().run(Command::Edit(Action::MakeMaterialUnique));
    settle(&mut harness);
    assert!(matches!(part(&harness).material, Some(MaterialChoice::Inline(_))));
    harness.get_by_label("Part of whole").click();
    settle(&mut harness);
    assert_eq!(meant(&harness), None);
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

fn center(harness: &Kit, name: &str) -> Pos2 {
    find(harness, name).unwrap().rect().center()
}

#[test]
fn rows_are_dragged_into_a_whole_within_it_and_out_again() {
    let mut harness = joined();
    let scene = harness.state().editor().scene().clone();
    let (from, to) = (center(&harness, "cone"), center(&harness, "whole"));
    drag(&mut harness, from, to);
    assert_eq!(
        (parts(&harness).join(" "), bodies(&harness).join(" ")),
        ("sphere cube cone".to_owned(), "floor whole cylinder".to_owned())
    );
    assert_eq!(meant(&harness), Some(path(&[2])));
    // The row of the part has come into view: between the others now.
    let (from, to) = (center(&harness, "cone"), center(&harness, "cube") - vec2(0.0, 8.0));
    drag(&mut harness, from, to);
    assert_eq!(parts(&harness).join(" "), "sphere cone cube");
    let (from, to) = (center(&harness, "cone"), center(&harness, "cylinder") + vec2(0.0, 8.0));
    drag(&mut harness, from, to);
    assert_eq!(harness.state().editor().steps_done(), 4);
    let now = harness.state().editor().scene();
    assert_eq!((parts(&harness).join(" "), bodies(&harness)), ("sphere cube".to_owned(), bodies_of(&scene)));
    for (before, now) in scene.bodies.iter().zip(&now.bodies) {
        assert!(before.middle().distance(now.middle()) < 1e-9, "{}", before.name);
        assert_eq!(before.material, now.material);
    }
}

fn bodies_of(scene: &catoptric_scene::Scene) -> Vec<String> {
    scene.bodies.iter().map(|body| body.name.clone()).collect()
}

#[test]
fn what_cannot_be_dropped_stays() {
    let mut harness = joined();
    harness.state_mut().run(Command::Edit(Action::Join { shape: ShapeKind::Union, name: String::new() }));
    settle(&mut harness);
    let whole = item_at(harness.state(), ScenePart::Body(1));
    harness.state_mut().editor_mut().apply(Action::SetLocked { item: whole, locked: true }).unwrap();
    settle(&mut harness);
    let before = harness.state().editor().scene().clone();
    let (from, to) = (center(&harness, "cone"), center(&harness, "whole"));
    drag(&mut harness, from, to);
    assert_eq!(harness.state().editor().scene(), &before);
}

#[test]
fn the_menu_of_a_part_takes_it_out() {
    let mut harness = joined();
    harness.get_by_label("Show the parts of whole").click();
    settle(&mut harness);
    harness.get_by_role_and_label(Role::TreeItem, "cube").click_secondary();
    settle(&mut harness);
    harness.get_by_label("Take the part out").click();
    settle(&mut harness);
    assert_eq!(
        (parts(&harness), bodies(&harness).join(" ")),
        (vec!["sphere".to_owned()], "floor whole cube cylinder cone".to_owned())
    );
}
