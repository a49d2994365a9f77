//! Camera navigation: orbit, pan, dolly, flight.

use catoptric_editor::{Label, navigate};
use catoptric_scene::{Camera, Scene, Shape};
use egui::{Key, Modifiers, Ui, Vec2, ViewportCommand, viewport::CursorGrab};
use glam::DVec3;

use super::scene_view::SceneView;
use super::steering::{Heading, KeyListener, Steering};
use crate::state::command::CameraCommand;
use crate::state::context::Cx;

/// Radians that the camera turns for each point that the pointer moves.
const TURN: f64 = 0.0055;
/// Radians that the camera turns in place for each point that the pointer moves.
const LOOK: f64 = 0.0035;
/// How much closer a point of the wheel brings; a notch is 40 to 50 points.
const WHEEL: f64 = 0.0024;
/// How long after the last turn of the wheel, or the last key, the next still joins it, seconds.
const PAUSE: f64 = 0.4;
/// How fast held keys turn, radians a second; shift, heights of the picture a second; come closer, powers of e.
const KEY_TURN: f64 = 1.2;
const KEY_PAN: f64 = 0.45;
const KEY_DOLLY: f64 = 1.0;

/// The state of camera navigation.
#[derive(Debug)]
pub(crate) struct CameraNavigation {
    /// Until when the wheel's or the keys' gesture stays open, seconds.
    open_until: Option<f64>,
    /// Factor of the speed of flight, set with the wheel.
    pub(crate) speed: f64,
    /// Whether the pointer is caught by the flight.
    is_caught: bool,
    /// The keys that steer.
    steering: Steering,
}

impl Default for CameraNavigation {
    fn default() -> Self {
        Self { open_until: None, speed: 1.0, is_caught: false, steering: Steering::default() }
    }
}

/// Moves the view's camera as far as the scene's range goes: the free one, or the scene's as a part of the gesture
/// `key`.
pub(crate) fn steer(cx: &mut Cx<'_>, key: &'static str, to: Camera) {
    let to = cx.view.range.of_scene(cx.editor.scene()).limit(&camera(cx), to);
    match &mut cx.view.free_camera {
        Some(free) => *free = to,
        None => {
            // A camera that navigation made is valid.
            let _ = cx.editor.navigate(Label::new(key, ""), to);
        }
    }
}

fn camera(cx: &Cx<'_>) -> Camera {
    cx.view.camera(cx.editor.scene())
}

/// Turns about the target as the pointer goes.
pub(crate) fn orbit(cx: &mut Cx<'_>, way: Vec2) {
    turn(cx, -f64::from(way.x) * TURN, f64::from(way.y) * TURN);
}

/// Turns about the target, radians. A floor stops the camera: below it, there would be nothing to see.
fn turn(cx: &mut Cx<'_>, yaw: f64, pitch: f64) {
    let present = camera(cx);
    let floors = floors(cx.editor.scene());
    let sides = |camera: &Camera| -> Vec<bool> {
        floors.iter().map(|(point, normal)| (camera.position - *point).dot(*normal) > 0.0).collect()
    };
    let before = sides(&present);
    let turned = |share: f64| navigate::orbit(&present, yaw, share * pitch);
    let stays = |share: f64| sides(&turned(share)) == before;
    if stays(1.0) || !stays(0.0) {
        return steer(cx, "edit-orbit", turned(1.0));
    }
    let (mut free, mut stopped) = (0.0, 1.0);
    for _ in 0..24 {
        let middle = 0.5 * (free + stopped);
        if stays(middle) {
            free = middle;
        } else {
            stopped = middle;
        }
    }
    steer(cx, "edit-orbit", turned(free));
}

/// A point and a normal of each level plane that is seen.
fn floors(scene: &Scene) -> Vec<(DVec3, DVec3)> {
    let planes = scene.bodies.iter().filter(|body| !body.hidden && body.shape == Shape::Plane);
    planes
        .map(|body| {
            let frame = body.placement.world_from_body();
            (frame.translation, frame.matrix3.y_axis.normalize_or(DVec3::Y))
        })
        .filter(|(_, normal)| normal.y.abs() > 0.999)
        .collect()
}

