//! Picking a pixel for the audit: the pixel under the pointer, and its pin.

use catoptric_scene::ScenePart;
use egui::{Popup, Pos2, Ui};
use glam::{DVec3, UVec2};

use super::rays;
use super::scene_view::SceneView;
use crate::base::plates;
use crate::base::theme::ThemeColors;
use crate::panels::audit::{color_text, tag};
use crate::panels::outliner::part_name;
use crate::state::audit::PinnedPixel;
use crate::state::context::Cx;

/// The size of the picture in pixels, and the one at a place.
fn pixel_at(ui: &Ui, scene_view: &SceneView, pos: Pos2) -> Option<(UVec2, UVec2)> {
    let scale = ui.ctx().pixels_per_point();
    let size = (scene_view.rect.size() * scale).round();
    let at = ((pos - scene_view.rect.min) * scale).floor();
    let is_inside = at.x >= 0.0 && at.y >= 0.0 && at.x < size.x && at.y < size.y;
    is_inside.then(|| (UVec2::new(at.x as u32, at.y as u32), UVec2::new(size.x as u32, size.y as u32)))
}

/// Lights the ray at a place, or looks into the pixel there; with Shift always into the pixel. The free view begins, so
/// that the rays can be looked at from elsewhere while the scene's camera stays.
pub(crate) fn click(ui: &Ui, cx: &mut Cx<'_>, scene_view: &SceneView, pos: Pos2) {
    let is_pixel_meant = ui.input(|input| input.modifiers.shift);
    if let Some(node) = rays::node_at(scene_view, cx, pos).filter(|_| !is_pixel_meant) {
        cx.audit.select(node);
        return;
    }
    let Some((pixel, size)) = pixel_at(ui, scene_view, pos) else { return };
    let home = cx.view.camera(cx.editor.scene());
    cx.editor.settle();
    cx.view.free_camera = Some(home);
    cx.audit.pin_to(PinnedPixel { pixel, size, camera: scene_view.camera, home });
    ui.ctx().request_repaint();
}

/// Tells of the ray or the pixel under the pointer.
pub(crate) fn note(ui: &Ui, cx: &mut Cx<'_>, scene_view: &SceneView, palette: &ThemeColors) {
    let pointer = ui.input(|input| input.pointer.hover_pos());
    let is_over =
        |pos: &Pos2| scene_view.visible.contains(*pos) && ui.ctx().layer_id_at(*pos) == Some(ui.layer_id());
    let Some(pos) = pointer.filter(is_over) else { return };
    if cx.view.is_moving || Popup::is_any_open(ui.ctx()) {
        return;
    }
    let painter = ui.painter_at(scene_view.visible);
    if let Some(place) = rays::node_at(scene_view, cx, pos)
        && let Some(node) = cx.audit.found().and_then(|found| found.node(place))
    {
        let text = tag(cx.texts, place, node);
        plates::beside_pointer(&painter, scene_view.visible, pos, &text, palette);
        return;
    }
    let Some((pixel, size)) = pixel_at(ui, scene_view, pos) else { return };
    if !cx.view.is_measuring {
        cx.audit.probe(ui.ctx(), cx.live, pixel, size, scene_view.camera);
    }
    let body = scene_view.body_at(scene_view.at(pos)).map(|hit| hit.body);
    let body = match body {
        Some(body) => part_name(cx.texts, cx.editor.scene(), ScenePart::Body(body)).into_owned(),
        None => cx.t("audit-background").to_owned(),
    };
    let light = cx.audit.probed(pixel).map(|light| color_text(cx.texts, DVec3::from(light.map(f64::from))));
    let arguments = [
        ("x", pixel.x.to_string().into()),
        ("y", pixel.y.to_string().into()),
        ("body", body.into()),
        ("light", light.unwrap_or_else(|| "…".to_owned()).into()),
    ];
    let text = cx.texts.with("audit-hover", &arguments);
    plates::beside_pointer(&painter, scene_view.visible, pos, &text, palette);
}
