//! Findings with the lines of the file, as people know them from compilers.

use std::ops::Range;

use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Renderer, Snippet};

use crate::format::diagnostic::{Diagnostic, Diagnostics, Severity};
use crate::language::Language;
use crate::text::{is_active, visible};

/// At most so many bytes of a line are shown on either side of the mark's beginning.
const MOST_SHOWN: usize = 160;
/// The command line speaks English.
const LANGUAGE: Language = Language::English;
/// Width of a rendered line in columns.
const WIDTH: usize = 140;

impl Diagnostics {
    /// The findings with the marked lines of `text`, which must be the text that was read. `file_name` is only shown.
    /// With `color`, terminal colors are used. In English.
    pub fn render(&self, file_name: &str, text: &str, color: bool) -> String {
        let renderer = if color { Renderer::styled().hyperlink(false) } else { Renderer::plain() };
        let renderer = renderer.term_width(WIDTH);
        let mut out = String::new();
        let file_name = visible(file_name);
        for diagnostic in self {
            out.push_str(&render_one(diagnostic, &file_name, text, &renderer));
            out.push_str("\n\n");
        }
        if self.omitted() > 0 {
            out.push_str(&format!("… and {} more\n", self.omitted()));
        } else {
            out.pop();
        }
        out
    }
}

/// One finding: message, place, line with mark, help, and the related place.
fn render_one(diagnostic: &Diagnostic, file_name: &str, text: &str, renderer: &Renderer) -> String {
    let level = match diagnostic.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
        Severity::Note => Level::NOTE,
    };
    let marked = MarkedLine::new(text, &diagnostic.span);
    let label = diagnostic.label(LANGUAGE).unwrap_or_default();
    let snippet = marked.snippet(file_name, diagnostic.line, &label);
    let mut main = level.primary_title(diagnostic.message(LANGUAGE)).element(snippet);
    if let Some(help) = diagnostic.help(LANGUAGE) {
        main = main.element(Level::HELP.message(help));
    }
    let mut out = marked.with_true_column(renderer.render(&[main]), diagnostic.line, diagnostic.column);
    if let Some(related) = &diagnostic.related {
        let marked = MarkedLine::new(text, &related.span);
        let title = Level::NOTE.secondary_title(related.message(LANGUAGE));
        let group: Group<'_> = title.element(marked.snippet(file_name, related.line, ""));
        out.push('\n');
        out.push_str(&marked.with_true_column(renderer.render(&[group]), related.line, related.column));
    }
    out
}

/// The displayed part of a line, and its mark.
struct MarkedLine {
    line: String,
    mark: Range<usize>,
}

impl MarkedLine {
    fn new(text: &str, span: &Range<usize>) -> Self {
        let start = floor_boundary(text, span.start.min(text.len()));
        let end = floor_boundary(text, span.end.clamp(start, text.len()));
        let from = window_start(text, start);
        let to = window_end(text, start);
        let end = end.min(to).max(start);
        let [before, marked, after] =
            [from..start, start..end, end..to].map(|part| seen(text.get(part).unwrap_or_default()));
        let mark = before.len()..before.len() + marked.len();
        Self { line: before + &marked + &after, mark }
    }

    fn snippet<'a>(&'a self, file_name: &'a str, line: usize, label: &'a str) -> Snippet<'a, Annotation<'a>> {
        let annotation = AnnotationKind::Primary.span(self.mark.clone());
        let annotation = if label.is_empty() { annotation } else { annotation.label(label) };
        Snippet::source(self.line.as_str()).line_start(line).path(file_name).annotation(annotation)
    }

    /// Corrects the column, which is counted from the beginning of what is shown.
    fn with_true_column(&self, rendered: String, line: usize, column: usize) -> String {
        let shown = self.line.get(..self.mark.start).unwrap_or_default().chars().count() + 1;
        if shown == column {
            return rendered;
        }
        rendered.replacen(&format!(":{line}:{shown}"), &format!(":{line}:{column}"), 1)
    }
}

/// A part of a line, each character of which that would do something replaced by a picture of it: one for one, so that
/// columns stay true.
fn seen(part: &str) -> String {
    let picture = |character: char| match character {
        '\t' => character,
        '\0'..='\u{1f}' => char::from_u32(0x2400 + u32::from(character)).unwrap_or('\u{fffd}'),
        '\u{7f}' => '\u{2421}',
        active if is_active(active) => '\u{fffd}',
        other => other,
    };
    part.chars().map(picture).collect()
}

/// Beginning of the shown part: of the line, or [`MOST_SHOWN`] bytes before `at`.
fn window_start(text: &str, at: usize) -> usize {
    let floor = floor_boundary(text, at.saturating_sub(MOST_SHOWN));
    let before = text.get(floor..at).unwrap_or_default();
    let start = before.rfind('\n').map_or(floor, |newline| floor + newline + 1);
    if start == 0 && text.starts_with('\u{feff}') { 3.min(at) } else { start }
}

/// End of the shown part: of the line, or [`MOST_SHOWN`] bytes after `at`.
fn window_end(text: &str, at: usize) -> usize {
    let ceiling = floor_boundary(text, (at + MOST_SHOWN).min(text.len()));
    let after = text.get(at..ceiling).unwrap_or_default();
    after.find(['\n', '\r']).map_or(ceiling, |newline| at + newline)
}

/// The last character boundary at or before `at`.
fn floor_boundary(text: &str, at: usize) -> usize {
    (0..=at).rev().find(|&place| text.is_char_boundary(place)).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::message::Message;

    fn rendered(text: &str, span: Range<usize>) -> String {
        let mut diagnostics = Diagnostics::default();
        diagnostics.push(
            Diagnostic::error(span, Message::NotAColor)
                .with_label(Message::Here)
                .with_help(Message::SaveAsUtf8),
        );
        diagnostics.locate(text);
        diagnostics.render("a.toml", text, false)
    }

    #[test]
    fn a_finding_shows_its_line() {
        let expected = "\
error: not a color
 --> a.toml:2:5
  |
2 | b = 2
  |     ^ here
  |
  = help: save the file as UTF-8
";
        assert_eq!(rendered("a = 1\nb = 2\nc = 3\n", 10..11), expected);
    }

    #[test]
    fn long_lines_are_cut_and_columns_stay_true() {
        let text = format!("a = [{}9, {}]\n", "1, ".repeat(100_000), "2, ".repeat(100_000));
        let place = text.find('9').unwrap();
        let out = rendered(&text, place..place + 1);
        assert!(out.len() < 2000, "{out}");
        assert!(out.contains(&format!("--> a.toml:1:{}\n", place + 1)), "{out}");
        assert!(out.contains("^ here"), "{out}");
    }

    #[test]
    fn places_beyond_the_text_are_clamped() {
        for span in [0..0, 5..9, 90..99, 2..3] {
            assert!(rendered("жжж", span).contains("not a color"));
        }
        assert!(rendered("", 0..0).contains("not a color"));
    }
}
