//! Rows that are dragged: to another place of their list, into a joined body or out of it, or a material onto a body.

use catoptric_editor::{Action, EditedScene, Item, PartPath, PartSlot, Selection};
use catoptric_scene::{MaterialChoice, ScenePart};
use egui::{Align2, CursorIcon, Id, LayerId, Order, Rect, Stroke, StrokeKind, TextStyle, Ui, pos2, vec2};

use super::part_row::STEP;
use super::rows::{OutlinerRow, OutlinerSection};
use super::{Outliner, ROW, body_of, has_place, meant, path_title};
use crate::base::theme;
use crate::state::command::Command;
use crate::state::context::Cx;
use crate::state::refusal;

/// How near to the edge of the list dragging scrolls it, points.
const EDGE: f32 = 18.0;

/// The part of a row, at its upper and at its lower edge, that means the place before or after it.
const BESIDE: f32 = 0.25;

/// The target of dragged rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum DropTarget {
    /// Before the element at this place of its list; the line is drawn above this row.
    Place { index: usize, row: usize },
    /// Before a part; the line is drawn above this row.
    Between { slot: PartSlot, row: usize },
    /// After the other parts of what is joined; the frame is drawn around this row.
    Onto { slot: PartSlot, row: usize },
    /// A material onto this body or part of it.
    Paint { item: Item, part: PartPath, row: usize },
}

/// Why what is dragged cannot be dropped at a target; asked once for each.
pub(super) struct CheckedDrop {
    target: DropTarget,
    /// `None` if it can be.
    refused: Option<String>,
}

impl DropTarget {
    /// What a drop does; `is_part` tells whether a part is dragged. `None` for materials.
    fn action(self, is_part: bool) -> Option<Action> {
        Some(match self {
            Self::Place { index, .. } if is_part => Action::TakeOut(Some(index)),
            Self::Place { index, .. } => Action::MoveToIndex(index),
            Self::Between { slot, .. } | Self::Onto { slot, .. } => Action::Nest(Some(slot)),
            Self::Paint { .. } => return None,
        })
    }
}

/// Begins to drag `item` or a part of it, with all that is selected if it is. A material stays as unselected as it was, so
/// that the bodies it may be meant for stay selected.
pub(super) fn start(cx: &mut Cx<'_>, outliner: &mut Outliner, (item, path): (Item, PartPath)) {
    let selection = cx.editor.selection();
    let is_selected = selection.contains(item) && selection.part().unwrap_or(PartPath::WHOLE) == path;
    if !matches!(item, Item::Material(_)) && !is_selected {
        cx.editor.select(Selection::of_part(item, path));
    }
    outliner.shown = meant(cx.editor.selection());
    outliner.dragged = Some((item, path));
    outliner.checked_drop = None;
}

/// Shows where what is dragged would go, and lets it go there. `top` is where the first row begins, `list` what is
/// seen of the list.
pub(super) fn drag_ui(ui: &mut Ui, cx: &mut Cx<'_>, outliner: &mut Outliner, top: f32, list: Rect) {
    let Some(dragged) = outliner.dragged else { return };
    let is_there = has_place(cx.editor.edited(), dragged);
    if !is_there || ui.input(|input| input.key_pressed(egui::Key::Escape)) {
        outliner.dragged = None;
        return;
    }
    let pointer = ui.input(|input| input.pointer.latest_pos());
    let drop = pointer
        .filter(|at| list.expand2(vec2(0.0, EDGE)).contains(*at))
        .and_then(|at| find(cx.editor.edited(), outliner.rows.all(), dragged, (at.y - top) / ROW));
    if !ui.input(|input| input.pointer.any_down()) {
        outliner.dragged = None;
        if let Some(drop) = drop {
            let_go(cx, dragged, drop);
        }
        return;
    }
    let refused = drop.and_then(|drop| refusal_of(cx, outliner, dragged, drop));
    if let Some(at) = pointer {
        scroll(ui, at.y, list);
        ghost(ui, cx, dragged, refused.as_deref(), at);
    }
    let is_possible = drop.is_some() && refused.is_none();
    ui.ctx().set_cursor_icon(if is_possible { CursorIcon::Grabbing } else { CursorIcon::NoDrop });
    if let Some(drop) = drop {
        paint(ui, drop, top, is_possible);
    }
}

