//! The text of the file, to be read beside its findings.

use std::ops::Range;

use egui::{Align, FontId, Label, RichText, ScrollArea, TextWrapMode, Ui};

use super::excerpt::floor;
use super::{ProblemsPanel, marked};
use crate::base::theme;
use crate::state::context::Cx;

/// The most lines that are shown on either side of the selected finding.
const AROUND: usize = 300;
/// The most bytes that are searched for these lines on either side.
const FARTHEST: usize = 1 << 16;
/// Longer lines are cut.
const LONGEST: usize = 400;

/// Draws the text around the selected finding, its line marked.
pub(super) fn source_ui(ui: &mut Ui, cx: &Cx<'_>, problems: &mut ProblemsPanel) {
    ui.label(RichText::new(cx.t("problems-text")).strong());
    let finding = problems.selected.and_then(|selected| problems.findings.iter().nth(selected));
    let Some(finding) = finding else { return };
    let palette = theme::palette(ui.visuals());
    let color = match finding.severity {
        catoptric_scene::Severity::Error => palette.error,
        catoptric_scene::Severity::Warning => palette.warning,
        catoptric_scene::Severity::Note => palette.accent,
    };
    let font = FontId::monospace(12.5);
    let (first, lines) = lines_around(&problems.text, finding.span.start, finding.line);
    let digits = (first + lines.len()).to_string().len();
    let scrolls = std::mem::take(&mut problems.scrolls);
    let frame = egui::Frame::new().fill(palette.field).corner_radius(4.0).inner_margin(6.0);
    frame.show(ui, |ui| {
        ScrollArea::both().id_salt("source").auto_shrink(false).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 1.0;
            ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
            for (index, range) in lines.into_iter().enumerate() {
                let number = first + index;
                let line = problems.text.get(range.clone()).unwrap_or_default();
                let is_marked = number == finding.line;
                let mark = if is_marked { mark_in(line, &range, &finding.span) } else { 0..0 };
                let text_color = if is_marked { palette.text } else { palette.weak };
                let mut job = marked(&format!("{number:>digits$}  "), &(0..0), &font, palette.weak, color);
                let rest = marked(line, &mark, &font, text_color, color);
                for section in rest.sections {
                    let part = rest.text.get(section.byte_range.start.0..section.byte_range.end.0);
                    job.append(part.unwrap_or_default(), 0.0, section.format);
                }
                let shown = ui.add(Label::new(job).selectable(true));
                if is_marked {
                    let row = shown.rect.with_max_x(ui.max_rect().max.x).expand(1.0);
                    ui.painter().rect_filled(row, 2.0, color.gamma_multiply(0.16));
                    if scrolls {
                        shown.scroll_to_me(Some(Align::Center));
                    }
                }
            }
        });
    });
}

/// The marked bytes of a line; at least one character, unless the mark is at its end.
fn mark_in(line: &str, range: &Range<usize>, span: &Range<usize>) -> Range<usize> {
    let start = floor(line, span.start.saturating_sub(range.start).min(line.len()));
    let end = floor(line, span.end.saturating_sub(range.start).min(line.len()));
    // A mark of no width still shows where it is.
    let next = line.get(start..).and_then(|rest| rest.chars().next()).map_or(start, |c| start + c.len_utf8());
    start..if end > start { end } else { next }
}

/// The lines around the place `at`, which lies in the line with `number`: the number of the first, and the bytes of
/// each.
fn lines_around(text: &str, at: usize, number: usize) -> (usize, Vec<Range<usize>>) {
    let at = floor(text, at.min(text.len()));
    let bytes = text.as_bytes();
    let is_newline = |index: &usize| bytes.get(*index) == Some(&b'\n');
    let earliest = at.saturating_sub(FARTHEST);
    // The newlines before the place, the nearest first; a line begins after each.
    let mut starts: Vec<usize> =
        (earliest..at).rev().filter(is_newline).take(AROUND + 1).map(|newline| newline + 1).collect();
    if earliest == 0 && starts.len() <= AROUND {
        starts.push(0);
    }
    if starts.is_empty() {
        starts.push(super::excerpt::ceil(text, earliest));
    }
    let first = number.saturating_sub(starts.len() - 1).max(1);
    starts.reverse();
    let latest = (at + FARTHEST).min(bytes.len());
    starts.extend((at..latest).filter(is_newline).take(AROUND).map(|newline| newline + 1));
    let ends =
        starts.iter().skip(1).map(|next| next - 1).chain([line_end(bytes, *starts.last().unwrap_or(&0))]);
    let lines = starts.iter().zip(ends).map(|(&start, end)| {
        let end = end.min(start + LONGEST).max(start);
        let line = start..floor(text, end);
        match text.get(line.clone()) {
            Some(found) if found.ends_with('\r') => line.start..line.end - 1,
            _ => line,
        }
    });
    (first, lines.collect())
}

fn line_end(bytes: &[u8], start: usize) -> usize {
    let rest = bytes.get(start..).unwrap_or_default().iter().take(LONGEST + 1);
    start + rest.take_while(|byte| **byte != b'\n').count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(text: &str, at: usize, number: usize) -> (usize, Vec<&str>) {
        let (first, lines) = lines_around(text, at, number);
        (first, lines.into_iter().map(|line| &text[line]).collect())
    }

    #[test]
    fn at_least_one_character_is_marked() {
        let mark = |span| mark_in("aжb", &(10..14), &span);
        assert_eq!((mark(10..13), mark(11..11), mark(12..12)), (0..3, 1..3, 1..3));
        assert_eq!((mark(13..99), mark(14..14)), (3..4, 4..4));
    }

    #[test]
    fn all_lines_of_a_short_text_are_shown_with_their_numbers() {
        let text = "a\nbb\r\n\nжж\nd";
        for (at, number) in [(0, 1), (2, 2), (3, 2), (6, 3), (7, 4), (12, 5), (13, 5)] {
            assert_eq!(shown(text, at, number), (1, vec!["a", "bb", "", "жж", "d"]), "{at}");
        }
        assert_eq!(shown("", 0, 1), (1, vec![""]));
        assert_eq!(shown("a\n", 2, 2), (1, vec!["a", ""]));
    }

    #[test]
    fn of_a_long_text_the_lines_around_are_shown() {
        let text = "line\n".repeat(10_000);
        let (first, lines) = lines_around(&text, 5 * 5_000, 5_001);
        assert_eq!((first, lines.len()), (5_001 - AROUND, 2 * AROUND + 1));
        let long = "ж".repeat(1 << 18);
        let (first, lines) = lines_around(&long, 1 << 17, 1);
        assert!(first == 1 && lines.len() == 1 && lines[0].len() <= LONGEST);
    }
}
