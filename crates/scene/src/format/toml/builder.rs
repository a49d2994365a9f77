//! Builds a statement from the tokens of one logical line.

use std::borrow::Cow;

use toml_parser::decoder::{Encoding, IntegerRadix, ScalarKind};
use toml_parser::lexer::Token;
use toml_parser::parser::{EventReceiver, RecursionGuard, ValidateWhitespace, parse_document};
use toml_parser::{ErrorSink, ParseError, Raw, Source, Span as RawSpan};

use super::{Assignment, Header, Key, Span, Statement, Value, ValueKind, problem};
use crate::format::diagnostic::Diagnostic;
use crate::shape::Shape;

/// Deepest nesting of brackets: a list of bodies needs five, and parts within parts two each.
const DEEPEST: u32 = 5 + 2 * Shape::MAX_DEPTH as u32;
/// The most errors of one logical line that are kept.
const MOST_ERRORS: usize = 16;

/// The result of reading a logical line.
pub(crate) struct ParsedLine<'t> {
    /// The statement; nothing for blank lines and lines that make no sense. Its value is invalid if anything in it is.
    pub(crate) statement: Option<Statement<'t>>,
    /// Syntax errors.
    pub(crate) problems: Vec<Diagnostic>,
}

/// Reads the tokens of one logical line of `text`.
pub(crate) fn parse<'t>(text: &'t str, tokens: &[Token]) -> ParsedLine<'t> {
    let mut builder = Builder::new(text);
    let mut errors = ErrorList::default();
    {
        let mut guard = RecursionGuard::new(&mut builder, DEEPEST);
        let mut receiver = ValidateWhitespace::new(&mut guard, Source::new(text));
        parse_document(tokens, &mut receiver, &mut errors);
    }
    builder.finish(&errors.0)
}

/// The first errors of a line.
#[derive(Default)]
struct ErrorList(Vec<ParseError>);

impl ErrorSink for ErrorList {
    fn report_error(&mut self, error: ParseError) {
        if self.0.len() < MOST_ERRORS {
            self.0.push(error);
        }
    }
}

/// A bracket of a value that is still open.
enum OpenBracket<'t> {
    Array(Span, Vec<Value<'t>>),
    Inline(Span, Vec<Assignment<'t>>, Vec<Key<'t>>),
}

/// Receives the parser's events.
struct Builder<'t> {
    text: &'t str,
    /// Beginning of a header, and whether it is one of a list.
    header: Option<(Span, bool)>,
    path: Vec<Key<'t>>,
    frames: Vec<OpenBracket<'t>>,
    value: Option<Value<'t>>,
    /// Whether a key could not be read.
    has_bad_key: bool,
    /// Whether the line is over; what follows after an error belongs to no statement.
    is_over: bool,
    problems: Vec<Diagnostic>,
}

impl<'t> Builder<'t> {
    fn new(text: &'t str) -> Self {
        Self {
            text,
            header: None,
            path: Vec::new(),
            frames: Vec::new(),
            value: None,
            has_bad_key: false,
            is_over: false,
            problems: Vec::new(),
        }
    }