/// Why a drop is impossible. Moves within a list always are possible.
fn refusal_of(
    cx: &Cx<'_>,
    outliner: &mut Outliner,
    dragged: (Item, PartPath),
    target: DropTarget,
) -> Option<String> {
    let action = target.action(!dragged.1.is_whole())?;
    if matches!(action, Action::MoveToIndex(_)) {
        return None;
    }
    if outliner.checked_drop.as_ref().is_none_or(|checked| checked.target != target) {
        let refused = cx.editor.try_out(&action).err();
        let refused = refused.and_then(|error| refusal::of_action(cx.texts, &error));
        outliner.checked_drop = Some(CheckedDrop { target, refused });
    }
    outliner.checked_drop.as_ref().and_then(|checked| checked.refused.clone())
}

/// Where what is dragged would go if it were dropped at `height`, counted in rows from the first.
fn find(
    edited: &EditedScene,
    rows: &[OutlinerRow],
    dragged: (Item, PartPath),
    height: f32,
) -> Option<DropTarget> {
    let section = OutlinerSection::of(dragged.0)?;
    let row = height.max(0.0) as usize;
    match (rows.get(row), section) {
        (
            Some(under @ (OutlinerRow::Item(Item::Body(_)) | OutlinerRow::Part(..))),
            OutlinerSection::Materials,
        ) => {
            let (item, part) = under.place()?;
            Some(DropTarget::Paint { item, part, row })
        }
        (Some(under @ (OutlinerRow::Item(_) | OutlinerRow::Part(..))), _)
            if under.place().and_then(|place| OutlinerSection::of(place.0)) == Some(section) =>
        {
            let unfolded = rows.get(row + 1).and_then(|next| next.place());
            beside(edited, dragged, (under.place()?, unfolded), row, height.fract())
        }
        (Some(OutlinerRow::Head(under, _)), _) if *under == section => {
            Some(DropTarget::Place { index: 0, row: row + 1 })
        }
        // The next head, or nothing more: the end of the list.
        (other, _) => {
            let is_ours = |row: &OutlinerRow| {
                row.place().and_then(|place| OutlinerSection::of(place.0)) == Some(section)
            };
            let last = rows.iter().rposition(is_ours)?;
            let is_end = other.is_none() || row == last + 1;
            let (item, _) = rows.get(last).filter(|_| is_end)?.place()?;
            Some(DropTarget::Place { index: index_of(edited, item) + 1, row: last + 1 })
        }
    }
}

fn index_of(edited: &EditedScene, item: Item) -> usize {
    match edited.part(item) {
        Some(ScenePart::Light(index) | ScenePart::Body(index) | ScenePart::Material(index)) => index,
        _ => 0,
    }
}

/// The target at a height within the row of a thing or part, with what the next row has: before it, after it, or among
/// its parts.
fn beside(
    edited: &EditedScene,
    dragged: (Item, PartPath),
    ((item, path), next): ((Item, PartPath), Option<(Item, PartPath)>),
    row: usize,
    height: f32,
) -> Option<DropTarget> {
    let parts = body_of(edited, item).and_then(|body| path.parts(body));
    let takes_parts = parts.is_some() && (item, path) != dragged && matches!(dragged.0, Item::Body(_));
    let slot = |within: PartPath, place: usize| PartSlot { whole: item, within, place };
    if takes_parts && (BESIDE..1.0 - BESIDE).contains(&height) {
        return Some(DropTarget::Onto { slot: slot(path, parts.map_or(0, <[_]>::len)), row });
    }
    let is_below = height >= 0.5;
    let below = usize::from(is_below);
    let is_unfolded = next.is_some_and(|(other, part)| other == item && part.parent() == Some(path));
    if takes_parts && is_below && is_unfolded {
        return Some(DropTarget::Between { slot: slot(path, 0), row: row + 1 });
    }
    match (path.parent(), path.place()) {
        (Some(around), Some(place)) => {
            Some(DropTarget::Between { slot: slot(around, place + below), row: row + below })
        }
        _ => Some(DropTarget::Place { index: index_of(edited, item) + below, row: row + below }),
    }
}