/// Shifts the picture as the pointer goes.
pub(crate) fn pan(cx: &mut Cx<'_>, scene_view: &SceneView, way: Vec2) {
    let present = camera(cx);
    let meters = scene_view.projector.meters_per_point(present.target);
    let shifted = navigate::pan(&present, -f64::from(way.x) * meters, f64::from(way.y) * meters);
    steer(cx, "edit-pan", shifted);
}

/// Turns the camera in place as the pointer moves.
pub(crate) fn look(cx: &mut Cx<'_>, way: Vec2) {
    let turned = navigate::fly(&camera(cx), DVec3::ZERO, f64::from(way.x) * LOOK, -f64::from(way.y) * LOOK);
    steer(cx, "edit-fly", turned);
}

impl CameraNavigation {
    /// Keeps the gesture of the wheel or the keys open for a while.
    fn keep_open(&mut self, ui: &Ui) {
        self.open_until = Some(ui.input(|input| input.time) + PAUSE);
    }

    /// Ends the gesture of the wheel or the keys when its time is over; to be called in every frame.
    pub(crate) fn settle(&mut self, ui: &Ui, cx: &mut Cx<'_>) {
        let Some(until) = self.open_until else { return };
        let left = until - ui.input(|input| input.time);
        if left > 0.0 {
            cx.view.is_moving = true;
            ui.ctx().request_repaint_after(std::time::Duration::from_secs_f64(left));
        } else {
            self.open_until = None;
            cx.editor.settle();
        }
    }

