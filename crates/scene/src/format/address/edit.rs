//! Changes of values by their addresses: the element as a file would have it, with the new values, read again.

use std::collections::HashMap;
use std::str::FromStr;

use super::error::{AddressError, refused};
use super::path::ScenePath;
use super::resolve::{Address, TableStep, record};
use super::value::SceneValue;
use crate::Scene;
use crate::body::Body;
use crate::camera::Camera;
use crate::environment::Environment;
use crate::format::build::SceneBuilder;
use crate::format::diagnostic::{Diagnostic, Diagnostics, Severity};
use crate::format::message::{Collection, Message};
use crate::format::quote::quoted;
use crate::format::read::{instance_fault, undefined_material};
use crate::format::record::{Datum, Record};
use crate::format::spec::{Default, KeySpec, Kind, TableSpec, When};
use crate::format::toml::{LogicalLine, LogicalLines, Span, Statement, parse};
use crate::format::tree::{Schema, Table, TableOrigin};
use crate::image::Image;
use crate::light::Light;
use crate::material::Material;
use crate::part::ScenePart;
use crate::scene_images::HasImages;
use crate::{MaterialChoice, Tracing};

/// A value to set at an address.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneEdit {
    /// Where.
    pub path: ScenePath,
    /// What; `None` takes the key away.
    pub value: Option<SceneValue>,
}

/// Reads `PATH=VALUE`; without a value it takes the key away.
///
/// ```
/// let edit: catoptric_scene::SceneEdit = "bodies.ball.shape = cube".parse()?;
/// assert_eq!((edit.path.to_string().as_str(), edit.value), ("bodies.ball.shape", Some("cube".into())));
/// # Ok::<(), catoptric_scene::AddressError>(())
/// ```
impl FromStr for SceneEdit {
    type Err = AddressError;

    fn from_str(text: &str) -> Result<Self, AddressError> {
        let (path, rest) = ScenePath::split(text)?;
        let Some(value) = rest.strip_prefix('=').map(str::trim) else {
            return Err(AddressError::new(&path, refused(Message::EqualsAndValueMissing)));
        };
        let value = if value.is_empty() { None } else { Some(value.parse()?) };
        Ok(Self { path, value })
    }
}

/// Makes the changes, or none of them.
pub(super) fn apply(scene: &mut Scene, edits: &[SceneEdit]) -> Result<(), AddressError> {
    let resolve = |scene: &Scene, edit: &SceneEdit| {
        Address::resolve(scene, &edit.path).map_err(|found| AddressError::new(&edit.path, found))
    };
    // Only where a change can fail behind others must those be taken back.
    let mut before: Option<Scene> = None;
    let mut rest = edits;
    while let Some(first) = rest.first() {
        let group = resolve(scene, first).and_then(|address| {
            let mut addresses = vec![address];
            for edit in rest.iter().skip(1) {
                match resolve(scene, edit) {
                    Ok(address) if addresses.iter().all(|first| first.part == address.part) => {
                        addresses.push(address);
                    }
                    _ => break,
                }
            }
            let (group, after) = rest.split_at_checked(addresses.len()).unwrap_or((rest, &[]));
            if !after.is_empty() && before.is_none() {
                before = Some(scene.clone());
            }
            change_part(scene, &addresses, group).map(|()| after)
        });
        match group {
            Ok(after) => rest = after,
            Err(error) => {
                if let Some(before) = before {
                    *scene = before;
                }
                return Err(error);
            }
        }
    }
    Ok(())
}

/// Makes changes of one part, which the first address names too.
fn change_part(scene: &mut Scene, addresses: &[Address], edits: &[SceneEdit]) -> Result<(), AddressError> {
    let Some(part) = addresses.first().map(|address| address.part) else { return Ok(()) };
    let Some(record) = record(scene, part) else { return Ok(()) };
    let mut lines = Vec::new();
    add_lines(&record, &mut Vec::new(), &mut lines);
    for (number, (address, edit)) in addresses.iter().zip(edits).enumerate() {
        put(&mut lines, address, edit.value.as_ref(), number)
            .map_err(|found| AddressError::new(&edit.path, found))?;
    }
    let table = record.table.0;
    let element = Element::read(part, table, &lines).and_then(|element| element.put_into(scene, part));
    element.map_err(|(found, number)| {
        let edit = number.and_then(|number| edits.get(number)).or(edits.last());
        AddressError::new(&edit.map(|edit| edit.path.to_string()).unwrap_or_default(), found)
    })
}

/// A key of a part of the scene and its value, as a line of a file: `material.checker.size = 1.0`.
struct ElementLine {
    path: Vec<LineStep>,
    /// `None` for the header that begins an element of a list.
    value: Option<SceneValue>,
    /// Which of the changes it is from, if it is from one.
    edit: Option<usize>,
}