fn let_go(cx: &mut Cx<'_>, (item, path): (Item, PartPath), drop: DropTarget) {
    match (drop, drop.action(!path.is_whole())) {
        (DropTarget::Paint { item: body, part, .. }, _) => {
            let name = cx.editor.edited().name(item).to_owned();
            if !cx.editor.selection().contains(body) || !part.is_whole() {
                cx.editor.select(Selection::of_part(body, part));
            }
            cx.run(Command::Edit(Action::AssignMaterial(MaterialChoice::Named(name))));
        }
        (_, Some(action)) => {
            if path.is_whole() {
                // The primary thing decides which list is meant.
                let mut selection = cx.editor.selection().clone();
                if selection.contains(item) {
                    selection.add(item);
                } else {
                    selection = Selection::one(item);
                }
                cx.editor.select(selection);
            } else {
                cx.editor.select(Selection::of_part(item, path));
            }
            cx.run(Command::Edit(action));
        }
        (_, None) => {}
    }
}

/// Scrolls while the pointer is at an edge of the list.
fn scroll(ui: &Ui, y: f32, list: Rect) {
    let beyond = (list.top() + EDGE - y).max(0.0) - (y - list.bottom() + EDGE).max(0.0);
    if beyond != 0.0 {
        ui.scroll_with_delta(vec2(0.0, beyond.clamp(-EDGE, EDGE) * 0.5));
        ui.ctx().request_repaint();
    }
}

fn paint(ui: &Ui, drop: DropTarget, top: f32, is_possible: bool) {
    let palette = theme::palette(ui.visuals());
    let color = if is_possible { palette.accent } else { palette.weak };
    let stroke = Stroke::new(2.0, color);
    let across = ui.max_rect().x_range();
    let line = |row: usize, depth: usize| {
        let y = top + row as f32 * ROW;
        let left = across.min + 10.0 + STEP * depth as f32;
        ui.painter().hline(left + 2.0..=across.max, y, stroke);
        ui.painter().circle_filled(pos2(left, y), 3.0, color);
    };
    match drop {
        DropTarget::Place { row, .. } => line(row, 0),
        DropTarget::Between { slot, row } => line(row, slot.within.depth() + 1),
        DropTarget::Onto { row, .. } | DropTarget::Paint { row, .. } => {
            let y = top + row as f32 * ROW;
            let rect = Rect::from_x_y_ranges(across, y..=y + ROW);
            ui.painter().rect_stroke(rect, 4.0, stroke, StrokeKind::Inside);
        }
    }
}

/// What is dragged, beside the pointer, and why it cannot be dropped there.
fn ghost(ui: &Ui, cx: &Cx<'_>, dragged: (Item, PartPath), refused: Option<&str>, at: egui::Pos2) {
    /// The width at which a reason begins another line, points.
    const WIDTH: f32 = 260.0;
    let (item, path) = dragged;
    let name = path_title(cx.texts, cx.editor.edited(), dragged);
    let selection = cx.editor.selection();
    let count =
        selection.iter().filter(|other| OutlinerSection::of(*other) == OutlinerSection::of(item)).count();
    let is_several = path.is_whole() && selection.contains(item) && count > 1;
    let text = if is_several { format!("{name}  +{}", count - 1) } else { name.into() };
    let palette = theme::palette(ui.visuals());
    let painter = ui.ctx().layer_painter(LayerId::new(Order::Tooltip, Id::unique("outliner ghost")));
    let font = TextStyle::Body.resolve(ui.style());
    let title = painter.layout_no_wrap(text, font, palette.text);
    let font = TextStyle::Small.resolve(ui.style());
    let reason = refused.map(|text| painter.layout(text.to_owned(), font, palette.warning, WIDTH));
    let below = reason.as_ref().map_or(egui::Vec2::ZERO, |reason| reason.size() + vec2(0.0, 2.0));
    let size = vec2(title.size().x.max(below.x), title.size().y + below.y);
    let rect = Align2::LEFT_TOP.anchor_size(at + vec2(16.0, -8.0), size + vec2(16.0, 8.0));
    painter.rect(rect, 4.0, palette.button, Stroke::new(1.0, palette.line), StrokeKind::Inside);
    let corner = rect.min + vec2(8.0, 4.0);
    let line = vec2(0.0, title.size().y + 2.0);
    painter.galley(corner, title, palette.text);
    if let Some(reason) = reason {
        painter.galley(corner + line, reason, palette.warning);
    }
}

#[cfg(test)]
mod tests {
    use catoptric_editor::Editor;
    use catoptric_scene::{Body, BodyPart, Light, Material, NamedMaterial, Scene, Shape};

    use super::*;

