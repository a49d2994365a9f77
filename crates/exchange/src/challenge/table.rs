//! Tables of keys: each is asked for once, and what is left is not known.

use std::ops::Range;
use std::rc::Rc;

use catoptric_scene::Color;
use glam::DVec3;

use crate::challenge::yaml::{Node, Value};
use crate::draft::Draft;
use crate::message::Message;
use crate::phrase::Kind;

/// A table that is being read.
pub(super) struct Table {
    /// What the table describes, for messages.
    pub(super) owner: String,
    pub(super) span: Range<usize>,
    entries: Vec<Entry>,
}

struct Entry {
    key: String,
    span: Range<usize>,
    value: Rc<Node>,
}

impl Table {
    /// Opens a table. A value that is none is an error.
    pub(super) fn open(node: &Node, owner: &str, draft: &mut Draft) -> Option<Self> {
        let Value::Table(pairs) = &node.value else {
            draft.refuse(&node.span, wrong(owner, node.kind(), Kind::Table), None);
            return None;
        };
        let mut table = Self { owner: owner.to_owned(), span: node.span.clone(), entries: Vec::new() };
        for (key, value) in pairs {
            let name = key.text().unwrap_or_default().replace('_', "-");
            if table.entries.iter().any(|entry| entry.key == name) {
                draft.refuse(&key.span, Message::KeyTwice { key: name }, None);
            } else {
                table.entries.push(Entry { key: name, span: key.span.clone(), value: Rc::clone(value) });
            }
        }
        Some(table)
    }

    /// The value of the first of these keys that is there.
    pub(super) fn take(&mut self, keys: &[&str]) -> Option<Rc<Node>> {
        let index = self.entries.iter().position(|entry| keys.contains(&entry.key.as_str()))?;
        Some(self.entries.remove(index).value)
    }

    /// The value of the first of these keys, which must be there.
    pub(super) fn require(&mut self, keys: &[&str], draft: &mut Draft) -> Option<Rc<Node>> {
        let found = self.take(keys);
        if found.is_none() {
            let key = keys.first().copied().unwrap_or_default().to_owned();
            draft.refuse(&self.place(), Message::KeyMissing { owner: self.owner.clone(), key }, None);
        }
        found
    }

    /// The number of a key, from `low` to `high`.
    pub(super) fn number(&mut self, keys: &[&str], range: [f64; 2], draft: &mut Draft) -> Option<f64> {
        let node = self.take(keys)?;
        number(&node, keys.first().copied().unwrap_or_default(), range, draft)
    }

    /// Reports what was not asked for.
    pub(super) fn end(self, draft: &mut Draft) {
        for entry in self.entries {
            let message = Message::UnknownKey { owner: self.owner.clone(), key: entry.key };
            draft.unsupported(&entry.span, message, Message::LeftOut);
        }
    }

    /// Where the table begins.
    fn place(&self) -> Range<usize> {
        self.entries.first().map_or(self.span.clone(), |entry| entry.span.clone())
    }
}

fn wrong(key: &str, found: Kind, expected: Kind) -> Message {
    Message::WrongKind { key: key.to_owned(), found, expected }
}

/// A number from `low` to `high`.
pub(super) fn number(node: &Node, key: &str, [low, high]: [f64; 2], draft: &mut Draft) -> Option<f64> {
    let Some(value) = node.number() else {
        draft.refuse(&node.span, wrong(key, node.kind(), Kind::Number), None);
        return None;
    };
    if (low..=high).contains(&value) {
        return Some(value);
    }
    let [value, low, high] = [value, low, high].map(Into::into);
    draft.refuse(&node.span, Message::KeyOutOfRange { key: key.to_owned(), value, low, high }, None);
    None
}

/// Three numbers.
pub(super) fn vector(node: &Node, key: &str, draft: &mut Draft) -> Option<DVec3> {
    let numbers: Option<Vec<f64>> =
        node.list().and_then(|list| list.iter().take(4).map(|element| element.number()).collect());
    if let Some(&[x, y, z]) = numbers.as_deref() {
        return Some(DVec3::new(x, y, z));
    }
    draft.refuse(&node.span, wrong(key, node.kind(), Kind::ThreeNumbers), None);
    None
}

/// Three numbers from 0 to 10⁶, or one for all.
pub(super) fn color(node: &Node, key: &str, draft: &mut Draft) -> Option<Color> {
    let value = match node.number() {
        Some(value) => DVec3::splat(value),
        None => vector(node, key, draft)?,
    };
    for component in value.to_array() {
        if !(0.0..=1e6).contains(&component) {
            let [found, low, high] = [component, 0.0, 1e6].map(Into::into);
            draft.refuse(
                &node.span,
                Message::KeyOutOfRange { key: key.to_owned(), value: found, low, high },
                None,
            );
            return None;
        }
    }
    Some(value.to_array().into())
}

/// `true` or `false`.
pub(super) fn flag(node: &Node, key: &str, draft: &mut Draft) -> Option<bool> {
    match node.text() {
        Some("true" | "True" | "yes") => Some(true),
        Some("false" | "False" | "no") => Some(false),
        _ => {
            draft.refuse(&node.span, wrong(key, node.kind(), Kind::Flag), None);
            None
        }
    }
}

/// A name.
pub(super) fn name<'n>(node: &'n Node, key: &str, draft: &mut Draft) -> Option<&'n str> {
    let text = node.text().filter(|text| !text.is_empty());
    if text.is_none() {
        draft.refuse(&node.span, wrong(key, node.kind(), Kind::Name), None);
    }
    text
}

/// A list.
pub(super) fn list<'n>(node: &'n Node, key: &str, draft: &mut Draft) -> Option<&'n [Rc<Node>]> {
    let list = node.list();
    if list.is_none() {
        draft.refuse(&node.span, wrong(key, node.kind(), Kind::List), None);
    }
    list
}
