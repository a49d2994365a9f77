//! Draws a row of the tree, with its buttons and drags.

use catoptric_editor::{Action, Item, PartPath, Selection};
use egui::accesskit::Role;
use egui::{Color32, Rect, Response, Sense, Stroke, StrokeKind, TextStyle, Ui, Vec2, WidgetInfo};
use egui::{pos2, vec2};
use egui_material_icons::{MaterialIcon, icons};

use super::rows::OutlinerSection;
use super::{
    Outliner, ROW, body_of, click, drag, item_color, item_icon, item_name, list_id, meant, menu, part_row,
    rename_ui, shared_material,
};
use crate::base::theme;
use crate::base::widgets::{icon_button, paint_icon, paint_line};
use crate::state::command::Command;
use crate::state::context::Cx;

/// Where the names of things begin, points from the left.
pub(super) const INDENT: f32 = 14.0;

/// Draws the head of a section: a click folds it, the button adds something to it.
pub(super) fn head_ui(
    ui: &mut Ui,
    cx: &mut Cx<'_>,
    outliner: &mut Outliner,
    section: OutlinerSection,
    count: usize,
) {
    let (_, rect) = ui.allocate_space(vec2(ui.available_width(), ROW));
    let response = ui.interact(rect, list_id().with(("head", section)), Sense::CLICK);
    let is_folded = outliner.rows.is_folded(section) && outliner.filter.is_empty();
    let title = cx.texts.get(section.key());
    response.widget_info(|| WidgetInfo::labeled(Role::TreeItem, true, title));
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_expanded(!is_folded);
        node.set_level(1);
    });
    let palette = theme::palette(ui.visuals());
    let chevron = if is_folded { icons::ICON_CHEVRON_RIGHT } else { icons::ICON_EXPAND_MORE };
    let color = if response.hovered() { palette.text } else { palette.weak };
    paint_icon(ui, chevron, pos2(rect.left() + 8.0, rect.center().y), 16.0, color);
    let font = TextStyle::Body.resolve(ui.style());
    let painter = ui.painter();
    let small = TextStyle::Small.resolve(ui.style());
    let count = painter.layout_no_wrap(count.to_string(), small, palette.weak);
    // The count stands behind the title, and in a narrow panel before the button.
    let title_width = painter.layout_no_wrap(title.to_owned(), font, color).size().x;
    let room = (rect.width() - 20.0 - 32.0 - count.size().x).max(0.0);
    let title_rect =
        rect.with_min_x(rect.left() + 20.0).with_max_x(rect.left() + 20.0 + title_width.min(room) + 0.5);
    paint_line(ui, title_rect, title, color);
    let at = pos2(title_rect.right() + 6.0, rect.center().y - count.size().y / 2.0);
    painter.galley(at, count, palette.weak);
    if response.clicked() {
        outliner.rows.fold(section, !is_folded);
    }
    let tip = cx.texts.tip(section.key()).unwrap_or_default();
    response.on_hover_text(tip);
    let place = Rect::from_min_max(pos2(rect.right() - 24.0, rect.top()), rect.max);
    let add = ui.scope_builder(egui::UiBuilder::new().max_rect(place), |ui| add_ui(ui, cx, section)).inner;
    menu::add_menu(&add, cx, section);
}

fn add_ui(ui: &mut Ui, cx: &Cx<'_>, section: OutlinerSection) -> Response {
    let key = match section {
        OutlinerSection::Lights => "command-add-light",
        OutlinerSection::Bodies => "outliner-add-body",
        OutlinerSection::Materials => "command-add-material",
    };
    icon_button(ui, icons::ICON_ADD, cx.texts.get(key), false)
}