    #[test]
    fn things_go_between_their_like_and_materials_onto_bodies() {
        let scene = Scene {
            materials: vec![NamedMaterial { name: "gold".to_owned(), material: Material::default() }],
            lights: vec![Light::default()],
            bodies: [Body::default(), Body::default()].into(),
            ..Scene::default()
        };
        let editor = Editor::new(scene);
        let edited = editor.edited();
        let item = |part| edited.item(part).unwrap();
        let (light, material) = (item(ScenePart::Light(0)), item(ScenePart::Material(0)));
        let [body, other] = [item(ScenePart::Body(0)), item(ScenePart::Body(1))];
        let rows = [
            OutlinerRow::Item(Item::Camera),
            OutlinerRow::Head(OutlinerSection::Lights, 1),
            OutlinerRow::Item(light),
            OutlinerRow::Head(OutlinerSection::Bodies, 2),
            OutlinerRow::Item(body),
            OutlinerRow::Item(other),
            OutlinerRow::Head(OutlinerSection::Materials, 1),
            OutlinerRow::Item(material),
        ];
        let place = |index, row| Some(DropTarget::Place { index, row });
        assert_eq!(find(edited, &rows, (body, PartPath::WHOLE), 4.2), place(0, 4));
        assert_eq!(find(edited, &rows, (body, PartPath::WHOLE), 4.7), place(1, 5));
        assert_eq!(find(edited, &rows, (body, PartPath::WHOLE), 5.7), place(2, 6));
        assert_eq!(find(edited, &rows, (body, PartPath::WHOLE), 6.3), place(2, 6));
        assert_eq!(find(edited, &rows, (body, PartPath::WHOLE), 3.3), place(0, 4));
        assert_eq!(find(edited, &rows, (body, PartPath::WHOLE), 2.5), None);
        assert_eq!(find(edited, &rows, (body, PartPath::WHOLE), 20.0), place(2, 6));
        assert_eq!(
            find(edited, &rows, (material, PartPath::WHOLE), 5.5),
            Some(DropTarget::Paint { item: other, part: PartPath::WHOLE, row: 5 })
        );
        assert_eq!(find(edited, &rows, (material, PartPath::WHOLE), 2.5), None);
        assert_eq!(find(edited, &rows, (material, PartPath::WHOLE), 7.9), place(1, 8));
    }

    #[test]
    fn bodies_and_parts_go_between_parts_and_onto_what_is_joined() {
        let parts = vec![BodyPart::default(), BodyPart::default()];
        let joined = Body { shape: Shape::Union, parts, ..Body::default() };
        let editor = Editor::new(Scene { bodies: [joined, Body::default()].into(), ..Scene::default() });
        let edited = editor.edited();
        let [whole, ball] = [0, 1].map(|index| edited.item(ScenePart::Body(index)).unwrap());
        let part = |place| PartPath::WHOLE.child(place).unwrap();
        let rows = [
            OutlinerRow::Head(OutlinerSection::Bodies, 2),
            OutlinerRow::Item(whole),
            OutlinerRow::Part(whole, part(0)),
            OutlinerRow::Part(whole, part(1)),
            OutlinerRow::Item(ball),
        ];
        let slot = |place| PartSlot { whole, within: PartPath::WHOLE, place };
        for dragged in [(ball, PartPath::WHOLE), (whole, part(1))] {
            let at = |height| find(edited, &rows, dragged, height).unwrap();
            assert_eq!(at(1.1), DropTarget::Place { index: 0, row: 1 });
            assert_eq!(at(1.5), DropTarget::Onto { slot: slot(2), row: 1 });
            assert_eq!(at(1.9), DropTarget::Between { slot: slot(0), row: 2 });
            assert_eq!(at(2.7), DropTarget::Between { slot: slot(1), row: 3 });
            assert_eq!(at(3.6), DropTarget::Between { slot: slot(2), row: 4 });
            assert_eq!(at(4.6), DropTarget::Place { index: 2, row: 5 });
            assert_eq!(at(9.0), DropTarget::Place { index: 2, row: 5 });
        }
        // A whole is not dropped onto itself.
        let own = find(edited, &rows, (whole, PartPath::WHOLE), 1.5);
        assert_eq!(own, Some(DropTarget::Place { index: 1, row: 2 }));
        let out = DropTarget::Place { index: 2, row: 5 };
        assert_eq!(out.action(true), Some(Action::TakeOut(Some(2))));
        assert_eq!(out.action(false), Some(Action::MoveToIndex(2)));
    }
}
