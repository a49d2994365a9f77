//! The gizmo, and the handles of lights and of the camera.

use catoptric_scene::ScenePart;
use catoptric_studio::{CameraCommand, DisplayCommand, Tool, ToolCommand};

use super::*;

/// Lengths of the gizmo, points: the arrows, and the rings.
const ARROW: f64 = 84.0;
const RING: f64 = 72.0;

impl Hand {
    /// Where the end of the gizmo's arrow along `axis` is.
    fn arrow(&self, pivot: DVec3, axis: DVec3) -> Pos2 {
        self.place(pivot + ARROW * self.meters_per_point(pivot) * axis)
    }

    /// Pulls an arrow so far that it goes `meters` along its axis.
    fn pull(&mut self, pivot: DVec3, axis: DVec3, meters: f64) {
        let from = self.arrow(pivot, axis);
        let to = self.place(pivot + (meters + ARROW * self.meters_per_point(pivot)) * axis);
        self.drag(from, to);
    }
}

#[test]
fn an_arrow_moves_along_its_axis_alone() {
    let mut hand = Hand::new();
    hand.select(&[ScenePart::Body(SPHERE)]);
    for axis in [DVec3::X, DVec3::Y] {
        let before = hand.scene().clone();
        let start = position(&before, SPHERE);
        hand.pull(start, axis, 0.8);
        let way = position(hand.scene(), SPHERE) - start;
        assert!((way.dot(axis) - 0.8).abs() < 0.03, "{way}");
        for other in DVec3::AXES.into_iter().filter(|other| *other != axis) {
            assert_eq!(way.dot(other), 0.0);
        }
        assert_only_moved(&before, &hand.scene().clone(), &[SPHERE]);
    }
    assert_eq!(hand.steps(), 2);
}

#[test]
fn a_local_arrow_moves_along_the_bodys_own_axis() {
    let mut hand = Hand::new();
    hand.select(&[ScenePart::Body(CUBE)]);
    hand.run(ToolCommand::ToggleGizmoSpace);
    let before = hand.scene().clone();
    let start = position(&before, CUBE);
    let own = before.bodies[CUBE].placement.world_from_body().matrix3.x_axis.normalize();
    hand.hold(Modifiers::COMMAND);
    hand.pull(start, own, 0.43);
    let way = position(hand.scene(), CUBE) - start;
    assert!(way.distance(0.4 * own) < 1e-8, "{way}");
    hand.undo();
    assert_same(hand.scene(), &before);
}

#[test]
fn a_ring_turns_about_its_axis() {
    let mut hand = Hand::new();
    hand.select(&[ScenePart::Body(CONE)]);
    hand.run(ToolCommand::Take(Tool::Rotate));
    // From above, the ring about Y is a circle.
    hand.run(CameraCommand::LookAlong(catoptric_editor::navigate::ViewSide::Top));
    let before = hand.scene().clone();
    let pivot = position(&before, CONE);
    let radius = RING * hand.meters_per_point(pivot);
    let at = |hand: &Hand, degrees: f64| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        hand.place(pivot + radius * DVec3::new(cosine, 0.0, -sine))
    };
    let (from, to) = (at(&hand, 30.0), at(&hand, 68.0));
    hand.drag(from, to);
    let turned = rotation(hand.scene(), CONE);
    assert!((turned - DVec3::new(0.0, 38.0, 0.0)).abs().max_element() < 1.0, "{turned}");
    assert_eq!((turned.x, turned.z), (0.0, 0.0));
    hand.undo();
    hand.hold(Modifiers::COMMAND);
    hand.drag(from, to);
    assert_eq!(rotation(hand.scene(), CONE), DVec3::new(0.0, 45.0, 0.0));
    assert_only_moved(&before, &hand.scene().clone(), &[CONE]);
}

#[test]
fn several_bodies_turn_about_their_middle() {
    let mut hand = Hand::new();
    hand.select(&[ScenePart::Body(SPHERE), ScenePart::Body(CYLINDER)]);
    hand.run(ToolCommand::Take(Tool::Rotate));
    hand.run(CameraCommand::LookAlong(catoptric_editor::navigate::ViewSide::Top));
    let before = hand.scene().clone();
    let places = [SPHERE, CYLINDER].map(|body| position(&before, body));
    let pivot = 0.5 * (places[0] + places[1]);
    let radius = RING * hand.meters_per_point(pivot);
    let at = |hand: &Hand, degrees: f64| {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        hand.place(pivot + radius * DVec3::new(cosine, 0.0, -sine))
    };
    // Beside the places where two rings are seen as one.
    let [from, middle, to] = [25.0, 70.0, 115.0].map(|degrees| at(&hand, degrees));
    hand.hold(Modifiers::COMMAND);
    hand.press(from);
    hand.way(from, middle);
    hand.way(middle, to);
    hand.release();
    for (body, start) in [SPHERE, CYLINDER].into_iter().zip(places) {
        let arm = start - pivot;
        let expected = pivot + DVec3::new(arm.z, arm.y, -arm.x);
        assert!(position(hand.scene(), body).distance(expected) < 1e-6);
        assert_eq!(rotation(hand.scene(), body), DVec3::new(0.0, 90.0, 0.0));
    }
}

