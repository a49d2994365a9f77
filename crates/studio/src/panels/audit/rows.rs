//! The list of rays: a row each, with its terms below it while it is expanded.

use std::ops::Range;
use std::sync::Arc;

use catoptric_lab::audit::{Node, NodeKind};
use egui::accesskit::Role;
use egui::{
    Align, Align2, Color32, FontId, Id, Rect, Response, ScrollArea, Sense, Stroke, TextStyle, Ui, WidgetInfo,
    pos2, vec2,
};
use egui_material_icons::icons;
use glam::DVec3;

use super::listing::{AuditListing, AuditRow};
use super::numbers::{color, color_text, short};
use super::terms::{self, AuditLine, body_name};
use crate::base::texts::Texts;
use crate::base::theme::{self, ThemeColors};
use crate::base::typeset::{self, TextLine};
use crate::base::widgets::color::screen_color;
use crate::base::widgets::{paint_icon, paint_line, paint_line_in};
use crate::state::audit::AuditResult;
use crate::state::context::Cx;

/// Height of a row, points.
const ROW: f32 = 21.0;
/// Width of the columns at the right: generation, weight, what the ray brings.
const COLUMNS: [f32; 3] = [44.0, 120.0, 190.0];
/// How much each step from the eye is moved to the right, and how many of them at most.
const INDENT: f32 = 13.0;
const MOST_INDENTS: u32 = 12;
/// Width of the names of terms.
const NAMES: f32 = 128.0;

/// The color of a kind of rays over the picture and in the list.
pub(crate) const fn kind_color(kind: NodeKind) -> Color32 {
    match kind {
        NodeKind::Primary => Color32::from_rgb(255, 205, 96),
        NodeKind::Reflected => Color32::from_rgb(88, 178, 255),
        NodeKind::TotallyReflected => Color32::from_rgb(190, 142, 255),
        NodeKind::Refracted => Color32::from_rgb(86, 214, 158),
    }
}

/// The message that names a kind of rays.
const fn kind_key(kind: NodeKind) -> &'static str {
    match kind {
        NodeKind::Primary => "audit-kind-primary",
        NodeKind::Reflected => "audit-kind-reflected",
        NodeKind::TotallyReflected => "audit-kind-total",
        NodeKind::Refracted => "audit-kind-refracted",
    }
}

/// Draws the list, as far as it is seen.
pub(super) fn list_ui(ui: &mut Ui, cx: &mut Cx<'_>, listing: &mut AuditListing, found: &Arc<AuditResult>) {
    listing.refresh(cx.audit, cx.texts);
    head_ui(ui, cx);
    ui.spacing_mut().item_spacing.y = 0.0;
    let count = listing.len();
    let wanted = if std::mem::take(&mut cx.audit.scrolls) {
        cx.audit.selected.and_then(|node| listing.place_of(node))
    } else {
        None
    };
    ScrollArea::vertical().id_salt("audit rays").auto_shrink(false).show_rows(ui, ROW, count, |ui, range| {
        if let Some(place) = wanted {
            let top = ui.max_rect().top() + ROW * (place as f32 - range.start as f32);
            let rect = Rect::from_min_size(pos2(ui.max_rect().left(), top), vec2(10.0, ROW));
            ui.scroll_to_rect(rect, Some(Align::Center));
        }
        rows_ui(ui, cx, listing, found, range);
    });
}

fn rows_ui(ui: &mut Ui, cx: &mut Cx<'_>, listing: &AuditListing, found: &AuditResult, range: Range<usize>) {
    let mut known: Option<(usize, Vec<AuditLine>, Vec<AuditLine>)> = None;
    for index in range {
        match listing.row(index) {
            Some(AuditRow::Ray(place)) => {
                if let Some(node) = found.node(place) {
                    ray_ui(ui, cx, listing, found, place, node);
                }
            }
            Some(AuditRow::Term(place, term)) => {
                if known.as_ref().is_none_or(|(of, ..)| *of != place) {
                    known = Some(terms_of(cx, found, place));
                }
                let Some((_, now, before)) = &known else { continue };
                if let Some(term) = now.get(term) {
                    let old = before.iter().find(|old| old.part == term.part);
                    let level = listing.depth(place);
                    term_ui(ui, cx, term, old, (place, level));
                }
            }
            None => {}
        }
    }
}

