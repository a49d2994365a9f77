//! Formulas set from a small markup: `k_a` has an index, `x^n` an exponent, `~n` wears a hat; `{…}` groups.

use std::sync::Arc;

use egui::text::{LayoutJob, TextFormat, TextWrapping};
use egui::{Color32, FontId, Galley, Pos2, Rect, Stroke, Ui, Vec2, vec2};

/// A typeset line: runs at their places relative to the left end of the line's middle.
#[derive(Default)]
pub(crate) struct TextLine {
    pieces: Vec<TextRun>,
    width: f32,
}

enum TextRun {
    Text { galley: Arc<Galley>, offset: Vec2 },
    Hat { offset: Vec2, size: Vec2, color: Color32 },
    Chip { offset: Vec2, size: f32, color: Color32 },
}

#[derive(Clone, Copy, PartialEq)]
enum ScriptLevel {
    Base,
    Sub,
    Sup,
}

impl TextLine {
    /// How wide it is.
    pub(crate) fn width(&self) -> f32 {
        self.width
    }

    /// Leaves a gap.
    pub(crate) fn space(&mut self, width: f32) {
        self.width += width;
    }

    /// Appends a formula.
    pub(crate) fn push(&mut self, ui: &Ui, markup: &str, size: f32, color: Color32) {
        let mut wears_hat = false;
        let mut level = ScriptLevel::Base;
        let mut is_grouped = false;
        let mut run = String::new();
        for letter in markup.chars() {
            match letter {
                '~' | '_' | '^' if !is_grouped => {
                    self.flush(ui, &mut run, size, color, level);
                    match letter {
                        '~' => wears_hat = true,
                        '_' => level = ScriptLevel::Sub,
                        _ => level = ScriptLevel::Sup,
                    }
                    continue;
                }
                '{' => {
                    is_grouped = true;
                    continue;
                }
                '}' => is_grouped = false,
                _ => run.push(letter),
            }
            if wears_hat {
                let start = self.width;
                self.flush(ui, &mut run, size, color, level);
                self.put_hat(start, size, color);
                wears_hat = false;
            } else if level != ScriptLevel::Base && !is_grouped {
                self.flush(ui, &mut run, size, color, level);
                level = ScriptLevel::Base;
            }
        }
        self.flush(ui, &mut run, size, color, level);
    }

    /// Appends words, cut to a width.
    pub(crate) fn push_words(&mut self, ui: &Ui, words: &str, size: f32, color: Color32, room: f32) {
        let mut job = LayoutJob::simple_singleline(words.to_owned(), FontId::proportional(size), color);
        job.wrap = TextWrapping::truncate_at_width(room);
        self.put(ui, job, 0.0);
    }

    /// Appends a small patch of a color.
    pub(crate) fn push_chip(&mut self, size: f32, color: Color32) {
        self.pieces.push(TextRun::Chip { offset: vec2(self.width, -0.5 * size), size, color });
        self.width += size + 3.0;
    }

    /// Paints it; `start` is the left end of its middle.
    pub(crate) fn paint(&self, ui: &Ui, start: Pos2) {
        let painter = ui.painter();
        for piece in &self.pieces {
            match piece {
                TextRun::Text { galley, offset } => {
                    painter.galley(start + *offset, Arc::clone(galley), Color32::PLACEHOLDER);
                }
                TextRun::Hat { offset, size, color } => {
                    let left = start + *offset;
                    let top = left + vec2(0.5 * size.x, -size.y);
                    let stroke = Stroke::new(1.0, *color);
                    painter.line_segment([left, top], stroke);
                    painter.line_segment([top, left + vec2(size.x, 0.0)], stroke);
                }
                TextRun::Chip { offset, size, color } => {
                    let rect = Rect::from_min_size(start + *offset, Vec2::splat(*size));
                    painter.rect_filled(rect, 2.0, *color);
                    let line = ui.visuals().widgets.hovered.bg_stroke;
                    painter.rect_stroke(rect, 2.0, line, egui::StrokeKind::Outside);
                }
            }
        }
    }

    fn flush(&mut self, ui: &Ui, run: &mut String, size: f32, color: Color32, level: ScriptLevel) {
        if run.is_empty() {
            return;
        }
        let (size, shift) = match level {
            ScriptLevel::Base => (size, 0.0),
            ScriptLevel::Sub => (0.74 * size, 0.26 * size),
            ScriptLevel::Sup => (0.74 * size, -0.34 * size),
        };
        let text = std::mem::take(run);
        for token in tokens(&text) {
            // Variables lean; words, figures and signs stand.
            let is_variable = token.chars().count() == 1 && token.chars().all(is_variable);
            let font_id = FontId::proportional(size);
            let format = TextFormat { font_id, color, italics: is_variable, ..TextFormat::default() };
            self.put(ui, LayoutJob::single_section(token.to_owned(), format), shift);
            if is_variable {
                // Room for the slant.
                self.width += 0.08 * size;
            }
        }
    }

    fn put(&mut self, ui: &Ui, mut job: LayoutJob, shift: f32) {
        job.break_on_newline = false;
        let galley = ui.painter().layout_job(job);
        let size = galley.size();
        let offset = vec2(self.width, shift - 0.5 * size.y);
        self.pieces.push(TextRun::Text { galley, offset });
        self.width += size.x;
    }

    fn put_hat(&mut self, start: f32, size: f32, color: Color32) {
        let width = (self.width - start).min(0.55 * size);
        let left = start + 0.5 * (self.width - start - width) + 0.08 * size;
        let offset = vec2(left, -0.42 * size);
        self.pieces.push(TextRun::Hat { offset, size: vec2(width, 0.2 * size), color });
    }
}

fn is_variable(letter: char) -> bool {
    letter.is_alphabetic() && letter != 'Σ'
}

/// The words and what stands between them.
fn tokens(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = text;
    std::iter::from_fn(move || {
        let is_word = rest.chars().next()?.is_alphabetic();
        let end = rest.find(|letter: char| letter.is_alphabetic() != is_word).unwrap_or(rest.len());
        let (token, after) = rest.split_at(end);
        rest = after;
        Some(token)
    })
}

/// Markup as plain text, for names and descriptions: `k_a` for `k_a`, `I_reflected` for `I_{reflected}`.
pub(crate) fn plain(markup: &str) -> String {
    markup.chars().filter(|letter| !matches!(letter, '~' | '{' | '}')).collect()
}

/// What a row with this symbol and these words is called.
pub(crate) fn named(symbol: &str, words: &str) -> String {
    match (symbol, words) {
        ("", words) => words.to_owned(),
        (symbol, "") => plain(symbol),
        (symbol, words) => format!("{} {words}", plain(symbol)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_and_signs_are_told_apart() {
        assert_eq!(tokens("1 / (d + K)").collect::<Vec<_>>(), ["1 / (", "d", " + ", "K", ")"]);
        assert_eq!(tokens("sin α").collect::<Vec<_>>(), ["sin", " ", "α"]);
        assert_eq!(tokens("").count(), 0);
    }

    #[test]
    fn markup_has_a_plain_form() {
        assert_eq!(plain("k_a"), "k_a");
        assert_eq!(plain("I_{reflected}"), "I_reflected");
        assert_eq!(named("k_d", "diffuse"), "k_d diffuse");
        assert_eq!(named("", "Radius"), "Radius");
    }
}
