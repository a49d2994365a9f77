//! The panel of everything in the scene: a tree with the camera, the surroundings, lights, bodies and materials.

mod drag;
mod keys;
mod menu;
mod part_row;
mod row;
mod rows;
mod tree;

use std::borrow::Cow;
use std::mem;

use catoptric_editor::{Action, EditedScene, Item, PartPath, Selection};
use catoptric_scene::{Body, BodyPart, MaterialChoice, Scene, ScenePart, ShapeKind};
use egui::accesskit::Role;
use egui::{EventFilter, Id, Rect, ScrollArea, Sense, TextEdit, Ui, WidgetInfo, pos2, vec2};
use egui_material_icons::{MaterialIcon, icons};

use crate::base::shapes::shape_name;
use crate::base::texts::Texts;
use crate::base::widgets::filter::filter_field;
use crate::state::command::{AddCommand, Command, join};
use crate::state::context::Cx;
pub(crate) use part_row::role as part_role;
use rows::{OutlinerRow, OutlinerRows};

/// Height of a row, points.
const ROW: f32 = 23.0;

/// The state of the outliner.
#[derive(Default)]
pub(crate) struct Outliner {
    filter: String,
    rows: OutlinerRows,
    /// Where ranges of rows begin.
    anchor: Option<Item>,
    renaming: Option<RenameField>,
    /// The primary thing that was last brought into view, with the way to the part that is meant.
    shown: Option<(Item, PartPath)>,
    /// The body whose row was under the pointer in the last frame.
    hovered: Option<Item>,
    /// The thing that is being dragged, with the way to its part.
    dragged: Option<(Item, PartPath)>,
    checked_drop: Option<drag::CheckedDrop>,
}

/// The name that is being typed.
struct RenameField {
    item: Item,
    part: PartPath,
    name: String,
    /// Whether the field has had the focus yet.
    has_begun: bool,
    /// Whether the field has been drawn in this frame.
    is_drawn: bool,
}

/// The list has the keyboard's focus under this id while it is used.
pub(crate) fn list_id() -> Id {
    Id::unique("outliner list")
}

impl Outliner {
    /// Forgets the name that is being typed.
    pub(crate) fn stop_renaming(&mut self) {
        self.renaming = None;
    }

    /// Begins to type another name for `item`, or for a part of it.
    pub(crate) fn rename(&mut self, edited: &EditedScene, item: Item, part: PartPath) {
        if matches!(item, Item::Body(_) | Item::Light(_) | Item::Material(_)) {
            let name = place_name(edited, (item, part)).to_owned();
            self.renaming = Some(RenameField { item, part, name, has_begun: false, is_drawn: false });
            self.rows.reveal(edited, item, part);
            self.shown = None;
        }
    }
}

/// Draws the camera, the lights, the bodies and the materials.
pub(crate) fn outliner_ui(ui: &mut Ui, cx: &mut Cx<'_>, outliner: &mut Outliner) {
    filter_ui(ui, cx.texts, &mut outliner.filter);
    let renamed = outliner.renaming.as_ref().map(|renaming| (renaming.item, renaming.part));
    outliner.renaming.take_if(|renaming| !has_place(cx.editor.edited(), (renaming.item, renaming.part)));
    let meant = renamed.or_else(|| meant(cx.editor.selection()));
    let wanted = meant.filter(|place| outliner.shown != Some(*place));
    if let Some((item, path)) = wanted {
        outliner.rows.reveal(cx.editor.edited(), item, path);
    }
    outliner.rows.update(cx.texts, cx.editor, &outliner.filter);
    // A filter may hide it.
    outliner.renaming.take_if(|renaming| {
        !renaming.has_begun && outliner.rows.row_of((renaming.item, renaming.part)).is_none()
    });
    outliner.shown = meant;

    let rect = ui.available_rect_before_wrap();
    list_focus(ui, cx, rect);
    if ui.memory(|memory| memory.has_focus(list_id())) {
        keys::keys(ui, cx, outliner);
    }
    let was_hovered = outliner.hovered.take();
    ui.spacing_mut().item_spacing.y = 0.0;
    let count = outliner.rows.all().len();
    ScrollArea::vertical().auto_shrink(false).show_rows(ui, ROW, count, |ui, range| {
        let top = ui.max_rect().top() - range.start as f32 * ROW;
        if let Some(place) = wanted.and_then(|place| outliner.rows.row_of(place)) {
            let corner = pos2(ui.max_rect().left(), top + place as f32 * ROW);
            ui.scroll_to_rect(Rect::from_min_size(corner, vec2(10.0, ROW)), None);
        }
        for place in range {
            let Some(row) = outliner.rows.all().get(place).copied() else { continue };
            match row {
                OutlinerRow::Head(section, count) => row::head_ui(ui, cx, outliner, section, count),
                OutlinerRow::Item(item) => row::item_ui(ui, cx, outliner, item),
                OutlinerRow::Part(item, path) => part_row::part_ui(ui, cx, outliner, (item, path)),
            }
        }
        drag::drag_ui(ui, cx, outliner, top, rect);
    });
    // A field that is out of sight has been left.
    let left = outliner.renaming.take_if(|renaming| renaming.has_begun && !mem::take(&mut renaming.is_drawn));
    if let Some(renaming) = left {
        take_name(cx, renaming);
    }
    empty_ui(ui, cx, outliner, rect);
    if outliner.hovered.is_some() {
        cx.view.hovered_body = outliner.hovered;
    } else if was_hovered.is_some() && cx.view.hovered_body == was_hovered {
        cx.view.hovered_body = None;
    }
}