/// The terms of a ray, now and before the last change.
fn terms_of(cx: &Cx<'_>, found: &AuditResult, place: usize) -> (usize, Vec<AuditLine>, Vec<AuditLine>) {
    let of = |scene, audit, node| terms::of_node(cx.texts, scene, audit, node);
    let now = found.node(place).map(|node| of(&found.scene, &found.audit, node)).unwrap_or_default();
    let before = found.before.as_ref().and_then(|before| {
        let (_, node) = before.twin(place)?;
        Some(of(&before.scene, &before.audit, node))
    });
    (place, now, before.unwrap_or_default())
}

/// The titles of the columns.
fn head_ui(ui: &mut Ui, cx: &Cx<'_>) {
    let (rect, _) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::hover());
    let palette = theme::palette(ui.visuals());
    let font = TextStyle::Small.resolve(ui.style());
    let columns = columns(rect);
    let titles = ["audit-column-generation", "audit-column-weight", "audit-column-brings"];
    for (column, key) in columns.iter().zip(titles) {
        paint_line_in(ui, *column, cx.texts.get(key), font.clone(), palette.weak);
    }
    let left = rect.with_max_x(columns.first().map_or(rect.right(), Rect::left));
    paint_line_in(ui, left.with_min_x(rect.left() + 22.0), cx.t("audit-column-ray"), font, palette.weak);
    ui.painter().hline(rect.x_range(), rect.bottom() - 0.5, Stroke::new(1.0, palette.line));
}

/// The columns at the right of a row, as far as there is room.
fn columns(rect: Rect) -> [Rect; 3] {
    let room = (rect.width() * 0.62).min(COLUMNS.iter().sum());
    let share = room / COLUMNS.iter().sum::<f32>();
    let mut left = rect.right() - room - 12.0;
    COLUMNS.map(|width| {
        let column =
            Rect::from_min_max(pos2(left, rect.top()), pos2(left + width * share - 6.0, rect.bottom()));
        left += width * share;
        column
    })
}

/// A ray: its kind, what it ends at, generation, weight, and what it brings.
fn ray_ui(
    ui: &mut Ui,
    cx: &mut Cx<'_>,
    listing: &AuditListing,
    found: &AuditResult,
    place: usize,
    node: &Node,
) {
    let (_, rect) = ui.allocate_space(vec2(ui.available_width(), ROW));
    let texts = cx.texts;
    let end = match node.ray.hit {
        Some(hit) => body_name(texts, &found.scene, hit.body),
        None => texts.get("audit-background").to_owned(),
    };
    let arguments = [
        ("ray", (place + 1).into()),
        ("kind", texts.get(kind_key(node.kind)).into()),
        ("end", end.as_str().into()),
    ];
    let name = texts.with("audit-ray", &arguments);
    let response = ui.interact(rect, Id::unique(("audit ray", place)), Sense::click());
    let is_selected = cx.audit.selected == Some(place);
    row_info(ui, &response, &name, is_selected, cx.audit.expanded.contains(&place));
    let palette = theme::palette(ui.visuals());
    if is_selected || response.hovered() {
        let fill = if is_selected { palette.selection } else { palette.hovered.gamma_multiply(0.5) };
        ui.painter().rect_filled(rect, 3.0, fill);
    }
    let left = rect.left() + INDENT * listing.depth(place).min(MOST_INDENTS) as f32;
    expand_ui(ui, cx, place, pos2(left + 9.0, rect.center().y));
    let dot = pos2(left + 26.0, rect.center().y);
    ui.painter().circle(dot, 4.5, kind_color(node.kind), Stroke::new(1.0, palette.weak));
    let columns = columns(rect);
    let end = columns.first().map_or(rect.right(), |column| column.left() - 6.0);
    let text = Rect::from_min_max(pos2(left + 36.0, rect.top()), pos2(end, rect.bottom()));
    paint_line(ui, text, &name, palette.text);
    columns_ui(ui, texts, found, (place, node), columns);
    if response.hovered() {
        // In full what the columns have no room for.
        let before = found.before.as_ref().and_then(|before| before.twin(place));
        let was = before.filter(|(_, old)| old.brings != node.brings).map(|(_, old)| {
            format!("; {}", texts.with("audit-was", &[("value", color_text(texts, old.brings).into())]))
        });
        let brings = texts.get("audit-brings");
        let value = color_text(texts, node.brings);
        response.clone().on_hover_text(format!("{name}\n{brings} {value}{}", was.unwrap_or_default()));
    }
    if response.clicked() {
        // It is in view already.
        cx.audit.selected = Some(place);
    }
    if response.double_clicked() {
        toggle(cx, place);
    }
}

