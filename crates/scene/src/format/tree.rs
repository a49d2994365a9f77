//! Tables as the file defines them, checked against the table of the format while they grow: unknown keys and keys
//! given twice are reported at once and never stored.

use std::borrow::Cow;
use std::collections::HashMap;

use crate::format::diagnostic::{Diagnostic, Diagnostics};
use crate::format::keys::{NESTED_PATTERN, PATTERN, ROOT, TABLES};
use crate::format::message::{Enumeration, Message};
use crate::format::nearest::nearest;
use crate::format::quote::quoted;
use crate::format::spec::{KeySpec, Kind, TableSpec};
use crate::format::toml::{Assignment, Key, Span, Value, ValueKind};
use crate::format::typed::key_help;
use crate::material::SolidTexture;
use crate::shape::Shape;

/// The keys that a table can have.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Schema {
    /// The keys of a table of the format.
    Keys(&'static TableSpec),
    /// Names of the user's choice, each a table of this kind.
    Names(&'static TableSpec),
}

/// The definition that made a table, which decides who may add to it (TOML 1.1, "Table").
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TableOrigin {
    /// By the header of a table within it.
    Implicitly,
    /// By its own header.
    ByHeader,
    /// By a dotted key.
    ByDottedKey,
    /// Inline.
    Inline,
}

/// A key with its value.
#[derive(Clone, Debug)]
pub(crate) struct KeyValue<'t> {
    pub(crate) key: Key<'t>,
    pub(crate) value: Value<'t>,
}

/// A table that is being read.
#[derive(Clone, Debug)]
pub(crate) struct Table<'t> {
    pub(crate) schema: Schema,
    pub(crate) defined: TableOrigin,
    pub(crate) entries: Vec<KeyValue<'t>>,
    /// Places of the entries by name, for tables with names of the user's choice.
    by_name: HashMap<Cow<'t, str>, usize>,
    /// How many lists within tables are around it; of a pattern, how many patterns there are with it.
    depth: usize,
}

impl<'t> Table<'t> {
    pub(crate) fn new(schema: Schema, defined: TableOrigin) -> Self {
        Self { schema, defined, entries: Vec::new(), by_name: HashMap::new(), depth: 0 }
    }

