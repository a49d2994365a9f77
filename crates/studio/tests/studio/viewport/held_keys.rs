//! Keys that are held, and releases that come otherwise or never.

use catoptric_editor::navigate::CameraRange;
use catoptric_scene::ScenePart;
use catoptric_studio::{CameraCommand, FileCommand, SelectionCommand, WindowCommand};

use super::looking::distance;
use super::*;

/// Presses or lets go a key that the layout labels `key`, at the place `physical` of the keyboard.
fn stroke(hand: &mut Hand, key: Key, physical: Key, pressed: bool) {
    let modifiers = hand.modifiers;
    hand.event(Event::Key { key, physical_key: Some(physical), pressed, repeat: false, modifiers });
}

/// A key that the layout labels as the keyboard does.
fn down(hand: &mut Hand, key: Key) {
    stroke(hand, key, key, true);
}

/// Asserts that nothing moves the camera any more.
#[track_caller]
fn assert_still(hand: &mut Hand) {
    hand.harness.run_steps(3);
    let before = hand.harness.state().view_camera();
    hand.harness.run_steps(10);
    assert_eq!(hand.harness.state().view_camera(), before);
}

#[test]
fn a_plus_that_is_released_as_equals_is_released() {
    let mut hand = Hand::new();
    let before = hand.scene().camera;
    hand.hold(Modifiers::SHIFT);
    stroke(&mut hand, Key::Plus, Key::Equals, true);
    hand.harness.run_steps(3);
    hand.hold(Modifiers::NONE);
    stroke(&mut hand, Key::Equals, Key::Equals, false);
    assert!(distance(&hand.scene().camera) < distance(&before), "it comes closer while it is held");
    assert_still(&mut hand);
    // Again: the second press is no repeat of the first.
    let before = hand.scene().camera;
    hand.hold(Modifiers::SHIFT);
    stroke(&mut hand, Key::Plus, Key::Equals, true);
    hand.hold(Modifiers::NONE);
    stroke(&mut hand, Key::Equals, Key::Equals, false);
    assert!(distance(&hand.scene().camera) < distance(&before));
    assert_still(&mut hand);
}

#[test]
fn a_shortcut_with_plus_enlarges_the_window_and_moves_no_camera() {
    let mut hand = Hand::new();
    let before = hand.scene().camera;
    hand.hold(Modifiers { shift: true, ..Modifiers::CTRL | Modifiers::COMMAND });
    stroke(&mut hand, Key::Plus, Key::Equals, true);
    hand.hold(Modifiers::NONE);
    stroke(&mut hand, Key::Equals, Key::Equals, false);
    hand.rest();
    assert_eq!(hand.scene().camera, before);
    assert_eq!(hand.steps(), 0);
}

#[test]
fn a_shortcut_whose_release_has_another_name_works_every_time() {
    let mut hand = Hand::new();
    for _ in 0..2 {
        hand.run(CameraCommand::ToggleFreeView);
        let before = hand.harness.state().view_camera();
        // Russian: `?` on Shift+7, which looks from below.
        hand.hold(Modifiers::SHIFT);
        stroke(&mut hand, Key::Questionmark, Key::Num7, true);
        hand.hold(Modifiers::NONE);
        stroke(&mut hand, Key::Num7, Key::Num7, false);
        hand.settle();
        assert_ne!(hand.harness.state().view_camera(), before);
        hand.run(CameraCommand::ToggleFreeView);
    }
}

#[test]
fn losing_the_focus_lets_all_keys_go() {
    let mut hand = Hand::new();
    down(&mut hand, Key::ArrowRight);
    hand.harness.run_steps(2);
    hand.event(Event::WindowFocused(false));
    hand.event(Event::WindowFocused(true));
    assert_still(&mut hand);
    // In a flight, too.
    hand.run(CameraCommand::ToggleFly);
    down(&mut hand, Key::W);
    hand.harness.run_steps(2);
    hand.event(Event::WindowFocused(false));
    assert_still(&mut hand);
}

#[test]
fn a_key_that_stops_repeating_is_let_go() {
    let mut hand = Hand::new();
    let before = hand.scene().camera;
    for _ in 0..4 {
        down(&mut hand, Key::ArrowRight);
    }
    assert_ne!(hand.scene().camera, before);
    hand.harness.run_steps(8);
    assert_still(&mut hand);
}

#[test]
fn typed_keys_and_those_of_dialogs_steer_nothing() {
    let mut hand = Hand::new();
    hand.select(&[ScenePart::Body(SPHERE)]);
    let before = hand.scene().camera;
    hand.run(SelectionCommand::Rename);
    stroke(&mut hand, Key::Plus, Key::Equals, true);
    hand.event(Event::Text("+".to_owned()));
    hand.harness.run_steps(3);
    // The field is left while the key is still down, and it repeats.
    let corner = hand.harness.state().viewport_rect().unwrap().right_bottom() - Vec2::splat(60.0);
    hand.click(corner);
    stroke(&mut hand, Key::Plus, Key::Equals, true);
    hand.rest();
    assert_eq!(hand.scene().camera, before);
    hand.event(Event::WindowFocused(false));
    hand.event(Event::WindowFocused(true));
    // A dialog takes over a key that is held.
    down(&mut hand, Key::ArrowRight);
    hand.run(WindowCommand::Palette);
    assert_still(&mut hand);
    hand.tap(Key::Escape);
    assert_still(&mut hand);
}

#[test]
fn another_document_lets_all_keys_go() {
    let mut hand = Hand::new();
    down(&mut hand, Key::PageUp);
    hand.harness.state_mut().run(FileCommand::OpenExample("whitted"));
    hand.harness.run_steps(3);
    assert_eq!(hand.harness.state().editor().title(), "whitted");
    assert_still(&mut hand);
    let example = catoptric_scene::Example::find("whitted").unwrap().load().unwrap().scene;
    assert_eq!(hand.scene().camera, example.camera);
}

#[test]
fn no_navigation_leaves_the_range_of_the_scene() {
    let mut hand = Hand::new();
    let range = CameraRange::of_scene(hand.scene());
    for (key, limit) in [(Key::PageUp, range.nearest()), (Key::PageDown, range.farthest())] {
        down(&mut hand, key);
        hand.harness.run_steps(220);
        stroke(&mut hand, key, key, false);
        hand.harness.run_steps(8);
        let reached = distance(&hand.scene().camera);
        assert!((reached / limit - 1.0).abs() < 1e-6, "{key:?}: {reached} instead of {limit}");
    }
    hand.rest();
    // Nor does the wheel.
    let middle = hand.harness.state().viewport_rect().unwrap().center();
    hand.go(middle);
    for _ in 0..80 {
        hand.wheel(400.0);
    }
    hand.harness.run_steps(8);
    let nearest = distance(&hand.scene().camera);
    assert!(nearest > 0.999 * range.nearest() && nearest < 1.5 * range.nearest(), "{nearest}");
}
