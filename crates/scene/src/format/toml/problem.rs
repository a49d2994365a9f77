//! Syntax errors in words.

use toml_parser::ParseError;
use toml_parser::decoder::Encoding;

use super::Span;
use crate::format::decimal;
use crate::format::diagnostic::Diagnostic;
use crate::format::quote::quoted;

const VALUES: &str = "a value is a number, a \"text\", a [list] or a { table }";

/// An error of the structure. `key` is the place of the statement's key.
pub(super) fn from_parser(error: &ParseError, text: &str, key: Option<Span>) -> Diagnostic {
    let context = error.context().map_or(0..0, |span| span.start()..span.end());
    let found = error.unexpected().map_or(context.clone(), |span| span.start()..span.end());
    let places = [Some(found.start), key.map(|key| key.range().start), Some(word_before(text, found.start))];
    if let Some(problem) = places.into_iter().flatten().find_map(|at| decimal_comma(text, at)) {
        return problem;
    }
    match error.description() {
        "unclosed array" => Diagnostic::error(context, "this list is not closed")
            .label("opened here")
            .help("write `]` after its last value"),
        "unclosed inline table" => Diagnostic::error(context, "this table is not closed")
            .label("opened here")
            .help("write `}` after its last value"),
        "unclosed table" => Diagnostic::error(context, "this header is not closed")
            .label("`]` is missing")
            .help("a header is `[name]`"),
        "unclosed array table" => Diagnostic::error(context, "this header is not closed")
            .label("`]]` is missing")
            .help("a header of a list is `[[name]]`"),
        "key with no value" | "missing value for key" => {
            let diagnostic =
                Diagnostic::error(key.map_or(found.clone(), Span::range), "this key has no value");
            if text.get(found.start..).is_some_and(|rest| rest.starts_with(':')) {
                return diagnostic
                    .label("`=` is missing")
                    .help("between a key and its value stands `=`, not `:`");
            }
            diagnostic.label("`=` and a value are missing").help(VALUES)
        }
        "missing value" => Diagnostic::error(found, "a value is missing").help(VALUES),
        "invalid key-value pair" | "missing table open" | "invalid table" => {
            Diagnostic::error(first_character(text, found.start), "a line cannot begin like this")
                .help("a line is `key = value`, `[table]`, `[[list]]` or `# a comment`")
        }
        "unexpected key or value" => {
            let number = decimal::number_before(text, found.start + 1);
            let help = match number.filter(|_| is_decimal_comma(text, found.start)) {
                Some((_, number)) => decimal::help(&number),
                None => "write each key on a line of its own, and comments after `#`".to_owned(),
            };
            Diagnostic::error(rest_of_line(text, found.start), "the line should end here")
                .label("too much")
                .help(help)
        }
        "missing comma between array elements" | "missing comma between key-value pairs" => {
            Diagnostic::error(found, "a comma is missing").label("before this")
        }
        "extra comma in array" | "extra comma in inline table" => {
            Diagnostic::error(first_character(text, found.start), "a value is missing before this comma")
        }
        "missing assignment between key-value pairs" => {
            Diagnostic::error(found, "`=` is missing").label("before this")
        }
        "missing array opening" => Diagnostic::error(first_character(text, found.start), "`]` without `[`"),
        "missing inline table opening" => {
            Diagnostic::error(first_character(text, found.start), "`}` without `{`")
        }
        "cannot recurse further; max recursion depth met" => {
            Diagnostic::error(found, "brackets are nested too deep").label("one level too deep")
        }
        other => Diagnostic::error(found, other.to_owned()),
    }
}

/// An error of a number or text, `raw` at `span` of `text`.
pub(super) fn from_value(
    error: &ParseError,
    text: &str,
    raw: &str,
    encoding: Option<Encoding>,
    span: Span,
) -> Diagnostic {
    let inner = error.unexpected().map_or(span.range(), |inner| inner.start()..inner.end());
    let description = error.description();
    if raw.is_empty() {
        if let Some(problem) = decimal_comma(text, word_before(text, span.range().start)) {
            return problem;
        }
        let help = if is_comment(text, span) {
            "# begins a comment; write a color in quotes: \"#ff0000\""
        } else {
            VALUES
        };
        return Diagnostic::error(span.range(), "a value is missing").label("here").help(help);
    }
    if encoding.is_none() {
        let is_number = raw.starts_with(|first: char| first.is_ascii_digit() || "+-._".contains(first));
        if let Some(problem) = decimal_comma(text, span.range().start) {
            return problem;
        }
        let whole = Diagnostic::error(span.range(), format!("{} is not a value", quoted(raw)));
        return match description {
            _ if raw.contains(['"', '\'']) => whole.label("a quote is missing").help(VALUES),
            _ if is_number && raw.contains(' ') => whole.label("is a comma missing?").help(VALUES),
            _ if raw.starts_with('(') => whole.help("a vector stands in square brackets: [0.0, 1.0, 0.0]"),
            _ if lacks_digit(raw) => {
                Diagnostic::error(span.range(), format!("{} is not a number", quoted(raw)))
                    .label("a digit is missing")
                    .help("a number has digits before and after the point: 0.5, 27.0")
            }
            "string values must be quoted" if is_number => whole.label("not a number").help(VALUES),
            "invalid float" => whole.label("not a number"),
            _ if is_number => {
                Diagnostic::error(inner, format!("{} is not a number: {description}", quoted(raw)))
            }
            _ => whole.help("a text stands in quotes: \"text\""),
        };
    }
    match description {
        "missing escaped value" => Diagnostic::error(inner, "unknown escape sequence in a text")
            .help("a backslash is written `\\\\`, a quote `\\\"`, a new line `\\n`"),
        "too few unicode value digits" | "invalid value" => {
            Diagnostic::error(inner, "not a Unicode character")
                .help("`\\u` is followed by four hexadecimal digits, `\\U` by eight")
        }
        _ if is_open(raw) => Diagnostic::error(first_line(raw, span), "this text is not closed")
            .label("opened here")
            .help("write the closing quote"),
        _ => Diagnostic::error(inner, "a character that a text cannot hold")
            .help("write it as an escape sequence, for example `\\t` or `\\u0007`"),
    }
}