/// The field that shows only what bears a name.
fn filter_ui(ui: &mut Ui, texts: &Texts, filter: &mut String) {
    let tip = texts.tip("outliner-filter").unwrap_or_default();
    let clear = texts.get("outliner-filter-clear");
    filter_field(ui, filter, ui.available_width(), [texts.get("outliner-filter"), tip, clear]);
    ui.add_space(2.0);
}

/// Lets the list have the focus as a whole: its arrow keys choose rows, and Tab passes it in one step.
fn list_focus(ui: &mut Ui, cx: &Cx<'_>, rect: Rect) {
    let list = ui.interact(rect, list_id(), Sense::focusable_noninteractive());
    list.widget_info(|| WidgetInfo::labeled(Role::Tree, true, cx.texts.get("pane-outliner")));
    if list.has_focus() {
        let filter = EventFilter { horizontal_arrows: true, vertical_arrows: true, ..EventFilter::default() };
        ui.memory_mut(|memory| memory.set_focus_lock_filter(list_id(), filter));
    }
    if list.gained_focus() && cx.editor.selection().is_empty() {
        ui.ctx().request_repaint();
    }
}

/// Below the rows: a click selects nothing.
fn empty_ui(ui: &mut Ui, cx: &mut Cx<'_>, outliner: &Outliner, rect: Rect) {
    let used = (outliner.rows.all().len() as f32 * ROW).min(rect.height());
    let rest = Rect::from_min_max(pos2(rect.left(), rect.top() + used), rect.max);
    if rest.height() < 1.0 {
        return;
    }
    let response = ui.interact(rest, list_id().with("rest"), Sense::CLICK);
    if response.clicked() {
        cx.editor.select(Selection::none());
    }
    menu::rest_menu(&response, cx);
}

/// Selects by a click: alone, to or from the rest with the command key, all rows from the last one with Shift.
fn click(cx: &mut Cx<'_>, outliner: &mut Outliner, item: Item, modifiers: egui::Modifiers) {
    let mut selection = cx.editor.selection().clone();
    if modifiers.shift {
        let from = outliner.anchor.filter(|item| cx.editor.edited().contains(*item)).or(selection.primary());
        selection = outliner.rows.range(from.unwrap_or(item), item);
    } else {
        if modifiers.command {
            selection.toggle(item);
        } else {
            selection.set(item);
        }
        outliner.anchor = Some(item);
    }
    // It is in view: its row was clicked.
    outliner.shown = meant(&selection);
    cx.editor.select(selection);
}

/// The primary thing, with the way to the part that is meant.
fn meant(selection: &Selection) -> Option<(Item, PartPath)> {
    selection.primary().map(|item| (item, selection.part().unwrap_or(PartPath::WHOLE)))
}

/// Whether there is such a thing, with such a part.
fn has_place(edited: &EditedScene, (item, path): (Item, PartPath)) -> bool {
    edited.contains(item)
        && (path.is_whole() || body_of(edited, item).is_some_and(|body| path.part(body).is_some()))
}

/// The name of a thing or of a part of it.
fn place_name(edited: &EditedScene, (item, path): (Item, PartPath)) -> &str {
    let part = || body_of(edited, item).and_then(|body| path.part(body));
    if path.is_whole() { edited.name(item) } else { part().map_or("", |part| &part.name) }
}

/// Draws the field in which a name is typed.
fn rename_ui(ui: &mut Ui, cx: &mut Cx<'_>, outliner: &mut Outliner, rect: Rect) {
    let Some(renaming) = &mut outliner.renaming else { return };
    renaming.is_drawn = true;
    let id = list_id().with("rename");
    let field = TextEdit::singleline(&mut renaming.name)
        .id(id)
        .margin(egui::Margin::symmetric(4, 2))
        .align(egui::Align2::LEFT_CENTER);
    let response = ui.put(rect, field.desired_width(f32::INFINITY).clip_text(true));
    let response = response.accessible_name(cx.texts.get("outliner-rename"));
    if !renaming.has_begun {
        renaming.has_begun = true;
        response.request_focus();
        let end = egui::text::CCursor::new(renaming.name.chars().count());
        let all = egui::text::CCursorRange::two(egui::text::CCursor::default(), end);
        let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
        state.cursor.set_char_range(Some(all));
        state.store(ui.ctx(), id);
        return;
    }
    if response.has_focus() {
        return;
    }
    let is_given_up = ui.input(|input| input.key_pressed(egui::Key::Escape));
    let Some(renaming) = outliner.renaming.take() else { return };
    if !is_given_up {
        take_name(cx, renaming);
    }
    ui.memory_mut(|memory| memory.request_focus(list_id()));
}

