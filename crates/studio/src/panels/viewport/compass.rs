//! The compass of the axes, in the upper right corner; a click looks along one of them.

use catoptric_editor::navigate::ViewSide;
use egui::accesskit::Role;
use egui::{Align2, Color32, FontId, Pos2, Rect, Sense, Stroke, Ui, Vec2, Visuals, WidgetInfo, vec2};
use glam::DVec3;

use super::scene_view::SceneView;
use crate::base::theme;
use crate::state::command::CameraCommand;
use crate::state::context::Cx;

/// Length of an arm, points.
const ARM: f32 = 32.0;
/// Radius of the discs at the ends, points.
const DISC: f32 = 9.0;

/// Width and height of the corner that it takes, points.
pub(crate) const WIDTH: f32 = 2.0 * (ARM + DISC + 12.0);

/// Whether there is room for it.
pub(crate) fn fits(rect: Rect) -> bool {
    rect.width() > 2.0 * WIDTH && rect.height() > 1.5 * WIDTH
}

/// An end of an axis.
struct AxisEnd {
    side: ViewSide,
    direction: DVec3,
    /// Which color and letter.
    axis: usize,
    key: &'static str,
}

/// The six ends, in the order of the keyboard.
const ENDS: [AxisEnd; 6] = [
    AxisEnd { side: ViewSide::Right, direction: DVec3::X, axis: 0, key: "viewport-look-right" },
    AxisEnd { side: ViewSide::Left, direction: DVec3::NEG_X, axis: 0, key: "viewport-look-left" },
    AxisEnd { side: ViewSide::Top, direction: DVec3::Y, axis: 1, key: "viewport-look-top" },
    AxisEnd { side: ViewSide::Bottom, direction: DVec3::NEG_Y, axis: 1, key: "viewport-look-bottom" },
    AxisEnd { side: ViewSide::Front, direction: DVec3::Z, axis: 2, key: "viewport-look-front" },
    AxisEnd { side: ViewSide::Back, direction: DVec3::NEG_Z, axis: 2, key: "viewport-look-back" },
];

impl AxisEnd {
    fn is_positive(&self) -> bool {
        self.direction.max_element() > 0.5
    }
}

/// Draws the compass.
pub(crate) fn compass_ui(ui: &mut Ui, cx: &mut Cx<'_>, scene_view: &SceneView) {
    let palette = theme::palette(&Visuals::dark());
    let center = scene_view.visible.right_top() + vec2(-0.5 * WIDTH, 0.5 * WIDTH);
    if !fits(scene_view.visible) {
        return;
    }
    let [right, up, forward] = scene_view.projector.axes();
    let place = |end: &AxisEnd| -> (Pos2, f64) {
        let aside = vec2(end.direction.dot(right) as f32, -end.direction.dot(up) as f32);
        (center + ARM * aside, end.direction.dot(forward))
    };
    let painter = ui.painter().clone();
    painter.circle_filled(center, ARM + DISC + 4.0, palette.panel.gamma_multiply(0.35));
    let mut ends: Vec<(&AxisEnd, Pos2, f64)> =
        ENDS.iter().map(|end| (end, place(end).0, place(end).1)).collect();
    // The widgets first, in a steady order; egui gives the last of those that overlap to the pointer, and so the
    // nearest must be asked for by hand.
    let responses: Vec<_> = ENDS.iter().map(|end| end_response(ui, cx, end, place(end).0)).collect();
    let pointer = ui.input(|input| input.pointer.hover_pos());
    let is_over = |pos: &Pos2| pointer.is_some_and(|pointer| pointer.distance(*pos) <= DISC + 2.0);
    let any_hovered = responses.iter().any(egui::Response::hovered);
    let nearest = ends
        .iter()
        .filter(|(_, pos, _)| any_hovered && is_over(pos))
        .min_by(|a, b| a.2.total_cmp(&b.2))
        .map(|(end, ..)| end.side);
    let is_clicked = responses.iter().any(|response| response.clicked_by(egui::PointerButton::Primary));
    let by_keys = responses.iter().zip(&ENDS).find(|(response, _)| response.clicked() && !is_clicked);
    let chosen = if is_clicked { nearest } else { by_keys.map(|(_, end)| end.side) };
    let focused =
        responses.iter().zip(&ENDS).find(|(response, _)| response.has_focus()).map(|(_, end)| end.side);
    ends.sort_by(|a, b| b.2.total_cmp(&a.2));
    for (end, pos, depth) in &ends {
        let is_bright = nearest == Some(end.side) || focused == Some(end.side);
        end_ui(&painter, center, (*end, *pos, *depth), is_bright, palette);
    }
    if let Some(side) = chosen {
        // From where the view already looks, the click goes to the other side.
        let side = if is_already_there(side, forward) { opposite(side) } else { side };
        cx.run(CameraCommand::LookAlong(side));
    }
}

fn end_response(ui: &mut Ui, cx: &Cx<'_>, end: &AxisEnd, pos: Pos2) -> egui::Response {
    let rect = Rect::from_center_size(pos, Vec2::splat(2.0 * (DISC + 2.0)));
    let response = ui.interact(rect, ui.scope_id().with(("compass", end.key)), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, cx.t(end.key)));
    response.on_hover_cursor(egui::CursorIcon::PointingHand).on_hover_text(cx.t(end.key))
}

fn end_ui(
    painter: &egui::Painter,
    center: Pos2,
    (end, pos, depth): (&AxisEnd, Pos2, f64),
    is_bright: bool,
    palette: &theme::ThemeColors,
) {
    let color = palette.axes.get(end.axis).copied().unwrap_or(palette.text);
    // What points away is fainter.
    let strength = 0.72 - 0.28 * depth as f32;
    let color = if is_bright { color } else { color.gamma_multiply(strength.clamp(0.4, 1.0)) };
    if end.is_positive() {
        painter.line_segment([center, pos], Stroke::new(2.2, color));
        painter.circle_filled(pos, DISC, color);
        let letter = ["X", "Y", "Z"].get(end.axis).copied().unwrap_or_default();
        let ink = Color32::from_rgb(20, 22, 26);
        painter.text(pos, Align2::CENTER_CENTER, letter, FontId::proportional(12.0), ink);
    } else {
        painter.circle(pos, DISC - 2.5, color.gamma_multiply(0.30), Stroke::new(1.4, color));
    }
    if is_bright {
        painter.circle_stroke(pos, DISC + 1.5, Stroke::new(1.5, Color32::WHITE));
    }
}

fn is_already_there(side: ViewSide, forward: DVec3) -> bool {
    ENDS.iter().any(|end| end.side == side && end.direction.dot(forward) < -0.9999)
}

fn opposite(side: ViewSide) -> ViewSide {
    match side {
        ViewSide::Front => ViewSide::Back,
        ViewSide::Back => ViewSide::Front,
        ViewSide::Left => ViewSide::Right,
        ViewSide::Right => ViewSide::Left,
        ViewSide::Top => ViewSide::Bottom,
        ViewSide::Bottom => ViewSide::Top,
    }
}