    /// The entry called `name`.
    pub(crate) fn entry(&self, name: &str) -> Option<&KeyValue<'t>> {
        self.entries.get(self.place(name)?)
    }

    /// The value called `name`.
    pub(crate) fn get(&self, name: &str) -> Option<&Value<'t>> {
        self.entry(name).map(|entry| &entry.value)
    }

    fn place(&self, name: &str) -> Option<usize> {
        match self.schema {
            Schema::Keys(_) => self.entries.iter().position(|entry| entry.key.text == name),
            Schema::Names(_) => self.by_name.get(name).copied(),
        }
    }

    /// Gives `key` its value; everything wrong with it goes to `found`.
    pub(crate) fn assign(&mut self, assignment: Assignment<'t>, found: &mut Diagnostics) {
        let Assignment { path, value } = assignment;
        let mut path = path.into_iter();
        let Some(mut key) = path.next() else { return };
        let mut table = self;
        for next in path {
            match table.step(&key, TableOrigin::ByDottedKey) {
                Ok(child) => table = child,
                Err(problem) => return found.push(*problem),
            }
            key = next;
        }
        table.put(key, value, found);
    }

    /// Opens the table of a header, a new one where the path leads to a list; afterwards [`Self::at`] finds it.
    pub(crate) fn open(&mut self, path: &[Key<'t>]) -> Result<(), Box<Diagnostic>> {
        let mut table = self;
        for (index, key) in path.iter().enumerate() {
            let is_last = index + 1 == path.len();
            table = table.step(key, if is_last { TableOrigin::ByHeader } else { TableOrigin::Implicitly })?;
        }
        Ok(())
    }

    /// The name of the list that a header of this path begins an element of, if it does.
    pub(crate) fn list_at(&self, path: &[Key<'_>]) -> Option<&'static str> {
        let mut schema = self.schema;
        for (index, key) in path.iter().enumerate() {
            schema = match schema {
                Schema::Names(spec) => Schema::Keys(spec),
                Schema::Keys(spec) => match spec.key(&key.text).map(|key| (key.name, key.kind))? {
                    (_, Kind::Table(spec) | Kind::NameOrTable(spec)) => Schema::Keys(spec),
                    (_, Kind::Named(spec)) => Schema::Names(spec),
                    (name, Kind::List(_)) if index + 1 == path.len() => return Some(name),
                    (_, Kind::List(spec)) => Schema::Keys(spec),
                    _ => return None,
                },
            };
        }
        None
    }

    /// The table below this one at `path`, in the last elements of its lists.
    pub(crate) fn at(&mut self, path: &[Key<'t>]) -> Option<&mut Self> {
        let mut table = self;
        for key in path {
            let place = table.place(&key.text)?;
            table = match &mut table.entries.get_mut(place)?.value.kind {
                ValueKind::Table(child) => child,
                ValueKind::Tables(children) => children.last_mut()?,
                _ => return None,
            };
        }
        Some(table)
    }

    /// The table `key` of this one, made if need be; `by` is how it is reached.
    fn step(&mut self, key: &Key<'t>, by: TableOrigin) -> Result<&mut Self, Box<Diagnostic>> {
        if let Some((name, spec)) = self.list_of(&key.text) {
            return self.step_into_list(key, name, spec, by);
        }
        let Some(schema) = self.child_schema(key)? else {
            let message = Message::NotATable { name: quoted(&key.text) };
            let diagnostic = Diagnostic::error(key.span.range(), message);
            return Err(match self.spec_of(&key.text).map(key_help) {
                Some(help) => diagnostic.with_help(help).into(),
                None => diagnostic.into(),
            });
        };
        let Some(place) = self.place(&key.text) else {
            let kind = ValueKind::Table(self.child(key, schema, by)?);
            self.insert(key.clone(), Value { span: key.span, kind });
            return self.last_table(key);
        };
        let Some(entry) = self.entries.get_mut(place) else { return Err(twice(key, key.span).into()) };
        let ValueKind::Table(child) = &mut entry.value.kind else {
            return Err(twice(key, entry.key.span).into());
        };
        let may_enter = match by {
            TableOrigin::Implicitly => child.defined != TableOrigin::Inline,
            TableOrigin::ByHeader => child.defined == TableOrigin::Implicitly,
            TableOrigin::ByDottedKey => child.defined == TableOrigin::ByDottedKey,
            TableOrigin::Inline => false,
        };
        if !may_enter {
            return Err(twice(key, entry.key.span).into());
        }
        if by == TableOrigin::ByHeader {
            child.defined = by;
        }
        Ok(child)
    }

    /// The last element of the list `key` of this table, a new one for a header of its own.
    fn step_into_list(
        &mut self,
        key: &Key<'t>,
        name: &'static str,
        spec: &'static TableSpec,
        by: TableOrigin,
    ) -> Result<&mut Self, Box<Diagnostic>> {
        let depth = self.depth + 1;
        if by == TableOrigin::ByDottedKey || by == TableOrigin::Inline {
            let finding = Diagnostic::error(key.span.range(), Message::IsAList { name });
            return Err(finding.with_help(Message::WriteBeforeElement { name: header_name(depth) }).into());
        }
        let adds = by == TableOrigin::ByHeader;
        if adds && depth > Shape::MAX_DEPTH {
            return Err(too_deep(key.span).into());
        }
        if self.place(&key.text).is_none() {
            if !adds {
                let finding = Diagnostic::error(key.span.range(), Message::NoElementYet { name });
                return Err(finding.with_help(Message::BeginElement { name: header_name(depth) }).into());
            }
            self.insert(key.clone(), Value { span: key.span, kind: ValueKind::Tables(Vec::new()) });
        }
        let list = self.place(&key.text).and_then(|place| self.entries.get_mut(place));
        let Some(KeyValue { key: first, value: Value { span, kind: ValueKind::Tables(list) } }) = list else {
            return Err(twice(key, key.span).into());
        };
        // A list that is given as a value ends with it; its place is that of the value.
        if *span != first.span {
            return Err(twice(key, first.span).into());
        }
        if adds {
            list.push(Self { depth, ..Self::new(Schema::Keys(spec), TableOrigin::ByHeader) });
        }
        list.last_mut().ok_or_else(|| twice(key, key.span).into())
    }

    /// The name and the table of a key that holds a list.
    fn list_of(&self, name: &str) -> Option<(&'static str, &'static TableSpec)> {
        let key = self.spec_of(name)?;
        match key.kind {
            Kind::List(spec) => Some((key.name, spec)),
            _ => None,
        }
    }

    /// The elements of a list that is given as a value.
    fn elements(
        &self,
        name: &'static str,
        spec: &'static TableSpec,
        values: Vec<Value<'t>>,
        found: &mut Diagnostics,
    ) -> Vec<Self> {
        let depth = self.depth + 1;
        let mut elements = Vec::with_capacity(values.len());
        for value in values {
            match value.kind {
                ValueKind::Inline(assignments) => {
                    let mut table = Self { depth, ..Self::new(Schema::Keys(spec), TableOrigin::Inline) };
                    assignments.into_iter().for_each(|assignment| table.assign(assignment, found));
                    elements.push(table);
                }
                ValueKind::Invalid => {}
                other => {
                    let message = Message::WrongElement { list: name, found: other.found() };
                    let finding = Diagnostic::error(value.span.range(), message);
                    found.push(finding.with_help(Message::WriteBeforeElement { name: header_name(depth) }));
                }
            }
        }
        elements
    }

    /// The table that was just inserted.
    fn last_table(&mut self, key: &Key<'t>) -> Result<&mut Self, Box<Diagnostic>> {
        match self.entries.last_mut().map(|entry| &mut entry.value.kind) {
            Some(ValueKind::Table(child)) => Ok(child),
            _ => Err(twice(key, key.span).into()),
        }
    }

    fn put(&mut self, key: Key<'t>, value: Value<'t>, found: &mut Diagnostics) {
        let schema = match self.child_schema(&key) {
            Ok(schema) => schema,
            Err(problem) => return found.push(*problem),
        };
        let earlier = self.place(&key.text).and_then(|place| self.entries.get_mut(place));
        if let Some(earlier) = earlier {
            // What is reported already is not worth a second report.
            match (&earlier.value.kind, &value.kind) {
                (_, ValueKind::Invalid) => {}
                (ValueKind::Invalid, ValueKind::Inline(_)) => {}
                (ValueKind::Invalid, _) => earlier.value = value,
                _ => found.push(twice(&key, earlier.key.span)),
            }
            return;
        }
        let value = match (schema, value) {
            (Some(schema), Value { span, kind: ValueKind::Inline(assignments) }) => {
                let table = self.child(&key, schema, TableOrigin::Inline);
                let table = table.map(|mut table| {
                    assignments.into_iter().for_each(|assignment| table.assign(assignment, found));
                    table
                });
                let kind = match table {
                    Ok(table) => ValueKind::Table(table),
                    Err(problem) => {
                        found.push(*problem);
                        ValueKind::Invalid
                    }
                };
                Value { span, kind }
            }
            (_, Value { span, kind: ValueKind::Array(values) }) => {
                let kind = match self.list_of(&key.text) {
                    Some(_) if self.depth >= Shape::MAX_DEPTH => {
                        found.push(too_deep(key.span));
                        ValueKind::Invalid
                    }
                    Some((name, spec)) => ValueKind::Tables(self.elements(name, spec, values, found)),
                    None => ValueKind::Array(values),
                };
                Value { span, kind }
            }
            (_, value) => value,
        };
        self.insert(key, value);
    }

    /// An inline table checked against its keys.
    pub(crate) fn from_inline(
        schema: Schema,
        assignments: Vec<Assignment<'t>>,
        found: &mut Diagnostics,
    ) -> Self {
        let mut table = Self::new(schema, TableOrigin::Inline);
        for assignment in assignments {
            table.assign(assignment, found);
        }
        table
    }

    /// A table under `key`.
    fn child(&self, key: &Key<'t>, schema: Schema, by: TableOrigin) -> Result<Self, Box<Diagnostic>> {
        let is = |schema: Schema, table: &TableSpec| matches!(schema, Schema::Keys(spec) if *spec == *table);
        let depth = match is(schema, &PATTERN) {
            true if is(self.schema, &NESTED_PATTERN) => self.depth + 1,
            true => 1,
            false if is(schema, &NESTED_PATTERN) => self.depth,
            false => 0,
        };
        if depth > SolidTexture::MAX_DEPTH {
            let most = SolidTexture::MAX_DEPTH.to_string();
            let finding = Diagnostic::error(key.span.range(), Message::PatternsTooDeep);
            let finding = finding.with_label(Message::OneLevelTooDeep);
            return Err(finding.with_help(Message::DeepestPatterns { most }).into());
        }
        Ok(Self { depth, ..Self::new(schema, by) })
    }

    fn insert(&mut self, key: Key<'t>, value: Value<'t>) {
        if matches!(self.schema, Schema::Names(_)) {
            self.by_name.insert(key.text.clone(), self.entries.len());
        }
        self.entries.push(KeyValue { key, value });
    }

    fn spec_of(&self, name: &str) -> Option<&'static KeySpec> {
        match self.schema {
            Schema::Keys(spec) => spec.find(name).map(|(_, key)| key),
            Schema::Names(_) => None,
        }
    }

    /// What `key` holds when it holds a table; an error when there is no such key.
    fn child_schema(&self, key: &Key<'t>) -> Result<Option<Schema>, Box<Diagnostic>> {
        match self.schema {
            Schema::Names(_) if key.text.is_empty() => {
                Err(Diagnostic::error(key.span.range(), Message::EmptyName).into())
            }
            Schema::Names(spec) => Ok(Some(Schema::Keys(spec))),
            Schema::Keys(spec) => match spec.find(&key.text) {
                Some((_, key)) => Ok(match key.kind {
                    Kind::Table(spec) | Kind::NameOrTable(spec) => Some(Schema::Keys(spec)),
                    Kind::Named(spec) => Some(Schema::Names(spec)),
                    _ => None,
                }),
                None => Err(unknown_key(key, spec).into()),
            },
        }
    }
}

/// A key or table that stood already at `first`.
fn twice(key: &Key<'_>, first: Span) -> Diagnostic {
    Diagnostic::error(key.span.range(), Message::GivenTwice { key: quoted(&key.text) })
        .with_label(Message::SecondTime)
        .with_help(Message::LeaveOne)
        .with_related(first.range(), Message::FirstTime)
}

/// What stands in the headers of lists at a depth. Only bodies have lists within them.
fn header_name(depth: usize) -> String {
    format!("bodies{}", ".parts".repeat(depth))
}

/// Parts of parts that are nested deeper than [`Shape::MAX_DEPTH`].
fn too_deep(span: Span) -> Diagnostic {
    let most = Shape::MAX_DEPTH.to_string();
    Diagnostic::error(span.range(), Message::PartsTooDeep)
        .with_label(Message::OneLevelTooDeep)
        .with_help(Message::DeepestParts { most })
}

/// A key that the format does not know.
pub(crate) fn unknown_key(key: &Key<'_>, spec: &'static TableSpec) -> Diagnostic {
    let message = Message::NoSuchKey { table: spec, key: quoted(&key.text) };
    let help = Message::KeysAre { table: spec, keys: Enumeration::of_keys(spec.keys.iter()) };
    let diagnostic = Diagnostic::error(key.span.range(), message).with_help(help);
    if let Some(name) = nearest(&key.text, spec.keys.iter().map(|key| key.name)) {
        return diagnostic.with_label(Message::DidYouMean { word: format!("`{name}`") });
    }
    // Not in a text that is no scene.
    let tables = if TABLES.contains(&spec) { TABLES.as_slice() } else { &[] };
    let elsewhere = |other: &&&TableSpec| other.name != spec.name && other.find(&key.text).is_some();
    match tables.iter().find(elsewhere) {
        Some(other) if other.name == ROOT.name => diagnostic
            .with_label(Message::UnknownKey)
            .with_help(Message::BelongsToFile { key: quoted(&key.text) }),
        Some(other) => diagnostic.with_label(Message::KeyOf { table: other }),
        None => diagnostic.with_label(Message::UnknownKey),
    }
}
