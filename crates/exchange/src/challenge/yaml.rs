//! YAML as a tree of bounded size, with places.

use std::collections::HashMap;
use std::ops::Range;
use std::rc::Rc;

use saphyr_parser::{Event, Parser, ScalarStyle, Span};

use crate::draft::Draft;
use crate::message::Message;
use crate::phrase::Kind;

/// The deepest nesting of values, definitions and groups.
pub(super) const MOST_DEEP: usize = 64;
/// The most values of a file.
const MOST_NODES: usize = 1_000_000;

/// A value with its place. Aliases share it.
#[derive(Debug)]
pub(super) struct Node {
    pub(super) value: Value,
    pub(super) span: Range<usize>,
}

/// A value.
#[derive(Debug)]
pub(super) enum Value {
    /// A text, a number, a flag.
    Scalar {
        text: String,
        /// Whether it stands in quotes.
        is_quoted: bool,
    },
    List(Vec<Rc<Node>>),
    /// Keys and values, in the order of the file.
    Table(Vec<(Rc<Node>, Rc<Node>)>),
}

impl Node {
    /// The text of a scalar.
    pub(super) fn text(&self) -> Option<&str> {
        match &self.value {
            Value::Scalar { text, .. } => Some(text),
            _ => None,
        }
    }

    /// The elements of a list.
    pub(super) fn list(&self) -> Option<&[Rc<Self>]> {
        match &self.value {
            Value::List(list) => Some(list),
            _ => None,
        }
    }

    /// The number that a scalar without quotes is.
    pub(super) fn number(&self) -> Option<f64> {
        match &self.value {
            Value::Scalar { text, is_quoted: false } => crate::lines::number(text),
            _ => None,
        }
    }

    /// What it is.
    pub(super) fn kind(&self) -> Kind {
        match &self.value {
            Value::Scalar { text, is_quoted: false } if text.is_empty() => Kind::Nothing,
            Value::Scalar { .. } if self.number().is_some() => Kind::Number,
            Value::Scalar { .. } => Kind::Text,
            Value::List(_) => Kind::List,
            Value::Table(_) => Kind::Table,
        }
    }
}

/// A list or a table that is being read.
struct Open {
    anchor: usize,
    start: usize,
    nodes: Vec<Rc<Node>>,
    is_table: bool,
}

/// Reads the first document. An error is reported, and gives nothing.
pub(super) fn parse(text: &str, draft: &mut Draft) -> Option<Rc<Node>> {
    let body = text.strip_prefix('\u{feff}').unwrap_or(text);
    let places = BytePlaces::new(body, text.len() - body.len());
    let mut reader = TreeReader { places, open: Vec::new(), anchors: HashMap::new(), count: 0, root: None };
    for event in Parser::new_from_str(body) {
        let read = match event {
            Ok((event, span)) => reader.event(event, span),
            Err(error) => {
                let at = reader.places.byte(error.marker().index());
                Err((at..at, Message::Yaml { fault: error.info().to_owned() }))
            }
        };
        if let Err((span, message)) = read {
            draft.error(&span, message);
            return None;
        }
    }
    reader.root
}

type Fault = (Range<usize>, Message);

struct TreeReader {
    places: BytePlaces,
    open: Vec<Open>,
    anchors: HashMap<usize, Rc<Node>>,
    count: usize,
    root: Option<Rc<Node>>,
}

impl TreeReader {
    fn event(&mut self, event: Event<'_>, span: Span) -> Result<(), Fault> {
        let (start, end) = (self.places.byte(span.start.index()), self.places.byte(span.end.index()));
        let span = start..end.max(start);
        match event {
            Event::Scalar(text, style, anchor, _) => {
                let is_quoted = style != ScalarStyle::Plain;
                self.node(anchor, Node { value: Value::Scalar { text: text.into_owned(), is_quoted }, span })
            }
            Event::SequenceStart(anchor, ..) => self.open(anchor, span, false),
            Event::MappingStart(anchor, ..) => self.open(anchor, span, true),
            Event::SequenceEnd | Event::MappingEnd => self.close(&span),
            Event::Alias(anchor) => match self.anchors.get(&anchor).map(Rc::clone) {
                Some(node) => self.insert(node),
                None => Err((span, Message::Undefined { name: "*".to_owned() })),
            },
            Event::DocumentStart(..) if self.root.is_some() => Err((span, Message::SecondDocument)),
            _ => Ok(()),
        }
    }

    fn open(&mut self, anchor: usize, span: Range<usize>, is_table: bool) -> Result<(), Fault> {
        if self.open.len() >= MOST_DEEP {
            return Err((span, Message::TooDeep { most: MOST_DEEP.to_string() }));
        }
        self.open.push(Open { anchor, start: span.start, nodes: Vec::new(), is_table });
        Ok(())
    }

    fn close(&mut self, span: &Range<usize>) -> Result<(), Fault> {
        let Some(Open { anchor, start, nodes, is_table }) = self.open.pop() else { return Ok(()) };
        // The end of a block is found only where the next one begins.
        let end = nodes.last().map_or(span.end, |last| last.span.end).max(start);
        let value = if is_table {
            let mut nodes = nodes.into_iter();
            let mut entries = Vec::new();
            while let (Some(key), Some(value)) = (nodes.next(), nodes.next()) {
                entries.push((key, value));
            }
            Value::Table(entries)
        } else {
            Value::List(nodes)
        };
        self.node(anchor, Node { value, span: start..end })
    }

    fn node(&mut self, anchor: usize, node: Node) -> Result<(), Fault> {
        let node = Rc::new(node);
        if anchor > 0 {
            self.anchors.insert(anchor, Rc::clone(&node));
        }
        self.insert(node)
    }

    fn insert(&mut self, node: Rc<Node>) -> Result<(), Fault> {
        self.count += 1;
        if self.count > MOST_NODES {
            return Err((node.span.clone(), Message::TooMuch { most: MOST_NODES.to_string() }));
        }
        match self.open.last_mut() {
            Some(open) => open.nodes.push(node),
            None => self.root = Some(node),
        }
        Ok(())
    }
}

/// Byte offsets of characters.
struct BytePlaces {
    /// Offset of the text that is parsed.
    start: usize,
    /// The offset of each character, where not all of them are bytes.
    offsets: Option<Vec<u32>>,
    length: usize,
}

impl BytePlaces {
    fn new(text: &str, start: usize) -> Self {
        // The text is no longer than the longest file.
        let offsets = || text.char_indices().map(|(at, _)| at as u32).collect();
        Self { start, offsets: (!text.is_ascii()).then(offsets), length: text.len() }
    }

    fn byte(&self, character: usize) -> usize {
        let at = match &self.offsets {
            Some(offsets) => offsets.get(character).map_or(self.length, |&at| at as usize),
            None => character.min(self.length),
        };
        self.start + at
    }
}
