//! Draws the gizmo.

use egui::{Color32, Painter, Pos2, Shape, Stroke};
use glam::DVec2;

use super::handle_drag::HandleDrag;
use super::{CENTER, Gizmo, GizmoHandle, OUTER_RING};
use crate::base::theme::ThemeColors;
use crate::panels::viewport::scene_view::SceneView;
use crate::state::command::Tool;

/// Half the angle of an arrow's head and half the side of a cube, points.
const HEAD: f64 = 5.5;

/// Draws the gizmo; `active` is under the pointer or dragged.
pub(crate) fn draw(
    painter: &Painter,
    scene_view: &SceneView,
    gizmo: &Gizmo,
    active: Option<GizmoHandle>,
    palette: &ThemeColors,
) {
    let Some(center) = scene_view.point(gizmo.pivot) else { return };
    let pen = GizmoPainter { painter, scene_view, gizmo, active, palette };
    match gizmo.tool {
        Tool::Move => {
            (0..3).for_each(|axis| pen.square(axis));
            pen.far_first().into_iter().for_each(|axis| pen.arrow(axis, GizmoHandle::Move(axis)));
            pen.center(center, GizmoHandle::MoveScreen);
        }
        Tool::Rotate => {
            let color = pen.color(palette.text.gamma_multiply(0.75), GizmoHandle::TurnView);
            pen.circle(center, OUTER_RING as f32, color);
            (0..3).for_each(|axis| pen.ring(axis));
        }
        Tool::Scale => {
            pen.far_first().into_iter().for_each(|axis| pen.arrow(axis, GizmoHandle::Scale(axis)));
            pen.center(center, GizmoHandle::ScaleAll);
        }
    }
}

/// Draws what a handle that is being pulled leaves behind: the line of its axis, the sector of a turn.
pub(crate) fn ghost(painter: &Painter, scene_view: &SceneView, drag: &HandleDrag, palette: &ThemeColors) {
    let gizmo = &drag.gizmo;
    let faint = |axis: usize| axis_color(palette, axis).gamma_multiply(0.6);
    match drag.handle {
        GizmoHandle::Move(axis) | GizmoHandle::Scale(axis) => {
            line(painter, scene_view, gizmo, axis, faint(axis));
        }
        GizmoHandle::MovePlane(axis) => {
            for other in [(axis + 1) % 3, (axis + 2) % 3] {
                line(painter, scene_view, gizmo, other, faint(other));
            }
        }
        GizmoHandle::Turn(_) | GizmoHandle::TurnView => {
            let Some(swept) = drag.swept(&scene_view.projector) else { return };
            let points: Vec<Pos2> = swept.into_iter().map(|at| scene_view.pos(at)).collect();
            let Some(middle) = points.first() else { return };
            let fill = palette.accent.gamma_multiply(0.22);
            for pair in points.get(1..).unwrap_or_default().windows(2) {
                if let [from, to] = pair {
                    painter.add(Shape::convex_polygon(vec![*middle, *from, *to], fill, Stroke::NONE));
                }
            }
            for end in [points.get(1), points.last()].into_iter().flatten() {
                painter.line_segment([*middle, *end], Stroke::new(1.2, palette.accent));
            }
        }
        GizmoHandle::MoveScreen | GizmoHandle::ScaleAll => {}
    }
}

/// The whole line of an axis.
fn line(painter: &Painter, scene_view: &SceneView, gizmo: &Gizmo, axis: usize, color: Color32) {
    let reach = 40.0 * scene_view.projector.depth(gizmo.pivot);
    let step = reach * gizmo.axis(axis);
    if let Some([from, to]) = scene_view.projector.segment(gizmo.pivot - step, gizmo.pivot + step) {
        painter.line_segment([scene_view.pos(from), scene_view.pos(to)], Stroke::new(1.0, color));
    }
}

fn axis_color(palette: &ThemeColors, axis: usize) -> Color32 {
    palette.axes.get(axis).copied().unwrap_or(palette.text)
}

struct GizmoPainter<'a> {
    painter: &'a Painter,
    scene_view: &'a SceneView,
    gizmo: &'a Gizmo,
    active: Option<GizmoHandle>,
    palette: &'a ThemeColors,
}

