//! Hands and keys in the picture. Bodies are found where the tracer shows them.

mod aim;
mod angle;
mod handles;
mod hands;
mod held_keys;
mod looking;
mod parts;
mod placing;

use catoptric_scene::{Anchor, Scene, ScenePart};
use catoptric_studio::{Command, Studio};
use egui::{Event, Key, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, TouchPhase, Vec2};
use egui_kittest::Harness;
use glam::{DVec2, DVec3};

use crate::kit::{studio, wait_until};

/// The bodies of the example.
const FLOOR: usize = 0;
const SPHERE: usize = 1;
const CUBE: usize = 2;
const CYLINDER: usize = 3;
const CONE: usize = 4;

/// A studio and the hand that uses it.
struct Hand {
    harness: Harness<'static, Studio>,
    pos: Pos2,
    modifiers: Modifiers,
}

impl Hand {
    /// Over the example of four bodies, once it is seen, in a window that shows all of them.
    fn new() -> Self {
        let mut harness = studio();
        harness.set_size(Vec2::new(1600.0, 800.0));
        let mut hand = Self { harness, pos: Pos2::ZERO, modifiers: Modifiers::NONE };
        hand.harness.run_steps(2);
        hand.settle();
        hand
    }

    /// Waits until the picture shows the document as it is, and the eye rests.
    fn settle(&mut self) {
        let mut last = None;
        let mut still = 0;
        for _ in 0..4000 {
            self.harness.step();
            let studio = self.harness.state();
            let revision = studio.editor().revision();
            let is_prepared = studio.live().render_scene().is_some_and(|(of, _)| of == revision);
            let frame = studio.live().latest().filter(|frame| is_prepared && frame.revision == revision);
            let now = frame.map(|frame| (frame.camera, frame.view_size));
            still = if now.is_some() && now == last { still + 1 } else { 0 };
            last = now;
            if still > 10 {
                return;
            }
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        unreachable!("the picture does not come to rest");
    }

    fn scene(&self) -> &Scene {
        self.harness.state().editor().scene()
    }

    fn steps(&self) -> usize {
        self.harness.state().editor().steps_done()
    }

    fn run(&mut self, command: impl Into<Command>) {
        self.harness.state_mut().run(command);
        self.harness.step();
        self.harness.step();
        self.settle();
    }

    fn select(&mut self, items: &[ScenePart]) {
        self.harness.state_mut().editor_mut().select_parts(items.iter().copied());
        self.harness.step();
        self.settle();
    }

    fn selected(&self) -> Vec<ScenePart> {
        self.harness.state().editor().selected_parts().collect()
    }

    fn undo(&mut self) {
        assert!(self.harness.state_mut().editor_mut().undo());
        self.settle();
    }

    /// Where a point of the world is in the window.
    fn place(&self, point: DVec3) -> Pos2 {
        let studio = self.harness.state();
        let (_, render_scene) = studio.live().render_scene().unwrap();
        let frame = studio.live().latest().unwrap();
        let rect = studio.viewport_rect().unwrap();
        let size = DVec2::new(f64::from(rect.width()), f64::from(rect.height()));
        let (at, _) = render_scene.camera_for(&frame.camera).project(point, size).unwrap();
        rect.min + Vec2::new(at.x as f32, at.y as f32)
    }

    /// Meters that a point of the window spans at a point of the world.
    fn meters_per_point(&self, point: DVec3) -> f64 {
        let studio = self.harness.state();
        let (_, render_scene) = studio.live().render_scene().unwrap();
        let [right, ..] = render_scene.camera_for(&studio.live().latest().unwrap().camera).axes();
        let step = 1e-3;
        step / f64::from(self.place(point + step * right).distance(self.place(point)))
    }

    fn go(&mut self, pos: Pos2) {
        self.pos = pos;
        self.event(Event::PointerMoved(pos));
    }

    fn event(&mut self, event: Event) {
        self.harness.event(event);
        self.harness.step();
    }

    fn hold(&mut self, modifiers: Modifiers) {
        self.modifiers = modifiers;
        self.event(Event::ModifiersChanged(modifiers));
    }

    fn button(&mut self, button: PointerButton, pressed: bool) {
        self.event(Event::PointerButton { pos: self.pos, button, pressed, modifiers: self.modifiers });
    }

    fn press(&mut self, pos: Pos2) {
        self.go(pos);
        self.button(PointerButton::Primary, true);
    }

    fn release(&mut self) {
        self.button(PointerButton::Primary, false);
        self.harness.step();
    }

    fn click(&mut self, pos: Pos2) {
        self.press(pos);
        self.release();
    }

    /// Drags with a button in several small moves.
    fn drag_with(&mut self, button: PointerButton, from: Pos2, to: Pos2) {
        self.go(from);
        self.button(button, true);
        self.way(from, to);
        self.button(button, false);
        self.harness.step();
        self.settle();
    }

    fn drag(&mut self, from: Pos2, to: Pos2) {
        self.drag_with(PointerButton::Primary, from, to);
    }

    fn way(&mut self, from: Pos2, to: Pos2) {
        for step in 1..=8 {
            self.go(from.lerp(to, step as f32 / 8.0));
        }
    }

    fn wheel(&mut self, points: f32) {
        self.event(Event::MouseWheel {
            source: MouseWheelSource::Wheel,
            unit: MouseWheelUnit::Point,
            delta: Vec2::new(0.0, points),
            phase: TouchPhase::Move,
            modifiers: self.modifiers,
        });
    }

    /// Presses a key and lets it go within a frame.
    fn tap(&mut self, key: Key) {
        for pressed in [true, false] {
            let event =
                Event::Key { key, physical_key: None, pressed, repeat: false, modifiers: self.modifiers };
            self.harness.input_mut().events.push(event);
        }
        self.harness.step();
    }

    /// Lets so much time pass that gestures of the wheel and the keys are over.
    fn rest(&mut self) {
        self.harness.run_steps(60);
        self.settle();
    }
}

/// The place of a body.
fn position(scene: &Scene, body: usize) -> DVec3 {
    scene.bodies[body].placement.world_from_body().translation
}

fn rotation(scene: &Scene, body: usize) -> DVec3 {
    let Anchor::Frame { rotation_degrees, .. } = scene.bodies[body].placement.anchor else { unreachable!() };
    rotation_degrees
}

/// Asserts that two scenes are equal, without writing both down.
#[track_caller]
fn assert_same(one: &Scene, other: &Scene) {
    assert!(one == other, "the scenes differ");
}

/// Asserts that two scenes differ in nothing but the placement of these bodies.
#[track_caller]
fn assert_only_moved(before: &Scene, after: &Scene, bodies: &[usize]) {
    let mut expected = before.clone();
    for body in bodies {
        assert_ne!(
            expected.bodies[*body].placement, after.bodies[*body].placement,
            "body {body} has not moved"
        );
        expected.bodies[*body].placement = after.bodies[*body].placement;
    }
    assert_same(&expected, after);
}
