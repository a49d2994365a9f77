//! Actions on the lists: duplicates, deletions, order.

use std::collections::HashSet;

use catoptric_scene::{MaterialChoice, Scene, ScenePart};

use super::ActionError;
use super::fragment;
use super::outcome::{ActionOutcome, Result, subject};
use crate::edited_scene::{EditedScene, PartAt};
use crate::names::UsedNames;
use crate::selection::Selection;

/// The selected bodies, lights and materials, in the scene's order.
pub(super) fn check_duplicate(scene: &EditedScene, selection: &Selection) -> Result<Vec<ScenePart>> {
    let is_thing =
        |part: &ScenePart| matches!(part, ScenePart::Body(_) | ScenePart::Light(_) | ScenePart::Material(_));
    let mut parts: Vec<ScenePart> = scene.parts_of(selection).filter(is_thing).collect();
    parts.sort_unstable();
    if parts.is_empty() { Err(ActionError::NothingSelected) } else { Ok(parts) }
}

pub(super) fn duplicate(edited: &EditedScene, selection: &Selection) -> Result {
    let parts = check_duplicate(edited, selection)?;
    let scene = edited.scene();
    let mut copies = Scene::default();
    let mut names = UsedNames::of_materials(scene);
    for &part in &parts {
        match part {
            ScenePart::Body(index) => copies.bodies.extend(scene.bodies.get(index).cloned()),
            ScenePart::Light(index) => copies.lights.extend(scene.lights.get(index).cloned()),
            ScenePart::Material(index) => {
                let mut copy = scene.materials.get(index).cloned();
                if let Some(copy) = &mut copy {
                    copy.name = names.take(&copy.name);
                }
                copies.materials.extend(copy);
            }
            ScenePart::Camera | ScenePart::Environment | ScenePart::Tracing => {}
        }
    }
    let mut outcome = fragment::add(edited, copies);
    outcome.subject = subject(scene, &parts);
    Ok(outcome)
}

pub(super) fn check_delete(scene: &EditedScene, selection: &Selection) -> Result<Vec<ScenePart>> {
    let mut parts = check_duplicate(scene, selection)?;
    parts.retain(|part| !part.is_locked(scene.scene()));
    if parts.is_empty() { Err(ActionError::Locked) } else { Ok(parts) }
}

pub(super) fn delete(scene: &EditedScene, selection: &Selection) -> Result {
    Ok(delete_parts(scene, selection, &check_delete(scene, selection)?))
}

pub(super) fn delete_parts(
    edited: &EditedScene,
    selection: &Selection,
    parts: &[ScenePart],
) -> ActionOutcome {
    let scene = edited.scene();
    let mut left = edited.clone();
    let materials = parts.iter().filter(|part| matches!(part, ScenePart::Material(_)));
    let lost: HashSet<&str> = materials.map(|part| part.name(scene)).collect();
    left.edit(|left| {
        for (index, body) in scene.bodies.iter().enumerate() {
            let is_lost = |choice: &MaterialChoice| choice.name().is_some_and(|name| lost.contains(name));
            if body.materials().any(is_lost)
                && let Some(left) = left.bodies.get_mut(index)
            {
                left.each_material_mut(&mut |choice| {
                    if is_lost(choice) {
                        *choice = own(scene, choice);
                    }
                });
            }
        }
    });
    left.remove(&parts.iter().copied().collect());
    ActionOutcome { scene: left, selection: selection.clone(), subject: subject(scene, parts) }
}

/// A material as a body's own.
pub(super) fn own(scene: &Scene, choice: &MaterialChoice) -> MaterialChoice {
    MaterialChoice::Inline(Box::new(scene.material(choice).cloned().unwrap_or_default()))
}

/// A move of items within their list.
#[derive(Clone, Copy)]
pub(super) enum ListMove {
    Up,
    Down,
    To(usize),
}

/// The kind of the primary item, and the order of its list after a move: for each new place the old one.
pub(super) fn check_reorder(
    scene: &EditedScene,
    selection: &Selection,
    to: ListMove,
) -> Result<(PartAt, Vec<usize>)> {
    let primary = selection.primary().and_then(|primary| scene.part(primary));
    let (kind, count): (PartAt, usize) = match primary {
        Some(ScenePart::Material(_)) => (ScenePart::Material, scene.scene().materials.len()),
        Some(ScenePart::Light(_)) => (ScenePart::Light, scene.scene().lights.len()),
        Some(ScenePart::Body(_)) => (ScenePart::Body, scene.scene().bodies.len()),
        _ => return Err(ActionError::NothingSelected),
    };
    let selected: HashSet<ScenePart> = scene.parts_of(selection).collect();
    let is_moved = |index: usize| selected.contains(&kind(index));
    let order = match to {
        ListMove::Up => shifted((0..count).collect(), is_moved),
        ListMove::Down => {
            let mut order = shifted((0..count).rev().collect(), is_moved);
            order.reverse();
            order
        }
        ListMove::To(place) => {
            let place = place.min(count);
            let before = (0..place).filter(|index| !is_moved(*index));
            let moved = (0..count).filter(|index| is_moved(*index));
            let after = (place..count).filter(|index| !is_moved(*index));
            before.chain(moved).chain(after).collect()
        }
    };
    if order.iter().enumerate().all(|(new, old)| new == *old) {
        return Err(ActionError::NothingToDo);
    }
    Ok((kind, order))
}

/// An order in which each moved element has changed places with the one before it, unless that moves too.
fn shifted(mut order: Vec<usize>, is_moved: impl Fn(usize) -> bool) -> Vec<usize> {
    for place in 1..order.len() {
        let pair = (order.get(place - 1).copied(), order.get(place).copied());
        if let (Some(before), Some(this)) = pair
            && is_moved(this)
            && !is_moved(before)
        {
            order.swap(place - 1, place);
        }
    }
    order
}

pub(super) fn reorder(scene: &EditedScene, selection: &Selection, to: ListMove) -> Result {
    let (kind, order) = check_reorder(scene, selection, to)?;
    let is_moved = |part: &ScenePart| std::mem::discriminant(part) == std::mem::discriminant(&kind(0));
    let moved: Vec<ScenePart> = scene.parts_of(selection).filter(is_moved).collect();
    let subject = subject(scene.scene(), &moved);
    let mut scene = scene.clone();
    scene.reorder(kind, &order);
    Ok(ActionOutcome { scene, selection: selection.clone(), subject })
}