/// Draws a thing.
pub(super) fn item_ui(ui: &mut Ui, cx: &mut Cx<'_>, outliner: &mut Outliner, item: Item) {
    let (_, rect) = ui.allocate_space(vec2(ui.available_width(), ROW));
    let id = list_id().with(item);
    let response = ui.interact(rect, id, Sense::CLICK | Sense::DRAG);
    let edited = cx.editor.edited().clone();
    let texts = cx.texts;
    let name = item_name(texts, &edited, item);
    let is_selected = cx.editor.selection().contains(item);
    let is_unfolded = part_row::is_unfolded(&edited, outliner, (item, PartPath::WHOLE));
    info(ui, &response, &name, (is_selected, is_unfolded), item);
    let is_hovered = response.contains_pointer() && outliner.dragged.is_none();
    paint_background(ui, cx, rect, item, is_selected, is_hovered);

    let left = rect.left() + if OutlinerSection::of(item).is_some() { INDENT } else { 0.0 };
    part_row::triangle_ui(ui, cx, outliner, (rect, left), (item, PartPath::WHOLE));
    let is_hidden = edited.is_hidden(item);
    let palette = theme::palette(ui.visuals());
    let color = if is_hidden { palette.weak } else { palette.text };
    paint_icon(ui, item_icon(&edited, item), pos2(left + 10.0, rect.center().y), 15.0, palette.weak);
    let mut text_left = left + 23.0;
    if let Some(dot) = item_color(&edited, item) {
        let stroke = Stroke::new(1.0, palette.weak.gamma_multiply(0.6));
        let center = pos2(text_left + 5.0, rect.center().y);
        ui.painter().circle(center, 4.5, if is_hidden { dot.gamma_multiply(0.4) } else { dot }, stroke);
        text_left += 16.0;
    }
    let flags = match (is_hidden, edited.is_locked(item)) {
        _ if is_hovered && has_flags(item) => 46.0,
        (_, true) => 46.0,
        (true, false) => 25.0,
        (false, false) => 4.0,
    };
    let text = Rect::from_min_max(pos2(text_left, rect.top()), rect.max - vec2(flags, 0.0));
    let is_renamed =
        outliner.renaming.as_ref().is_some_and(|renaming| renaming.item == item && renaming.part.is_whole());
    if is_renamed {
        let field = Rect::from_min_max(text.min - vec2(5.0, 0.0), pos2(rect.right() - 4.0, rect.bottom()));
        rename_ui(ui, cx, outliner, field);
        return;
    }
    paint_line(ui, text, &name, color);
    if has_flags(item) {
        flags_ui(ui, cx, rect, item, &name, is_hovered);
    }
    tip_ui(&response, cx, item, &name);
    act(ui, cx, outliner, item, &response);
    if is_hovered && matches!(item, Item::Body(_)) {
        outliner.hovered = Some(item);
    }
    menu::item_menu(&response, cx, item);
}

fn info(
    ui: &Ui,
    response: &Response,
    name: &str,
    (is_selected, is_unfolded): (bool, Option<bool>),
    item: Item,
) {
    response.widget_info(|| WidgetInfo::labeled(Role::TreeItem, true, name));
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_selected(is_selected);
        node.set_level(if OutlinerSection::of(item).is_some() { 2 } else { 1 });
        if let Some(is_unfolded) = is_unfolded {
            node.set_expanded(is_unfolded);
        }
    });
}

fn paint_background(ui: &Ui, cx: &Cx<'_>, rect: Rect, item: Item, is_selected: bool, is_hovered: bool) {
    let palette = theme::palette(ui.visuals());
    // While a part is meant, its row is the strongest.
    let is_primary = meant(cx.editor.selection()) == Some((item, PartPath::WHOLE));
    let fill = match (is_selected, is_hovered) {
        (true, _) if is_primary => palette.selection,
        (true, _) => palette.selection.gamma_multiply(0.6),
        (false, true) => palette.hovered.gamma_multiply(0.7),
        (false, false) => Color32::TRANSPARENT,
    };
    ui.painter().rect_filled(rect, 4.0, fill);
    if is_primary && ui.memory(|memory| memory.has_focus(list_id())) {
        let stroke = Stroke::new(1.0, palette.accent.gamma_multiply(0.7));
        ui.painter().rect_stroke(rect, 4.0, stroke, StrokeKind::Inside);
    }
}

