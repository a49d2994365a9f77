//! Choosing and carrying.

use super::*;
use crate::kit::item_at;
use catoptric_scene::ScenePart;

#[test]
fn a_click_selects_the_body_that_is_seen() {
    let mut hand = Hand::new();
    for body in [SPHERE, CUBE, CYLINDER, CONE] {
        let above = if body == CUBE { 0.7 } else { 0.3 };
        let point = position(hand.scene(), body) + above * DVec3::Y;
        let at = hand.place(point);
        hand.click(at);
        assert_eq!(hand.selected(), [ScenePart::Body(body)]);
    }
    // Emptiness deselects.
    let place = hand.place(DVec3::new(-1.2, 0.0, 2.6));
    let hide = catoptric_editor::Action::SetHidden {
        item: item_at(hand.harness.state(), ScenePart::Body(FLOOR)),
        hidden: true,
    };
    hand.harness.state_mut().editor_mut().apply(hide).unwrap();
    hand.settle();
    hand.click(place);
    assert_eq!(hand.selected(), []);
    assert_eq!(hand.steps(), 1, "selecting is no step");
}

#[test]
fn clicks_at_the_same_place_go_to_what_is_behind() {
    let mut hand = Hand::new();
    let at = hand.place(position(hand.scene(), SPHERE));
    hand.click(at);
    assert_eq!(hand.selected(), [ScenePart::Body(SPHERE)]);
    hand.click(at + Vec2::new(2.0, 1.0));
    assert_eq!(hand.selected(), [ScenePart::Body(FLOOR)]);
    // Behind the last comes the first.
    hand.click(at);
    assert_eq!(hand.selected(), [ScenePart::Body(SPHERE)]);
    // Elsewhere, it begins anew.
    hand.click(at + Vec2::new(9.0, 0.0));
    assert_eq!(hand.selected(), [ScenePart::Body(SPHERE)]);
}

#[test]
fn shift_and_ctrl_add_and_take_away() {
    let mut hand = Hand::new();
    let places = [SPHERE, CYLINDER].map(|body| hand.place(position(hand.scene(), body) + 0.5 * DVec3::Y));
    hand.click(places[0]);
    hand.hold(Modifiers::SHIFT);
    hand.click(places[1]);
    assert_eq!(hand.selected(), [ScenePart::Body(SPHERE), ScenePart::Body(CYLINDER)]);
    hand.hold(Modifiers::COMMAND);
    hand.click(places[0]);
    assert_eq!(hand.selected(), [ScenePart::Body(CYLINDER)]);
}

#[test]
fn a_body_is_dragged_along_the_ground_and_stays_under_the_pointer() {
    let mut hand = Hand::new();
    let before = hand.scene().clone();
    let start = position(&before, SPHERE);
    let from = hand.place(start);
    let to = from + Vec2::new(90.0, 40.0);
    hand.drag(from, to);
    assert_eq!(hand.selected(), [ScenePart::Body(SPHERE)]);
    assert_only_moved(&before, &hand.scene().clone(), &[SPHERE]);
    let moved = position(hand.scene(), SPHERE);
    assert_eq!(moved.y, start.y);
    assert!(moved.x > start.x && moved.z > start.z);
    // The point that was grabbed is on the front of the ball; it has gone as far as the ball has.
    let rendered = hand.place(moved);
    assert!(rendered.distance(to) < 20.0, "{rendered} instead of {to}");
    assert_eq!(hand.steps(), 1);
    hand.undo();
    assert_same(hand.scene(), &before);
}

#[test]
fn alt_moves_up_and_down_and_ctrl_brings_to_the_grid() {
    let mut hand = Hand::new();
    let start = position(hand.scene(), SPHERE);
    let from = hand.place(start);
    hand.hold(Modifiers::ALT);
    hand.drag(from, from - Vec2::new(30.0, 60.0));
    let up = position(hand.scene(), SPHERE);
    assert!(up.y > start.y + 0.2 && up.x == start.x && up.z == start.z, "{up}");
    hand.hold(Modifiers::COMMAND);
    let from = hand.place(up) + Vec2::new(30.0, 30.0);
    hand.drag(from, from + Vec2::new(77.0, 13.0));
    let snapped = position(hand.scene(), SPHERE);
    for part in [snapped.x, snapped.z] {
        assert!((10.0 * part - (10.0 * part).round()).abs() < 1e-9, "{snapped}");
    }
    assert!(snapped.x != up.x && snapped.y == up.y);
}

