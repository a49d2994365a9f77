//! The list of a folder.

use std::io;

use catoptric_platform::time::SystemTime;

use egui::{Align2, FontId, Frame, Margin, Rect, ScrollArea, Sense, Ui, WidgetInfo, pos2, vec2};
use egui_material_icons::icons;

use super::FileDialog;
use super::listing::{FolderItem, FolderListing};
use crate::base::texts::Texts;
use crate::base::theme::{self, ThemeColors};
use crate::base::widgets::paint_line_in;
use crate::base::words;

const HEIGHT: f32 = 300.0;
const ROW: f32 = 24.0;
const SIZE_WIDTH: f32 = 90.0;
const DATE_WIDTH: f32 = 130.0;

/// Draws the list; returns whether an entry was double-clicked.
pub(super) fn table_ui(ui: &mut Ui, dialog: &mut FileDialog, texts: &Texts) -> bool {
    let palette = theme::palette(ui.visuals());
    let frame = Frame::new().fill(palette.field).corner_radius(6.0).inner_margin(Margin::same(4));
    let scrolls = std::mem::take(&mut dialog.scrolls);
    let chosen = frame
        .show(ui, |ui| {
            ui.set_height(HEIGHT);
            let entries = dialog.entries();
            let message = match &dialog.listing {
                None => Some("files-reading"),
                Some(FolderListing { entries: Err(kind), .. }) => Some(match kind {
                    io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => "files-no-folder",
                    io::ErrorKind::PermissionDenied => "files-denied",
                    _ => "files-failed",
                }),
                Some(_) => entries.is_empty().then_some("files-empty"),
            };
            match message {
                Some(key) => {
                    ui.centered_and_justified(|ui| ui.weak(texts.get(key)));
                    None
                }
                None => {
                    let selected =
                        entries.iter().position(|entry| Some(&entry.name) == dialog.selected.as_ref());
                    rows_ui(ui, &entries, selected, scrolls, texts)
                }
            }
        })
        .inner;
    let Some(ClickedRow { name, is_folder, opens }) = chosen else { return false };
    dialog.select(&name, is_folder);
    opens
}

/// The row that was clicked, once or twice.
struct ClickedRow {
    name: String,
    is_folder: bool,
    opens: bool,
}

fn rows_ui(
    ui: &mut Ui,
    entries: &[&FolderItem],
    selected: Option<usize>,
    scrolls: bool,
    texts: &Texts,
) -> Option<ClickedRow> {
    let palette = theme::palette(ui.visuals());
    let mut chosen = None;
    ui.spacing_mut().item_spacing.y = 0.0;
    let mut area = ScrollArea::vertical().id_salt("files").auto_shrink(false);
    if scrolls && let Some(selected) = selected {
        area = area.vertical_scroll_offset((selected as f32 * ROW - 0.5 * HEIGHT).max(0.0));
    }
    area.show_rows(ui, ROW, entries.len(), |ui, range| {
        for (index, entry) in entries.iter().enumerate().skip(range.start).take(range.len()) {
            let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
            let is_selected = selected == Some(index);
            response.widget_info(|| {
                WidgetInfo::selected(egui::accesskit::Role::Button, true, is_selected, &entry.name)
            });
            if is_selected {
                ui.painter().rect_filled(rect, 4.0, palette.selection);
            } else if response.hovered() || response.has_focus() {
                ui.painter().rect_filled(rect, 4.0, palette.button);
            }
            row_ui(ui, rect, entry, texts, palette);
            if response.clicked() {
                let (name, is_folder) = (entry.name.clone(), entry.is_folder);
                chosen = Some(ClickedRow { name, is_folder, opens: response.double_clicked() });
            }
        }
    });
    chosen
}

fn row_ui(ui: &Ui, rect: Rect, entry: &FolderItem, texts: &Texts, palette: &ThemeColors) {
    let font = FontId::proportional(13.5);
    let small = FontId::proportional(12.0);
    let middle = rect.center().y;
    let icon = if entry.is_folder { icons::ICON_FOLDER.codepoint } else { icons::ICON_DRAFT.codepoint };
    let icon_color = if entry.is_folder { palette.accent } else { palette.weak };
    let painter = ui.painter();
    let icon_font = FontId::proportional(16.0);
    painter.text(pos2(rect.min.x + 8.0, middle), Align2::LEFT_CENTER, icon, icon_font, icon_color);
    let date_start = rect.max.x - DATE_WIDTH;
    let size_start = date_start - SIZE_WIDTH;
    let name_rect = rect.with_min_x(rect.min.x + 32.0).with_max_x(size_start - 8.0);
    paint_line_in(ui, name_rect, &entry.name, font, palette.text);
    if !entry.is_folder {
        let size = words::bytes(texts, entry.bytes);
        let end = pos2(date_start - 12.0, middle);
        painter.text(end, Align2::RIGHT_CENTER, size, small.clone(), palette.weak);
    }
    if let Some(modified) = entry.modified {
        let age = age(texts, modified);
        painter.text(pos2(rect.max.x - 8.0, middle), Align2::RIGHT_CENTER, age, small, palette.weak);
    }
}

/// How long ago something was.
pub(crate) fn age(texts: &Texts, time: SystemTime) -> String {
    let passed = SystemTime::now().duration_since(time).unwrap_or_default();
    let minutes = passed.as_secs() / 60;
    let (key, number) = match minutes {
        0 => ("ago-now", 0),
        1..60 => ("ago-minutes", minutes),
        60..1440 => ("ago-hours", minutes / 60),
        _ => ("ago-days", minutes / 1440),
    };
    texts.with(key, &[("number", number.into())])
}