/// Eye and lock at the right: seen when they are set, and under the pointer.
fn flags_ui(ui: &mut Ui, cx: &mut Cx<'_>, rect: Rect, item: Item, name: &str, is_hovered: bool) {
    let (hidden, locked) = (cx.editor.edited().is_hidden(item), cx.editor.edited().is_locked(item));
    let eye = if hidden { icons::ICON_VISIBILITY_OFF } else { icons::ICON_VISIBILITY };
    let key = if hidden { "outliner-show" } else { "outliner-hide" };
    let seen = [hidden || is_hovered, locked || is_hovered];
    if flag_ui(ui, cx, rect, 12.0, (item, "eye"), eye, (key, name), seen[0]) {
        cx.run(Command::Edit(Action::SetHidden { item, hidden: !hidden }));
    }
    let lock = if locked { icons::ICON_LOCK } else { icons::ICON_LOCK_OPEN };
    let key = if locked { "outliner-unlock" } else { "outliner-lock" };
    if flag_ui(ui, cx, rect, 33.0, (item, "lock"), lock, (key, name), seen[1]) {
        cx.run(Command::Edit(Action::SetLocked { item, locked: !locked }));
    }
}

#[expect(clippy::too_many_arguments, reason = "two calls, side by side")]
fn flag_ui(
    ui: &Ui,
    cx: &Cx<'_>,
    row: Rect,
    from_right: f32,
    id: (Item, &str),
    icon: MaterialIcon,
    (key, name): (&'static str, &str),
    is_seen: bool,
) -> bool {
    let center = pos2(row.right() - from_right, row.center().y);
    let rect = Rect::from_center_size(center, Vec2::splat(20.0));
    let response = ui.interact(rect, list_id().with(id), Sense::CLICK);
    let label = cx.texts.with(key, &[("name", name.into())]);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
    if is_seen || response.hovered() {
        let palette = theme::palette(ui.visuals());
        let color = if response.hovered() { palette.text } else { palette.weak };
        paint_icon(ui, icon, center, 15.0, color);
    }
    response.on_hover_text(label).clicked()
}

/// Whether a thing can be hidden and locked.
fn has_flags(item: Item) -> bool {
    matches!(item, Item::Body(_) | Item::Light(_))
}

/// The whole name, and what a body is made of: beside the row, so that the rows below stay in view.
fn tip_ui(response: &Response, cx: &Cx<'_>, item: Item, name: &str) {
    // A dialog may have opened over it.
    if !response.contains_pointer() {
        return;
    }
    let mut tooltip = egui::Tooltip::for_enabled(response);
    tooltip.popup = tooltip.popup.align(egui::RectAlign::RIGHT).gap(8.0);
    tooltip.show(|ui| tip_content(ui, cx, item, name));
}

fn tip_content(ui: &mut Ui, cx: &Cx<'_>, item: Item, name: &str) {
    ui.label(name);
    let text = match (item, body_of(cx.editor.edited(), item).map(shared_material)) {
        (Item::Body(_), Some(Some(material))) => {
            cx.texts.with("outliner-of-material", &[("material", material.into())])
        }
        (Item::Body(_), _) => cx.texts.get("outliner-own-material").to_owned(),
        (Item::Material(_), _) => cx.texts.get("outliner-drag-material").to_owned(),
        _ => return,
    };
    let color = theme::palette(ui.visuals()).weak;
    ui.label(egui::RichText::new(text).color(color));
}

/// Clicks and the beginning of a drag.
fn act(ui: &Ui, cx: &mut Cx<'_>, outliner: &mut Outliner, item: Item, response: &Response) {
    if response.double_clicked() {
        cx.editor.select(item);
        outliner.rename(cx.editor.edited(), item, PartPath::WHOLE);
        return;
    }
    if response.clicked() {
        click(cx, outliner, item, ui.input(|input| input.modifiers));
        ui.memory_mut(|memory| memory.request_focus(list_id()));
    }
    if response.secondary_clicked() && !cx.editor.selection().contains(item) {
        outliner.shown = Some((item, PartPath::WHOLE));
        cx.editor.select(Selection::one(item));
    }
    if response.drag_started_by(egui::PointerButton::Primary) && OutlinerSection::of(item).is_some() {
        drag::start(cx, outliner, (item, PartPath::WHOLE));
    }
}