#[test]
fn a_cube_scales_along_its_axis() {
    let mut hand = Hand::new();
    hand.select(&[ScenePart::Body(CUBE)]);
    hand.run(ToolCommand::Take(Tool::Scale));
    hand.run(ToolCommand::ToggleGizmoSpace);
    let before = hand.scene().clone();
    let pivot = position(&before, CUBE);
    let length = ARROW * hand.meters_per_point(pivot);
    let own = before.bodies[CUBE].placement.world_from_body().matrix3.x_axis.normalize();
    hand.hold(Modifiers::COMMAND);
    hand.pull(pivot, own, 0.5 * length);
    assert_eq!(hand.scene().bodies[CUBE].placement.scale, DVec3::new(1.5, 1.0, 1.0));
    assert_only_moved(&before, &hand.scene().clone(), &[CUBE]);
    hand.undo();
    // Along the world's X it is scaled in both of its level directions.
    hand.run(ToolCommand::ToggleGizmoSpace);
    hand.hold(Modifiers::COMMAND);
    hand.pull(pivot, DVec3::X, 0.5 * length);
    let scale = hand.scene().bodies[CUBE].placement.scale;
    assert!(scale.x > scale.z && scale.z > 1.0 && scale.y == 1.0, "{scale}");
    hand.undo();
    // All over, from the center.
    let center = hand.place(pivot);
    hand.drag(center, center + Vec2::new(120.0, 0.0));
    assert_eq!(hand.scene().bodies[CUBE].placement.scale, DVec3::splat(2.0));
}

#[test]
fn escape_abandons_a_pull() {
    let mut hand = Hand::new();
    hand.select(&[ScenePart::Body(SPHERE)]);
    let before = hand.scene().clone();
    let pivot = position(&before, SPHERE);
    let from = hand.arrow(pivot, DVec3::Y);
    hand.press(from);
    hand.way(from, from - Vec2::new(0.0, 60.0));
    assert!(hand.scene() != &before);
    hand.tap(Key::Escape);
    hand.release();
    assert_same(hand.scene(), &before);
}

#[test]
fn a_light_is_chosen_and_dragged_by_its_handle() {
    let mut hand = Hand::new();
    hand.run(CameraCommand::FrameAll);
    // From afar, so that the lights are in the picture.
    for _ in 0..3 {
        hand.tap(Key::PageDown);
        hand.tap(Key::PageDown);
        hand.tap(Key::PageDown);
        hand.tap(Key::PageDown);
    }
    hand.rest();
    let before = hand.scene().clone();
    let steps = hand.steps();
    let light = before.lights[1].position;
    let at = hand.place(light);
    assert!(hand.harness.state().viewport_rect().unwrap().shrink(20.0).contains(at), "{at}");
    hand.click(at);
    assert_eq!(hand.selected(), [ScenePart::Light(1)]);
    hand.hold(Modifiers::ALT);
    // Beside the gizmo's center, which is at the light itself.
    let from = at + Vec2::new(8.0, 8.0);
    hand.drag(from, from - Vec2::new(0.0, 40.0));
    let moved = hand.scene().lights[1].position;
    assert!(moved.y > light.y + 0.2 && moved.x == light.x && moved.z == light.z, "{moved}");
    let mut expected = before.clone();
    expected.lights[1].position = moved;
    assert_same(hand.scene(), &expected);
    assert_eq!(hand.steps(), steps + 1);
}

#[test]
fn the_scenes_camera_is_a_thing_in_the_free_view() {
    let mut hand = Hand::new();
    hand.run(CameraCommand::ToggleFreeView);
    for _ in 0..24 {
        hand.tap(Key::PageDown);
    }
    for _ in 0..6 {
        hand.tap(Key::ArrowUp);
    }
    hand.rest();
    let before = hand.scene().clone();
    let at = hand.place(before.camera.position);
    assert!(hand.harness.state().viewport_rect().unwrap().contains(at), "{at}");
    hand.click(at);
    assert_eq!(hand.selected(), [ScenePart::Camera], "{at}");
    hand.select(&[]);
    hand.drag(at, at + Vec2::new(50.0, 0.0));
    let camera = hand.scene().camera;
    assert_ne!(camera.position, before.camera.position);
    let way = camera.position - before.camera.position;
    assert!((camera.target - before.camera.target - way).length() < 1e-9);
    assert_eq!(hand.scene().bodies, before.bodies);
}

#[test]
fn without_handles_nothing_but_bodies_is_taken() {
    let mut hand = Hand::new();
    hand.select(&[ScenePart::Body(SPHERE)]);
    hand.run(DisplayCommand::ToggleHandles);
    let before = hand.scene().clone();
    let pivot = position(&before, SPHERE);
    let far = hand.place(pivot + 2.6 * DVec3::Y);
    hand.drag(far, far - Vec2::new(0.0, 50.0));
    assert_eq!(hand.scene().bodies, before.bodies);
}

#[test]
fn the_picture_tells_what_is_selected_and_brackets_go_on() {
    use egui_kittest::kittest::Queryable as _;
    let mut hand = Hand::new();
    hand.select(&[ScenePart::Body(SPHERE)]);
    hand.harness.get_by_label_contains("Selected: sphere");
    hand.tap(Key::CloseBracket);
    hand.harness.run_steps(2);
    assert_eq!(hand.selected(), [ScenePart::Body(CUBE)]);
    hand.hold(Modifiers::CTRL);
    hand.tap(Key::Tab);
    hand.hold(Modifiers::NONE);
    hand.harness.run_steps(2);
    assert_eq!(hand.selected(), [ScenePart::Body(CYLINDER)]);
    hand.tap(Key::OpenBracket);
    hand.harness.run_steps(2);
    assert_eq!(hand.selected(), [ScenePart::Body(CUBE)]);
}
