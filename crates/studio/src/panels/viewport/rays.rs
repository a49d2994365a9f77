//! The rays of an audited pixel in the picture's space.

use std::collections::BTreeSet;

use catoptric_lab::audit::NodeKind;
use egui::{Align2, Color32, Painter, Pos2, Shape, Stroke, Vec2, Visuals, vec2};

use super::dashes::dashed;
use super::handles::draw_camera;
use super::scene_view::SceneView;
use crate::base::{plates, theme};
use crate::panels::audit::{kind_color, tag};
use crate::state::audit::{AuditResult, AuditState, RaySegment, SEEN, SegmentKind, SegmentPart, pixel_at};
use crate::state::context::Cx;

/// How near to a ray the pointer takes it, points.
const REACH: f32 = 6.0;
/// Rays shorter than this have no arrow, points.
const ARROW: f32 = 46.0;
/// How far a pulse of slow light is seen, points.
const PULSE: f32 = 4.2;

/// The visible part of a ray segment in the window.
struct VisibleSegment<'a> {
    way: &'a RaySegment,
    ends: [Pos2; 2],
    is_hidden: bool,
}

/// Draws the rays, the audited camera, and the pixel where it is.
pub(crate) fn draw(painter: &Painter, scene_view: &SceneView, cx: &Cx<'_>) {
    let (Some(found), audit) = (cx.audit.found(), &*cx.audit) else { return };
    let is_at_home = found.pin.camera == scene_view.camera;
    if !is_at_home {
        draw_camera(painter, scene_view, &found.pin.camera, Stroke::new(1.5, kind_color(NodeKind::Primary)));
    }
    let pen = RayPainter { painter, scene_view, audit, found, line: line_of(found, audit.selected()) };
    pen.draw();
    if is_at_home && let Some(at) = pixel_at(&found.pin, &scene_view.projector) {
        cross(painter, scene_view.pos(at));
    }
    pen.tag(cx);
}

/// The ray at a place, if one is near: of rays rather than of shadow rays.
pub(crate) fn node_at(scene_view: &SceneView, cx: &Cx<'_>, pos: Pos2) -> Option<usize> {
    let (found, audit) = (cx.audit.found()?, &*cx.audit);
    let mut nearest: Option<(f32, usize)> = None;
    for way in found.ways.iter().filter(|way| audit.shows(way.generation)) {
        let Some([from, to]) = scene_view.projector.segment(way.from, way.to) else { continue };
        let (from, to) = (scene_view.pos(from), scene_view.pos(to));
        if from.distance(to) < 2.0 {
            continue;
        }
        let distance = distance_to(pos, [from, to]) + if way.is_ray() { 0.0 } else { 0.5 * REACH };
        if distance <= REACH && nearest.is_none_or(|(least, _)| distance <= least) {
            nearest = Some((distance, way.node));
        }
    }
    nearest.map(|(_, node)| node)
}

/// A ray with those before it, back to the eye.
fn line_of(found: &AuditResult, node: Option<usize>) -> BTreeSet<usize> {
    let mut line = BTreeSet::new();
    let mut next = node;
    while let Some(place) = next {
        line.insert(place);
        next = found.node(place).and_then(|node| node.ray.parent);
    }
    line
}

fn distance_to(pos: Pos2, [from, to]: [Pos2; 2]) -> f32 {
    let way = to - from;
    let share = ((pos - from).dot(way) / way.length_sq().max(1e-6)).clamp(0.0, 1.0);
    pos.distance(from + share * way)
}

struct RayPainter<'a> {
    painter: &'a Painter,
    scene_view: &'a SceneView,
    audit: &'a AuditState,
    found: &'a AuditResult,
    /// The selected ray and those before it.
    line: BTreeSet<usize>,
}

