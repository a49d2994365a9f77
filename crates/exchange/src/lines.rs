//! Lines of words and numbers.

use std::ops::Range;

/// The most words of a line that are kept.
pub(crate) const MOST_WORDS: usize = 64;

/// A word, and where it stands in the text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Word<'t> {
    pub(crate) text: &'t str,
    pub(crate) span: Range<usize>,
}

/// The words of each line that has any, up to a `#` or `//` that begins a word. Of a line with more than [`MOST_WORDS`] so many
/// and one more are given.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = Vec<Word<'_>>> {
    let body = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut at = text.len() - body.len();
    body.split('\n').filter_map(move |line| {
        let start = at;
        at += line.len() + 1;
        let words = words(line, start);
        (!words.is_empty()).then_some(words)
    })
}

fn words(line: &str, start: usize) -> Vec<Word<'_>> {
    let is_space = |letter: char| letter.is_whitespace();
    line.split(is_space)
        .filter(|word| !word.is_empty())
        .take_while(|word| !word.starts_with('#') && !word.starts_with("//"))
        .take(MOST_WORDS + 1)
        .map(|word| {
            // A word is a part of its line.
            let from = start + (word.as_ptr() as usize - line.as_ptr() as usize);
            Word { text: word, span: from..from + word.len() }
        })
        .collect()
}

/// A finite decimal number.
pub(crate) fn number(text: &str) -> Option<f64> {
    let is_decimal = text.bytes().all(|byte| byte.is_ascii_digit() || b"+-.eE".contains(&byte));
    text.parse().ok().filter(|value: &f64| is_decimal && value.is_finite())
}

/// The number that a decimal comma stands in, written with a point.
pub(crate) fn without_decimal_comma(text: &str) -> Option<String> {
    let (whole, fraction) = text.split_once(',')?;
    let is_digits = |part: &str| !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit());
    let digits = whole.strip_prefix(['-', '+']).unwrap_or(whole);
    (is_digits(digits) && is_digits(fraction)).then(|| format!("{whole}.{fraction}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_know_their_places() {
        let found: Vec<_> = lines("\u{feff}A\t0.2  1,2,3 # x\r\n\n #\nжб c // d").flatten().collect();
        let text: Vec<_> = found.iter().map(|word| (word.text, word.span.clone())).collect();
        assert_eq!(text, [("A", 3..4), ("0.2", 5..8), ("1,2,3", 10..15), ("жб", 25..29), ("c", 30..31)]);
    }

    #[test]
    fn numbers_are_decimal_and_finite() {
        assert_eq!(["1", "-.5", "+2.", "1e3"].map(number), [Some(1.0), Some(-0.5), Some(2.0), Some(1000.0)]);
        assert_eq!(["inf", "nan", "1e999", "", "--1", "1,5", "0x1"].map(number), [None; 7]);
        assert_eq!(without_decimal_comma("-0,5").as_deref(), Some("-0.5"));
        assert_eq!(without_decimal_comma("1,2,3"), None);
    }
}
