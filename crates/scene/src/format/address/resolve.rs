//! The part of a scene and the keys that an address leads to.

use std::slice;

use super::error::refused;
use super::path::{PathSegment, ScenePath};
use super::value::SceneValue;
use crate::Scene;
use crate::compound::BodyPart;
use crate::format::diagnostic::Diagnostic;
use crate::format::keys;
use crate::format::message::{Conjunction, Enumeration, KeyMeaning, Message};
use crate::format::nearest::nearest;
use crate::format::quote::{key_to_copy, quoted, quoted_value};
use crate::format::read::undefined_material;
use crate::format::record::{self, Datum, Record};
use crate::format::spec::{KeySpec, Kind, TableSpec, When};
use crate::format::toml::{Key, Span};
use crate::format::tree::unknown_key;
use crate::format::typed::{inapplicable, key_help};
use crate::material::MaterialChoice;
use crate::part::ScenePart;

/// What is wrong with an address.
type Refusal = Box<Diagnostic>;

/// A place in a scene.
#[derive(Debug)]
pub(super) struct Address {
    pub(super) part: ScenePart,
    /// The tables that lead from the part to the table of the key.
    pub(super) tables: Vec<TableStep>,
    /// The table of the key.
    pub(super) table: &'static TableSpec,
    /// The key itself.
    pub(super) key: &'static KeySpec,
    /// The number of a vector or color that is meant.
    pub(super) component: Option<usize>,
}

/// A table within a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct TableStep {
    /// Its key, or that of the list that it is an element of.
    pub(super) key: &'static KeySpec,
    /// Its place in the list.
    pub(super) element: Option<usize>,
}

impl Address {
    pub(super) fn resolve(scene: &Scene, path: &ScenePath) -> Result<Self, Refusal> {
        let mut rest = path.segments.iter();
        let Some(first) = rest.next() else { return Err(refused(Message::PathIs).into()) };
        let root = find(&keys::ROOT, first)?;
        let (part, mut table) = part(scene, root, &mut rest)?;
        let mut tables: Vec<TableStep> = Vec::new();
        while let Some(segment) = rest.next() {
            let key = find(table, segment)?;
            match key.kind {
                Kind::Table(inner) | Kind::NameOrTable(inner) if !rest.as_slice().is_empty() => {
                    if let Kind::NameOrTable(_) = key.kind {
                        check_is_own(scene, part, &tables)?;
                    }
                    table = inner;
                    tables.push(TableStep { key, element: None });
                }
                Kind::List(inner) => {
                    let segment = rest.next().ok_or_else(|| is_list(key, inner))?;
                    let parts = parts(scene, part, &tables);
                    let names = || parts.iter().map(|part| part.name.as_str());
                    let element = place_in_list(key, segment, parts.len(), names)?;
                    table = inner;
                    tables.push(TableStep { key, element: Some(element) });
                }
                _ => {
                    let component = rest.next().map(|segment| component(key, segment)).transpose()?;
                    return match rest.next() {
                        Some(more) => Err(no_part(key, more)),
                        None => Ok(Self { part, tables, table, key, component }),
                    };
                }
            }
        }
        let name = path.segments.last().map_or(root.name, |segment| &segment.text);
        Err(is_table(quoted(name), table))
    }

    /// The value there.
    pub(super) fn value(&self, scene: &Scene) -> Result<SceneValue, Refusal> {
        let key = self.key;
        if let Kind::Table(table) = key.kind {
            return Err(is_table(quoted(key.name), table));
        }
        let record = record(scene, self.part);
        let Some(record) = record.as_ref().and_then(|record| inner_record(record, &self.tables)) else {
            // Only a table that is absent has no record.
            return Err(absent(self.tables.last().map_or(key, |step| step.key)));
        };
        let value = match record.get(key.name) {
            Some(Datum::Table(_)) => return Err(refused(Message::MaterialIsOwn).into()),
            Some(datum) => SceneValue::of_datum(datum),
            None => None,
        };
        let value = value.ok_or_else(|| why_absent(record, key))?;
        match self.component {
            None => Ok(value),
            Some(index) => {
                let number = value.three().and_then(|three| three.get(index).copied());
                number.map(SceneValue::Number).ok_or_else(|| absent(key))
            }
        }
    }
}

