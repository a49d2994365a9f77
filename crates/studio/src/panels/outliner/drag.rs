//! Rows that are dragged: to another place of their list, or a material onto a body.

use catoptric_editor::{Action, EditedScene, Item, Selection};
use catoptric_scene::{MaterialChoice, ScenePart};
use egui::{Align2, CursorIcon, Id, LayerId, Order, Rect, Stroke, StrokeKind, TextStyle, Ui, pos2, vec2};

use super::rows::{OutlinerRow, OutlinerSection};
use super::{Outliner, ROW, item_name};
use crate::base::theme;
use crate::state::command::Command;
use crate::state::context::Cx;

/// How near to the edge of the list dragging scrolls it, points.
const EDGE: f32 = 18.0;

/// The target of dragged rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum DropTarget {
    /// Before the element at this place of its list; the line is drawn above this row.
    Place { index: usize, row: usize },
    /// Onto this body.
    Body { item: Item, row: usize },
}

/// Begins to drag `item`, with all that is selected if it is. A material stays as unselected as it was, so that the
/// bodies it may be meant for stay selected.
pub(super) fn start(cx: &mut Cx<'_>, outliner: &mut Outliner, item: Item) {
    if !matches!(item, Item::Material(_)) && !cx.editor.selection().contains(item) {
        cx.editor.select(item);
    }
    outliner.shown = cx.editor.selection().primary();
    outliner.dragged = Some(item);
}

/// Shows where what is dragged would go, and lets it go there. `top` is where the first row begins, `list` what is
/// seen of the list.
pub(super) fn drag_ui(ui: &mut Ui, cx: &mut Cx<'_>, outliner: &mut Outliner, top: f32, list: Rect) {
    let Some(item) = outliner.dragged else { return };
    if !cx.editor.edited().contains(item) || ui.input(|input| input.key_pressed(egui::Key::Escape)) {
        outliner.dragged = None;
        return;
    }
    let pointer = ui.input(|input| input.pointer.latest_pos());
    let drop = pointer
        .filter(|at| list.expand2(vec2(0.0, EDGE)).contains(*at))
        .and_then(|at| find(cx.editor.edited(), outliner.rows.all(), item, (at.y - top) / ROW));
    if !ui.input(|input| input.pointer.any_down()) {
        outliner.dragged = None;
        if let Some(drop) = drop {
            let_go(cx, item, drop);
        }
        return;
    }
    if let Some(at) = pointer {
        scroll(ui, at.y, list);
        ghost(ui, cx, item, at);
    }
    ui.ctx().set_cursor_icon(if drop.is_some() { CursorIcon::Grabbing } else { CursorIcon::NoDrop });
    if let Some(drop) = drop {
        paint(ui, drop, top);
    }
}

/// Where `item` would go if it were dropped at `height`, counted in rows from the first.
fn find(edited: &EditedScene, rows: &[OutlinerRow], item: Item, height: f32) -> Option<DropTarget> {
    let section = OutlinerSection::of(item)?;
    let index_of = |item: Item| match edited.part(item) {
        Some(ScenePart::Light(index) | ScenePart::Body(index) | ScenePart::Material(index)) => index,
        _ => 0,
    };
    let row = height.max(0.0) as usize;
    match rows.get(row) {
        Some(OutlinerRow::Item(under)) if OutlinerSection::of(*under) == Some(section) => {
            let below = usize::from(height.fract() >= 0.5);
            Some(DropTarget::Place { index: index_of(*under) + below, row: row + below })
        }
        Some(OutlinerRow::Item(body @ Item::Body(_))) if section == OutlinerSection::Materials => {
            Some(DropTarget::Body { item: *body, row })
        }
        Some(OutlinerRow::Head(under, _)) if *under == section => {
            Some(DropTarget::Place { index: 0, row: row + 1 })
        }
        // The next head, or nothing more: the end of the list.
        other => {
            let last = rows.iter().rposition(
                |row| matches!(row, OutlinerRow::Item(item) if OutlinerSection::of(*item) == Some(section)),
            )?;
            let is_end = other.is_none() || row == last + 1;
            let Some(OutlinerRow::Item(item)) = rows.get(last).filter(|_| is_end) else { return None };
            Some(DropTarget::Place { index: index_of(*item) + 1, row: last + 1 })
        }
    }
}

