//! Draws the row of a part of a joined body, and the triangle that unfolds parts.

use catoptric_editor::{EditedScene, Item, PartPath, Selection};
use catoptric_scene::{Body, BodyPart, Shape};
use egui::accesskit::Role;
use egui::{Color32, FontId, Rect, Response, Sense, Stroke, StrokeKind, Ui, Vec2, WidgetInfo, pos2, vec2};
use egui_material_icons::icons;

use super::row::INDENT;
use super::{Outliner, ROW, body_of, drag, list_id, meant, menu, part_title, rename_ui, shape_icon};
use crate::base::theme;
use crate::base::widgets::{paint_icon, paint_line, paint_line_in};
use crate::state::context::Cx;

/// How much farther right each depth begins, points.
pub(super) const STEP: f32 = 14.0;

/// What a part does in its whole: the sign on its row, and the message that explains it.
pub(crate) struct PartRole {
    pub(crate) sign: &'static str,
    pub(crate) key: &'static str,
}

/// What the part at a place does in a whole of this shape.
pub(crate) fn role(whole: Shape, place: usize) -> Option<PartRole> {
    let (sign, key) = match (whole, place) {
        (Shape::Union, _) => ("∪", "part-joined"),
        (Shape::Intersection, _) => ("∩", "part-common"),
        (Shape::Difference, 0) => ("+", "part-remains"),
        (Shape::Difference, _) => ("−", "part-taken-away"),
        (Shape::Surface { .. }, 0) => ("∂", "part-surface"),
        (Shape::Surface { .. }, _) => ("∩", "part-cuts"),
        _ => return None,
    };
    Some(PartRole { sign, key })
}

/// Whether the parts of what is joined are shown; `None` for all else.
pub(super) fn is_unfolded(
    edited: &EditedScene,
    outliner: &Outliner,
    (item, path): (Item, PartPath),
) -> Option<bool> {
    path.parts(body_of(edited, item)?)?;
    Some(outliner.rows.shows_parts(item, path) || !outliner.filter.is_empty())
}

/// Draws the triangle before what is joined; a click folds or unfolds it. Its row begins at `left`.
pub(super) fn triangle_ui(
    ui: &Ui,
    cx: &Cx<'_>,
    outliner: &mut Outliner,
    (row, left): (Rect, f32),
    place: (Item, PartPath),
) {
    let edited = cx.editor.edited();
    let Some(is_open) = is_unfolded(edited, outliner, place) else { return };
    let center = pos2(left - 5.0, row.center().y);
    let rect = Rect::from_center_size(center, Vec2::new(16.0, ROW));
    let response = ui.interact(rect, list_id().with((place, "triangle")), Sense::CLICK);
    let palette = theme::palette(ui.visuals());
    let icon = if is_open { icons::ICON_EXPAND_MORE } else { icons::ICON_CHEVRON_RIGHT };
    let color = if response.hovered() { palette.text } else { palette.weak };
    paint_icon(ui, icon, center, 15.0, color);
    let name = super::path_title(cx.texts, edited, place);
    let key = if is_open { "outliner-fold" } else { "outliner-unfold" };
    let label = cx.texts.with(key, &[("name", name.into_owned().into())]);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
    if response.clicked() {
        outliner.rows.show_parts(edited, place, !is_open);
        ui.ctx().request_repaint();
    }
}

/// Draws a part.
pub(super) fn part_ui(ui: &mut Ui, cx: &mut Cx<'_>, outliner: &mut Outliner, place: (Item, PartPath)) {
    let (item, path) = place;
    let edited = cx.editor.edited().clone();
    let Some(body) = body_of(&edited, item) else { return };
    let Some(part) = path.part(body) else { return };
    let (_, rect) = ui.allocate_space(vec2(ui.available_width(), ROW));
    let response = ui.interact(rect, list_id().with(place), Sense::CLICK | Sense::DRAG);
    let name = part_title(cx.texts, part, path.place().unwrap_or_default());
    let is_meant = meant(cx.editor.selection()) == Some(place);
    let unfolded = is_unfolded(&edited, outliner, place);
    response.widget_info(|| WidgetInfo::labeled(Role::TreeItem, true, name.as_ref()));
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_selected(is_meant);
        node.set_level(2 + path.depth());
        if let Some(is_unfolded) = unfolded {
            node.set_expanded(is_unfolded);
        }
    });
    let is_hovered = response.contains_pointer() && outliner.dragged.is_none();
    paint_background(ui, rect, is_meant, is_hovered);
    // Deep rows keep room for their names in a narrow panel.
    let left = rect.left() + INDENT + (STEP * path.depth() as f32).min(0.4 * rect.width());
    triangle_ui(ui, cx, outliner, (rect, left), place);
    let text = paint_marks(ui, cx, (rect, left), (body, path, part));
    let is_renamed = outliner.renaming.as_ref().is_some_and(|field| (field.item, field.part) == place);
    if is_renamed {
        let field = Rect::from_min_max(text.min - vec2(5.0, 0.0), pos2(rect.right() - 4.0, rect.bottom()));
        rename_ui(ui, cx, outliner, field);
        return;
    }
    let palette = theme::palette(ui.visuals());
    paint_line(ui, text, &name, if body.hidden { palette.weak } else { palette.text });
    tip_ui(&response, cx, (body, path, part), &name);
    act(ui, cx, outliner, place, &response);
    if is_hovered {
        outliner.hovered = Some(item);
    }
    menu::part_menu(&response, cx);
}