/// The record of a table within that of a part of the scene.
fn inner_record<'a, 'r>(record: &'a Record<'r>, tables: &[TableStep]) -> Option<&'a Record<'r>> {
    tables.iter().try_fold(record, |record, step| match (record.get(step.key.name), step.element) {
        (Some(Datum::Table(inner)), None) => Some(inner),
        (Some(Datum::Tables(elements)), Some(element)) => elements.get(element),
        _ => None,
    })
}

/// The parts of a body, or of a part of it.
fn parts<'a>(scene: &'a Scene, part: ScenePart, tables: &[TableStep]) -> &'a [BodyPart] {
    let ScenePart::Body(index) = part else { return &[] };
    let Some(body) = scene.bodies.get(index) else { return &[] };
    let elements = tables.iter().filter_map(|step| step.element);
    elements.fold(body.parts.as_slice(), |parts, element| parts.get(element).map_or(&[], |part| &part.parts))
}

/// The keys and values of a part, if there is one.
pub(super) fn record<'a>(scene: &'a Scene, part: ScenePart) -> Option<Record<'a>> {
    Some(match part {
        ScenePart::Camera => record::camera(&scene.camera),
        ScenePart::Environment => record::environment(&scene.environment),
        ScenePart::Tracing => record::tracing(&scene.tracing),
        ScenePart::Material(index) => crate::format::material::record(&scene.materials.get(index)?.material),
        ScenePart::Light(index) => record::light(scene.lights.get(index)?),
        ScenePart::Body(index) => record::body(scene.bodies.get(index)?),
    })
}