#[test]
fn escape_abandons_what_the_hand_does() {
    let mut hand = Hand::new();
    let before = hand.scene().clone();
    let from = hand.place(position(&before, SPHERE));
    hand.press(from);
    hand.way(from, from + Vec2::new(80.0, 20.0));
    assert!(hand.scene() != &before);
    hand.tap(Key::Escape);
    assert_same(hand.scene(), &before);
    // The button is still down; nothing moves any more.
    hand.way(hand.pos, from + Vec2::new(160.0, 60.0));
    hand.release();
    assert_same(hand.scene(), &before);
    assert_eq!(hand.steps(), 0);
}

#[test]
fn what_is_in_the_hand_is_neither_deleted_nor_undone() {
    let mut hand = Hand::new();
    let before = hand.scene().clone();
    let from = hand.place(position(&before, SPHERE));
    hand.press(from);
    hand.way(from, from + Vec2::new(60.0, 10.0));
    hand.tap(Key::Delete);
    hand.hold(Modifiers::COMMAND);
    hand.tap(Key::Z);
    hand.hold(Modifiers::NONE);
    hand.way(hand.pos, from + Vec2::new(90.0, 20.0));
    hand.release();
    assert_only_moved(&before, &hand.scene().clone(), &[SPHERE]);
    assert_eq!(hand.steps(), 1);
}

#[test]
fn all_that_is_selected_goes_along_but_what_is_locked() {
    let mut hand = Hand::new();
    hand.select(&[
        ScenePart::Body(CONE),
        ScenePart::Body(CYLINDER),
        ScenePart::Light(0),
        ScenePart::Body(SPHERE),
    ]);
    let item = item_at(hand.harness.state(), ScenePart::Body(CYLINDER));
    let lock = catoptric_editor::Action::SetLocked { item, locked: true };
    hand.harness.state_mut().editor_mut().apply(lock).unwrap();
    hand.settle();
    let before = hand.scene().clone();
    let from = hand.place(position(&before, CONE) + 0.4 * DVec3::Y);
    hand.drag(from, from + Vec2::new(-50.0, 20.0));
    let after = hand.scene().clone();
    let way = position(&after, CONE) - position(&before, CONE);
    assert!(way.length() > 0.2);
    assert!((position(&after, SPHERE) - position(&before, SPHERE) - way).length() < 1e-9);
    assert!((after.lights[0].position - before.lights[0].position - way).length() < 1e-9);
    assert_eq!(after.bodies[CYLINDER], before.bodies[CYLINDER]);
    assert_eq!(hand.steps(), 2);
    hand.undo();
    assert_same(hand.scene(), &before);
}

#[test]
fn a_locked_body_can_be_selected_but_does_not_move() {
    let mut hand = Hand::new();
    let lock = catoptric_editor::Action::SetLocked {
        item: item_at(hand.harness.state(), ScenePart::Body(SPHERE)),
        locked: true,
    };
    hand.harness.state_mut().editor_mut().apply(lock).unwrap();
    hand.settle();
    let before = hand.scene().clone();
    let from = hand.place(position(&before, SPHERE));
    hand.click(from);
    assert_eq!(hand.selected(), [ScenePart::Body(SPHERE)]);
    hand.drag(from + Vec2::new(10.0, 0.0), from + Vec2::new(80.0, 0.0));
    assert_eq!(hand.scene().bodies, before.bodies);
    // The view turns instead.
    assert_ne!(hand.scene().camera, before.camera);
}

#[test]
fn the_body_under_the_pointer_is_outlined_and_the_cursor_says_what_would_happen() {
    let mut hand = Hand::new();
    hand.go(hand.place(position(hand.scene(), CYLINDER) + 0.5 * DVec3::Y));
    wait_until(&mut hand.harness, "an outline", |studio| {
        studio.live().latest().is_some_and(|frame| !frame.hover.is_empty())
    });
    assert_eq!(hand.harness.output().platform_output.cursor_icon, egui::CursorIcon::Grab);
    let floor = hand.place(DVec3::new(-1.2, 0.0, 2.6));
    hand.go(floor);
    wait_until(&mut hand.harness, "no outline", |studio| {
        studio.live().latest().is_some_and(|frame| frame.hover.is_empty())
    });
    assert_eq!(hand.harness.output().platform_output.cursor_icon, egui::CursorIcon::Default);
}

#[test]
fn the_right_button_opens_a_menu_about_what_it_points_at() {
    let mut hand = Hand::new();
    hand.go(hand.place(position(hand.scene(), CONE) + 0.4 * DVec3::Y));
    hand.button(PointerButton::Secondary, true);
    hand.button(PointerButton::Secondary, false);
    hand.harness.run_steps(3);
    assert_eq!(hand.selected(), [ScenePart::Body(CONE)]);
    let name = hand.harness.state().texts().get("command-delete").to_owned();
    use egui_kittest::kittest::Queryable as _;
    hand.harness.get_by_label(&name).click();
    hand.harness.run_steps(3);
    assert_eq!(hand.scene().bodies.len(), 4);
}
