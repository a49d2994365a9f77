//! The lists of lights and bodies, which are built element by element.

use super::{AssignmentTarget, Reader, not_a_list};
use crate::format::build::SceneBuilder;
use crate::format::diagnostic::Diagnostic;
use crate::format::keys;
use crate::format::message::{Message, Subject};
use crate::format::quote::quoted;
use crate::format::spec::{Kind, TableSpec};
use crate::format::toml::{Assignment, Key, Span, Value, ValueKind};
use crate::format::tree::{Schema, Table, TableOrigin};

/// The list of bodies or of lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ListKind {
    Lights,
    Bodies,
}

/// The list whose element is being read.
#[derive(Default)]
pub(super) struct ListReader<'t> {
    /// Place of the value that gives the whole list.
    value: Option<Span>,
    /// Place of the first header.
    header: Option<Span>,
    /// The element that headers and assignments add to.
    pub(super) open: Option<Table<'t>>,
}

impl ListKind {
    /// The list of this key of the root.
    pub(super) fn from_key(key: &str) -> Option<Self> {
        match key {
            "lights" => Some(Self::Lights),
            "bodies" => Some(Self::Bodies),
            _ => None,
        }
    }

    const fn key(self) -> &'static str {
        match self {
            Self::Lights => "lights",
            Self::Bodies => "bodies",
        }
    }

    const fn spec(self) -> &'static TableSpec {
        match self {
            Self::Lights => &keys::LIGHT,
            Self::Bodies => &keys::BODY,
        }
    }
}

impl<'t> Reader<'t> {
    fn list(&mut self, kind: ListKind) -> &mut ListReader<'t> {
        match kind {
            ListKind::Lights => &mut self.lights,
            ListKind::Bodies => &mut self.bodies,
        }
    }

    /// `[[bodies]]`, or `[bodies.material]` for the open body.
    pub(super) fn list_header(
        &mut self,
        kind: ListKind,
        mut path: Vec<Key<'t>>,
        is_list: bool,
    ) -> AssignmentTarget<'t> {
        let name = kind.key();
        let first = path.remove(0);
        if path.is_empty() {
            if !is_list {
                let help = Message::Write { text: format!("[[{name}]]") };
                let finding = Diagnostic::error(first.span.range(), Message::IsAList { name });
                self.found.push(finding.with_help(help));
            }
            if let Some(value) = self.list(kind).value.take() {
                self.found.push(twice(&first, value));
            }
            self.close(kind);
            let list = self.list(kind);
            list.header.get_or_insert(first.span);
            list.open = Some(Table::new(Schema::Keys(kind.spec()), TableOrigin::ByHeader));
            return AssignmentTarget::Element(kind, path);
        }
        let Some(table) = self.list(kind).open.as_ref() else {
            if is_list {
                self.found
                    .push(not_a_list(&[std::slice::from_ref(&first), path.as_slice()].concat(), first.span));
            }
            let finding = Diagnostic::error(first.span.range(), Message::NoElementYet { name });
            self.found.push(finding.with_help(Message::BeginElement { name: name.to_owned() }));
            return AssignmentTarget::Nowhere;
        };
        match (is_list, table.list_at(&path), path.last()) {
            (true, None, _) => {
                self.found
                    .push(not_a_list(&[std::slice::from_ref(&first), path.as_slice()].concat(), first.span));
            }
            (false, Some(list), Some(last)) => {
                let whole: Vec<&str> = path.iter().map(|key| key.text.as_ref()).collect();
                let help = Message::Write { text: format!("[[{name}.{}]]", whole.join(".")) };
                let finding = Diagnostic::error(last.span.range(), Message::IsAList { name: list });
                self.found.push(finding.with_help(help));
            }
            _ => {}
        }
        let Some(table) = self.list(kind).open.as_mut() else { return AssignmentTarget::Nowhere };
        match table.open(&path) {
            Ok(()) => AssignmentTarget::Element(kind, path),
            Err(problem) => {
                self.found.push(*problem);
                AssignmentTarget::Nowhere
            }
        }
    }

    /// `bodies = [{ … }, { … }]`
    pub(super) fn list_value(&mut self, kind: ListKind, assignment: Assignment<'t>) {
        let name = kind.key();
        let Assignment { path, value } = assignment;
        let Some(first) = path.first() else { return };
        let help = Message::WriteBeforeElement { name: name.to_owned() };
        if path.len() > 1 {
            let finding = Diagnostic::error(first.span.range(), Message::IsAList { name });
            return self.found.push(finding.with_help(help));
        }
        let list = self.list(kind);
        if let Some(earlier) = list.value.or(list.header) {
            return self.found.push(twice(first, earlier));
        }
        list.value = Some(first.span);
        let values = match value.kind {
            ValueKind::Array(values) => values,
            ValueKind::Invalid => return,
            other => {
                let message = Message::WrongValue {
                    subject: Subject::key(name),
                    found: other.found(),
                    expected: Kind::List(kind.spec()),
                };
                return self.found.push(Diagnostic::error(value.span.range(), message).with_help(help));
            }
        };
        for value in values {
            self.element(kind, value);
        }
    }

    fn element(&mut self, kind: ListKind, value: Value<'t>) {
        match value.kind {
            ValueKind::Inline(assignments) => {
                let schema = Schema::Keys(kind.spec());
                let table = Table::from_inline(schema, assignments, &mut self.found);
                self.list(kind).open = Some(table);
                self.close(kind);
            }
            other => {
                let message = Message::WrongElement { list: kind.key(), found: other.found() };
                let finding = Diagnostic::error(value.span.range(), message);
                let name = kind.key().to_owned();
                self.found.push(finding.with_help(Message::WriteBeforeElement { name }));
            }
        }
    }

    /// Builds the open element of a list.
    pub(super) fn close(&mut self, kind: ListKind) {
        let Some(table) = self.list(kind).open.take() else { return };
        let mut build = SceneBuilder { text: self.text, found: &mut self.found };
        match kind {
            ListKind::Lights => {
                let (light, name) = build.light(&table);
                self.places.lights.push(name.unwrap_or_default());
                self.scene.lights.push(light);
            }
            ListKind::Bodies => {
                let built = build.body(&table);
                let index = self.scene.bodies.len() as u32;
                if !built.is_known {
                    self.places.unknown.push(index);
                }
                if let Some(span) = built.material_span {
                    self.places.materials.push((index, span));
                }
                let of_parts = built.parts.materials.into_iter();
                self.places.of_parts.extend(of_parts.map(|(name, span)| (index, name, span)));
                let instances = built.parts.instances.into_iter();
                self.places.instances.extend(instances.map(|(name, span)| (index, name, span)));
                self.places.empty.extend(built.parts.empty);
                self.places.bodies.push(built.name_span.unwrap_or_default());
                self.scene.bodies.push(built.body);
            }
        }
    }
}

fn twice(key: &Key<'_>, first: Span) -> Diagnostic {
    Diagnostic::error(key.span.range(), Message::GivenTwice { key: quoted(&key.text) })
        .with_label(Message::SecondTime)
        .with_help(Message::ListInOneWay)
        .with_related(first.range(), Message::FirstTime)
}
