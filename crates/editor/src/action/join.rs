//! Bodies joined as the parts of one, and taken apart again.

use std::collections::HashSet;

use catoptric_scene::{Body, BodyPart, Placement, Scene, ScenePart, ShapeKind};

use super::ActionError;
use super::nest::body_of_part;
use super::outcome::{ActionOutcome, Result, selected_bodies, subject, wanting};
use crate::edited_scene::EditedScene;
use crate::names::UsedNames;
use crate::selection::Selection;

/// The selected bodies that are not locked, in the order of choosing, two at least; one is enough for a surface.
pub(super) fn check_join(scene: &EditedScene, selection: &Selection, shape: ShapeKind) -> Result<Vec<usize>> {
    let mut indices = selected_bodies(scene, selection);
    if indices.is_empty() || !shape.is_compound() {
        return Err(ActionError::NothingSelected);
    }
    indices.retain(|index| !ScenePart::Body(*index).is_locked(scene.scene()));
    match indices.len() {
        0 => Err(ActionError::Locked),
        1 if shape != ShapeKind::Surface => Err(ActionError::OneBody),
        _ => Ok(indices),
    }
}

/// The names of the bodies that are not among these.
fn other_names(scene: &Scene, indices: &[usize]) -> UsedNames {
    let indices: HashSet<usize> = indices.iter().copied().collect();
    let others = scene.bodies.iter().enumerate().filter(|(index, _)| !indices.contains(index));
    UsedNames::of(others.map(|(_, body)| body.name.as_str()))
}

/// The scene in which nothing is an instance of these bodies, which others will stand for.
fn without_instances(edited: &EditedScene, indices: &[usize]) -> EditedScene {
    let bodies = indices.iter().filter_map(|index| edited.scene().bodies.get(*index));
    let names: HashSet<&str> = bodies.map(|body| body.name.as_str()).collect();
    let mut freed = edited.clone();
    freed.edit(|scene| scene.free_instances(|of| names.contains(of)));
    freed
}

/// The first of the bodies becomes the whole: it keeps its place in the list.
pub(super) fn join(edited: &EditedScene, selection: &Selection, shape: ShapeKind, name: &str) -> Result {
    let indices = check_join(edited, selection, shape)?;
    let edited = &without_instances(edited, &indices);
    let scene = edited.scene();
    let bodies: Vec<&Body> = indices.iter().filter_map(|index| scene.bodies.get(*index)).collect();
    let (Some(first), Some(&place)) = (bodies.first(), indices.first()) else {
        return Err(ActionError::NothingSelected);
    };
    let origin = first.middle();
    let mut taken: HashSet<&str> = HashSet::new();
    let parts = bodies.iter().map(|body| BodyPart {
        name: if taken.insert(&body.name) { body.name.clone() } else { String::new() },
        shape: body.shape,
        placement: body.placement.moved_by(-origin),
        material: (body.material != first.material).then(|| body.material.clone()),
        parts: body.parts.clone(),
        parametric: body.parametric.clone(),
        instance: body.instance.clone(),
    });
    let mut names = other_names(scene, &indices);
    let whole = Body {
        name: names.take(if name.is_empty() { shape.key() } else { name }),
        shape: shape.shape(),
        placement: Placement::at(origin),
        material: first.material.clone(),
        hidden: bodies.iter().all(|body| body.hidden),
        shadow: first.shadow,
        contact: first.contact,
        locked: false,
        parts: parts.collect(),
        ..Body::default()
    };
    let subject = whole.name.clone();
    let mut joined = edited.clone();
    joined.edit(|scene| {
        if let Some(body) = scene.bodies.get_mut(place) {
            *body = whole;
        }
    });
    let item = joined.item(ScenePart::Body(place));
    joined.remove(&indices.iter().skip(1).copied().map(ScenePart::Body).collect());
    Ok(ActionOutcome { scene: joined, selection: item.map_or_else(Selection::none, Selection::one), subject })
}

pub(super) fn check_take_apart(scene: &EditedScene, selection: &Selection) -> Result<Vec<usize>> {
    wanting(scene, selection, |body| body.shape.is_compound())
}

/// The parts stand as bodies in the place of the whole, the first of them being what the whole was.
pub(super) fn take_apart(edited: &EditedScene, selection: &Selection) -> Result {
    let indices = check_take_apart(edited, selection)?;
    let edited = &without_instances(edited, &indices);
    let scene = edited.scene();
    let wholes: Vec<ScenePart> = indices.iter().copied().map(ScenePart::Body).collect();
    let mut names = other_names(scene, &indices);
    let mut apart = edited.clone();
    // For each body of the old list, the places of those that follow it in the new one.
    let mut followers: Vec<Vec<usize>> = vec![Vec::new(); scene.bodies.len()];
    let mut parts: Vec<ScenePart> = Vec::new();
    for &index in &indices {
        let Some(whole) = scene.bodies.get(index) else { continue };
        let parts_of_whole = whole.form().parts;
        let mut bodies = Vec::with_capacity(parts_of_whole.len());
        let frame = whole.placement.world_from_body();
        for part in parts_of_whole {
            let name = names.take(if part.name.is_empty() { &whole.name } else { &part.name });
            let material = part.material.as_ref().unwrap_or(&whole.material);
            let body = body_of_part(part, material, frame, name)?;
            let Body { hidden, shadow, contact, .. } = *whole;
            bodies.push(Body { hidden, shadow, contact, ..body });
        }
        let mut bodies = bodies.into_iter();
        let Some(first) = bodies.next() else { continue };
        apart.edit(|scene| {
            if let Some(body) = scene.bodies.get_mut(index) {
                *body = first;
            }
        });
        let start = apart.scene().bodies.len();
        apart.append([], [], bodies);
        let added = start..apart.scene().bodies.len();
        parts.extend([index].into_iter().chain(added.clone()).map(ScenePart::Body));
        if let Some(followers) = followers.get_mut(index) {
            followers.extend(added);
        }
    }
    let selection = parts.into_iter().filter_map(|part| apart.item(part)).collect();
    let order: Vec<usize> = followers
        .into_iter()
        .enumerate()
        .flat_map(|(index, followers)| [index].into_iter().chain(followers))
        .collect();
    apart.reorder(ScenePart::Body, &order);
    Ok(ActionOutcome { scene: apart, selection, subject: subject(scene, &wholes) })
}
