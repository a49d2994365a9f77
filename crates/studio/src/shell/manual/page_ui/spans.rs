//! Running text: words, links, code and formulas in lines.

use egui::accesskit::Role;
use egui::{Color32, FontId, Label, Response, RichText, Sense, Ui, Vec2, WidgetInfo, vec2};
use egui_material_icons::icons;

use crate::base::texts::Texts;
use crate::base::theme;
use crate::base::widgets::icon_ui;
use crate::shell::manual::formula::{Formula, lines};
use crate::shell::manual::markdown::{ManualLink, TextSpan, TextSpanKind};

/// Size of running text, and height of its lines, points.
pub(super) const BODY: f32 = 13.5;
pub(super) const ROW: f32 = 19.0;

/// How much smaller code is than the text around it.
const CODE: f32 = 0.93;

fn row_height(size: f32) -> f32 {
    ROW.max(1.3 * size)
}

/// How wide running text is in one line, points.
pub(super) fn width(ui: &Ui, spans: &[TextSpan]) -> f32 {
    let color = ui.visuals().text_color();
    let text = |text: &str, font| ui.painter().layout_no_wrap(text.to_owned(), font, color).size().x;
    let widths = spans.iter().map(|span| match &span.kind {
        TextSpanKind::Text(words) => text(words, FontId::proportional(BODY)),
        TextSpanKind::Code(code) => text(code, FontId::monospace(CODE * BODY)),
        TextSpanKind::Formula(formula) => {
            let lines = lines(ui, formula.node(), (BODY, color), false, f32::INFINITY);
            lines.first().map_or(0.0, |line| line.width)
        }
        // The words before it are long in every language.
        TextSpanKind::Picture(alt) => text(alt, FontId::proportional(BODY)) + 90.0,
        TextSpanKind::Break => 0.0,
    });
    widths.sum()
}

/// Draws running text in the width there is; returns the link that was followed.
pub(super) fn spans_ui(ui: &mut Ui, spans: &[TextSpan], size: f32, texts: &Texts) -> Option<ManualLink> {
    let mut followed = None;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing = Vec2::ZERO;
        ui.spacing_mut().interact_size.y = row_height(size);
        for span in spans {
            if span_ui(ui, span, size, texts)
                && let Some(link) = &span.link
            {
                followed = Some(link.as_ref().clone());
            }
        }
    });
    followed
}

/// Draws a piece; returns whether it is a link that was followed.
fn span_ui(ui: &mut Ui, span: &TextSpan, size: f32, texts: &Texts) -> bool {
    let palette = theme::palette(ui.visuals());
    let (is_heading, is_link) = (size > BODY, span.link.is_some());
    let color = match span.link {
        Some(_) => palette.accent,
        // The fonts have no bold face.
        None if span.is_strong || is_heading => ui.visuals().strong_text_color(),
        None => palette.text,
    };
    let text = match &span.kind {
        TextSpanKind::Text(text) => {
            RichText::new(text).size(size).color(color).line_height(Some(row_height(size)))
        }
        TextSpanKind::Code(code) => {
            let code = RichText::new(code).monospace().size(CODE * size).color(color);
            if is_heading { code } else { code.background_color(palette.field) }
        }
        TextSpanKind::Formula(formula) => {
            formula_ui(ui, formula, size, color);
            return false;
        }
        TextSpanKind::Picture(alt) => {
            let words = texts.with("manual-picture", &[("name", alt.as_str().into())]);
            icon_ui(ui, icons::ICON_IMAGE, 15.0, palette.weak);
            ui.add(Label::new(RichText::new(words).size(size).italics().color(palette.weak)).wrap());
            return false;
        }
        TextSpanKind::Break => {
            ui.end_row();
            return false;
        }
    };
    let text = if span.is_emphasized { text.italics() } else { text };
    if !is_link {
        ui.add(Label::new(text).wrap().selectable(true));
        return false;
    }
    let response = ui.link(text);
    if let Some(ManualLink::Web(url)) = span.link.as_deref() {
        return response.on_hover_text(url).clicked();
    }
    response.clicked()
}

/// A formula within a line, in pieces where it is longer than the line.
fn formula_ui(ui: &mut Ui, formula: &Formula, size: f32, color: Color32) {
    let font = FontId::proportional(size);
    let sample = ui.painter().layout_no_wrap("x".to_owned(), font, color);
    let rows = sample.rows.first();
    let baseline = rows.and_then(|row| Some(row.pos.y + row.glyphs.first()?.pos.y)).unwrap_or(0.8 * size);
    let whole = ui.max_rect().width();
    for (place, line) in lines(ui, formula.node(), (size, color), false, whole).iter().enumerate() {
        let (rect, response) = ui.allocate_exact_size(vec2(line.width, sample.size().y), Sense::hover());
        line.paint(ui, rect.min + vec2(0.0, baseline), color);
        if place == 0 {
            name(&response, &formula.plain());
        }
    }
}

/// Lets a screen reader say what is drawn.
pub(super) fn name(response: &Response, words: &str) {
    response.widget_info(|| WidgetInfo::labeled(Role::Label, true, words));
}
