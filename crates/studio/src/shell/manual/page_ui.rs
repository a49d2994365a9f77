//! A page of the manual as it is read.

mod spans;
mod table;

use egui::{Color32, Frame, Label, Margin, Rect, RichText, ScrollArea, Sense, Stroke, Ui, Vec2, pos2, vec2};
use egui_material_icons::icons;

use super::formula::{Formula, lines};
use super::markdown::{Block, BlockContent, ManualLink, ManualPage};
use super::missing_glyphs;
use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::widgets::icon_button;

/// How far lists and quotations are set in, points.
const INDENT: f32 = 20.0;
/// Size of a formula of its own, points.
const FORMULA: f32 = 15.5;
/// Lines longer than this are hard to read, points.
const MOST_WIDTH: f32 = 760.0;

/// The offsets of the blocks of a page, so that only those in view are drawn.
#[derive(Default)]
pub(super) struct BlockOffsets {
    /// What the heights depend on.
    of: Option<(usize, crate::base::texts::Language, i32)>,
    /// The top of each block, and the end of the last one, points.
    tops: Vec<f32>,
}

/// A page to draw, with the place in it.
pub(super) struct PageView<'a> {
    pub(super) page: &'a ManualPage,
    /// The place of the page.
    pub(super) place: usize,
    /// The block that was searched for.
    pub(super) marked: Option<usize>,
    pub(super) texts: &'a Texts,
}

/// Draws a page that can be scrolled; `to` is the block to scroll to, which is forgotten when that has been done,
/// `step` how far the keys scroll, points. Returns the link that was followed.
pub(super) fn page_ui(
    ui: &mut Ui,
    shown: &PageView<'_>,
    measured: &mut BlockOffsets,
    to: &mut Option<usize>,
    step: f32,
) -> Option<ManualLink> {
    let width = (ui.available_width() - 24.0).clamp(80.0, MOST_WIDTH);
    let of = Some((shown.place, shown.texts.language(), width as i32));
    let is_measured = measured.of == of;
    let mut area = ScrollArea::vertical().id_salt(("manual page", shown.place)).auto_shrink(false);
    if is_measured && let Some(block) = to.take() {
        area = area.vertical_scroll_offset(measured.tops.get(block).copied().unwrap_or(0.0));
    }
    let mut followed = None;
    area.show_viewport(ui, |ui, view| {
        if step != 0.0 {
            ui.scroll_with_delta(vec2(0.0, -step));
        }
        ui.spacing_mut().item_spacing = Vec2::ZERO;
        ui.set_width(width);
        let start = ui.cursor().top();
        let blocks = shown.page.blocks.iter().enumerate();
        if is_measured {
            let (first, last) = in_view(&measured.tops, view);
            ui.set_height(measured.tops.last().copied().unwrap_or(0.0));
            ui.add_space(measured.tops.get(first).copied().unwrap_or(0.0));
            for (place, block) in blocks.skip(first).take(last - first) {
                followed = block_ui(ui, shown, place, block).or(followed.take());
            }
            return;
        }
        measured.tops.clear();
        for (place, block) in blocks {
            measured.tops.push(ui.cursor().top() - start);
            followed = block_ui(ui, shown, place, block).or(followed.take());
        }
        measured.tops.push(ui.cursor().top() - start);
        measured.of = of;
        ui.ctx().request_repaint();
    });
    followed
}

/// The first block in view, and the one after the last.
fn in_view(tops: &[f32], view: Rect) -> (usize, usize) {
    let count = tops.len().saturating_sub(1);
    let first = tops.partition_point(|top| *top <= view.min.y).saturating_sub(1).min(count);
    (first, tops.partition_point(|top| *top < view.max.y).clamp(first, count))
}

fn block_ui(ui: &mut Ui, shown: &PageView<'_>, place: usize, block: &Block) -> Option<ManualLink> {
    let palette = theme::palette(ui.visuals());
    let background = ui.painter().add(egui::Shape::Noop);
    let is_marked = shown.marked == Some(place);
    let inner = ui.push_id(place, |ui| {
        let indent = block.indent.saturating_sub(usize::from(block.indent > 0)) as f32 * INDENT;
        ui.horizontal_top(|ui| {
            ui.add_space(indent);
            ui.vertical(|ui| content_ui(ui, shown, block)).inner
        })
        .inner
    });
    if is_marked {
        let rect = inner.response.rect.expand2(vec2(6.0, 1.0));
        let fill = palette.selection.gamma_multiply(0.6);
        ui.painter().set(background, egui::Shape::rect_filled(rect, 4.0, fill));
    }
    ui.add_space(9.0);
    inner.inner
}

