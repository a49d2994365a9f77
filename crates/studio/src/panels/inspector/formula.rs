//! The formula of the model with the present numbers in place.
//!
//! Factors point to the rows of their symbols and are lit by them.

use catoptric_scene::Color;
use egui::{Color32, Frame, Id, Rect, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use super::InspectorState;
use super::symbol::Symbol;
use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::typeset::{self, TextLine};
use crate::base::widgets::color::screen_color;
use crate::base::widgets::number::{list, shown};
use crate::base::widgets::tip::tip_beside;

mod falloff;
mod law;
mod material;

pub(super) use falloff::falloff_ui;
pub(super) use law::law_ui;
pub(super) use material::material_ui;

/// The size of letters in formulas.
const SIZE: f32 = 14.0;
/// The height of a line of them.
const LINE: f32 = 23.0;

/// A part of a formula: markup, and the symbol that it shows.
struct FormulaFactor {
    markup: String,
    /// A color to show before it.
    chip: Option<Color>,
    symbol: Option<Symbol>,
}

impl FormulaFactor {
    /// What stands between: `+`, `·`, brackets.
    fn sign(markup: &str) -> Self {
        Self { markup: markup.to_owned(), chip: None, symbol: None }
    }

    /// A symbol.
    fn symbol(symbol: Symbol) -> Self {
        Self { markup: symbol.markup().to_owned(), chip: None, symbol: Some(symbol) }
    }

    /// A number in the place of a symbol.
    fn number(texts: &Texts, symbol: Symbol, value: f64) -> Self {
        Self { markup: shown(texts, value, 3), chip: None, symbol: Some(symbol) }
    }

    /// A color in the place of a symbol.
    fn color(texts: &Texts, symbol: Symbol, color: Color) -> Self {
        Self { markup: color_text(texts, color), chip: Some(color), symbol: Some(symbol) }
    }

    /// Other markup in the place of a symbol.
    fn text(symbol: Symbol, markup: impl Into<String>) -> Self {
        Self { markup: markup.into(), chip: None, symbol: Some(symbol) }
    }
}

/// A color as numbers: one when it is gray.
fn color_text(texts: &Texts, color: Color) -> String {
    let Color { r, g, b } = color;
    if r == g && g == b {
        return shown(texts, r, 3);
    }
    format!("({})", list(texts, [r, g, b].map(|part| shown(texts, part, 3))))
}

/// One line of a formula.
struct FormulaRow<'t> {
    /// What the line is called, for the names of its parts.
    name: &'t str,
    factors: Vec<FormulaFactor>,
    /// Whether it has the numbers of the line above it.
    is_numeric: bool,
    /// Whether it adds nothing.
    is_idle: bool,
    /// How far it is moved to the right.
    indent: f32,
}

/// Draws the lines of a formula in a frame of their own.
fn rows_ui(ui: &mut Ui, texts: &Texts, memory: &mut InspectorState, id: Id, rows: &[FormulaRow<'_>]) {
    let palette = theme::palette(ui.visuals());
    let frame =
        Frame::new().fill(palette.field).corner_radius(4.0).inner_margin(egui::Margin::symmetric(8, 6));
    frame.show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.spacing_mut().item_spacing.y = 0.0;
        for (index, row) in rows.iter().enumerate() {
            if !row.is_numeric && index > 0 {
                ui.add_space(4.0);
            }
            row_ui(ui, texts, memory, id.with(index), row);
        }
    });
}

/// Sets one line, broken between factors where it is too long.
fn row_ui(ui: &mut Ui, texts: &Texts, memory: &mut InspectorState, id: Id, row: &FormulaRow<'_>) {
    let palette = theme::palette(ui.visuals());
    let color = match (row.is_idle, row.is_numeric) {
        (true, _) => palette.weak.gamma_multiply(0.8),
        (false, true) => palette.accent,
        (false, false) => palette.text,
    };
    let size = if row.is_numeric { SIZE - 1.0 } else { SIZE };
    let set: Vec<TextLine> = row.factors.iter().map(|factor| set_factor(ui, factor, size, color)).collect();
    let right = ui.available_width();
    // In a narrow panel, what is indented moves to the left rather than out of it.
    let widest = set.iter().map(TextLine::width).fold(0.0, f32::max);
    let indent = row.indent.min((right - 18.0 - widest).max(0.0));
    let mut x = indent;
    let mut line = 0.0;
    let places: Vec<(f32, f32)> = set
        .iter()
        .map(|piece| {
            if x + piece.width() > right && x > indent {
                x = indent + 18.0;
                line += LINE - 2.0;
            }
            let place = (x, line);
            x += piece.width();
            place
        })
        .collect();
    let (rect, _) = ui.allocate_exact_size(vec2(right, line + LINE), Sense::hover());
    for (index, (factor, piece)) in row.factors.iter().zip(&set).enumerate() {
        let Some(&(x, y)) = places.get(index) else { continue };
        let start = pos2(rect.left() + x, rect.top() + y + 0.5 * LINE);
        if let Some(symbol) = factor.symbol {
            let name = format!("{}: {}", row.name, typeset::plain(&factor.markup));
            let place = Rect::from_min_size(start - vec2(1.0, 10.0), vec2(piece.width() + 2.0, 20.0));
            point(ui, texts, memory, id.with(index), place, &name, symbol);
        }
        piece.paint(ui, start);
    }
}

fn set_factor(ui: &Ui, factor: &FormulaFactor, size: f32, color: Color32) -> TextLine {
    let mut line = TextLine::default();
    if factor.symbol.is_some() && !factor.markup.starts_with('^') {
        line.space(1.5);
    }
    if let Some(chip) = factor.chip {
        line.push_chip(9.0, screen_color(chip));
    }
    line.push(ui, &factor.markup, size, color);
    line.space(if factor.symbol.is_some() { 2.0 } else { 1.0 });
    line
}

/// Lights a factor that is pointed to, here or in its row, and explains it.
fn point(
    ui: &Ui,
    texts: &Texts,
    memory: &mut InspectorState,
    id: Id,
    place: Rect,
    name: &str,
    symbol: Symbol,
) {
    let is_lit = memory.pointed == Some(symbol);
    if is_lit {
        let palette = theme::palette(ui.visuals());
        ui.painter().rect_filled(place, 3.0, palette.selection);
    }
    let response = ui.interact(place, id, Sense::hover());
    if response.hovered() {
        memory.term_hovered = Some(symbol);
    }
    response.widget_info(|| WidgetInfo::selected(Role::Label, true, is_lit, name));
    let tip = texts.tip(symbol.tip_key()).unwrap_or_default();
    tip_beside(ui, response, tip);
}
