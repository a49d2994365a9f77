//! Standard output, standard error, and their colors.
//!
//! All words that reach a terminal pass through here, where whatever would control it (of names, paths, arguments) is
//! written out. What is an output of its own, such as a scene on standard output, goes the way of files.

use std::borrow::Cow;
use std::io::{self, IsTerminal, Write};

use anyhow::{Context as _, Result};
use catoptric_scene::visible_lines;
use serde_json::Value;

/// The exit status after an error.
pub(crate) const STATUS_ERROR: u8 = 2;

/// Prints words to standard output. A reader that has gone away, such as `head`, is no error.
pub(crate) fn print(words: &str) -> Result<()> {
    put(&visible_lines(words))
}

/// Prints words with colors to standard output.
pub(crate) fn print_colored(words: &str) -> Result<()> {
    put(&visible_but_colors(words))
}

fn put(words: &str) -> Result<()> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(words.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(error).context("cannot write to standard output")
        }
        _ => Ok(()),
    }
}

/// Prints words and a line break to standard error; when even that fails, the error is dropped.
pub(crate) fn say(words: &str) {
    let _ = writeln!(io::stderr().lock(), "{}", visible_lines(words));
}

/// Prints words with colors, and a line break, to standard error.
pub(crate) fn say_colored(words: &str) {
    let _ = writeln!(io::stderr().lock(), "{}", visible_but_colors(words));
}

/// Words in which only colors and styles (`ESC [ … m`) control a terminal.
fn visible_but_colors(words: &str) -> Cow<'_, str> {
    let mut parts = words.split("\u{1b}[");
    let mut seen = visible_lines(parts.next().unwrap_or_default());
    for part in parts {
        let numbers = part.find(|character: char| !character.is_ascii_digit() && character != ';');
        let is_color = numbers.is_some_and(|end| part.get(end..).is_some_and(|rest| rest.starts_with('m')));
        let seen = seen.to_mut();
        seen.push_str(if is_color { "\u{1b}[" } else { "\\u001B[" });
        seen.push_str(&visible_lines(part));
    }
    seen
}

/// A value as JSON, a line break at its end. Every character that would control a terminal is escaped; a reader gets it
/// all the same.
pub(crate) fn json_text(value: &Value) -> String {
    let mut text = String::new();
    // Beyond ASCII there are only texts, in which any character may be written as UTF-16.
    for character in format!("{value:#}\n").chars() {
        if character != '\n' && catoptric_scene::is_active(character) {
            for unit in character.encode_utf16(&mut [0; 2]) {
                text.push_str(&format!("\\u{unit:04x}"));
            }
        } else {
            text.push(character);
        }
    }
    text
}

/// Whether a stream should get colors: it is a terminal, and the user does not ask otherwise (<https://no-color.org>).
pub(crate) fn color_on(stream: &impl IsTerminal) -> bool {
    is_able(stream) && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
}

/// Whether a stream is a terminal that can do more than print line after line.
pub(crate) fn is_able(stream: &impl IsTerminal) -> bool {
    stream.is_terminal() && std::env::var_os("TERM").is_none_or(|term| term != "dumb")
}

/// A number of things: `1 body`, `2 bodies`.
pub(crate) fn count(number: usize, one: &str, many: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_colors_pass() {
        assert_eq!(visible_but_colors("\u{1b}[1;31merror\u{1b}[0m: a"), "\u{1b}[1;31merror\u{1b}[0m: a");
        assert_eq!(visible_but_colors("\u{1b}[2Ja\u{1b}]0;title\u{7}"), "\\u001B[2Ja\\u001B]0;title\\u0007");
        assert_eq!(visible_but_colors("\u{1b}[1;3\u{1b}[0m\u{9b}31m"), "\\u001B[1;3\u{1b}[0m\\u009B31m");
        assert_eq!(visible_but_colors("a\tb\nc\u{1b}["), "a\tb\nc\\u001B[");
        assert!(matches!(visible_but_colors("plain"), Cow::Borrowed("plain")));
    }

    #[test]
    fn json_says_the_same_in_harmless_characters() {
        let name = "a\u{1b}\u{7f}\u{9b}\u{202e}\u{e0041}ж\n";
        let value = serde_json::json!({ name: [name, 1] });
        let text = json_text(&value);
        assert!(
            !text
                .trim_end()
                .chars()
                .any(|character| character != '\n' && catoptric_scene::is_active(character))
        );
        assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), value);
    }
}