fn content_ui(ui: &mut Ui, shown: &PageView<'_>, block: &Block) -> Option<ManualLink> {
    let palette = theme::palette(ui.visuals());
    match &block.content {
        BlockContent::Heading { level, spans, .. } => {
            let size = [22.0, 17.0, 14.5].get(level.saturating_sub(1)).copied().unwrap_or(13.5);
            ui.add_space(if *level == 1 { 2.0 } else { 10.0 });
            let followed = spans::spans_ui(ui, spans, size, shown.texts);
            if *level <= 2 {
                let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 5.0), Sense::hover());
                ui.painter().hline(rect.x_range(), rect.bottom(), Stroke::new(1.0, palette.line));
            }
            followed
        }
        BlockContent::Paragraph { marker: None, spans } if block.indent == 0 => {
            spans::spans_ui(ui, spans, spans::BODY, shown.texts)
        }
        BlockContent::Paragraph { marker, spans } => {
            ui.horizontal_top(|ui| {
                let size = vec2(INDENT, spans::ROW);
                let (rect, _) = ui.allocate_exact_size(size, Sense::hover());
                if let Some(marker) = marker {
                    let font = egui::FontId::proportional(spans::BODY);
                    let at = pos2(rect.right() - 7.0, rect.center().y);
                    ui.painter().text(at, egui::Align2::RIGHT_CENTER, marker, font, palette.weak);
                }
                ui.vertical(|ui| spans::spans_ui(ui, spans, spans::BODY, shown.texts)).inner
            })
            .inner
        }
        BlockContent::Code(code) => {
            code_ui(ui, code, shown.texts);
            None
        }
        BlockContent::Table(rows) => table::table_ui(ui, rows, shown.texts),
        BlockContent::Formula(formula) => {
            formula_ui(ui, formula);
            None
        }
        BlockContent::Line => {
            let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), 5.0), Sense::hover());
            ui.painter().hline(rect.x_range(), rect.center().y, Stroke::new(1.0, palette.line));
            None
        }
    }
}

/// A formula of its own, in as many lines as it needs.
fn formula_ui(ui: &mut Ui, formula: &Formula) {
    let color = ui.visuals().text_color();
    let room = (ui.available_width() - 2.0 * INDENT).max(60.0);
    for (place, line) in lines(ui, formula.node(), (FORMULA, color), true, room).iter().enumerate() {
        let left = if place == 0 { INDENT } else { 2.0 * INDENT };
        let size = vec2(left + line.width, line.ascent + line.descent + 8.0);
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        line.paint(ui, pos2(rect.left() + left, rect.top() + 4.0 + line.ascent), color);
        if place == 0 {
            spans::name(&response, &formula.plain());
        }
    }
}

/// Text with its own lines, which can be copied.
fn code_ui(ui: &mut Ui, code: &str, texts: &Texts) {
    let palette = theme::palette(ui.visuals());
    let shown = missing_glyphs::simplified(code);
    let frame = Frame::new().fill(palette.field).corner_radius(5.0).inner_margin(Margin::symmetric(10, 7));
    let framed = frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        ScrollArea::horizontal().id_salt("code").show(ui, |ui| {
            let text = RichText::new(&shown).monospace().color(palette.text);
            let response = ui.add(Label::new(text).extend().selectable(true));
            hats_ui(ui, response.rect, code, &shown, palette.text);
        });
    });
    let rect = framed.response.rect;
    if ui.rect_contains_pointer(rect) {
        let corner = Rect::from_min_size(rect.right_top() + vec2(-27.0, 4.0), Vec2::splat(22.0));
        let builder = egui::UiBuilder::new().max_rect(corner);
        let copies = ui.scope_builder(builder, |ui| {
            icon_button(ui, icons::ICON_CONTENT_COPY, texts.get("manual-copy"), false).clicked()
        });
        if copies.inner {
            ui.ctx().copy_text(code.to_owned());
        }
    }
}

/// Draws the hats of letters, which the font does not have.
fn hats_ui(ui: &Ui, rect: Rect, code: &str, shown: &str, color: Color32) {
    let hats = missing_glyphs::hats(code);
    if hats.is_empty() {
        return;
    }
    let font = egui::TextStyle::Monospace.resolve(ui.style());
    let galley = ui.painter().layout_no_wrap(shown.to_owned(), font, color);
    for hat in hats {
        let place = |index| galley.pos_from_cursor(egui::text::CCursor::new(index));
        let (letter, next) = (place(hat), place(hat + 1));
        let (left, right) = (rect.left() + letter.left(), rect.left() + next.left());
        // Capitals are as high as the line, nearly.
        let is_high = shown.chars().nth(hat).is_some_and(char::is_uppercase);
        let foot = rect.top() + letter.top() + if is_high { 2.0 } else { 5.0 };
        let middle = 0.5 * (left + right);
        let reach = 0.32 * (right - left);
        let points = vec![pos2(middle - reach, foot), pos2(middle, foot - 2.5), pos2(middle + reach, foot)];
        ui.painter().line(points, Stroke::new(1.0, color));
    }
}
