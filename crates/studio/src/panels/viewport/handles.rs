//! The handles of lights, and of the scene's camera in the free view.

use catoptric_editor::Item;
use catoptric_scene::{Camera, Light, Projection, ScenePart};
use egui::{Color32, Painter, Pos2, Stroke};
use glam::DVec3;

use super::dashes::dashed;
use super::scene_view::{SceneView, marks};
use crate::base::projector::Projector;
use crate::base::theme::ThemeColors;
use crate::state::context::Cx;

/// Radius of a light's disc, points.
const DISC: f32 = 6.0;

/// Draws them; `hovered` is under the pointer.
pub(crate) fn draw(
    painter: &Painter,
    scene_view: &SceneView,
    cx: &Cx<'_>,
    hovered: Option<Item>,
    palette: &ThemeColors,
) {
    let scene = cx.editor.scene();
    for item in marks(cx) {
        let is_selected = cx.editor.selection().contains(item);
        let pen =
            HandlePainter { painter, scene_view, palette, is_selected, is_hovered: hovered == Some(item) };
        match cx.editor.edited().part(item) {
            Some(ScenePart::Light(index)) => {
                if let Some(light) = scene.lights.get(index) {
                    pen.light(light);
                }
            }
            Some(ScenePart::Camera) => pen.camera(&scene.camera),
            _ => {}
        }
    }
}

struct HandlePainter<'a> {
    painter: &'a Painter,
    scene_view: &'a SceneView,
    palette: &'a ThemeColors,
    is_selected: bool,
    is_hovered: bool,
}

impl HandlePainter<'_> {
    fn light(&self, light: &Light) {
        if self.is_selected {
            self.drop_line(light.position);
        }
        let Some(center) =
            self.scene_view.point(light.position).filter(|at| self.scene_view.visible.contains(*at))
        else {
            return;
        };
        let faint = if light.hidden { 0.4 } else { 1.0 };
        let disc = if self.is_hovered { DISC + 1.0 } else { DISC };
        let fill = shown_color(light).gamma_multiply(faint);
        let dark = Color32::from_black_alpha(170).gamma_multiply(faint);
        let ray = |index: u8, inner: f32, outer: f32| -> [Pos2; 2] {
            let direction = egui::Vec2::angled(f32::from(index) * std::f32::consts::FRAC_PI_4);
            [center + inner * direction, center + outer * direction]
        };
        if !light.hidden {
            for index in 0..8 {
                self.painter.line_segment(ray(index, disc + 2.0, disc + 7.0), Stroke::new(4.0, dark));
            }
            for index in 0..8 {
                self.painter.line_segment(ray(index, disc + 2.5, disc + 6.0), Stroke::new(1.8, fill));
            }
        }
        self.painter.circle(center, disc, fill, Stroke::new(1.4, dark));
        if self.is_selected || self.is_hovered {
            let color = if self.is_selected { self.palette.accent } else { Color32::from_white_alpha(190) };
            self.painter.circle_stroke(center, disc + 10.5, Stroke::new(3.4, Color32::from_black_alpha(80)));
            self.painter.circle_stroke(center, disc + 10.5, Stroke::new(1.8, color));
        }
    }

    /// A line down to the ground y = 0, and a cross where it arrives.
    fn drop_line(&self, from: DVec3) {
        let foot = DVec3::new(from.x, 0.0, from.z);
        let Some([top, bottom]) = self.scene_view.projector.segment(from, foot) else { return };
        let color = self.palette.accent.gamma_multiply(0.8);
        let points = [self.scene_view.pos(top), self.scene_view.pos(bottom)];
        dashed(self.painter, points, Stroke::new(1.2, color), 4.0, 4.0);
        let arm = 8.0 * self.scene_view.projector.meters_per_point(foot);
        for direction in [DVec3::X, DVec3::Z] {
            if let Some([from, to]) =
                self.scene_view.projector.segment(foot - arm * direction, foot + arm * direction)
            {
                let ends = [self.scene_view.pos(from), self.scene_view.pos(to)];
                self.painter.line_segment(ends, Stroke::new(1.4, color));
            }
        }
    }

    fn camera(&self, camera: &Camera) {
        let color = if self.is_selected {
            self.palette.accent
        } else if self.is_hovered {
            Color32::WHITE
        } else {
            Color32::from_gray(214)
        };
        let width = if self.is_selected || self.is_hovered { 1.8 } else { 1.3 };
        draw_camera(self.painter, self.scene_view, camera, Stroke::new(width, color));
    }
}

/// Draws a camera: a pyramid from the eye to the edges of the picture, and a mark that shows where up is.
pub(crate) fn draw_camera(painter: &Painter, scene_view: &SceneView, camera: &Camera, stroke: Stroke) {
    // Large enough to be seen from afar.
    let least = 40.0 * scene_view.projector.meters_per_point(camera.position);
    let [eye, corners, top] = frustum(camera, least);
    let mut segments: Vec<[DVec3; 2]> = Vec::new();
    for index in 0..4 {
        let (Some(corner), Some(next)) = (corners.get(index), corners.get((index + 1) % 4)) else { continue };
        segments.push([*corner, *next]);
        segments.extend(eye.get(index).map(|eye| [*eye, *corner]));
    }
    if let [left, tip, right] = *top.as_slice() {
        segments.extend([[left, tip], [tip, right]]);
    }
    for stroke in [Stroke::new(stroke.width + 2.0, Color32::from_black_alpha(90)), stroke] {
        for [from, to] in &segments {
            if let Some([from, to]) = scene_view.projector.segment(*from, *to) {
                painter.line_segment([scene_view.pos(from), scene_view.pos(to)], stroke);
            }
        }
    }
    if let Some(center) = scene_view.point(camera.position) {
        painter.circle(center, 4.5, stroke.color, Stroke::new(1.2, Color32::from_black_alpha(150)));
    }
}

/// The edges of what a camera sees: where its rays begin, the corners at a distance of at least `least` meters, and the
/// mark above them.
fn frustum(camera: &Camera, least: f64) -> [Vec<DVec3>; 3] {
    const ASPECT: f64 = 1.5;
    let [right, up, forward] = Projector::new(camera, glam::DVec2::ONE).axes();
    let reach = (0.16 * camera.position.distance(camera.target)).max(least);
    let (half, is_perspective) = match camera.projection {
        Projection::Perspective { fov_degrees } => (reach * (0.5 * fov_degrees).to_radians().tan(), true),
        Projection::Parallel { height } => (0.5 * height, false),
    };
    let half = half.min(3.0 * reach);
    let corner =
        |depth: f64, x: f64, y: f64| camera.position + depth * forward + half * (ASPECT * x * right + y * up);
    let around =
        |depth: f64| [(-1.0, 1.0), (1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)].map(|(x, y)| corner(depth, x, y));
    let eye = if is_perspective { vec![camera.position; 4] } else { around(0.0).to_vec() };
    let top = vec![corner(reach, -0.35, 1.12), corner(reach, 0.0, 1.7), corner(reach, 0.35, 1.12)];
    [eye, around(reach).to_vec(), top]
}

/// A light's color at full brightness, as a display shows it.
pub(crate) fn shown_color(light: &Light) -> Color32 {
    let linear = light.color.to_array();
    let most = linear.iter().copied().fold(0.0, f64::max);
    let [red, green, blue] = linear.map(|part| {
        let part = if most > 0.0 { part / most } else { 1.0 };
        egui::ecolor::gamma_u8_from_linear_f32(part.clamp(0.0, 1.0) as f32)
    });
    Color32::from_rgb(red, green, blue)
}
