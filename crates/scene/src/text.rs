//! Text of files and users, made fit to be shown.

use std::borrow::Cow;
use std::fmt::Write as _;

/// Whether a character does something where it is shown, instead of being seen: it controls a terminal, breaks the
/// line, or turns the direction of the text around it (as in <https://trojansource.codes>).
pub const fn is_active(character: char) -> bool {
    matches!(
        character,
        // C0, DEL and C1.
        '\0'..='\u{1f}' | '\u{7f}'..='\u{9f}'
        // Marks, embeddings, overrides and isolates of direction; separators of lines and paragraphs.
        | '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{206f}'
        // Byte order mark, annotations, tags.
        | '\u{feff}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}'
    )
}

/// The text with each [active](is_active) character written as TOML and JSON escape it: `\u001B`. It is one line.
///
/// ```
/// assert_eq!(catoptric_scene::visible("\u{1b}[31mred\n"), "\\u001B[31mred\\u000A");
/// ```
pub fn visible(text: &str) -> Cow<'_, str> {
    with_escapes(text, is_active)
}

/// [`visible`], but for line breaks and tabs, which stay.
pub fn visible_lines(text: &str) -> Cow<'_, str> {
    with_escapes(text, |character| is_active(character) && !matches!(character, '\n' | '\t'))
}

/// A name in quotes, made [`visible`], for people: `"glass"`.
pub fn quoted_name(name: &str) -> String {
    format!("\"{}\"", visible(name))
}

fn with_escapes(text: &str, is_escaped: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&is_escaped) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    for character in text.chars() {
        if is_escaped(character) {
            push_escape(&mut out, character);
        } else {
            out.push(character);
        }
    }
    Cow::Owned(out)
}

/// Appends the escape sequence of a character, as basic strings of TOML have it.
pub(crate) fn push_escape(out: &mut String, character: char) {
    let code = u32::from(character);
    // Writing to a string cannot fail.
    let _ = if code > 0xffff { write!(out, "\\U{code:08X}") } else { write!(out, "\\u{code:04X}") };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_harmless_stays() {
        for text in ["", "glass", "Стекло «ёлочка»", "a\u{301} 👩\u{200d}🔬 שלום \u{200c}", "tab\tand\nline"]
        {
            assert!(matches!(visible_lines(text), Cow::Borrowed(same) if same == text), "{text}");
        }
    }

    #[test]
    fn what_is_active_is_written_out() {
        assert_eq!(visible("a\u{9b}2J\u{7f}"), "a\\u009B2J\\u007F");
        assert_eq!(visible("\u{202e}\u{2066}\u{e0041}"), "\\u202E\\u2066\\U000E0041");
        assert_eq!(visible_lines("a\tb\nc\rd\0"), "a\tb\nc\\u000Dd\\u0000");
        assert_eq!(quoted_name("a\nb"), "\"a\\u000Ab\"");
    }
}