    /// Comes closer to what is under the pointer, or goes away from it, with the wheel or two fingers.
    pub(crate) fn wheel(&mut self, ui: &Ui, cx: &mut Cx<'_>, scene_view: &SceneView) {
        let (way, zoom, pointer) =
            ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta(), input.pointer.hover_pos()));
        let Some(pointer) = pointer else { return };
        let factor = (-f64::from(way) * WHEEL).exp() / f64::from(zoom.max(0.01));
        let is_rest = |factor: f64| (factor - 1.0).abs() < 1e-6;
        if is_rest(factor) {
            return;
        }
        let present = camera(cx);
        let factor = cx.view.range.of_scene(cx.editor.scene()).allowed_factor(&present, factor);
        if is_rest(factor) {
            return;
        }
        let at = scene_view.at(pointer);
        let reach = present.position.distance(present.target);
        let ray = scene_view.projector.ray(at);
        let met = scene_view.body_at(at).map(|hit| hit.position);
        // Towards the horizon, the camera would be thrown there.
        let met = met.filter(|point| point.distance(present.position) < 4.0 * reach);
        let point = met.unwrap_or_else(|| {
            let [.., forward] = scene_view.projector.axes();
            ray.at((present.target - ray.origin).dot(forward) / ray.direction.dot(forward))
        });
        steer(cx, "edit-dolly", navigate::zoom_towards(&present, point, factor));
        self.keep_open(ui);
        cx.view.is_moving = true;
    }

    /// Takes up the keys of this frame, and for whom they are.
    pub(crate) fn listen(&mut self, ui: &Ui, cx: &Cx<'_>, listener: KeyListener) {
        self.steering.update(ui, cx.held_keys, listener);
    }

    /// Ends whatever moves the camera: another document has come.
    pub(crate) fn stop(&mut self) {
        self.open_until = None;
        self.steering.clear();
    }

    /// Moves the camera by the keys that are held for the picture.
    pub(crate) fn keys(&mut self, ui: &Ui, cx: &mut Cx<'_>, scene_view: &SceneView) {
        let seconds = |way, opposite| self.steering.seconds(way, opposite);
        let arrows = [seconds(Heading::Right, Heading::Left), seconds(Heading::Up, Heading::Down)];
        let dolly = seconds(Heading::Forward, Heading::Back);
        let is_shift = ui.input(|input| input.modifiers.shift);
        let [right, up] = arrows;
        let present = camera(cx);
        if (right != 0.0 || up != 0.0) && is_shift {
            let step = KEY_PAN
                * scene_view.projector.size().y
                * scene_view.projector.meters_per_point(present.target);
            steer(cx, "edit-pan", navigate::pan(&present, right * step, up * step));
        } else if right != 0.0 || up != 0.0 {
            turn(cx, right * KEY_TURN, up * KEY_TURN);
        } else if dolly != 0.0 {
            steer(cx, "edit-dolly", navigate::dolly(&present, (-dolly * KEY_DOLLY).exp()));
        } else {
            return;
        }
        self.keep_open(ui);
        cx.view.is_moving = true;
        ui.ctx().request_repaint();
    }

    /// Flies with W, A, S, D, Q and E; returns whether one of them was held.
    pub(crate) fn fly_keys(&mut self, ui: &Ui, cx: &mut Cx<'_>) -> bool {
        let seconds = |way, opposite| self.steering.seconds(way, opposite);
        let step = DVec3::new(
            seconds(Heading::Right, Heading::Left),
            seconds(Heading::Up, Heading::Down),
            seconds(Heading::Forward, Heading::Back),
        );
        if step == DVec3::ZERO {
            return false;
        }
        let present = camera(cx);
        let range = cx.view.range.of_scene(cx.editor.scene());
        let pace = range.flight_distance(&present) * 0.45 * self.speed;
        let pace = if ui.input(|input| input.modifiers.shift) { 4.0 * pace } else { pace };
        steer(cx, "edit-fly", navigate::fly(&present, pace * step, 0.0, 0.0));
        self.keep_open(ui);
        cx.view.is_moving = true;
        ui.ctx().request_repaint();
        true
    }

    /// A frame of flight. The pointer is caught; what it does turns the view.
    pub(crate) fn fly(&mut self, ui: &Ui, cx: &mut Cx<'_>) {
        let is_covered = !ui.memory(|memory| memory.allows_interaction(ui.layer_id()));
        let is_over = ui.input_mut(|input| {
            is_covered
                || input.consume_key(Modifiers::NONE, Key::Escape)
                || input.consume_key(Modifiers::NONE, Key::Enter)
                || input.pointer.any_pressed()
                || !input.focused
        });
        if is_over {
            cx.run(CameraCommand::ToggleFly);
            return;
        }
        if !self.is_caught {
            self.is_caught = true;
            cx.editor.settle();
            // Of the two ways to catch the pointer, systems refuse one or the other; either will do.
            ui.ctx().send_viewport_cmd(ViewportCommand::CursorGrab(CursorGrab::Locked));
            ui.ctx().send_viewport_cmd(ViewportCommand::CursorGrab(CursorGrab::Confined));
        }
        ui.ctx().set_cursor_icon(egui::CursorIcon::None);
        let (way, wheel) = ui.input(|input| {
            let way = input.pointer.motion().unwrap_or_else(|| input.pointer.delta());
            let wheel = input.smooth_scroll_delta();
            (way, wheel.x + wheel.y)
        });
        if way != Vec2::ZERO {
            look(cx, way);
            self.keep_open(ui);
        }
        self.speed = (self.speed * (f64::from(wheel) * 0.004).exp()).clamp(0.02, 50.0);
        self.fly_keys(ui, cx);
    }

    /// Lets the pointer go after a flight; to be called in every frame without one.
    pub(crate) fn land(&mut self, ui: &Ui, cx: &mut Cx<'_>) {
        if std::mem::take(&mut self.is_caught) {
            ui.ctx().send_viewport_cmd(ViewportCommand::CursorGrab(CursorGrab::None));
            self.open_until = None;
            cx.editor.settle();
        }
    }
}