    fn finish(mut self, errors: &[ParseError]) -> ParsedLine<'t> {
        while !self.frames.is_empty() {
            self.close(Span::default());
        }
        let key = self.path.first().zip(self.path.last()).map(|(first, last)| first.span.to(last.span));
        let from_parser = errors.iter().map(|error| problem::from_parser(error, self.text, key));
        self.problems.extend(from_parser);
        let is_valid = self.problems.is_empty();
        let problems = problem::one_per_line(self.problems, self.text);
        let statement = match (self.header, self.value) {
            _ if self.path.is_empty() || self.has_bad_key => None,
            (Some((span, is_list)), _) => Some(Statement::Header(Header { path: self.path, is_list, span })),
            (None, Some(value)) => {
                let value = if is_valid { value } else { Value { kind: ValueKind::Invalid, ..value } };
                Some(Statement::Assignment(Assignment { path: self.path, value }))
            }
            (None, None) => None,
        };
        ParsedLine { statement, problems }
    }

    fn raw(&self, span: RawSpan, encoding: Option<Encoding>) -> Raw<'t> {
        let raw = self.text.get(span.start()..span.end()).unwrap_or_default();
        Raw::new_unchecked(raw, encoding, span)
    }

    fn problem(&mut self, diagnostic: Diagnostic) {
        if self.problems.len() < MOST_ERRORS {
            self.problems.push(diagnostic);
        }
    }

    /// A whole value: goes to the innermost bracket, or is the statement's.
    fn put(&mut self, value: Value<'t>) {
        match self.frames.last_mut() {
            Some(OpenBracket::Array(_, values)) => values.push(value),
            Some(OpenBracket::Inline(_, assignments, path)) => {
                assignments.push(Assignment { path: std::mem::take(path), value });
            }
            None => self.value = Some(value),
        }
    }

    fn close(&mut self, end: Span) {
        let (start, kind) = match self.frames.pop() {
            Some(OpenBracket::Array(span, values)) => (span, ValueKind::Array(values)),
            Some(OpenBracket::Inline(span, assignments, _)) => (span, ValueKind::Inline(assignments)),
            None => return,
        };
        self.put(Value { span: start.to(end), kind });
    }

    fn decode(&mut self, span: RawSpan, encoding: Option<Encoding>) -> ValueKind<'t> {
        let raw = self.raw(span, encoding);
        let mut error: Option<ParseError> = None;
        let mut decoded = Cow::Borrowed("");
        let kind = raw.decode_scalar(&mut decoded, &mut error);
        if let Some(error) = error {
            self.problem(problem::from_value(&error, self.text, raw.as_str(), encoding, span.into()));
            return ValueKind::Invalid;
        }
        match kind {
            ScalarKind::String => ValueKind::Text(decoded),
            ScalarKind::Boolean(flag) => ValueKind::Boolean(flag),
            ScalarKind::DateTime => ValueKind::DateTime,
            ScalarKind::Float => ValueKind::Number { value: decimal(&decoded), is_integer: false },
            ScalarKind::Integer(IntegerRadix::Dec) => {
                ValueKind::Number { value: decimal(&decoded), is_integer: true }
            }
            ScalarKind::Integer(radix) => {
                let value =
                    u64::from_str_radix(&decoded, radix.value()).map_or(f64::INFINITY, |value| value as f64);
                ValueKind::Number { value, is_integer: true }
            }
        }
    }
}

impl EventReceiver for Builder<'_> {
    fn std_table_open(&mut self, span: RawSpan, _error: &mut dyn ErrorSink) {
        self.header = Some((span.into(), false));
    }

    fn array_table_open(&mut self, span: RawSpan, _error: &mut dyn ErrorSink) {
        self.header = Some((span.into(), true));
    }

    fn std_table_close(&mut self, span: RawSpan, _error: &mut dyn ErrorSink) {
        self.header = self.header.map(|(start, is_list)| (start.to(span.into()), is_list));
    }

    fn array_table_close(&mut self, span: RawSpan, _error: &mut dyn ErrorSink) {
        self.header = self.header.map(|(start, is_list)| (start.to(span.into()), is_list));
    }

    fn inline_table_open(&mut self, span: RawSpan, _error: &mut dyn ErrorSink) -> bool {
        if !self.is_over {
            self.frames.push(OpenBracket::Inline(span.into(), Vec::new(), Vec::new()));
        }
        true
    }

    fn inline_table_close(&mut self, span: RawSpan, _error: &mut dyn ErrorSink) {
        self.close(span.into());
    }

    fn array_open(&mut self, span: RawSpan, _error: &mut dyn ErrorSink) -> bool {
        if !self.is_over {
            self.frames.push(OpenBracket::Array(span.into(), Vec::new()));
        }
        true
    }

    fn array_close(&mut self, span: RawSpan, _error: &mut dyn ErrorSink) {
        self.close(span.into());
    }

    fn simple_key(&mut self, span: RawSpan, encoding: Option<Encoding>, _error: &mut dyn ErrorSink) {
        if self.is_over {
            return;
        }
        let raw = self.raw(span, encoding);
        let mut error: Option<ParseError> = None;
        let mut text = Cow::Borrowed("");
        raw.decode_key(&mut text, &mut error);
        if let Some(error) = error {
            self.problem(problem::from_key(&error, raw.as_str(), span.into()));
            self.has_bad_key |= self.frames.is_empty();
        }
        let key = Key { text, span: span.into() };
        match self.frames.last_mut() {
            Some(OpenBracket::Inline(_, _, path)) => path.push(key),
            _ => self.path.push(key),
        }
    }

    fn newline(&mut self, _span: RawSpan, _error: &mut dyn ErrorSink) {
        self.is_over |= self.frames.is_empty() && !self.path.is_empty();
    }

    fn scalar(&mut self, span: RawSpan, encoding: Option<Encoding>, _error: &mut dyn ErrorSink) {
        if self.is_over {
            return;
        }
        let kind = self.decode(span, encoding);
        self.put(Value { span: span.into(), kind });
    }
}

/// A decimal number that is one; too large ones are infinite.
fn decimal(text: &str) -> f64 {
    text.parse().unwrap_or(f64::NAN)
}