fn let_go(cx: &mut Cx<'_>, item: Item, drop: DropTarget) {
    match drop {
        DropTarget::Place { index, .. } => {
            // The primary thing decides which list is meant.
            let mut selection = cx.editor.selection().clone();
            if selection.contains(item) {
                selection.add(item);
            } else {
                selection = Selection::one(item);
            }
            cx.editor.select(selection);
            cx.run(Command::Edit(Action::MoveToIndex(index)));
        }
        DropTarget::Body { item: body, .. } => {
            let name = cx.editor.edited().name(item).to_owned();
            if !cx.editor.selection().contains(body) {
                cx.editor.select(body);
            }
            cx.run(Command::Edit(Action::AssignMaterial(MaterialChoice::Named(name))));
        }
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

fn paint(ui: &Ui, drop: DropTarget, top: f32) {
    let color = theme::palette(ui.visuals()).accent;
    let stroke = Stroke::new(2.0, color);
    let across = ui.max_rect().x_range();
    match drop {
        DropTarget::Place { row, .. } => {
            let y = top + row as f32 * ROW;
            ui.painter().hline(across.min + 12.0..=across.max, y, stroke);
            ui.painter().circle_filled(pos2(across.min + 10.0, y), 3.0, color);
        }
        DropTarget::Body { row, .. } => {
            let y = top + row as f32 * ROW;
            let rect = Rect::from_x_y_ranges(across, y..=y + ROW);
            ui.painter().rect_stroke(rect, 4.0, stroke, StrokeKind::Inside);
        }
    }
}

/// What is dragged, beside the pointer.
fn ghost(ui: &Ui, cx: &Cx<'_>, item: Item, at: egui::Pos2) {
    let name = item_name(cx.texts, cx.editor.edited(), item);
    let selection = cx.editor.selection();
    let count =
        selection.iter().filter(|other| OutlinerSection::of(*other) == OutlinerSection::of(item)).count();
    let text =
        if selection.contains(item) && count > 1 { format!("{name}  +{}", count - 1) } else { name.into() };
    let palette = theme::palette(ui.visuals());
    let painter = ui.ctx().layer_painter(LayerId::new(Order::Tooltip, Id::unique("outliner ghost")));
    let font = TextStyle::Body.resolve(ui.style());
    let galley = painter.layout_no_wrap(text, font, palette.text);
    let rect = Align2::LEFT_CENTER.anchor_size(at + vec2(16.0, 4.0), galley.size() + vec2(16.0, 8.0));
    painter.rect(rect, 4.0, palette.button, Stroke::new(1.0, palette.line), StrokeKind::Inside);
    painter.galley(rect.min + vec2(8.0, 4.0), galley, palette.text);
}

#[cfg(test)]
mod tests {
    use catoptric_editor::Editor;
    use catoptric_scene::{Body, Light, Material, NamedMaterial, Scene};

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
        assert_eq!(find(edited, &rows, body, 4.2), place(0, 4));
        assert_eq!(find(edited, &rows, body, 4.7), place(1, 5));
        assert_eq!(find(edited, &rows, body, 5.7), place(2, 6));
        assert_eq!(find(edited, &rows, body, 6.3), place(2, 6));
        assert_eq!(find(edited, &rows, body, 3.3), place(0, 4));
        assert_eq!(find(edited, &rows, body, 2.5), None);
        assert_eq!(find(edited, &rows, body, 20.0), place(2, 6));
        assert_eq!(find(edited, &rows, material, 5.5), Some(DropTarget::Body { item: other, row: 5 }));
        assert_eq!(find(edited, &rows, material, 2.5), None);
        assert_eq!(find(edited, &rows, material, 7.9), place(1, 8));
    }
}