fn row_info(ui: &Ui, response: &Response, name: &str, is_selected: bool, is_expanded: bool) {
    response.widget_info(|| WidgetInfo::labeled(Role::TreeItem, true, name));
    ui.ctx().accesskit_node_builder(response.id, |node| {
        node.set_selected(is_selected);
        node.set_expanded(is_expanded);
    });
}

fn columns_ui(
    ui: &Ui,
    texts: &Texts,
    found: &AuditResult,
    (place, node): (usize, &Node),
    columns: [Rect; 3],
) {
    let palette = theme::palette(ui.visuals());
    let font = FontId::proportional(12.5);
    let old = found.before.as_ref().map(|before| before.twin(place).map(|(_, node)| node));
    let [generation, weight, brings] = columns;
    paint_line_in(ui, generation, &node.ray.generation.to_string(), font.clone(), palette.weak);
    let is_other = matches!(old, Some(Some(old)) if old.ray.weight != node.ray.weight);
    let tone = if is_other { palette.warning } else { palette.weak };
    paint_line_in(ui, weight, &color(texts, node.ray.weight), font.clone(), tone);
    chip(ui, brings.left_center(), node.brings);
    let text = color_text(texts, node.brings);
    let (tone, text) = match old {
        // It was not there.
        Some(None) => (palette.warning, format!("{text} {}", texts.get("audit-new"))),
        Some(Some(old)) if old.brings != node.brings => {
            let was = texts.with("audit-was", &[("value", color_text(texts, old.brings).into())]);
            (palette.warning, format!("{text}, {was}"))
        }
        _ => (palette.text, text),
    };
    paint_line_in(ui, brings.with_min_x(brings.left() + 15.0), &text, font, tone);
}

/// A patch of a color at the left end of a column.
fn chip(ui: &Ui, at: egui::Pos2, light: DVec3) {
    let rect = Align2::LEFT_CENTER.anchor_size(at, egui::Vec2::splat(10.0));
    ui.painter().rect_filled(rect, 2.0, chip_color(light));
    let stroke = Stroke::new(1.0, theme::palette(ui.visuals()).line);
    ui.painter().rect_stroke(rect, 2.0, stroke, egui::StrokeKind::Outside);
}

/// Linear light as a display shows it.
pub(super) fn chip_color(light: DVec3) -> Color32 {
    screen_color(catoptric_scene::Color::new(light.x, light.y, light.z))
}

/// The arrow that lists the terms of a ray, or folds them away.
fn expand_ui(ui: &Ui, cx: &mut Cx<'_>, place: usize, at: egui::Pos2) {
    let rect = Rect::from_center_size(at, vec2(17.0, ROW));
    let response = ui.interact(rect, Id::unique(("audit expand", place)), Sense::click());
    let is_expanded = cx.audit.expanded.contains(&place);
    let key = if is_expanded { "audit-fold" } else { "audit-expand" };
    let name = cx.texts.with(key, &[("ray", (place + 1).into())]);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    let palette = theme::palette(ui.visuals());
    let icon = if is_expanded { icons::ICON_EXPAND_MORE } else { icons::ICON_CHEVRON_RIGHT };
    let tone = if response.hovered() { palette.text } else { palette.weak };
    paint_icon(ui, icon, at, 16.0, tone);
    if response.clicked() {
        toggle(cx, place);
    }
}

fn toggle(cx: &mut Cx<'_>, place: usize) {
    if !cx.audit.expanded.remove(&place) {
        cx.audit.expanded.insert(place);
    }
}

