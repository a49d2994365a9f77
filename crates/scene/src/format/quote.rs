//! What a file says, repeated in a message.

/// So many characters are repeated.
const MOST: usize = 40;

/// `found` between backquotes, on one line, cut when it is long.
pub(crate) fn quoted(found: &str) -> String {
    let mut out = String::from("`");
    for (index, character) in found.chars().enumerate() {
        if index == MOST {
            out.push('…');
            break;
        }
        if character.is_control() {
            out.extend(character.escape_default());
        } else {
            out.push(character);
        }
    }
    out.push('`');
    out
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
