//! Moving the camera.

use catoptric_editor::navigate::ViewSide;
use catoptric_scene::{Camera, Projection, ScenePart};
use catoptric_studio::{CameraCommand, WindowCommand};

use super::*;
use crate::kit::item_at;

/// Asserts that two cameras stand at the same place and look at the same point: the picture may show more beside it.
#[track_caller]
fn assert_at(one: &Camera, other: &Camera) {
    let distance = one.position.distance(other.position) + one.target.distance(other.target);
    assert!(distance < 1e-9, "{one:?} instead of {other:?}");
}

pub(super) fn distance(camera: &Camera) -> f64 {
    camera.position.distance(camera.target)
}

/// A place without bodies but the floor.
fn empty(hand: &Hand) -> Pos2 {
    hand.place(DVec3::new(-1.2, 0.0, 2.6))
}

#[test]
fn dragging_beside_the_bodies_orbits_in_one_step() {
    let mut hand = Hand::new();
    let before = hand.scene().clone();
    let from = empty(&hand);
    hand.drag(from, from + Vec2::new(120.0, 30.0));
    let camera = hand.scene().camera;
    assert_eq!(camera.target, before.camera.target);
    assert!((distance(&camera) - distance(&before.camera)).abs() < 1e-9);
    // The scene goes to the right with the hand: the camera goes to the left, and up as the hand goes down.
    assert!(camera.position.x < before.camera.position.x && camera.position.y > before.camera.position.y);
    assert_eq!(hand.scene().bodies, before.bodies);
    assert_eq!(hand.steps(), 1);
    assert!(!hand.harness.state().editor().has_unsaved_work(), "looking at an example is no work");
    hand.undo();
    assert_same(hand.scene(), &before);
    // The right button orbits over bodies, too.
    let ball = hand.place(position(hand.scene(), SPHERE));
    hand.drag_with(PointerButton::Secondary, ball, ball + Vec2::new(60.0, 0.0));
    assert_eq!(hand.scene().bodies, before.bodies);
    assert_ne!(hand.scene().camera, before.camera);
    assert_eq!(hand.selected(), []);
}

#[test]
fn the_floor_stops_an_orbit() {
    let mut hand = Hand::new();
    let from = empty(&hand);
    hand.drag(from, from - Vec2::new(60.0, 200.0));
    let camera = hand.scene().camera;
    assert!(camera.position.y > 0.0 && camera.position.y < 0.05, "{camera:?}");
    // Without the floor there is nothing in the way.
    let hide = catoptric_editor::Action::SetHidden {
        item: item_at(hand.harness.state(), ScenePart::Body(FLOOR)),
        hidden: true,
    };
    hand.harness.state_mut().editor_mut().apply(hide).unwrap();
    hand.settle();
    let sky = hand.harness.state().viewport_rect().unwrap().right_bottom() - Vec2::splat(60.0);
    hand.drag(sky, sky - Vec2::new(0.0, 100.0));
    assert!(hand.scene().camera.position.y < -1.0);
}

#[test]
fn panning_carries_the_picture_with_the_hand() {
    let mut hand = Hand::new();
    let target = hand.scene().camera.target;
    let at = hand.place(target);
    let from = empty(&hand);
    hand.drag_with(PointerButton::Middle, from, from + Vec2::new(70.0, -25.0));
    assert!((hand.place(target) - at - Vec2::new(70.0, -25.0)).length() < 0.5);
    let from = empty(&hand);
    hand.hold(Modifiers::SHIFT);
    hand.drag_with(PointerButton::Secondary, from, from - Vec2::new(70.0, -25.0));
    assert!((hand.place(target) - at).length() < 0.5);
    assert_eq!(hand.steps(), 2);
}

#[test]
fn the_wheel_comes_closer_to_what_is_under_the_pointer_in_one_step() {
    let mut hand = Hand::new();
    let before = hand.scene().clone();
    let point = position(&before, CYLINDER) + DVec3::new(0.0, 1.7, 0.0);
    let at = hand.place(point);
    hand.go(at);
    hand.wheel(50.0);
    hand.wheel(50.0);
    hand.wheel(50.0);
    hand.rest();
    let camera = hand.scene().camera;
    assert!(camera.position.distance(point) < 0.8 * before.camera.position.distance(point));
    assert!(hand.place(point).distance(at) < 6.0);
    assert_eq!(hand.steps(), 1);
    hand.wheel(-150.0);
    hand.rest();
    assert_eq!(hand.steps(), 2);
    assert!(hand.scene().camera.position.distance(before.camera.position) < 0.3);
    hand.undo();
    hand.undo();
    assert_same(hand.scene(), &before);
}

#[test]
fn keys_turn_shift_and_come_closer() {
    let mut hand = Hand::new();
    let before = hand.scene().camera;
    hand.tap(Key::ArrowRight);
    hand.tap(Key::ArrowRight);
    hand.rest();
    let turned = hand.scene().camera;
    assert!(turned.position.x > before.position.x && turned.target == before.target);
    assert_eq!(hand.steps(), 1, "taps close together are one step");
    hand.hold(Modifiers::SHIFT);
    hand.tap(Key::ArrowUp);
    hand.hold(Modifiers::NONE);
    hand.rest();
    assert!(hand.scene().camera.target.y > before.target.y);
    hand.tap(Key::PageUp);
    hand.rest();
    assert!(distance(&hand.scene().camera) < distance(&before));
    assert_eq!(hand.steps(), 3);
}

