//! The line of a finding.

use std::ops::Range;

/// At most so many bytes of the line are shown before the mark, and so many from its start.
const BEFORE: usize = 60;
const AFTER: usize = 160;

/// A part of a line with a mark in it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Excerpt {
    pub(super) line: String,
    /// The marked bytes of `line`.
    pub(super) mark: Range<usize>,
}

impl Excerpt {
    /// The line of `text` in which `span` begins, shortened around it. Tabs become spaces.
    pub(super) fn new(text: &str, span: &Range<usize>) -> Self {
        let at = floor(text, span.start.min(text.len()));
        let earliest = ceil(text, at.saturating_sub(BEFORE));
        let latest = floor(text, (at + AFTER).min(text.len()));
        let before = text.get(earliest..at).unwrap_or_default();
        let after = text.get(at..latest).unwrap_or_default();
        let line_start = before.rfind('\n').map(|newline| newline + 1);
        let before = before.get(line_start.unwrap_or(0)..).unwrap_or_default();
        let after = after.split(['\n', '\r']).next().unwrap_or_default();
        let is_cut = line_start.is_none() && earliest > 0;
        let mut line = if is_cut { "…".to_owned() } else { String::new() };
        line.push_str(if is_cut { before } else { before.trim_start() });
        let start = line.len();
        line.push_str(after);
        let marked = span.end.saturating_sub(at).min(after.len());
        // A mark of no width still shows where it is.
        let marked = if marked == 0 { after.chars().next().map_or(0, char::len_utf8) } else { marked };
        let end = floor(&line, start + marked);
        if start == line.len() {
            line.push(' ');
            return Self { mark: start..line.len(), line: line.replace('\t', " ") };
        }
        Self { line: line.replace('\t', " "), mark: start..end }
    }
}

/// The start of the character that `at` lies in.
pub(super) fn floor(text: &str, mut at: usize) -> usize {
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// The start of the next character unless `at` is one.
pub(super) fn ceil(text: &str, mut at: usize) -> usize {
    while !text.is_char_boundary(at) {
        at += 1;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    fn excerpt(text: &str, marked: &str) -> (String, String) {
        let start = text.find(marked).unwrap();
        let Excerpt { line, mark } = Excerpt::new(text, &(start..start + marked.len()));
        let marked = line[mark].to_owned();
        (line, marked)
    }

    #[test]
    fn the_line_around_the_mark_is_shown() {
        assert_eq!(
            excerpt("a = 1\n\tfov = 300 # жар\r\nb = 2", "300"),
            ("fov = 300 # жар".into(), "300".into())
        );
        assert_eq!(excerpt("fov", "fov"), ("fov".into(), "fov".into()));
        let long = format!("ж = \"{}x{}\"", "ж".repeat(500), "щ".repeat(500));
        let (line, marked) = excerpt(&long, "x");
        assert!(line.starts_with('…') && line.len() < 300 && marked == "x", "{line}");
    }

    #[test]
    fn marks_without_width_and_beyond_the_end_are_shown() {
        for span in [0..0, 3..3, 9..9, 4..100] {
            let excerpt = Excerpt::new("ab\nc", &span);
            assert!(!excerpt.mark.is_empty() && excerpt.line.get(excerpt.mark.clone()).is_some(), "{span:?}");
        }
        assert_eq!(Excerpt::new("", &(0..0)).line, " ");
    }
}