/// A term: words, the formula, its numbers, and what comes out; what it was before the last change.
fn term_ui(
    ui: &mut Ui,
    cx: &Cx<'_>,
    term: &AuditLine,
    old: Option<&AuditLine>,
    (place, level): (usize, u32),
) {
    let (_, rect) = ui.allocate_space(vec2(ui.available_width(), ROW));
    let palette = theme::palette(ui.visuals());
    let is_changed = old.is_some_and(|old| (&old.numbers, &old.value) != (&term.numbers, &term.value));
    let left = rect.left() + INDENT * level.min(MOST_INDENTS) as f32 + 24.0;
    if is_changed {
        let mark = Rect::from_min_size(pos2(left - 6.0, rect.top() + 3.0), vec2(3.0, ROW - 6.0));
        ui.painter().rect_filled(mark, 1.5, palette.warning);
    }
    let line = set(ui, term, old.filter(|_| is_changed), cx, palette, rect.right() - left);
    let mut plain = plain(cx.texts, term);
    if let Some(old) = old.filter(|_| is_changed) {
        plain.push_str("; ");
        plain.push_str(&was(cx.texts, old));
    }
    let response = ui.interact(rect, Id::unique(("audit term", place, plain.as_str())), Sense::hover());
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &plain));
    line.paint(ui, pos2(left, rect.center().y));
    response.on_hover_text(plain);
}

/// Sets a term.
fn set(
    ui: &Ui,
    term: &AuditLine,
    old: Option<&AuditLine>,
    cx: &Cx<'_>,
    palette: &ThemeColors,
    room: f32,
) -> TextLine {
    const SIZE: f32 = 13.0;
    let mut line = TextLine::default();
    let inner = if term.is_inner() { 12.0 } else { 0.0 };
    line.space(inner);
    line.push_words(ui, &term.name, 12.0, palette.weak, NAMES - 8.0 - inner);
    line.space((NAMES - line.width()).max(4.0));
    if !term.words.is_empty() {
        line.push_words(ui, &term.words, 12.5, palette.text, (room - line.width()).max(40.0));
        line.space(8.0);
    }
    if !term.symbols.is_empty() {
        line.push(ui, term.symbols, SIZE, palette.text);
        line.push(ui, " = ", SIZE, palette.weak);
    }
    if !term.numbers.is_empty() {
        line.push(ui, &term.numbers, SIZE, palette.accent);
    }
    if let Some(value) = term.value {
        if !term.numbers.is_empty() {
            line.push(ui, " = ", SIZE, palette.weak);
        }
        line.push_chip(9.0, chip_color(value));
        line.push(ui, &color_text(cx.texts, value), SIZE, palette.text);
    }
    if let Some(old) = old {
        line.space(10.0);
        let words = was(cx.texts, old);
        line.push_words(ui, &words, 12.5, palette.warning, (room - line.width()).max(80.0));
    }
    line
}

/// What a term was before the last change.
fn was(texts: &Texts, old: &AuditLine) -> String {
    let value = old.value.map_or_else(|| typeset::plain(&old.numbers), |value| color_text(texts, value));
    texts.with("audit-was", &[("value", value.into())])
}

/// A term as plain text.
fn plain(texts: &Texts, term: &AuditLine) -> String {
    let value = term.value.map(|value| color_text(texts, value)).unwrap_or_default();
    let sides = [typeset::plain(term.symbols), typeset::plain(&term.numbers), value];
    let equation: Vec<String> = sides.into_iter().filter(|side| !side.is_empty()).collect();
    let words = [format!("{}:", term.name), term.words.clone(), equation.join(" = ")];
    let words: Vec<String> = words.into_iter().filter(|words| !words.is_empty()).collect();
    words.join(" ")
}

/// What stands beside a selected ray in the picture: its number, kind and weight.
pub(crate) fn tag(texts: &Texts, place: usize, node: &Node) -> String {
    let arguments = [
        ("ray", (place + 1).into()),
        ("kind", texts.get(kind_key(node.kind)).into()),
        ("weight", short(texts, f64::from(node.largest_weight())).into()),
    ];
    texts.with("audit-tag", &arguments)
}
