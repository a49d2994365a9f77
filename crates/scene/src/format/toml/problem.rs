//! Syntax errors in words.

use std::ops::Range;

use toml_parser::ParseError;
use toml_parser::decoder::Encoding;

use super::Span;
use crate::format::decimal;
use crate::format::diagnostic::Diagnostic;
use crate::format::message::Message;
use crate::format::quote::quoted;

/// An error of the structure. `key` is the place of the statement's key.
pub(super) fn from_parser(error: &ParseError, text: &str, key: Option<Span>) -> Diagnostic {
    let context = error.context().map_or(0..0, |span| span.start()..span.end());
    let found = error.unexpected().map_or(context.clone(), |span| span.start()..span.end());
    let places = [Some(found.start), key.map(|key| key.range().start), Some(word_before(text, found.start))];
    if let Some(problem) = places.into_iter().flatten().find_map(|at| decimal_comma(text, at)) {
        return problem;
    }
    let not_closed = |message, label| Diagnostic::error(context.clone(), message).with_label(label);
    let at_first = |message| Diagnostic::error(first_character(text, found.start), message);
    match error.description() {
        "unclosed array" => not_closed(Message::ListNotClosed, Message::OpenedHere)
            .with_help(Message::CloseAfterLast { bracket: "]" }),
        "unclosed inline table" => not_closed(Message::TableNotClosed, Message::OpenedHere)
            .with_help(Message::CloseAfterLast { bracket: "}" }),
        "unclosed table" => {
            not_closed(Message::HeaderNotClosed, Message::Missing { key: "]" }).with_help(Message::HeaderIs)
        }
        "unclosed array table" => not_closed(Message::HeaderNotClosed, Message::Missing { key: "]]" })
            .with_help(Message::ListHeaderIs),
        "key with no value" | "missing value for key" => {
            let place = key.map_or(found.clone(), Span::range);
            let diagnostic = Diagnostic::error(place, Message::NoValue);
            if text.get(found.start..).is_some_and(|rest| rest.starts_with(':')) {
                return diagnostic
                    .with_label(Message::Missing { key: "=" })
                    .with_help(Message::EqualsNotColon);
            }
            diagnostic.with_label(Message::EqualsAndValueMissing).with_help(Message::ValueIs)
        }
        "missing value" => Diagnostic::error(found, Message::ValueMissing).with_help(Message::ValueIs),
        "invalid key-value pair" | "missing table open" | "invalid table" => {
            at_first(Message::LineBegins).with_help(Message::LineIs)
        }
        "unexpected key or value" => {
            let number = decimal::number_before(text, found.start + 1);
            let help = match number.filter(|_| is_decimal_comma(text, found.start)) {
                Some((_, example)) => Message::DecimalPoint { example },
                None => Message::OneKeyPerLine,
            };
            Diagnostic::error(rest_of_line(text, found.start), Message::LineEnds)
                .with_label(Message::TooMuch)
                .with_help(help)
        }
        "missing comma between array elements" | "missing comma between key-value pairs" => {
            Diagnostic::error(found, Message::CommaMissing).with_label(Message::BeforeThis)
        }
        "extra comma in array" | "extra comma in inline table" => at_first(Message::ValueMissingBeforeComma),
        "missing assignment between key-value pairs" => {
            Diagnostic::error(found, Message::Missing { key: "=" }).with_label(Message::BeforeThis)
        }
        "missing array opening" => at_first(Message::NotOpened { closing: "]", opening: "[" }),
        "missing inline table opening" => at_first(Message::NotOpened { closing: "}", opening: "{" }),
        "cannot recurse further; max recursion depth met" => {
            Diagnostic::error(found, Message::TooDeep).with_label(Message::OneLevelTooDeep)
        }
        _ => Diagnostic::error(found, Message::Syntax { fault: error.into() }),
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
    if raw.is_empty() {
        if let Some(problem) = decimal_comma(text, word_before(text, span.range().start)) {
            return problem;
        }
        let help = if is_comment(text, span) { Message::QuoteColor } else { Message::ValueIs };
        return Diagnostic::error(span.range(), Message::ValueMissing)
            .with_label(Message::Here)
            .with_help(help);
    }
    if encoding.is_none() {
        return decimal_comma(text, span.range().start)
            .unwrap_or_else(|| from_unquoted(error, raw, inner, span));
    }
    match error.description() {
        "missing escaped value" => {
            Diagnostic::error(inner, Message::UnknownEscape).with_help(Message::EscapesAre)
        }
        "too few unicode value digits" | "invalid value" => {
            Diagnostic::error(inner, Message::NotUnicode).with_help(Message::UnicodeIs)
        }
        _ if is_open(raw) => Diagnostic::error(first_line(raw, span), Message::TextNotClosed)
            .with_label(Message::OpenedHere)
            .with_help(Message::CloseQuote),
        _ => Diagnostic::error(inner, Message::BadCharacter).with_help(Message::EscapeCharacter),
    }
}

/// An error of a value without quotes.
fn from_unquoted(error: &ParseError, raw: &str, inner: Range<usize>, span: Span) -> Diagnostic {
    let is_number = raw.starts_with(|first: char| first.is_ascii_digit() || "+-._".contains(first));
    let whole = Diagnostic::error(span.range(), Message::NotAValue { raw: quoted(raw) });
    match error.description() {
        _ if raw.contains(['"', '\'']) => whole.with_label(Message::QuoteMissing).with_help(Message::ValueIs),
        _ if is_number && raw.contains(' ') => {
            whole.with_label(Message::IsCommaMissing).with_help(Message::ValueIs)
        }
        _ if raw.starts_with('(') => whole.with_help(Message::VectorIs),
        _ if lacks_digit(raw) => Diagnostic::error(span.range(), Message::NotANumber { raw: quoted(raw) })
            .with_label(Message::DigitMissing)
            .with_help(Message::NumberIs),
        "string values must be quoted" if is_number => {
            whole.with_label(Message::NoNumber).with_help(Message::ValueIs)
        }
        "invalid float" => whole.with_label(Message::NoNumber),
        _ if is_number => {
            Diagnostic::error(inner, Message::BadNumber { raw: quoted(raw), fault: error.into() })
        }
        _ => whole.with_help(Message::TextIs),
    }
}

/// An error of a key, `raw` at `span`.
pub(super) fn from_key(error: &ParseError, raw: &str, span: Span) -> Diagnostic {
    if raw.is_empty() {
        return Diagnostic::error(span.range(), Message::KeyMissing).with_label(Message::BeforeThis);
    }
    if is_open(raw) {
        return Diagnostic::error(span.range(), Message::KeyNotClosed).with_help(Message::CloseQuote);
    }
    if raw.starts_with(['"', '\'']) {
        let message = Message::BadKey { raw: quoted(raw), fault: error.into() };
        return Diagnostic::error(span.range(), message);
    }
    let diagnostic = Diagnostic::error(span.range(), Message::NotAKey { raw: quoted(raw) });
    diagnostic.with_help(if raw.ends_with(':') { Message::EqualsBetween } else { Message::KeyIs })
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
        Diagnostic::error(start..end, Message::NotANumber { raw: quoted(written) })
            .with_label(Message::DecimalComma)
            .with_help(Message::DecimalPoint { example: number }),
    )
}

/// Where the word before `at` begins: in an inline table, the digits after a decimal comma are a key whose value is
/// missed.
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

fn first_line(raw: &str, span: Span) -> Range<usize> {
    let range = span.range();
    let length = raw.find(['\n', '\r']).unwrap_or(raw.len());
    range.start..range.start + length
}

fn first_character(text: &str, at: usize) -> Range<usize> {
    let length = text.get(at..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
    at..at + length
}

fn rest_of_line(text: &str, at: usize) -> Range<usize> {
    let rest = text.get(at..).unwrap_or_default();
    let line = rest.split(['\n', '\r']).next().unwrap_or_default();
    at..at + line.trim_end().len()
}