/// A key on the way to a value, and the place in the list that it is the key of.
type LineStep = (&'static str, Option<usize>);

impl ElementLine {
    /// Whether it is about the key `name` of the table at `tables`, or a key within that.
    fn is_of(&self, tables: &[TableStep], name: &str) -> bool {
        let around = self.path.iter().zip(tables).all(|(own, step)| *own == (step.key.name, step.element));
        around && self.path.get(tables.len()).is_some_and(|(own, _)| *own == name)
    }

    /// The places of the elements that it stands in, from the outermost.
    fn elements(&self) -> impl Iterator<Item = usize> {
        self.path.iter().filter_map(|(_, element)| *element)
    }

    /// Its text. Keys of an element of a list stand under its header.
    fn push_to(&self, text: &mut String) {
        let of_lists =
            self.path.iter().rposition(|(_, element)| element.is_some()).map_or(0, |last| last + 1);
        let from = if self.value.is_some() { of_lists } else { 0 };
        let keys: Vec<&str> = self.path.iter().skip(from).map(|(key, _)| *key).collect();
        let keys = keys.join(".");
        text.push_str(&match &self.value {
            Some(value) => format!("{keys} = {value}\n"),
            None => format!("[[{keys}]]\n"),
        });
    }
}

/// Adds the lines of a table that is written at `path`.
fn add_lines(record: &Record<'_>, path: &mut Vec<LineStep>, lines: &mut Vec<ElementLine>) {
    for (name, datum) in record.written() {
        if let Datum::Tables(elements) = datum {
            for (index, element) in elements.iter().enumerate() {
                path.push((name, Some(index)));
                lines.push(ElementLine { path: path.clone(), value: None, edit: None });
                add_lines(element, path, lines);
                path.pop();
            }
            continue;
        }
        path.push((name, None));
        match (datum, SceneValue::of_datum(datum)) {
            (Datum::Table(inner), _) => add_lines(inner, path, lines),
            (_, Some(value)) => {
                lines.push(ElementLine { path: path.clone(), value: Some(value), edit: None });
            }
            (_, None) => {}
        }
        path.pop();
    }
}

/// Puts a value in the place of the old one, and takes away the keys that cannot stand beside it.
fn put(
    lines: &mut Vec<ElementLine>,
    address: &Address,
    value: Option<&SceneValue>,
    edit: usize,
) -> Result<(), Box<Diagnostic>> {
    let Address { key, tables, .. } = address;
    let remove = |lines: &mut Vec<ElementLine>, name: &str| lines.retain(|line| !line.is_of(tables, name));
    let value = match (value, address.component) {
        (None, _) => match take_away(lines, address) {
            Some(default) => default,
            None => return Ok(()),
        },
        (Some(value), None) => value.clone(),
        (Some(value), Some(index)) => {
            let old = lines.iter().find(|line| line.is_of(tables, key.name));
            let old = old.map(|line| line.value.as_ref().and_then(SceneValue::three));
            let old = old.unwrap_or_else(|| key.default_vector());
            SceneValue::Vector(with_component(old, index, value).ok_or_else(|| wrong_number(key))?)
        }
    };
    remove(lines, key.name);
    key.excludes.iter().for_each(|other| remove(lines, other));
    // So do the tables on the way.
    for (depth, step) in tables.iter().enumerate() {
        let around = tables.get(..depth).unwrap_or_default();
        lines.retain(|line| step.key.excludes.iter().all(|other| !line.is_of(around, other)));
    }
    if let (Kind::Choice(words), SceneValue::Text(word)) = (key.kind, &value)
        && words.contains(&word.as_str())
    {
        without_meaning(address, word).for_each(|other| remove(lines, other));
    }
    let around = tables.iter().map(|step| (step.key.name, step.element));
    let path: Vec<LineStep> = around.chain([(key.name, None)]).collect();
    // The list may be gone with an earlier change.
    for (place, (_, element)) in path.iter().enumerate() {
        let header = path.get(..=place).unwrap_or_default();
        let stands = |line: &ElementLine| line.value.is_none() && line.path == header;
        if element.is_some() && !lines.iter().any(stands) {
            lines.push(ElementLine { path: header.to_vec(), value: None, edit: Some(edit) });
        }
    }
    lines.push(ElementLine { path, value: Some(value), edit: Some(edit) });
    // The keys of an element stand between its header and that of the next one, in the order of their numbers.
    lines.sort_by(|one, other| one.elements().cmp(other.elements()));
    Ok(())
}

/// Takes a key away, and those that have no meaning without it. A table stays when its last key goes: the value that has
/// to stand there then.
fn take_away(lines: &mut Vec<ElementLine>, address: &Address) -> Option<SceneValue> {
    let Address { key, tables, .. } = address;
    let has_table = |lines: &[ElementLine]| {
        let is_of = |(table, around): (&TableStep, &[TableStep])| {
            lines.iter().any(|line| line.is_of(around, table.key.name))
        };
        tables.split_last().is_some_and(is_of)
    };
    let had_table = has_table(lines);
    let mut remove = |name: &str| lines.retain(|line| !line.is_of(tables, name));
    remove(key.name);
    let needing = address.table.keys.iter().filter(|other| other.requires == Some(key.name));
    needing.for_each(|other| remove(other.name));
    if let Default::Text(word) = key.default {
        without_meaning(address, word).for_each(&mut remove);
    }
    default_of(key).filter(|_| had_table && !has_table(lines))
}

/// What an absent key stands for, where that is one value.
fn default_of(key: &KeySpec) -> Option<SceneValue> {
    Some(match key.default {
        Default::Number(number) => number.into(),
        Default::Vector(vector) => vector.into(),
        Default::Text(text) => text.into(),
        Default::Flag(flag) => flag.into(),
        Default::Absent | Default::ByChoice(_) | Default::EmptyTable => return None,
    })
}

/// The keys beside a choice that have no meaning for this word of it.
fn without_meaning(address: &Address, word: &str) -> impl Iterator<Item = &'static str> {
    let keys = address.table.keys.iter();
    keys.filter(move |other| match other.when {
        When::Choice { choice, values } => choice == address.key.name && !values.contains(&word),
        When::Always => false,
    })
    .map(|other| other.name)
}