impl GizmoPainter<'_> {
    /// The color of a handle: bright when it is active, faint when it cannot be dragged from here.
    fn color(&self, color: Color32, handle: GizmoHandle) -> Color32 {
        if self.active == Some(handle) {
            return Color32::from_rgb(255, 214, 92);
        }
        let others = if self.active.is_some() { 0.7 } else { 1.0 };
        color.gamma_multiply(others * self.gizmo.clearness(&self.scene_view.projector, handle) as f32)
    }

    /// The axes, the farthest end first.
    fn far_first(&self) -> [usize; 3] {
        let mut axes = [0, 1, 2];
        let [.., forward] = self.scene_view.projector.axes();
        axes.sort_by(|a, b| {
            let depth = |axis: usize| self.gizmo.axis(axis).dot(forward);
            depth(*b).total_cmp(&depth(*a))
        });
        axes
    }

    /// A line with a dark edge, legible over any picture.
    fn line(&self, points: Vec<Pos2>, color: Color32, width: f32) {
        let edge = Color32::from_black_alpha((f32::from(color.a()) * 0.35) as u8);
        self.painter.add(Shape::line(points.clone(), Stroke::new(width + 2.0, edge)));
        self.painter.add(Shape::line(points, Stroke::new(width, color)));
    }

    /// A shaft with an arrow's head for moving, or a cube for scaling.
    fn arrow(&self, axis: usize, handle: GizmoHandle) {
        let Some([from, to]) = self.gizmo.shaft(&self.scene_view.projector, axis) else { return };
        let color = self.color(axis_color(self.palette, axis), handle);
        if color.a() < 8 {
            return;
        }
        let width = if self.active == Some(handle) { 3.4 } else { 2.6 };
        self.line([from, to].map(|at| self.scene_view.pos(at)).to_vec(), color, width);
        let along = (to - from).normalize_or(DVec2::X);
        let aside = along.perp();
        let corners = match handle {
            GizmoHandle::Scale(_) => [
                to + HEAD * (along + aside),
                to + HEAD * (along - aside),
                to - HEAD * (along + aside),
                to - HEAD * (along - aside),
            ]
            .to_vec(),
            _ => [to + 2.4 * HEAD * along, to + HEAD * aside, to - HEAD * aside].to_vec(),
        };
        let points = corners.into_iter().map(|at| self.scene_view.pos(at)).collect();
        let edge = Stroke::new(1.0, Color32::from_black_alpha(color.a() / 3));
        self.painter.add(Shape::convex_polygon(points, color, edge));
    }

    fn square(&self, axis: usize) {
        let handle = GizmoHandle::MovePlane(axis);
        let Some(corners) = self.gizmo.square(&self.scene_view.projector, axis) else { return };
        let color = self.color(axis_color(self.palette, axis), handle);
        if color.a() < 8 {
            return;
        }
        let points = corners.into_iter().map(|at| self.scene_view.pos(at)).collect();
        let fill = color.gamma_multiply(if self.active == Some(handle) { 0.7 } else { 0.4 });
        self.painter.add(Shape::convex_polygon(points, fill, Stroke::new(1.2, color)));
    }

    /// The near half of a ring, strong, and the far half, faint.
    fn ring(&self, axis: usize) {
        let handle = GizmoHandle::Turn(axis);
        let color = self.color(axis_color(self.palette, axis), handle);
        let ring = self.gizmo.ring(&self.scene_view.projector, axis);
        let mut near = Vec::new();
        for pair in ring.windows(2) {
            let [(from, is_near), (to, _)] = pair else { continue };
            let (from, to) = (self.scene_view.pos(*from), self.scene_view.pos(*to));
            if *is_near {
                if near.is_empty() {
                    near.push(from);
                }
                near.push(to);
                continue;
            }
            self.painter.line_segment([from, to], Stroke::new(1.0, color.gamma_multiply(0.3)));
            self.near_arc(std::mem::take(&mut near), color, handle);
        }
        self.near_arc(near, color, handle);
    }

    fn near_arc(&self, points: Vec<Pos2>, color: Color32, handle: GizmoHandle) {
        if points.len() > 1 {
            self.line(points, color, if self.active == Some(handle) { 3.2 } else { 2.2 });
        }
    }

    fn center(&self, center: Pos2, handle: GizmoHandle) {
        let color = self.color(Color32::from_gray(236), handle);
        self.painter.circle(
            center,
            CENTER as f32 - 1.5,
            color.gamma_multiply(0.35),
            Stroke::new(3.4, Color32::from_black_alpha(70)),
        );
        self.painter.circle_stroke(center, CENTER as f32 - 1.5, Stroke::new(1.8, color));
    }

    fn circle(&self, center: Pos2, radius: f32, color: Color32) {
        self.painter.circle_stroke(center, radius, Stroke::new(3.2, Color32::from_black_alpha(60)));
        self.painter.circle_stroke(center, radius, Stroke::new(1.4, color));
    }
}
