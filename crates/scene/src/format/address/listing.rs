//! All addresses of a scene.

use super::path::{PathSegment, ScenePath};
use super::resolve::{component_letters, record};
use super::value::SceneValue;
use crate::Scene;
use crate::format::record::{Datum, Record};
use crate::format::spec::{KeySpec, Kind};
use crate::part::ScenePart;

/// An address of a scene, what can stand there, and what does.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneKey {
    /// The address.
    pub path: ScenePath,
    /// The key of the format: kind of value, limits, meaning.
    pub spec: &'static KeySpec,
    /// The present value; `None` for what is absent without a default.
    pub value: Option<SceneValue>,
}

impl SceneKey {
    /// The address of one of three numbers, from 0 on; `None` for a value that has no three.
    pub fn component(&self, index: usize) -> Option<ScenePath> {
        self.value.as_ref().and_then(SceneValue::three)?;
        let letter = *component_letters(self.spec)?.get(index)?;
        let segments = [self.path.segments.as_slice(), &[PathSegment::key(letter)]].concat();
        Some(ScenePath { segments })
    }

    /// The addresses of its single numbers: the number itself, and the numbers of a vector or color. None for what is no
    /// number or has no value.
    pub fn numbers(&self) -> Vec<ScenePath> {
        let single = matches!(self.value, Some(SceneValue::Number(_))).then(|| self.path.clone());
        single.into_iter().chain((0..3).filter_map(|index| self.component(index))).collect()
    }
}

/// The addresses of a scene in the order of the format.
pub(super) fn keys(scene: &Scene) -> impl Iterator<Item = SceneKey> + '_ {
    parts(scene).flat_map(|part| keys_of(scene, part, []))
}

/// The parts of a scene in the order of their addresses.
pub(super) fn parts(scene: &Scene) -> impl Iterator<Item = ScenePart> + use<> {
    let single = [ScenePart::Camera, ScenePart::Environment, ScenePart::Tracing].into_iter();
    let materials = (0..scene.materials.len()).map(ScenePart::Material);
    let lights = (0..scene.lights.len()).map(ScenePart::Light);
    let bodies = (0..scene.bodies.len()).map(ScenePart::Body);
    single.chain(materials).chain(lights).chain(bodies)
}

/// The addresses of a part, or of what `places` lead to among its parts, in the order of the format; none where there is
/// no such part.
pub(super) fn keys_of(
    scene: &Scene,
    part: ScenePart,
    places: impl IntoIterator<Item = usize>,
) -> Vec<SceneKey> {
    let mut found = Vec::new();
    let Some(record) = record(scene, part) else { return found };
    let (mut meant, mut path) = (&record, segments(scene, part));
    for place in places {
        let Some(Datum::Tables(parts)) = meant.get("parts") else { return found };
        let Some(inner) = parts.get(place) else { return found };
        path.extend([PathSegment::key("parts"), element_segment(inner, place)]);
        meant = inner;
    }
    add(meant, false, &path, &mut found);
    found
}

/// What an element of a list within a part is called in addresses: its name, else its place.
fn element_segment(element: &Record<'_>, index: usize) -> PathSegment {
    match element.get("name") {
        Some(Datum::Text(name)) if !name.is_empty() => PathSegment::name(name),
        _ => PathSegment::key(&index.to_string()),
    }
}

/// The beginning of the addresses of a part.
pub(super) fn segments(scene: &Scene, part: ScenePart) -> Vec<PathSegment> {
    let element = |list: &str, index: usize| {
        let name = part.name(scene);
        let element =
            if name.is_empty() { PathSegment::key(&index.to_string()) } else { PathSegment::name(name) };
        vec![PathSegment::key(list), element]
    };
    match part {
        ScenePart::Camera => vec![PathSegment::key("camera")],
        ScenePart::Environment => vec![PathSegment::key("environment")],
        ScenePart::Tracing => vec![PathSegment::key("tracing")],
        ScenePart::Material(index) => element("materials", index),
        ScenePart::Light(index) => element("lights", index),
        ScenePart::Body(index) => element("bodies", index),
    }
}

/// Adds the keys of a table that have a meaning; whether it is only one that there could be.
fn add(record: &Record<'_>, is_absent: bool, path: &[PathSegment], found: &mut Vec<SceneKey>) {
    for spec in record.table.0.keys {
        if !spec.applies(|choice| record.chosen(choice)) || record.key_against(spec).is_some() {
            continue;
        }
        let segments = [path, &[PathSegment::key(spec.name)]].concat();
        let datum = record.get(spec.name);
        if let Some(Datum::Tables(elements)) = datum {
            for (index, element) in elements.iter().enumerate() {
                let own = element_segment(element, index);
                add(element, false, &[segments.as_slice(), &[own]].concat(), found);
            }
        }
        let inner = match (datum, spec.kind) {
            (Some(Datum::Table(inner)), _) => Some(inner),
            // Within what is absent, nothing else is asked for.
            (None, Kind::Table(table)) if !is_absent => Some(&Record::new(table)),
            _ => None,
        };
        if !matches!(spec.kind, Kind::Table(_) | Kind::List(_)) {
            let value = datum.and_then(SceneValue::of_datum);
            found.push(SceneKey { path: ScenePath { segments: segments.clone() }, spec, value });
        }
        if let Some(inner) = inner {
            add(inner, datum.is_none(), &segments, found);
        }
    }
}
