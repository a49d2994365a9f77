//! The hint of the first start: three things to try, over the picture.

use std::sync::Arc;

use catoptric_scene::{Camera, Scene};
use egui::{Align, Align2, Area, Context, Frame, Id, Layout, Order, Rect, RichText, Ui};
use egui_material_icons::icons;
use glam::DVec3;

use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::widgets::{icon_button, icon_ui};
use crate::state::command::{AuditCommand, Command, FileCommand};
use crate::state::context::Cx;

/// The messages of the steps.
const STEPS: [&str; 3] = ["first-move", "first-orbit", "first-reflection"];

/// What there is to go on with when all steps are done.
const NEXT: [(&str, Command); 2] = [
    ("first-gallery", Command::File(FileCommand::Examples)),
    ("first-lab", Command::Audit(AuditCommand::Tool)),
];

/// The state of the first steps.
#[derive(Debug, Default)]
pub(crate) struct FirstSteps {
    done: [bool; 3],
    /// The scene before anything was done to it, and the camera of the view then.
    start: Option<(Arc<Scene>, Camera)>,
    /// The picture is to be seen whole.
    is_held_back: bool,
}

impl FirstSteps {
    /// Shows the hint from its beginning.
    pub(crate) fn open(&mut self, cx: &mut Cx<'_>) {
        let scene = cx.editor.scene();
        *self = Self { start: Some((Arc::clone(scene), cx.view.camera(scene))), ..Self::default() };
        cx.settings.is_hint_dismissed = false;
    }

    /// Leaves the picture of a scene alone that was asked for by name. The hint comes with the next start, or when it is
    /// asked for.
    pub(crate) fn hold_back(&mut self) {
        self.is_held_back = true;
    }
}

/// Cosine of the least angle that counts as a turn of the view, one degree.
const LEAST_TURN: f64 = 0.999_848;

/// Whether the view looks in another direction. The wheel, which scales the way to what is under the pointer, and a
/// shift leave the direction as it is.
fn is_turned(before: &Camera, now: &Camera) -> bool {
    let direction = |camera: &Camera| (camera.target - camera.position).normalize_or(DVec3::NEG_Z);
    direction(before).dot(direction(now)) < LEAST_TURN
}

/// Draws the hint in the corner of the rectangle where the picture is seen, unless it has been dismissed; only keeps up
/// with what was done where there is none.
pub(crate) fn first_steps_ui(context: &Context, cx: &mut Cx<'_>, steps: &mut FirstSteps, view: Option<Rect>) {
    if cx.settings.is_hint_dismissed || steps.is_held_back {
        return;
    }
    watch(cx, steps);
    let Some(view) = view else { return };
    if view.width() < 480.0 || view.height() < 260.0 {
        return;
    }
    let corner = view.left_bottom() + egui::vec2(14.0, -14.0);
    let mut done = CardResponse::default();
    Area::new(Id::unique("first steps"))
        .order(Order::Middle)
        .pivot(Align2::LEFT_BOTTOM)
        .fixed_pos(corner)
        .show(context, |ui| {
            Frame::popup(ui.style()).inner_margin(12.0).show(ui, |ui| {
                ui.set_width(304.0);
                done = card_ui(ui, cx.texts, steps.done);
            });
        });
    cx.settings.is_hint_dismissed |= done.is_closed;
    cx.commands.extend(done.next);
}

/// The button of the card that was pressed.
#[derive(Default)]
struct CardResponse {
    is_closed: bool,
    /// Where the hint leads on to.
    next: Option<Command>,
}

/// Ticks the steps that have been done since the start; a scene that nothing was done to is a new start.
fn watch(cx: &Cx<'_>, steps: &mut FirstSteps) {
    let scene = cx.editor.scene();
    let camera = cx.view.camera(scene);
    let is_fresh = cx.editor.steps().len() == 0 && !cx.editor.is_in_gesture();
    let is_same = steps.start.as_ref().is_some_and(|(start, _)| Arc::ptr_eq(start, scene));
    if steps.start.is_none() || is_fresh && !is_same {
        steps.start = Some((Arc::clone(scene), camera));
        return;
    }
    let Some((start, start_camera)) = &steps.start else { return };
    steps.done[1] |= is_turned(start_camera, &camera);
    if is_same || start.bodies.len() != scene.bodies.len() {
        return;
    }
    let pairs = || start.bodies.iter().zip(&scene.bodies);
    let reflection = |scene: &Scene, body: &catoptric_scene::Body| {
        scene.material(&body.material).and_then(catoptric_scene::Material::reflection)
    };
    steps.done[0] |= pairs().any(|(before, now)| before.placement != now.placement);
    steps.done[2] |= pairs().any(|(before, now)| reflection(start, before) != reflection(scene, now));
}

/// Draws the card.
fn card_ui(ui: &mut Ui, texts: &Texts, done: [bool; 3]) -> CardResponse {
    let palette = theme::palette(ui.visuals());
    let mut pressed = CardResponse::default();
    ui.horizontal(|ui| {
        ui.label(RichText::new(texts.get("first-title")).strong());
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            pressed.is_closed =
                icon_button(ui, icons::ICON_CLOSE, texts.get("first-dismiss"), false).clicked();
        });
    });
    ui.add_space(2.0);
    for (key, is_done) in STEPS.into_iter().zip(done) {
        let (icon, tint, color) = if is_done {
            (icons::ICON_CHECK_CIRCLE, palette.axes[1], palette.weak)
        } else {
            (icons::ICON_RADIO_BUTTON_UNCHECKED, palette.accent, palette.text)
        };
        ui.horizontal_top(|ui| {
            icon_ui(ui, icon, 17.0, tint);
            let step = ui.add(egui::Label::new(RichText::new(texts.get(key)).color(color)).wrap());
            if is_done {
                // Nobody but those who see it would know by the color.
                let told = texts.with("first-step-done", &[("step", texts.get(key).into())]);
                ui.ctx().accesskit_node_builder(step.id, |node| node.set_value(told));
            }
        });
    }
    if done == [true; 3] {
        ui.add_space(4.0);
        ui.add(egui::Label::new(texts.get("first-done")).wrap());
        ui.horizontal_wrapped(|ui| {
            for (key, command) in NEXT {
                let button = ui.button(texts.get(key));
                if button.on_hover_text(texts.tip(key).unwrap_or_default()).clicked() {
                    pressed = CardResponse { is_closed: true, next: Some(command) };
                }
            }
            pressed.is_closed |= ui.button(texts.get("close")).clicked();
        });
    }
    pressed
}

#[cfg(test)]
mod tests {
    use super::*;
    use catoptric_editor::navigate;

    #[test]
    fn the_wheel_and_shifts_are_no_turns() {
        let camera = Camera::default();
        let point = camera.target + DVec3::new(0.7, -0.4, 0.3);
        for factor in [0.2, 0.9, 1.1, 5.0] {
            assert!(!is_turned(&camera, &navigate::zoom_towards(&camera, point, factor)), "{factor}");
        }
        assert!(!is_turned(&camera, &navigate::pan(&camera, 1.0, 2.0)));
        assert!(is_turned(&camera, &navigate::orbit(&camera, 0.1, 0.0)));
        assert!(is_turned(&camera, &navigate::orbit(&camera, 0.0, 0.1)));
    }
}