/// An error of a key, `raw` at `span`.
pub(super) fn from_key(error: &ParseError, raw: &str, span: Span) -> Diagnostic {
    if raw.is_empty() {
        return Diagnostic::error(span.range(), "a key is missing").label("before this");
    }
    if is_open(raw) {
        return Diagnostic::error(span.range(), "this key is not closed").help("write the closing quote");
    }
    if raw.starts_with(['"', '\'']) {
        return Diagnostic::error(
            span.range(),
            format!("{} is not a key: {}", quoted(raw), error.description()),
        );
    }
    let diagnostic = Diagnostic::error(span.range(), format!("{} is not a key", quoted(raw)));
    if raw.ends_with(':') {
        return diagnostic.help("between a key and its value stands `=`");
    }
    diagnostic.help("a key is made of the letters A to Z and a to z, digits, `_` and `-`; others need quotes")
}

/// The first error of each line: what follows on the same line is mostly its consequence.
pub(super) fn one_per_line(mut problems: Vec<Diagnostic>, text: &str) -> Vec<Diagnostic> {
    problems.sort_by_key(|problem| problem.span.start);
    let mut last = None;
    problems.retain(|problem| {
        let start = problem.span.start;
        let is_new =
            last.is_none_or(|last| text.get(last..start).is_none_or(|between| between.contains('\n')));
        if is_new {
            last = Some(start);
        }
        is_new
    });
    problems
}

/// Whether the closing quote is missing.
pub(super) fn is_open(raw: &str) -> bool {
    let quote = ["\"\"\"", "'''", "\"", "'"].into_iter().find(|quote| raw.starts_with(quote));
    quote.is_some_and(|quote| {
        raw.len() < 2 * quote.len() || !raw.ends_with(quote) || ends_with_escaped_quote(raw)
    })
}

/// Whether the last quote of `"…\"` is escaped.
fn ends_with_escaped_quote(raw: &str) -> bool {
    let Some(inner) = raw.strip_prefix('"').and_then(|raw| raw.strip_suffix('"')) else { return false };
    inner.bytes().rev().take_while(|&byte| byte == b'\\').count() % 2 == 1
}

/// Whether this is a decimal number, but for digits beside its point.
fn lacks_digit(raw: &str) -> bool {
    let number = raw.strip_prefix(['+', '-']).unwrap_or(raw);
    let number = number.split(['e', 'E']).next().unwrap_or_default();
    let is_digits = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit() || byte == b'_');
    number.split_once('.').is_some_and(|(before, after)| {
        (before.is_empty() || after.is_empty()) && is_digits(before) && is_digits(after)
    })
}

/// A number with a decimal comma within brackets, whose digits from `at` on were taken for a value or key of their own.
fn decimal_comma(text: &str, at: usize) -> Option<Diagnostic> {
    let (start, number) = decimal::number_before(text, at)?;
    let end = start + number.len();
    let written = text.get(start..end)?;
    Some(
        Diagnostic::error(start..end, format!("{} is not a number", quoted(written)))
            .label("a decimal comma")
            .help(decimal::help(&number)),
    )
}

/// Where the word before `at` begins: in an inline table, the digits after a decimal comma are a key whose value is missed.
fn word_before(text: &str, at: usize) -> usize {
    let before = text.get(..at).unwrap_or_default().trim_end();
    before.trim_end_matches(|letter: char| letter.is_ascii_alphanumeric()).len()
}

/// Whether a decimal comma stands at `at`: it parts two groups of digits, and is the only comma after the `=`.
fn is_decimal_comma(text: &str, at: usize) -> bool {
    let (Some(before), Some(after)) = (text.get(..at), text.get(rest_of_line(text, at))) else {
        return false;
    };
    let line = before.rsplit(['\n', '\r']).next().unwrap_or_default();
    let Some((_, whole)) = line.split_once('=') else { return false };
    let is_number = |part: &str| part.parse::<f64>().is_ok_and(f64::is_finite);
    let Some(fraction) = after.strip_prefix(',') else { return false };
    let fraction = fraction.split('#').next().unwrap_or_default().trim_end();
    is_number(whole.trim_start())
        && fraction.starts_with(|first: char| first.is_ascii_digit())
        && is_number(fraction)
}

/// Whether a comment stands where the value at `span` is missing.
fn is_comment(text: &str, span: Span) -> bool {
    let rest = text.get(span.range().start..).unwrap_or_default();
    rest.trim_start_matches([' ', '\t']).starts_with('#')
}

fn first_line(raw: &str, span: Span) -> std::ops::Range<usize> {
    let range = span.range();
    let length = raw.find(['\n', '\r']).unwrap_or(raw.len());
    range.start..range.start + length
}

fn first_character(text: &str, at: usize) -> std::ops::Range<usize> {
    let length = text.get(at..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
    at..at + length
}

fn rest_of_line(text: &str, at: usize) -> std::ops::Range<usize> {
    let rest = text.get(at..).unwrap_or_default();
    let line = rest.split(['\n', '\r']).next().unwrap_or_default();
    at..at + line.trim_end().len()
}
