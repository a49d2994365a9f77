//! Arrows at the edge of the picture towards lights, and in the free view the camera, that are out of view.

use catoptric_editor::Item;
use catoptric_scene::ScenePart;
use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, Vec2, vec2};
use glam::DVec3;

use super::drag_payload::place_of;
use super::handles;
use super::scene_view::{SceneView, marks};
use crate::base::theme::ThemeColors;
use crate::state::context::Cx;

/// The distance from the edges of the picture, points.
const MARGIN: f32 = 20.0;
/// Radius of an arrow's disc, and how near to its middle the pointer takes it, points.
const DISC: f32 = 7.0;
const REACH: f32 = 14.0;

/// An arrow towards a thing that is out of view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct OffscreenArrow {
    /// What it points to.
    pub(crate) item: Item,
    /// The middle of the arrow in the window.
    pub(crate) center: Pos2,
    /// Where it points in the picture; of length 1.
    direction: Vec2,
}

/// The arrows of all that is out of view. Those that would cover each other stand side by side.
pub(crate) fn arrows(cx: &Cx<'_>, scene_view: &SceneView) -> Vec<OffscreenArrow> {
    let mut arrows: Vec<OffscreenArrow> = Vec::new();
    let room = room(scene_view.clear);
    for item in marks(cx) {
        let place = place_of(cx.editor.edited(), item);
        let Some(direction) = place.and_then(|place| direction_to(scene_view, place)) else { continue };
        let along = vec2(-direction.y, direction.x);
        let edge = edge_point(room, scene_view.rect.center(), direction);
        // To one side and the other, ever farther.
        let steps =
            (0..64).map(|step: i16| f32::from((step + 1) / 2) * if step % 2 == 0 { 1.0 } else { -1.0 });
        let is_free = |center: &Pos2| arrows.iter().all(|other| other.center.distance(*center) > 2.0 * REACH);
        let center = steps.map(|step| room.clamp(edge + step * REACH * along)).find(is_free);
        arrows.push(OffscreenArrow { item, center: center.unwrap_or(edge), direction });
    }
    arrows
}

/// The arrow under a place of the window.
pub(crate) fn arrow_at(cx: &Cx<'_>, scene_view: &SceneView, pos: Pos2) -> Option<Item> {
    let near = |arrow: &OffscreenArrow| arrow.center.distance(pos);
    let arrows = arrows(cx, scene_view).into_iter().filter(|arrow| near(arrow) <= REACH);
    arrows.min_by(|a, b| near(a).total_cmp(&near(b))).map(|arrow| arrow.item)
}

/// Where in the picture an arrow must point for something to come into view; `None` for what is in view.
fn direction_to(scene_view: &SceneView, place: DVec3) -> Option<Vec2> {
    let at = scene_view.point(place);
    if at.is_some_and(|at| scene_view.visible.contains(at)) {
        return None;
    }
    let [right, up, _] = scene_view.projector.axes();
    let offset = place - scene_view.projector.position();
    let direction = vec2(offset.dot(right) as f32, -offset.dot(up) as f32);
    // What is right behind the eye can be reached by a turn to any side.
    Some(if direction.length() > 0.0 { direction.normalized() } else { Vec2::DOWN })
}

/// Where arrows may stand.
fn room(rect: Rect) -> Rect {
    rect.shrink(MARGIN.min(0.2 * rect.width()).min(0.2 * rect.height()))
}

/// Where the line from the picture's `middle` in a direction meets the edge of `room`.
fn edge_point(room: Rect, middle: Pos2, direction: Vec2) -> Pos2 {
    let middle = room.clamp(middle);
    let factor = |before: f32, behind: f32, part: f32| match part {
        0.0 => f32::INFINITY,
        _ => (if part < 0.0 { before } else { behind }) / part.abs(),
    };
    let across = factor(middle.x - room.left(), room.right() - middle.x, direction.x);
    let down = factor(middle.y - room.top(), room.bottom() - middle.y, direction.y);
    room.clamp(middle + across.min(down).min(1e6) * direction)
}

/// Draws the arrows; `hovered` is under the pointer.
pub(crate) fn draw(
    painter: &Painter,
    scene_view: &SceneView,
    cx: &Cx<'_>,
    hovered: Option<Item>,
    palette: &ThemeColors,
) {
    let scene = cx.editor.scene();
    for OffscreenArrow { item, center, direction } in arrows(cx, scene_view) {
        let fill = match cx.editor.edited().part(item) {
            Some(ScenePart::Light(index)) => {
                scene.lights.get(index).map_or(Color32::WHITE, handles::shown_color)
            }
            _ => Color32::from_gray(214),
        };
        let fill = if cx.editor.edited().is_hidden(item) { fill.gamma_multiply(0.4) } else { fill };
        let is_selected = cx.editor.selection().contains(item);
        let dark = Color32::from_black_alpha(170);
        let across = vec2(-direction.y, direction.x);
        let tip = center + (DISC + 9.0) * direction;
        let base = center + (DISC + 1.5) * direction;
        let head = vec![tip, base + 6.0 * across, base - 6.0 * across];
        painter.add(Shape::convex_polygon(head, fill, Stroke::new(1.4, dark)));
        painter.circle(center, DISC, fill, Stroke::new(1.4, dark));
        if is_selected || hovered == Some(item) {
            let color = if is_selected { palette.accent } else { Color32::from_white_alpha(190) };
            painter.circle_stroke(center, DISC + 3.0, Stroke::new(3.4, Color32::from_black_alpha(80)));
            painter.circle_stroke(center, DISC + 3.0, Stroke::new(1.8, color));
        }
    }
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    #[test]
    fn arrows_stand_at_the_edge_in_their_direction() {
        let room = Rect::from_min_max(pos2(10.0, 20.0), pos2(110.0, 60.0));
        let middle = pos2(60.0, 30.0);
        assert_eq!(edge_point(room, middle, Vec2::RIGHT), pos2(110.0, 30.0));
        assert_eq!(edge_point(room, middle, Vec2::UP), pos2(60.0, 20.0));
        let corner = edge_point(room, middle, vec2(5.0, 3.0).normalized());
        assert!(corner.distance(pos2(110.0, 60.0)) < 1e-3, "{corner:?}");
        // The picture's middle may be covered.
        assert_eq!(edge_point(room, pos2(60.0, 10.0), Vec2::DOWN), pos2(60.0, 60.0));
    }
}