fn paint_background(ui: &Ui, rect: Rect, is_meant: bool, is_hovered: bool) {
    let palette = theme::palette(ui.visuals());
    let fill = match (is_meant, is_hovered) {
        (true, _) => palette.selection,
        (false, true) => palette.hovered.gamma_multiply(0.7),
        (false, false) => Color32::TRANSPARENT,
    };
    ui.painter().rect_filled(rect, 4.0, fill);
    if is_meant && ui.memory(|memory| memory.has_focus(list_id())) {
        let stroke = Stroke::new(1.0, palette.accent.gamma_multiply(0.7));
        ui.painter().rect_stroke(rect, 4.0, stroke, StrokeKind::Inside);
    }
}

/// Paints icon, color and the sign of what the part does; returns the room that is left for the name.
fn paint_marks(
    ui: &Ui,
    cx: &Cx<'_>,
    (rect, left): (Rect, f32),
    (body, path, part): (&Body, PartPath, &BodyPart),
) -> Rect {
    let palette = theme::palette(ui.visuals());
    let icon = shape_icon(part.form().body_shape().kind());
    paint_icon(ui, icon, pos2(left + 10.0, rect.center().y), 15.0, palette.weak);
    let mut text = rect.with_min_x(left + 23.0).with_max_x(rect.right() - 4.0);
    if let Some(material) = cx.editor.scene().material(path.material(body)) {
        let [red, green, blue] = material.emblem().to_srgb8();
        let stroke = Stroke::new(1.0, palette.weak.gamma_multiply(0.6));
        let (center, dot) = (pos2(text.left() + 5.0, rect.center().y), Color32::from_rgb(red, green, blue));
        // One that is as the whole has the whole's dot, smaller.
        let radius = if part.material.is_some() { 4.5 } else { 2.5 };
        ui.painter().circle(center, radius, dot, stroke);
        text.min.x += 16.0;
    }
    let whole = path.parent().and_then(|around| around.form(body)).map(|form| form.shape);
    let role = whole.zip(path.place()).and_then(|(whole, place)| role(whole, place));
    if let Some(role) = role {
        let room = text.with_min_x(rect.right() - 18.0);
        paint_line_in(ui, room, role.sign, FontId::proportional(14.0), palette.weak);
        text.max.x = rect.right() - 22.0;
    }
    text
}

/// The whole name, and what the part does in its whole.
fn tip_ui(response: &Response, cx: &Cx<'_>, (body, path, part): (&Body, PartPath, &BodyPart), name: &str) {
    if !response.contains_pointer() {
        return;
    }
    let whole = path.parent().and_then(|around| around.form(body)).map(|form| form.shape);
    let role = whole.zip(path.place()).and_then(|(whole, place)| role(whole, place));
    let mut tooltip = egui::Tooltip::for_enabled(response);
    tooltip.popup = tooltip.popup.align(egui::RectAlign::RIGHT).gap(8.0);
    tooltip.show(|ui| {
        let color = theme::palette(ui.visuals()).weak;
        ui.label(name);
        if let Some(role) = role {
            ui.label(egui::RichText::new(cx.texts.get(role.key)).color(color));
        }
        let key = if part.material.is_some() { "part-own-material" } else { "part-material-of-whole" };
        ui.label(egui::RichText::new(cx.texts.get(key)).color(color));
    });
}

/// Clicks and the beginning of a drag.
fn act(ui: &Ui, cx: &mut Cx<'_>, outliner: &mut Outliner, place: (Item, PartPath), response: &Response) {
    let (item, path) = place;
    let mut select = |outliner: &mut Outliner| {
        outliner.anchor = Some(item);
        outliner.shown = Some(place);
        cx.editor.select(Selection::of_part(item, path));
    };
    if response.double_clicked() {
        select(outliner);
        outliner.rename(cx.editor.edited(), item, path);
        return;
    }
    if response.clicked() {
        select(outliner);
        ui.memory_mut(|memory| memory.request_focus(list_id()));
    }
    if response.secondary_clicked() {
        select(outliner);
    }
    if response.drag_started_by(egui::PointerButton::Primary) {
        drag::start(cx, outliner, place);
    }
}
