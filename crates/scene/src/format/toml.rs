//! TOML, one statement at a time: from text to headers and assignments with their places.
//!
//! Lexing and parsing is done by `toml_parser`; here its tokens are cut into statements, so that a file of a million
//! bodies never stands in memory as a whole tree, and its errors are put into words.

mod builder;
mod lines;
mod problem;

pub(crate) use builder::parse;
pub(crate) use lines::{LogicalLine, LogicalLines};

use std::borrow::Cow;
use std::ops::Range;

use crate::format::message::FoundValue;
use crate::format::tree::Table;

/// Bytes of the text. Texts are shorter than 4 GiB.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Span {
    start: u32,
    end: u32,
}

impl Span {
    pub(crate) fn new(start: usize, end: usize) -> Self {
        let narrow = |offset: usize| u32::try_from(offset).unwrap_or(u32::MAX);
        Self { start: narrow(start), end: narrow(end) }
    }

    pub(crate) fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }

    /// From the beginning of this one to the end of `other`.
    pub(crate) fn to(self, other: Self) -> Self {
        Self { start: self.start, end: other.end.max(self.start) }
    }
}

impl From<toml_parser::Span> for Span {
    fn from(span: toml_parser::Span) -> Self {
        Self::new(span.start(), span.end())
    }
}

/// One part of a key, decoded.
#[derive(Clone, Debug)]
pub(crate) struct Key<'t> {
    pub(crate) text: Cow<'t, str>,
    pub(crate) span: Span,
}

/// A value with its place.
#[derive(Clone, Debug)]
pub(crate) struct Value<'t> {
    pub(crate) span: Span,
    pub(crate) kind: ValueKind<'t>,
}

/// The kind of a value.
#[derive(Clone, Debug)]
pub(crate) enum ValueKind<'t> {
    /// Something that is reported already.
    Invalid,
    Text(Cow<'t, str>),
    Number {
        value: f64,
        is_integer: bool,
    },
    Boolean(bool),
    DateTime,
    Array(Vec<Value<'t>>),
    /// An inline table as it is written; [`Table`] checks it.
    Inline(Vec<Assignment<'t>>),
    Table(Table<'t>),
    /// A list of tables within a table.
    Tables(Vec<Table<'t>>),
}

impl ValueKind<'_> {
    /// What it is, for a message.
    pub(crate) fn found(&self) -> FoundValue {
        match self {
            Self::Invalid => FoundValue::Invalid,
            Self::Text(_) => FoundValue::Text,
            Self::Number { .. } => FoundValue::Number,
            Self::Boolean(_) => FoundValue::Boolean,
            Self::DateTime => FoundValue::Date,
            Self::Array(_) | Self::Tables(_) => FoundValue::List,
            Self::Inline(_) | Self::Table(_) => FoundValue::Table,
        }
    }
}

/// `key = value`, or `key.key = value`.
#[derive(Clone, Debug)]
pub(crate) struct Assignment<'t> {
    pub(crate) path: Vec<Key<'t>>,
    pub(crate) value: Value<'t>,
}

/// `[key.key]`, or `[[key.key]]`.
#[derive(Clone, Debug)]
pub(crate) struct Header<'t> {
    pub(crate) path: Vec<Key<'t>>,
    pub(crate) is_list: bool,
    pub(crate) span: Span,
}

/// The statement of a logical line.
#[derive(Clone, Debug)]
pub(crate) enum Statement<'t> {
    Header(Header<'t>),
    Assignment(Assignment<'t>),
}