impl RayPainter<'_> {
    fn draw(&self) {
        let parts = self.audit.hidden_parts();
        let mut pieces = Vec::new();
        for (index, way) in self.found.ways.iter().enumerate() {
            let known = parts.and_then(|parts| parts.get(index)).map_or(SEEN.as_slice(), Vec::as_slice);
            self.pieces(&mut pieces, way, known);
        }
        // What is lit lies over the rest.
        let (lit, others): (Vec<_>, Vec<_>) =
            pieces.into_iter().partition(|piece| self.line.contains(&piece.way.node));
        for pieces in [others, lit] {
            pieces.iter().for_each(|piece| self.casing(piece));
            pieces.iter().for_each(|piece| self.stroke(piece));
        }
        self.ends();
        self.pulses();
    }

    /// What is shown of a way: of its generation, and as far as slow light has come.
    fn pieces<'w>(&self, pieces: &mut Vec<VisibleSegment<'w>>, way: &'w RaySegment, parts: &[SegmentPart]) {
        let share = self.share(way);
        if share <= 0.0 {
            return;
        }
        for part in parts.iter().filter(|part| part.from < share) {
            let point = |at: f64| way.from.lerp(way.to, at);
            let Some([from, to]) =
                self.scene_view.projector.segment(point(part.from), point(part.to.min(share)))
            else {
                continue;
            };
            let ends = [self.scene_view.pos(from), self.scene_view.pos(to)];
            pieces.push(VisibleSegment { way, ends, is_hidden: part.is_hidden });
        }
    }

    /// How much of a way slow light has left behind it.
    fn share(&self, way: &RaySegment) -> f64 {
        if !self.audit.shows(way.generation) {
            return 0.0;
        }
        let [start, end] = way.path;
        match self.audit.light.front {
            Some(front) if end > start => ((front - start) / (end - start)).clamp(0.0, 1.0),
            Some(front) => f64::from(u8::from(front >= end)),
            None => 1.0,
        }
    }

    fn is_selected(&self, way: &RaySegment) -> bool {
        self.audit.selected() == Some(way.node)
    }

    /// The width of a line grows with the ray's weight; shadow rays are thin.
    fn width(&self, way: &RaySegment) -> f32 {
        let weight = way.weight.clamp(0.0, 1.0).sqrt();
        let width = if way.is_ray() { 1.1 + 2.3 * weight } else { 0.8 + 0.5 * weight };
        if self.is_selected(way) { width + 0.8 } else { width }
    }

    fn color(&self, way: &RaySegment) -> Color32 {
        let color = match way.kind {
            SegmentKind::Ray(kind) => kind_color(kind),
            SegmentKind::Lit => Color32::from_rgb(255, 240, 180),
            SegmentKind::Blocked => Color32::from_rgb(242, 104, 92),
        };
        // With one ray lit, the others stand back.
        let is_other = self.audit.selected().is_some_and(|node| node != 0) && !self.line.contains(&way.node);
        let alpha = match (way.is_ray(), is_other) {
            (true, false) => 1.0,
            (true, true) => 0.5,
            (false, false) => 0.72,
            (false, true) => 0.3,
        };
        color.gamma_multiply(alpha)
    }

    /// A dark edge keeps a ray legible over anything; the selected one glows.
    fn casing(&self, piece: &VisibleSegment<'_>) {
        if piece.is_hidden {
            return;
        }
        let (width, color) = (self.width(piece.way), self.color(piece.way));
        let alpha = f32::from(color.a()) / 255.0;
        let dark = Color32::from_black_alpha(130).gamma_multiply(alpha);
        if self.is_selected(piece.way) && piece.way.is_ray() {
            let glow = color.gamma_multiply(0.28);
            self.painter.line_segment(piece.ends, Stroke::new(width + 7.0, glow));
        }
        self.painter.line_segment(piece.ends, Stroke::new(width + 2.0, dark));
    }

    fn stroke(&self, piece: &VisibleSegment<'_>) {
        let (width, color) = (self.width(piece.way), self.color(piece.way));
        if piece.is_hidden {
            let stroke = Stroke::new((0.7 * width).max(0.9), color.gamma_multiply(0.5));
            dashed(self.painter, piece.ends, stroke, 4.0, 4.0);
            return;
        }
        self.painter.line_segment(piece.ends, Stroke::new(width, color));
    }

    /// Arrows along the rays, and dots where they end.
    fn ends(&self) {
        for way in self.found.ways.iter().filter(|way| self.share(way) >= 1.0) {
            let Some([from, to]) = self.scene_view.projector.segment(way.from, way.to) else { continue };
            let ends = [self.scene_view.pos(from), self.scene_view.pos(to)];
            let color = self.color(way);
            if way.is_ray() {
                self.arrow(way, ends, color);
            }
            let radius = 0.5 * self.width(way) + 1.2;
            let dark = Color32::from_black_alpha(150).gamma_multiply(f32::from(color.a()) / 255.0);
            match way.kind {
                SegmentKind::Ray(_) if !way.is_open => {
                    self.painter.circle(ends[1], radius, color, Stroke::new(1.0, dark));
                }
                SegmentKind::Blocked => self.stop(ends, color),
                _ => {}
            }
        }
    }

    fn arrow(&self, way: &RaySegment, [from, to]: [Pos2; 2], color: Color32) {
        let along = to - from;
        if along.length() < ARROW {
            return;
        }
        let direction = along.normalized();
        let size = 3.4 + 1.3 * self.width(way);
        let tip = from + 0.58 * along + 0.5 * size * direction;
        let side = 0.5 * size * direction.rot90();
        let back = tip - size * direction;
        let points = vec![tip, back + side, back - side];
        let dark = Color32::from_black_alpha(130).gamma_multiply(f32::from(color.a()) / 255.0);
        self.painter.add(Shape::convex_polygon(points, color, Stroke::new(1.0, dark)));
    }

    /// A bar across the end of a shadow ray that is blocked.
    fn stop(&self, [from, to]: [Pos2; 2], color: Color32) {
        let along = to - from;
        if along.length() < 8.0 {
            return;
        }
        let side = 4.0 * along.normalized().rot90();
        let dark = Color32::from_black_alpha(130).gamma_multiply(f32::from(color.a()) / 255.0);
        for stroke in [Stroke::new(3.6, dark), Stroke::new(1.8, color)] {
            self.painter.line_segment([to - side, to + side], stroke);
        }
    }

    /// Where slow light is now.
    fn pulses(&self) {
        for way in &self.found.ways {
            let share = self.share(way);
            if share <= 0.0 || share >= 1.0 {
                continue;
            }
            let Some(at) = self.scene_view.point(way.from.lerp(way.to, share)) else { continue };
            let color = self.color(way);
            let radius = PULSE * (0.55 + 0.45 * way.weight.clamp(0.0, 1.0).sqrt());
            for (factor, alpha) in [(2.6, 0.12), (1.7, 0.3)] {
                self.painter.circle_filled(at, factor * radius, color.gamma_multiply(alpha));
            }
            self.painter.circle_filled(at, 0.8 * radius, Color32::WHITE.gamma_multiply(0.92));
        }
    }

    /// The number of the selected ray beside it; the pixel's own needs none.
    fn tag(&self, cx: &Cx<'_>) {
        let Some(place) = self.audit.selected().filter(|place| *place != 0) else { return };
        let way = self.found.ways.iter().find(|way| way.node == place && way.is_ray());
        let (Some(way), Some(node)) = (way, self.found.node(place)) else { return };
        let Some([from, to]) =
            self.scene_view.projector.segment(way.from, way.to).filter(|_| self.share(way) > 0.0)
        else {
            return;
        };
        let middle = self.scene_view.pos(from).lerp(self.scene_view.pos(to), 0.5);
        if self.scene_view.visible.contains(middle) {
            let text = tag(cx.texts, place, node);
            let palette = theme::palette(&Visuals::dark());
            plates::plate(
                self.painter,
                self.scene_view.visible,
                middle + vec2(0.0, -14.0),
                Align2::CENTER_BOTTOM,
                &text,
                palette,
            );
        }
    }
}

/// Marks the audited pixel in its own picture.
fn cross(painter: &Painter, at: Pos2) {
    let strokes = [Stroke::new(3.4, Color32::from_black_alpha(150)), Stroke::new(1.4, Color32::WHITE)];
    for stroke in strokes {
        for turn in 0..4_u8 {
            let arm = Vec2::angled(f32::from(turn) * std::f32::consts::FRAC_PI_2);
            painter.line_segment([at + 5.0 * arm, at + 12.0 * arm], stroke);
        }
        painter.circle_stroke(at, 5.0, Stroke::new(0.8 * stroke.width, stroke.color));
    }
}
