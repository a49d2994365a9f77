//! The panel of the steps of editing.

use catoptric_editor::Editor;
use egui::accesskit::Role;
use egui::{Rect, ScrollArea, Sense, Ui, WidgetInfo, pos2, vec2};
use egui_material_icons::icons;

use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::widgets::{paint_icon, paint_line};
use crate::state::command_context::step_name;
use crate::state::context::Cx;

/// Height of a row, points.
const ROW: f32 = 24.0;

/// Draws the history; a click goes to that step.
pub(crate) fn history_ui(ui: &mut Ui, cx: &mut Cx<'_>) {
    ui.spacing_mut().item_spacing.y = 0.0;
    let count = cx.editor.steps().len() + 1;
    let done = cx.editor.steps_done();
    let mut wanted = None;
    let seen = ui.scope_id().with("seen");
    let is_new = ui.data_mut(|data| data.get_temp(seen)) != Some((count, done));
    let mut scroll = ScrollArea::vertical().auto_shrink(false);
    if is_new {
        ui.data_mut(|data| data.insert_temp(seen, (count, done)));
        let middle = done as f32 * ROW - 0.5 * ui.available_height();
        scroll = scroll.vertical_scroll_offset(middle.max(0.0));
    }
    scroll.show_rows(ui, ROW, count, |ui, rows| {
        let names = names(cx.editor, cx.texts, &rows);
        for (row, name) in rows.zip(names) {
            if row_ui(ui, cx.texts, &name, row, done) {
                wanted = Some(row);
            }
        }
    });
    if let Some(step) = wanted {
        cx.editor.go_to_step(step);
    }
}

/// The names of the rows: the first row is the document as it was opened, row n the n-th step.
fn names(editor: &Editor, texts: &Texts, rows: &std::ops::Range<usize>) -> Vec<String> {
    let opened = (rows.start == 0).then(|| texts.get("history-opened").to_owned());
    let steps = editor.steps().skip(rows.start.saturating_sub(1));
    opened.into_iter().chain(steps.map(|label| step_name(texts, label))).take(rows.len()).collect()
}

/// Draws a row; returns whether it was clicked.
fn row_ui(ui: &mut Ui, texts: &Texts, name: &str, row: usize, done: usize) -> bool {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
    let is_present = row == done;
    response.widget_info(|| WidgetInfo::selected(Role::ListItem, true, is_present, name));
    let palette = theme::palette(ui.visuals());
    let color = if row > done { palette.weak } else { palette.text };
    if is_present {
        ui.painter().rect_filled(rect, 4.0, palette.selection);
    } else if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, 4.0, palette.hovered);
    }
    let icon = match row.cmp(&done) {
        std::cmp::Ordering::Less => icons::ICON_CHECK,
        std::cmp::Ordering::Equal => icons::ICON_ARROW_FORWARD,
        std::cmp::Ordering::Greater => icons::ICON_REDO,
    };
    let icon_color = if is_present { palette.accent } else { palette.weak };
    paint_icon(ui, icon, pos2(rect.left() + 14.0, rect.center().y), 14.0, icon_color);
    let text = Rect::from_min_max(rect.min + vec2(28.0, 0.0), rect.max - vec2(6.0, 0.0));
    paint_line(ui, text, name, color);
    let tip = if is_present { "history-present" } else { "history-go" };
    response.on_hover_text(format!("{name}\n{}", texts.get(tip))).clicked()
}