fn take_name(cx: &mut Cx<'_>, RenameField { item, part, name, .. }: RenameField) {
    if name != place_name(cx.editor.edited(), (item, part)) {
        let action = match part.is_whole() {
            true => Action::Rename { item, name },
            false => Action::RenamePart { whole: item, part, name },
        };
        cx.run(Command::Edit(action));
    }
}

/// What to call a part at a place among its like: its name, or what it is.
pub(crate) fn part_title<'a>(texts: &'a Texts, part: &'a BodyPart, place: usize) -> Cow<'a, str> {
    if !part.name.is_empty() {
        return Cow::Borrowed(&part.name);
    }
    let kind = texts.get(shape_name(part.form().body_shape().kind()));
    Cow::Owned(texts.with("outliner-unnamed", &[("kind", kind.into()), ("number", (place + 1).into())]))
}

/// What to call a part of a thing, or the thing.
pub(crate) fn path_title<'a>(
    texts: &'a Texts,
    edited: &'a EditedScene,
    (item, path): (Item, PartPath),
) -> Cow<'a, str> {
    let part = body_of(edited, item).and_then(|body| path.part(body)).zip(path.place());
    part.map_or_else(|| item_name(texts, edited, item), |(part, place)| part_title(texts, part, place))
}

/// What to call a thing: its name, or what it is.
pub(crate) fn item_name<'a>(texts: &'a Texts, edited: &'a EditedScene, item: Item) -> Cow<'a, str> {
    edited.part(item).map(|part| part_name(texts, edited.scene(), part)).unwrap_or_default()
}

/// What to call what stands at a place: its name, or what it is.
pub(crate) fn part_name<'a>(texts: &'a Texts, scene: &'a Scene, part: ScenePart) -> Cow<'a, str> {
    let name = part.name(scene);
    if !name.is_empty() {
        return Cow::Borrowed(name);
    }
    let (key, place) = match part {
        ScenePart::Camera => return Cow::Borrowed(texts.get("outliner-camera")),
        ScenePart::Environment => return Cow::Borrowed(texts.get("outliner-environment")),
        ScenePart::Tracing => return Cow::Borrowed(texts.get("outliner-tracing")),
        ScenePart::Light(place) => ("name-light", place),
        ScenePart::Material(place) => ("name-material", place),
        ScenePart::Body(place) => {
            let name = |body: &Body| shape_name(body.body_shape().kind());
            (scene.bodies.get(place).map_or("name-sphere", name), place)
        }
    };
    let arguments = [("kind", texts.get(key).into()), ("number", (place + 1).into())];
    Cow::Owned(texts.with("outliner-unnamed", &arguments))
}

/// The body that a thing is.
pub(crate) fn body_of(edited: &EditedScene, item: Item) -> Option<&Body> {
    match edited.part(item) {
        Some(ScenePart::Body(place)) => edited.scene().bodies.get(place),
        _ => None,
    }
}

/// The icon of a thing.
pub(crate) fn item_icon(edited: &EditedScene, item: Item) -> MaterialIcon {
    match item {
        Item::Camera => icons::ICON_VIDEOCAM,
        Item::Environment => icons::ICON_LANDSCAPE,
        Item::Tracing => icons::ICON_ROUTE,
        Item::Light(_) => icons::ICON_LIGHTBULB,
        Item::Material(_) => icons::ICON_PALETTE,
        Item::Body(_) => {
            shape_icon(body_of(edited, item).map_or(ShapeKind::Sphere, |body| body.body_shape().kind()))
        }
    }
}

/// The icon of a body or part of this shape.
pub(crate) fn shape_icon(shape: ShapeKind) -> MaterialIcon {
    let command =
        if shape.is_compound() { Command::Edit(join(shape)) } else { AddCommand::Body(shape).into() };
    command.look().map_or(icons::ICON_CIRCLE, |look| look.icon)
}

/// The color of the dot before a name: that of the surface or of the light.
fn item_color(edited: &EditedScene, item: Item) -> Option<egui::Color32> {
    let scene = edited.scene();
    let color = match edited.part(item)? {
        ScenePart::Camera | ScenePart::Environment | ScenePart::Tracing => return None,
        ScenePart::Light(place) => scene.lights.get(place)?.color,
        ScenePart::Material(place) => scene.materials.get(place)?.material.emblem(),
        ScenePart::Body(place) => scene.material(&scene.bodies.get(place)?.material)?.emblem(),
    };
    let [r, g, b] = color.to_srgb8();
    Some(egui::Color32::from_rgb(r, g, b))
}

/// The shared material of a body, if it has one.
fn shared_material(body: &Body) -> Option<&str> {
    match &body.material {
        MaterialChoice::Named(name) => Some(name),
        MaterialChoice::Inline(_) => None,
    }
}