/// Three numbers with another one in a place.
fn with_component(old: Option<[f64; 3]>, index: usize, value: &SceneValue) -> Option<[f64; 3]> {
    let (mut vector, SceneValue::Number(number)) = (old?, value) else { return None };
    *vector.get_mut(index)? = *number;
    Some(vector)
}

/// A part that was read.
enum Element {
    Camera(Camera),
    Environment(Environment),
    Tracing(Tracing),
    Material(Material),
    Light(Light),
    Body(Body),
}

/// What is wrong, and in which of the changes, if it is in one.
type Fault = (Box<Diagnostic>, Option<usize>);

impl Element {
    /// Reads lines by the rules of scene files.
    fn read(part: ScenePart, spec: &'static TableSpec, lines: &[ElementLine]) -> Result<Self, Fault> {
        let mut text = String::new();
        let mut ends = Vec::with_capacity(lines.len());
        for line in lines {
            line.push_to(&mut text);
            ends.push(text.len());
        }
        let mut found = Diagnostics::default();
        let table = table(&text, spec, &mut found);
        let mut build = SceneBuilder { text: &text, found: &mut found };
        let element = match part {
            ScenePart::Camera => Self::Camera(build.camera(&table)),
            ScenePart::Environment => Self::Environment(build.environment(&table)),
            ScenePart::Tracing => Self::Tracing(build.tracing(&table)),
            ScenePart::Material(_) => Self::Material(build.material(&table)),
            ScenePart::Light(_) => Self::Light(build.light(&table).0),
            ScenePart::Body(_) => Self::Body(build.body(&table).body),
        };
        match found.into_iter().find(|finding| finding.severity == Severity::Error) {
            None => Ok(element),
            Some(finding) => {
                let line = lines.get(ends.partition_point(|&end| end <= finding.span.start));
                Err((Box::new(finding.clone()), line.and_then(|line| line.edit)))
            }
        }
    }

    /// Puts the part in the place of the old one, unless its names are wrong.
    fn put_into(self, scene: &mut Scene, part: ScenePart) -> Result<(), Fault> {
        match (self, part) {
            (Self::Camera(camera), _) => scene.camera = camera,
            (Self::Environment(new), _) => replace(&mut scene.environment, new),
            (Self::Tracing(tracing), _) => scene.tracing = tracing,
            (Self::Material(new), ScenePart::Material(index)) => {
                if let Some(named) = scene.materials.get_mut(index) {
                    replace(&mut named.material, new);
                }
            }
            (Self::Light(new), ScenePart::Light(index)) => {
                let names = scene.lights.iter().map(|light| light.name.as_str());
                check_name(Collection::Lights, names, index, &new.name)?;
                if let Some(light) = scene.lights.get_mut(index) {
                    *light = new;
                }
            }
            (Self::Body(new), ScenePart::Body(index)) => {
                check_body(scene, index, &new)?;
                put_body(scene, index, new)?;
            }
            (Self::Material(_) | Self::Light(_) | Self::Body(_), _) => {}
        }
        Ok(())
    }
}