#[test]
fn the_free_view_leaves_the_scene_alone() {
    let mut hand = Hand::new();
    let before = hand.scene().clone();
    hand.run(CameraCommand::ToggleFreeView);
    let from = empty(&hand);
    hand.drag(from, from + Vec2::new(120.0, 30.0));
    hand.go(from);
    hand.wheel(120.0);
    hand.rest();
    assert_same(hand.scene(), &before);
    assert_eq!(hand.steps(), 0);
    let seen = hand.harness.state().live().latest().unwrap().camera;
    assert!(seen.position.distance(before.camera.position) > 0.5);
    // The camera can be put there.
    use egui_kittest::kittest::Queryable as _;
    let name = hand.harness.state().texts().get("viewport-camera-here").to_owned();
    hand.harness.get_by_label(&name).click();
    hand.harness.run_steps(3);
    hand.settle();
    assert_at(&hand.scene().camera, &seen);
    assert_eq!(hand.steps(), 1);
}

#[test]
fn escape_brings_the_free_view_back() {
    let mut hand = Hand::new();
    hand.run(CameraCommand::ToggleFreeView);
    let before = hand.harness.state().live().latest().unwrap().camera;
    let from = empty(&hand);
    hand.press(from);
    hand.way(from, from + Vec2::new(90.0, 0.0));
    hand.tap(Key::Escape);
    hand.release();
    hand.rest();
    assert_eq!(hand.harness.state().live().latest().unwrap().camera, before);
}

#[test]
fn a_flight_is_one_step_and_ends_with_escape() {
    let mut hand = Hand::new();
    let before = hand.scene().camera;
    hand.go(empty(&hand));
    hand.run(CameraCommand::ToggleFly);
    hand.harness.key_down(Key::W);
    hand.harness.run_steps(20);
    hand.go(hand.pos + Vec2::new(40.0, 0.0));
    hand.harness.key_up(Key::W);
    hand.harness.run_steps(2);
    hand.tap(Key::Escape);
    hand.rest();
    let flown = hand.scene().camera;
    assert!(flown.position.z < before.position.z - 0.5, "{flown:?}");
    assert!((flown.target - flown.position).x > (before.target - before.position).x);
    assert_eq!(hand.steps(), 1);
    // It has landed: the keys mean other things again.
    hand.harness.key_down(Key::W);
    hand.harness.run_steps(10);
    hand.harness.key_up(Key::W);
    hand.rest();
    assert_eq!(hand.scene().camera, flown);
}

#[test]
fn a_flight_ends_where_a_dialog_begins() {
    let mut hand = Hand::new();
    hand.go(empty(&hand));
    hand.run(CameraCommand::ToggleFly);
    hand.run(WindowCommand::Palette);
    hand.rest();
    let before = hand.scene().camera;
    hand.harness.key_down(Key::W);
    hand.harness.run_steps(10);
    hand.harness.key_up(Key::W);
    hand.harness.run_steps(2);
    assert_eq!(hand.scene().camera, before);
}

#[test]
fn framing_and_looking_along_an_axis_arrive() {
    let mut hand = Hand::new();
    hand.select(&[ScenePart::Body(CONE)]);
    let before = hand.scene().clone();
    hand.run(CameraCommand::FrameSelection);
    let camera = hand.scene().camera;
    assert!(camera.target.distance(position(hand.scene(), CONE)) < 0.7);
    assert_at(&hand.harness.state().live().latest().unwrap().camera, &camera);
    assert_eq!(hand.steps(), 1);
    hand.run(CameraCommand::ToggleProjection);
    assert!(matches!(hand.scene().camera.projection, Projection::Parallel { .. }));
    hand.undo();
    hand.undo();
    assert_same(hand.scene(), &before);
    hand.run(CameraCommand::LookAlong(ViewSide::Top));
    assert_same(hand.scene(), &before);
    let seen = hand.harness.state().live().latest().unwrap().camera;
    assert_eq!((seen.position.x, seen.position.z), (seen.target.x, seen.target.z));
}

#[test]
fn the_compass_looks_along_its_axes() {
    use egui_kittest::kittest::Queryable as _;
    let mut hand = Hand::new();
    let name = hand.harness.state().texts().get("viewport-look-right").to_owned();
    hand.harness.get_by_label(&name).click();
    hand.harness.run_steps(4);
    hand.settle();
    let seen = hand.harness.state().live().latest().unwrap().camera;
    assert!(
        seen.position.x > seen.target.x + 1.0 && (seen.position.z - seen.target.z).abs() < 1e-9,
        "{seen:?}"
    );
}

#[test]
fn exposure_changes_the_picture_and_not_the_scene() {
    use egui_kittest::kittest::Queryable as _;
    let mut hand = Hand::new();
    hand.rest();
    let pixels = hand.harness.state().live().latest().unwrap().pixels.clone();
    let text = |hand: &Hand, key: &str| hand.harness.state().texts().get(key).to_owned();
    let name = text(&hand, "viewport-exposure");
    hand.harness.get_by_role_and_label(egui::accesskit::Role::Button, &name).click();
    hand.harness.run_steps(3);
    let name = text(&hand, "viewport-exposure-slider");
    hand.harness.get_by_role_and_label(egui::accesskit::Role::Slider, &name).set_value_accesskit(2.0);
    hand.harness.run_steps(3);
    let filmic = text(&hand, "viewport-tone-filmic");
    hand.harness.get_by_label(&filmic).click();
    hand.harness.run_steps(3);
    let sum = |pixels: &[u8]| pixels.iter().map(|code| u64::from(*code)).sum::<u64>() / pixels.len() as u64;
    let before = sum(&pixels);
    wait_until(&mut hand.harness, "a brighter picture", |studio| {
        studio.live().latest().is_some_and(|frame| sum(&frame.pixels) > before + 10)
    });
    assert_eq!(hand.steps(), 0);
}
