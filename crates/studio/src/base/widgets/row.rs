//! Rows of a panel of values: labels in one column, controls in the other, room for a reset button at the end.

use std::sync::Arc;

use egui::text::{LayoutJob, TextFormat, TextWrapping};
use egui::{FontId, Galley, Id, Rect, Response, Role, Sense, Shape, Ui, UiBuilder, WidgetInfo, pos2, vec2};
use egui_material_icons::icons::ICON_RESTART_ALT;

use crate::base::theme;
use crate::base::typeset::{self, TextLine};
use crate::base::widgets::number::HEIGHT;
use crate::base::widgets::paint_icon;
use crate::base::widgets::tip::tip_beside;

/// The width of the column of labels.
const LABEL: f32 = 106.0;
/// A row that is no wider, points, has its label above its controls.
const STACKED: f32 = 250.0;
/// The width kept free for the reset button.
pub(crate) const RESET: f32 = 20.0;
/// The gap between controls of a row.
pub(crate) const GAP: f32 = 4.0;
/// The size of a label's letters.
const LETTERS: f32 = 13.5;

/// The label of a row.
pub(crate) struct RowLabel<'a> {
    /// Where the widgets of the row have their identity.
    pub(crate) id: Id,
    /// The words.
    pub(crate) text: &'a str,
    /// A symbol before them, as markup of [`typeset`]; empty for none.
    pub(crate) symbol: &'a str,
    /// The unit of the numbers, where their fields have no room for it; empty for none.
    pub(crate) unit: &'a str,
    /// What they mean.
    pub(crate) tip: String,
    /// Whether something else on the panel points to this row.
    pub(crate) is_highlighted: bool,
}

/// Draws a row; returns what its contents returned and whether the pointer is over it. In a narrow panel the label
/// stands above the controls.
pub(crate) fn row<R>(
    ui: &mut Ui,
    label: &RowLabel<'_>,
    contents: impl FnOnce(&mut Ui, &Response) -> R,
) -> (R, bool) {
    let width = ui.available_width();
    let is_stacked = width < STACKED;
    let background = ui.painter().add(Shape::Noop);
    let set = LabelLayout::new(ui, label, if is_stacked { width } else { LABEL });
    let inner = ui.scope_builder(UiBuilder::new().scope_id(label.id), |ui| {
        ui.spacing_mut().item_spacing = vec2(GAP, 0.0);
        let above = is_stacked.then(|| set.show(ui, label));
        ui.horizontal(|ui| {
            ui.set_min_size(vec2(width, if is_stacked { HEIGHT } else { set.height() }));
            let response = above.unwrap_or_else(|| set.show(ui, label));
            contents(ui, &response)
        })
        .inner
    });
    let rect = Rect::from_x_y_ranges(ui.max_rect().x_range(), inner.response.rect.y_range());
    if label.is_highlighted {
        let fill = theme::palette(ui.visuals()).selection.gamma_multiply(0.6);
        ui.painter().set(background, Shape::rect_filled(rect.expand2(vec2(4.0, 2.0)), 4.0, fill));
    }
    let is_hovered = ui.rect_contains_pointer(rect.expand2(vec2(0.0, 2.0)));
    (inner.inner, is_hovered)
}

/// The room that a row's controls have.
pub(crate) fn control_width(ui: &Ui) -> f32 {
    (ui.available_width() - RESET - GAP).max(60.0)
}

/// A label that is laid out: the symbol, and the words beside it, in two lines where one is too short.
struct LabelLayout {
    symbol: TextLine,
    words: Arc<Galley>,
    width: f32,
}

impl LabelLayout {
    fn new(ui: &Ui, label: &RowLabel<'_>, width: f32) -> Self {
        let palette = theme::palette(ui.visuals());
        let color = if ui.is_enabled() { palette.text } else { palette.weak };
        let mut symbol = TextLine::default();
        if !label.symbol.is_empty() {
            symbol.push(ui, label.symbol, LETTERS, color);
            symbol.space(6.0);
        }
        let color = if label.symbol.is_empty() { color } else { palette.weak };
        let format = |color| TextFormat::simple(FontId::proportional(LETTERS), color);
        let mut job = LayoutJob::single_section(label.text.to_owned(), format(color));
        if !label.unit.is_empty() {
            job.append(&format!(", {}", label.unit.trim()), 0.0, format(palette.weak));
        }
        job.wrap = TextWrapping { max_rows: 2, ..TextWrapping::wrap_at_width(width - symbol.width()) };
        Self { symbol, words: ui.painter().layout_job(job), width }
    }

    fn height(&self) -> f32 {
        self.words.size().y.max(HEIGHT)
    }

    fn show(&self, ui: &mut Ui, label: &RowLabel<'_>) -> Response {
        let (rect, response) = ui.allocate_exact_size(vec2(self.width, self.height()), Sense::hover());
        self.symbol.paint(ui, rect.left_center());
        let words = pos2(rect.left() + self.symbol.width(), rect.center().y - 0.5 * self.words.size().y);
        ui.painter().galley(words, Arc::clone(&self.words), ui.visuals().text_color());
        let name = typeset::named(label.symbol, label.text);
        let enabled = ui.is_enabled();
        response.widget_info(|| WidgetInfo::labeled(Role::Label, enabled, &name));
        let mut tip = if self.words.elided { format!("{}\n", label.text) } else { String::new() };
        tip.push_str(&label.tip);
        tip_beside(ui, response, &tip)
    }
}

/// The button that brings a default back; nothing but its room when the value is the default.
pub(crate) fn reset_button(ui: &mut Ui, is_default: bool, name: &str, tip: &str) -> bool {
    if is_default {
        ui.allocate_space(vec2(RESET, HEIGHT));
        return false;
    }
    let (rect, response) = ui.allocate_exact_size(vec2(RESET, HEIGHT), Sense::click());
    let palette = theme::palette(ui.visuals());
    let is_lit = response.hovered() || response.has_focus();
    let color = if is_lit { palette.accent } else { palette.weak };
    paint_icon(ui, ICON_RESTART_ALT, rect.center(), 14.0, color);
    let enabled = ui.is_enabled();
    response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, name));
    tip_beside(ui, response, tip).clicked()
}
