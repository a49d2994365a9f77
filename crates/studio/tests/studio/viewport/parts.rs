//! Parts of joined bodies, found and moved in the picture.

use catoptric_editor::{Action, PartPath, Selection};
use catoptric_scene::ShapeKind;

use super::*;

fn path(places: &[usize]) -> PartPath {
    PartPath::by(places.iter().copied()).unwrap()
}

/// A group of sphere and cube, and where the two are seen.
fn group() -> (Hand, [Pos2; 2]) {
    let mut hand = Hand::new();
    // Beside the arrows of the gizmo.
    let beside = DVec3::new(-0.3, -0.3, 0.0);
    let seen = [SPHERE, CUBE].map(|body| hand.place(position(hand.scene(), body) + beside));
    hand.select(&[SPHERE, CUBE].map(ScenePart::Body));
    hand.run(Command::Edit(Action::Join { shape: ShapeKind::Group, name: "pair".to_owned() }));
    (hand, seen)
}

fn meant(hand: &Hand) -> Option<PartPath> {
    hand.harness.state().editor().selection().part()
}

#[test]
fn clicks_go_from_the_whole_to_its_parts() {
    let (mut hand, [sphere, cube]) = group();
    hand.harness.state_mut().editor_mut().select(Selection::none());
    hand.click(sphere);
    assert_eq!((hand.selected(), meant(&hand)), (vec![ScenePart::Body(SPHERE)], None));
    hand.click(sphere);
    assert_eq!((hand.selected(), meant(&hand)), (vec![ScenePart::Body(SPHERE)], Some(path(&[0]))));
    hand.click(cube);
    assert_eq!(meant(&hand), Some(path(&[1])));
    hand.harness.state_mut().editor_mut().select(Selection::none());
    hand.hold(Modifiers::ALT);
    hand.click(cube);
    assert_eq!(meant(&hand), Some(path(&[1])));
}

#[test]
fn a_drag_moves_the_part_that_is_meant_within_the_whole() {
    let (mut hand, [sphere, cube]) = group();
    hand.click(cube);
    assert_eq!(meant(&hand), Some(path(&[1])));
    let (before, steps) = (hand.scene().bodies[SPHERE].clone(), hand.steps());
    hand.drag(cube, cube + Vec2::new(40.0, 0.0));
    let after = hand.scene().bodies[SPHERE].clone();
    assert_eq!((after.placement, &after.parts[0]), (before.placement, &before.parts[0]));
    assert_ne!(after.parts[1].placement, before.parts[1].placement);
    assert_eq!((hand.steps(), meant(&hand)), (steps + 1, Some(path(&[1]))));
    // Elsewhere the whole is held.
    hand.drag(sphere, sphere + Vec2::new(40.0, 0.0));
    let moved = hand.scene().bodies[SPHERE].clone();
    assert_ne!(moved.placement, after.placement);
    assert_eq!((moved.parts, meant(&hand)), (after.parts, None));
}
