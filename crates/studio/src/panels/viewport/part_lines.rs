//! The outlines of a joined body's parts over the picture: of all thinly, of the one that is meant strongly. What is
//! taken away from a body is seen by them alone.

use catoptric_scene::{Form, Shape as BodyShape};
use egui::{Color32, Painter, Pos2, Shape, Stroke};
use glam::{DAffine3, DVec3};

use super::scene_view::SceneView;
use crate::base::theme::ThemeColors;
use crate::state::context::Cx;

/// Bodies of more simple parts than this, which only groups have, show the part that is meant alone.
const MOST: usize = BodyShape::MAX_PARTS;

/// Draws them for a body that is selected alone.
pub(crate) fn draw(painter: &Painter, scene_view: &SceneView, cx: &Cx<'_>, palette: &ThemeColors) {
    let mut selected = cx.editor.selected_bodies();
    let (Some(index), None) = (selected.next(), selected.next()) else { return };
    let Some(body) = cx.editor.scene().bodies.get(index) else { return };
    let form = body.form();
    if catoptric_editor::joined_parts(&form).is_none() || body.hidden {
        return;
    }
    let mut thin = Vec::new();
    add_lines(&form, DAffine3::IDENTITY, scene_view, &mut thin);
    let color = palette.accent.gamma_multiply(0.6);
    for line in &thin {
        painter.extend(Shape::dashed_line(line, Stroke::new(1.0, color), 3.0, 3.0));
    }
    let meant = cx.editor.selected_part().map(|(_, path)| path);
    let Some(path) = meant else { return };
    let Some(form) = path.form(body) else { return };
    let mut strong = Vec::new();
    add_lines(&form, path.frame_around(body), scene_view, &mut strong);
    for line in strong {
        painter.add(Shape::line(line.clone(), Stroke::new(4.6, Color32::from_black_alpha(90))));
        painter.add(Shape::line(line, Stroke::new(2.6, palette.accent)));
    }
}

/// Adds the lines in the window by which the eye sees the parts of a form: pieces that are in view.
fn add_lines(form: &Form<'_>, around: DAffine3, scene_view: &SceneView, lines: &mut Vec<Vec<Pos2>>) {
    let eye = scene_view.projector.position();
    // What is far outside would make a shape of every dash up to there.
    let near = scene_view.rect.expand(scene_view.rect.size().max_elem());
    let shown = |point: DVec3| scene_view.point(point).filter(|at| near.contains(*at));
    let mut count = 0_usize;
    form.each_simple(around, &mut |part| {
        count += 1;
        if count > MOST {
            return;
        }
        for line in part.shape.outline(part.frame.inverse().transform_point3(eye)) {
            let points: Vec<Option<Pos2>> =
                line.into_iter().map(|point| shown(part.frame.transform_point3(point))).collect();
            let pieces = points.split(Option::is_none).filter(|piece| piece.len() > 1);
            lines.extend(pieces.map(|piece| piece.iter().copied().flatten().collect()));
        }
    });
}