/// The lines of a text as a table.
fn table<'t>(text: &'t str, spec: &'static TableSpec, found: &mut Diagnostics) -> Table<'t> {
    let mut table = Table::new(Schema::Keys(spec), TableOrigin::ByHeader);
    let mut path = Vec::new();
    let mut lines = LogicalLines::new(text);
    while let Some(line) = lines.next() {
        let tokens = match line {
            LogicalLine::Tokens(tokens) => tokens,
            LogicalLine::TooLong(span) => {
                found.push(Diagnostic::error(span.range(), Message::ValueTooLong));
                continue;
            }
        };
        let parsed = parse(text, tokens);
        parsed.problems.into_iter().for_each(|problem| found.push(problem));
        match parsed.statement {
            Some(Statement::Assignment(assignment)) => {
                if let Some(table) = table.at(&path) {
                    table.assign(assignment, found);
                }
            }
            Some(Statement::Header(header)) => {
                path = header.path;
                if let Err(problem) = table.open(&path) {
                    found.push(*problem);
                }
            }
            None => {}
        }
    }
    table
}

/// Puts a new value in the place of an old one; a picture that stays keeps its pixels.
fn replace<T: HasImages>(old: &mut T, mut new: T) {
    let mut opened: Vec<Image> = Vec::new();
    old.edit_images(&mut |image| opened.push(image.clone()));
    new.edit_images(&mut |image| {
        if let Some(same) = opened.iter().find(|old| old.source() == image.source()) {
            image.clone_from(same);
        }
    });
    *old = new;
}

fn check_body(scene: &Scene, index: usize, new: &Body) -> Result<(), Fault> {
    let Some(old) = scene.bodies.get(index) else { return Ok(()) };
    if old.name != new.name {
        let names = scene.bodies.iter().map(|body| body.name.as_str());
        check_name(Collection::Bodies, names, index, &new.name)?;
    }
    let names = || scene.materials.iter().map(|named| named.name.as_str());
    let mut used = new.materials().filter_map(MaterialChoice::name);
    match used.find(|name| names().all(|other| other != *name)) {
        Some(name) => Err((undefined_material(name, Span::default(), names).into(), None)),
        None => Ok(()),
    }
}

/// Puts a body in the place of an old one, and has instances follow it.
fn put_body(scene: &mut Scene, index: usize, new: Body) -> Result<(), Fault> {
    let Some(old) = scene.bodies.get(index) else { return Ok(()) };
    if !new.has_instances() && !scene.has_instances() {
        if let Some(body) = scene.bodies.get_mut(index) {
            replace(body, new);
        }
        return Ok(());
    }
    let mut edited = scene.clone();
    if !old.name.is_empty() && old.name != new.name {
        edited.rename_instances(&HashMap::from([(old.name.clone(), new.name.clone())]));
    }
    if let Some(body) = edited.bodies.get_mut(index) {
        replace(body, new);
    }
    let faults = edited.resolve_instances();
    let known = if faults.is_empty() { Vec::new() } else { scene.instance_faults() };
    if let Some(fault) = faults.iter().find(|fault| !known.contains(fault)) {
        return Err((instance_fault(fault, Span::default(), scene).into(), None));
    }
    *scene = edited;
    Ok(())
}

/// Refuses a name that another element has.
fn check_name<'a>(
    things: Collection,
    names: impl Iterator<Item = &'a str>,
    index: usize,
    name: &str,
) -> Result<(), Fault> {
    let mut others = names.enumerate().filter(|(other, _)| *other != index);
    if name.is_empty() || !others.any(|(_, taken)| taken == name) {
        return Ok(());
    }
    let finding = refused(Message::NameTwice { things, name: quoted(name) });
    Err((finding.with_help(Message::Rename).into(), None))
}

/// A part of a vector that is no number.
fn wrong_number(key: &'static KeySpec) -> Box<Diagnostic> {
    refused(Message::PartIsNumber { key: key.name }).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::keys;

    #[test]
    fn lines_are_of_their_key_and_those_around_it() {
        let line = |keys: &[&'static str]| ElementLine {
            path: keys.iter().map(|key| (*key, None)).collect(),
            value: Some(1.0.into()),
            edit: None,
        };
        let material = TableStep { key: keys::BODY.key("material").unwrap(), element: None };
        let size = line(&["material", "checker", "size"]);
        assert!(size.is_of(&[], "material") && size.is_of(&[material], "checker"));
        assert!(!size.is_of(&[], "checker") && !size.is_of(&[material], "size"));
        assert!(!line(&["material"]).is_of(&[material], "color"));
        let second = TableStep { key: keys::BODY.key("parts").unwrap(), element: Some(1) };
        let path = vec![("parts", Some(1)), ("radius", None)];
        let radius = ElementLine { path, ..line(&[]) };
        assert!(radius.is_of(&[], "parts") && radius.is_of(&[second], "radius"));
        assert!(!radius.is_of(&[TableStep { element: Some(0), ..second }], "radius"));
    }
}
