//! Names: every material that is used is defined, and no two bodies or lights share a name.

use std::collections::HashMap;
use std::ops::Range;

use crate::compound::each_part_mut;
use crate::format::diagnostic::{Diagnostic, Diagnostics, Severity};
use crate::format::message::{Collection, Conjunction, Enumeration, Message};
use crate::format::nearest::nearest;
use crate::format::quote::{key_to_copy, quoted, quoted_value};
use crate::format::rules::{self, BrokenRule};
use crate::format::toml::Span;
use crate::instances::{InstanceFault, InstanceProblem};
use crate::material::MaterialChoice;
use crate::{Color, Light, Scene, Surroundings};

/// The most defined materials that a message lists.
const MOST_LISTED: usize = 8;

/// The places of the scene's things in the file.
#[derive(Default)]
pub(super) struct SourcePositions {
    /// The name of each light.
    pub(super) lights: Vec<Span>,
    /// The name of each body.
    pub(super) bodies: Vec<Span>,
    /// Bodies with a named material, and where it is named.
    pub(super) materials: Vec<(u32, Span)>,
    /// Bodies with a part of a named material, its name, and where it is named.
    pub(super) of_parts: Vec<(u32, String, Span)>,
    /// Bodies that are instances or have a part that is one, of what, and where that is named.
    pub(super) instances: Vec<(u32, String, Span)>,
    /// Shapes that hold nothing, and where they are said.
    pub(super) empty: Vec<(&'static str, Span)>,
    /// Bodies of an unknown shape or of unknown parts, in order. They stand in the scene until their names are checked.
    pub(super) unknown: Vec<u32>,
}

/// Reports materials that are used but not defined, unless their definitions may have got lost. The answer tells of
/// each material whether it is used.
pub(super) fn check_materials(
    scene: &mut Scene,
    places: &SourcePositions,
    has_lost_tables: bool,
    found: &mut Diagnostics,
) -> Vec<bool> {
    let names = scene.materials.iter().map(|named| named.name.as_str());
    let defined: HashMap<&str, usize> = names.enumerate().map(|(index, name)| (name, index)).collect();
    let mut is_used = vec![false; scene.materials.len()];
    for &(index, span) in &places.materials {
        let Some(body) = scene.bodies.get_mut(index as usize) else { continue };
        let Some(name) = body.material.name() else { continue };
        if let Some(is_used) = defined.get(name).and_then(|&index| is_used.get_mut(index)) {
            *is_used = true;
            continue;
        }
        if !has_lost_tables {
            let names = || scene.materials.iter().map(|named| named.name.as_str());
            found.push_with(|| undefined_material(name, span, names));
        }
        body.material = MaterialChoice::default();
    }
    for (index, name, span) in &places.of_parts {
        if let Some(is_used) = defined.get(name.as_str()).and_then(|&index| is_used.get_mut(index)) {
            *is_used = true;
            continue;
        }
        if !has_lost_tables {
            let names = || scene.materials.iter().map(|named| named.name.as_str());
            found.push_with(|| undefined_material(name, *span, names));
        }
        let parts = scene.bodies.get_mut(*index as usize).map(|body| body.parts.as_mut_slice());
        each_part_mut(parts.unwrap_or_default(), &mut |part| {
            part.material.take_if(|material| material.name() == Some(name));
        });
    }
    is_used
}

/// Gives instances what they are instances of, and reports those that cannot be. Those of lost bodies are not reported.
pub(super) fn follow_instances(
    scene: &mut Scene,
    places: &SourcePositions,
    has_lost_tables: bool,
    found: &mut Diagnostics,
) {
    let mut faults = scene.resolve_instances();
    faults.retain(|fault| !(has_lost_tables && fault.problem == InstanceProblem::Unknown));
    for fault in &faults {
        let is_here =
            |(index, of, _): &&(u32, String, Span)| *index as usize == fault.body && *of == fault.of;
        let span = places.instances.iter().find(is_here).map(|(_, _, span)| *span).unwrap_or_default();
        found.push_with(|| instance_fault(fault, span, scene));
    }
}

/// An instance that cannot be.
pub(crate) fn instance_fault(fault: &InstanceFault, span: Span, scene: &Scene) -> Diagnostic {
    let BrokenRule { message, help, .. } = rules::instance(fault);
    let finding = Diagnostic::error(span.range(), message).with_help(help);
    let names = || scene.bodies.iter().map(|body| body.name.as_str()).filter(|name| !name.is_empty());
    match nearest(&fault.of, names()).filter(|_| fault.problem == InstanceProblem::Unknown) {
        Some(nearest) => finding.with_label(Message::DidYouMean { word: quoted_value(nearest) }),
        None => finding,
    }
}

/// A material that is not defined; `names` are those that are.
pub(crate) fn undefined_material<'a, I: Iterator<Item = &'a str>>(
    name: &str,
    span: Span,
    names: impl Fn() -> I,
) -> Diagnostic {
    let mut listing: Vec<String> = names().take(MOST_LISTED).map(quoted_value).collect();
    let help = match names().take(MOST_LISTED + 1).count() {
        0 => match key_to_copy(name).filter(|_| !name.is_empty()) {
            Some(key) => Message::Define { key },
            None => Message::OwnMaterial,
        },
        1 => Message::OnlyDefined { name: listing.concat() },
        count if count > MOST_LISTED => {
            listing.push("…".to_owned());
            Message::Defined { names: Enumeration::new(listing, Conjunction::Space) }
        }
        _ => Message::Defined { names: Enumeration::new(listing, Conjunction::And) },
    };
    let label = match nearest(name, names()) {
        Some(nearest) => Message::DidYouMean { word: quoted_value(nearest) },
        None => Message::NotDefined,
    };
    Diagnostic::error(span.range(), Message::Undefined { name: quoted(name) })
        .with_label(label)
        .with_help(help)
}

/// Reports second uses of names, and takes these names away.
pub(super) fn check_unique(scene: &mut Scene, places: &SourcePositions, found: &mut Diagnostics) {
    let lights = scene.lights.iter().map(|light| light.name.as_str());
    let again = second_uses(lights, &places.lights, Collection::Lights, found);
    for index in again {
        if let Some(light) = scene.lights.get_mut(index) {
            light.name.clear();
        }
    }
    let bodies = scene.bodies.iter().map(|body| body.name.as_str());
    let again = second_uses(bodies, &places.bodies, Collection::Bodies, found);
    for index in again {
        if let Some(body) = scene.bodies.get_mut(index) {
            body.name.clear();
        }
    }
}

/// Takes the bodies of an unknown shape or of unknown parts out of the scene. The places of the other bodies are off after that.
pub(super) fn remove_unknown(scene: &mut Scene, places: &SourcePositions) {
    let mut unknown = places.unknown.iter().copied().peekable();
    let mut index = 0;
    scene.bodies.retain(|_| {
        let is_unknown = unknown.next_if_eq(&index).is_some();
        index += 1;
        !is_unknown
    });
}

fn second_uses<'a>(
    names: impl Iterator<Item = &'a str>,
    places: &[Span],
    things: Collection,
    found: &mut Diagnostics,
) -> Vec<usize> {
    let mut first_at: HashMap<&str, usize> = HashMap::new();
    let mut again = Vec::new();
    for (index, name) in names.enumerate() {
        if name.is_empty() {
            continue;
        }
        let first = *first_at.entry(name).or_insert(index);
        if first == index {
            continue;
        }
        again.push(index);
        let place = |index: usize| places.get(index).copied().unwrap_or_default().range();
        found.push_with(|| {
            Diagnostic::error(place(index), Message::NameTwice { things, name: quoted(name) })
                .with_label(Message::SecondOne)
                .with_help(Message::Rename)
                .with_related(place(first), Message::FirstOne)
        });
    }
    again
}

/// Warnings about a scene without errors.
pub(super) fn warn(
    scene: &Scene,
    places: &SourcePositions,
    defined_at: &[Range<usize>],
    is_used: &[bool],
    found: &mut Diagnostics,
) {
    let is_lit = |light: &Light| !light.hidden;
    let environment = &scene.environment;
    let has_light = scene.lights.iter().any(is_lit)
        || environment.ambient != Color::BLACK
        || environment.surroundings != Surroundings::Even;
    if !has_light && !scene.bodies.is_empty() {
        let warning = Diagnostic::new(Severity::Warning, 0..0, Message::NoLight);
        found.push(warning.with_help(Message::AddLight));
    }
    for (shape, span) in &places.empty {
        let warning = Diagnostic::new(Severity::Warning, span.range(), Message::EmptyBody { shape });
        found.push(warning.with_help(Message::MoveParts));
    }
    for ((named, span), is_used) in scene.materials.iter().zip(defined_at).zip(is_used) {
        if !is_used {
            let message = Message::Unused { name: quoted(&named.name) };
            let warning = Diagnostic::new(Severity::Warning, span.clone(), message);
            found.push(warning.with_help(Message::UseOrRemove));
        }
    }
}