/// The key of a table that a segment names.
fn find(table: &'static TableSpec, segment: &PathSegment) -> Result<&'static KeySpec, Refusal> {
    table.key(&segment.text).ok_or_else(|| {
        let key = Key { text: segment.text.as_str().into(), span: Span::default() };
        unknown_key(&key, table).into()
    })
}

/// The part that a key of the root and perhaps the next segment name, and its table.
fn part(
    scene: &Scene,
    root: &'static KeySpec,
    rest: &mut slice::Iter<'_, PathSegment>,
) -> Result<(ScenePart, &'static TableSpec), Refusal> {
    let mut element = |table: &'static TableSpec| rest.next().ok_or_else(|| is_list(root, table));
    Ok(match root.kind {
        Kind::Named(table) => {
            let name = &element(table)?.text;
            let place = scene.materials.iter().position(|named| named.name == *name);
            let names = || scene.materials.iter().map(|named| named.name.as_str());
            let missing = || undefined_material(name, Span::default(), names);
            (ScenePart::Material(place.ok_or_else(missing)?), table)
        }
        Kind::List(table) if *table == keys::LIGHT => {
            let names = || scene.lights.iter().map(|light| light.name.as_str());
            (ScenePart::Light(place_in_list(root, element(table)?, scene.lights.len(), names)?), table)
        }
        Kind::List(table) => {
            let names = || scene.bodies.iter().map(|body| body.name.as_str());
            (ScenePart::Body(place_in_list(root, element(table)?, scene.bodies.len(), names)?), table)
        }
        Kind::Table(table) if *table == keys::CAMERA => (ScenePart::Camera, table),
        Kind::Table(table) if *table == keys::ENVIRONMENT => (ScenePart::Environment, table),
        Kind::Table(table) => (ScenePart::Tracing, table),
        _ => return Err(refused(Message::NotOfScene { key: root.name }).into()),
    })
}

/// The place of a light or body by its number or name.
fn place_in_list<'a, I: Iterator<Item = &'a str>>(
    list: &'static KeySpec,
    segment: &PathSegment,
    count: usize,
    names: impl Fn() -> I,
) -> Result<usize, Refusal> {
    let place = match segment.number() {
        Some(number) => Some(number).filter(|number| *number < count),
        None => names().position(|name| !name.is_empty() && name == segment.text),
    };
    place.ok_or_else(|| {
        let finding = refused(Message::NoElement { list: list.name, name: quoted(&segment.text) });
        let finding = finding.with_help(match count.checked_sub(1) {
            Some(last) => Message::ElementIs { list: list.name, last: last.to_string() },
            None => Message::ListIsEmpty { list: list.name },
        });
        let near = if segment.number().is_some() { None } else { nearest(&segment.text, names()) };
        match near {
            Some(near) => finding.with_label(Message::DidYouMean { word: quoted(near) }).into(),
            None => finding.into(),
        }
    })
}

/// Refuses keys of the material of a body or a part that shares a named one.
fn check_is_own(scene: &Scene, part: ScenePart, tables: &[TableStep]) -> Result<(), Refusal> {
    let ScenePart::Body(index) = part else { return Ok(()) };
    let material = match tables.split_last() {
        None => scene.bodies.get(index).map(|body| &body.material),
        Some((last, around)) => last
            .element
            .and_then(|element| parts(scene, part, around).get(element))
            .and_then(|part| part.material.as_ref()),
    };
    match material {
        Some(MaterialChoice::Named(name)) => {
            let finding = refused(Message::MaterialIsShared { name: quoted_value(name) });
            Err(match key_to_copy(name) {
                Some(key) => finding.with_help(Message::SharedUnder { key }).into(),
                None => finding.into(),
            })
        }
        _ => Ok(()),
    }
}

/// The names of the three numbers of a vector or color; `None` for a key without them.
pub(super) fn component_letters(key: &KeySpec) -> Option<[&'static str; 3]> {
    match key.kind {
        Kind::Vector(_) | Kind::NumberOrVector(_) => Some(["x", "y", "z"]),
        Kind::Color(_) => Some(["r", "g", "b"]),
        _ => None,
    }
}

/// The place of a number of a vector or color.
fn component(key: &'static KeySpec, segment: &PathSegment) -> Result<usize, Refusal> {
    let letters = component_letters(key).ok_or_else(|| no_part(key, segment))?;
    let named = letters.iter().position(|letter| *letter == segment.text);
    named.or(segment.number().filter(|number| *number < 3)).ok_or_else(|| no_part(key, segment))
}

fn no_part(key: &'static KeySpec, segment: &PathSegment) -> Refusal {
    let finding = refused(Message::NoSuchPart { key: key.name, part: quoted(&segment.text) });
    let Some(letters) = component_letters(key) else { return finding.with_help(key_help(key)).into() };
    let parts = Enumeration::new(letters.map(|letter| format!("`{letter}`")).to_vec(), Conjunction::And);
    finding.with_help(Message::PartsAre { key: key.name, parts }).into()
}

fn is_table(name: String, table: &'static TableSpec) -> Refusal {
    let keys = Enumeration::of_keys(table.keys.iter());
    refused(Message::IsATable { name }).with_help(Message::KeysAre { table, keys }).into()
}

fn is_list(list: &'static KeySpec, table: &'static TableSpec) -> Refusal {
    is_table(quoted(list.name), table)
}

/// The reason why a key has no value in a table.
fn why_absent(record: &Record<'_>, key: &'static KeySpec) -> Refusal {
    if let When::Choice { choice, .. } = key.when
        && let Some(chosen) = record.chosen(choice)
        && let Some(finding) = inapplicable(record.table.0, key, chosen, false, Span::default())
    {
        return finding.into();
    }
    match record.key_against(key) {
        Some(other) => refused(Message::CannotStandBeside { key: key.name, other: other.name })
            .with_label(Message::SetAlready { key: other.name })
            .into(),
        None => absent(key),
    }
}

fn absent(key: &'static KeySpec) -> Refusal {
    let meaning = KeyMeaning { key, has_range: true };
    refused(Message::AbsentKey { key: key.name }).with_help(Message::KeyMeans { meaning }).into()
}
