//! Quotes text of a file in a message.

use crate::format::write::{key_text, text_value};
use crate::text::{is_active, push_escape};

/// The most characters that are repeated.
const MOST: usize = 40;

/// `found` between backquotes, on one line, cut when it is long.
pub(crate) fn quoted(found: &str) -> String {
    let mut out = String::from("`");
    for (index, character) in found.chars().enumerate() {
        if index == MOST {
            out.push('…');
            break;
        }
        if is_active(character) {
            match character {
                '\n' => out.push_str("\\n"),
                '\r' => out.push_str("\\r"),
                '\t' => out.push_str("\\t"),
                other => push_escape(&mut out, other),
            }
        } else {
            out.push(character);
        }
    }
    out.push('`');
    out
}

/// The longest name that is repeated whole, for it is to be copied: in bytes.
const LONGEST_TO_COPY: usize = 200;

/// A name between backquotes as a value that can be copied into the file; shortened like any other text when nobody
/// would.
pub(crate) fn quoted_value(name: &str) -> String {
    if name.len() > LONGEST_TO_COPY { quoted(name) } else { format!("`{}`", text_value(name)) }
}

/// A key of a table that can be copied into the file, with quotes where it needs them; `None` if it is too long for
/// that.
pub(crate) fn key_to_copy(name: &str) -> Option<String> {
    (name.len() <= LONGEST_TO_COPY).then(|| key_text(name))
}

/// A header's path that can be copied into the file, of keys as they are.
pub(crate) fn path_to_copy<'a>(keys: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let keys: Option<Vec<String>> = keys.into_iter().map(key_to_copy).collect();
    keys.map(|keys| keys.join("."))
}

/// `a`, `a and b`, `a, b and c`.
pub(crate) fn listed<S: AsRef<str>>(words: &[S], last_link: &str) -> String {
    let mut out = String::new();
    for (index, word) in words.iter().enumerate() {
        if index > 0 {
            let is_last = index + 1 == words.len();
            out.push_str(if is_last { last_link } else { ", " });
        }
        out.push_str(word.as_ref());
    }
    out
}
