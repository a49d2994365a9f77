//! What the tracer found out for lines over the picture: the ground grid and outlines. They belong to the picture that
//! is shown, whatever the camera does meanwhile.

use catoptric_live::{Frame, GridKind, Polyline};
use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, Vec2, vec2};

use crate::base::theme::ThemeColors;

/// The scale from the pixels of a frame to points of the window.
struct FrameScale {
    origin: Pos2,
    factor: Vec2,
}

impl FrameScale {
    fn new(rect: Rect, frame: &Frame) -> Self {
        let [width, height] = frame.view_size.map(|side| side.max(1) as f32);
        Self { origin: rect.min, factor: vec2(rect.width() / width, rect.height() / height) }
    }

    fn pos(&self, at: glam::Vec2) -> Pos2 {
        self.origin + vec2(at.x, at.y) * self.factor
    }
}

/// Draws the ground grid and the axes.
pub(crate) fn grid(painter: &Painter, rect: Rect, frame: &Frame, palette: &ThemeColors) {
    let scale = FrameScale::new(rect, frame);
    let [red, _, blue] = palette.axes;
    for line in frame.grid.iter() {
        let (color, alpha) = match line.kind {
            GridKind::Minor => (Color32::from_gray(176), 0.20),
            GridKind::Major => (Color32::from_gray(190), 0.36),
            GridKind::AxisX => (red, 0.62),
            GridKind::AxisZ => (blue, 0.62),
        };
        let color = color.gamma_multiply(alpha * line.strength.clamp(0.0, 1.0));
        painter.line_segment([scale.pos(line.from), scale.pos(line.to)], Stroke::new(1.0, color));
    }
}

/// Draws the outlines of what is selected, and of what the pointer is over.
pub(crate) fn outlines(painter: &Painter, rect: Rect, frame: &Frame, palette: &ThemeColors) {
    let scale = FrameScale::new(rect, frame);
    for line in frame.hover.iter() {
        let color = Color32::from_white_alpha(if line.hidden { 90 } else { 190 });
        outline(painter, &scale, line, Stroke::new(1.2, color));
    }
    for line in frame.outline.iter() {
        let color = if line.hidden { palette.accent.gamma_multiply(0.55) } else { palette.accent };
        outline(painter, &scale, line, Stroke::new(2.0, color));
    }
}

fn outline(painter: &Painter, scale: &FrameScale, line: &Polyline, stroke: Stroke) {
    let mut points: Vec<Pos2> = line.points.iter().map(|point| scale.pos(*point)).collect();
    if line.hidden {
        if line.closed {
            points.extend(points.first().copied());
        }
        painter.extend(Shape::dashed_line(&points, Stroke::new(0.75 * stroke.width, stroke.color), 5.0, 4.0));
        return;
    }
    // A dark edge keeps it legible over anything.
    let edge = Stroke::new(stroke.width + 1.8, Color32::from_black_alpha(70));
    for stroke in [edge, stroke] {
        let points = points.clone();
        painter.add(if line.closed {
            Shape::closed_line(points, stroke)
        } else {
            Shape::line(points, stroke)
        });
    }
}
