//! Bodies that become parts, parts that become bodies, and parts that go to another whole: all stay where they are.

use std::collections::HashSet;

use catoptric_scene::{
    Body, BodyContact, BodyPart, Form, MaterialChoice, Placement, ScenePart, Shadow, Shape,
};
use glam::{DAffine3, DMat3};

use super::ActionError;
use super::outcome::{ActionOutcome, Result, selected_bodies, subject};
use super::part::{FocusedPart, aside, focused, free, take};
use crate::edited_scene::EditedScene;
use crate::identity::Item;
use crate::names::UsedNames;
use crate::part_path::PartPath;
use crate::selection::Selection;

/// A place among the parts of a joined body, or of a joined part of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct PartSlot {
    /// The body.
    pub whole: Item,
    /// The way to what has the parts.
    pub within: PartPath,
    /// Before the part that is at this place now, or at the end.
    pub place: usize,
}

/// The parts on their way into a whole.
struct IncomingPart {
    part: BodyPart,
    /// The material that is seen.
    material: MaterialChoice,
}

/// A form as it is in another frame, looking the same; `None` if only a sheared frame could do that.
pub(super) fn carried(form: &Form<'_>, other_from_own: DAffine3) -> Option<(Shape, Placement)> {
    if other_from_own.matrix3 == DMat3::IDENTITY {
        return Some((form.shape, form.placement.moved_by(other_from_own.translation)));
    }
    let shape = form.sized_shape();
    let frame = other_from_own * form.placement.world_from_body();
    // A round one needs no turn about itself where its frame can stay as it is: textures would turn with it.
    let is_plane = shape == Shape::Plane;
    let as_it_is = Some(Shape::CUBE).filter(|_| !is_plane).and_then(|any| any.placed(frame));
    let placement = as_it_is.or_else(|| shape.placed(frame))?;
    Some((shape, placement))
}

/// The slot that is meant: without one, the end of the primary body's parts.
fn slot_of(scene: &EditedScene, selection: &Selection, slot: Option<PartSlot>) -> Result<PartSlot> {
    let end = || {
        let whole = selection.primary()?;
        Some(PartSlot { whole, within: PartPath::WHOLE, place: usize::MAX })
    };
    let slot = slot.or_else(end).ok_or(ActionError::NothingSelected)?;
    if matches!(scene.part(slot.whole), Some(ScenePart::Body(_))) {
        Ok(slot)
    } else {
        Err(ActionError::NotJoined)
    }
}

/// The body with a slot, and its place.
fn target<'a>(scene: &'a EditedScene, slot: &PartSlot) -> Result<(usize, &'a Body)> {
    let Some(ScenePart::Body(index)) = scene.part(slot.whole) else { return Err(ActionError::NotJoined) };
    let body = scene.scene().bodies.get(index).ok_or(ActionError::NotJoined)?;
    if slot.within.parts(body).is_none() {
        return Err(ActionError::NotJoined);
    }
    if body.locked { Err(ActionError::Locked) } else { Ok((index, body)) }
}

/// The selected bodies that can become parts of the one at `target`, in the scene's order.
fn sources(scene: &EditedScene, selection: &Selection, target: usize) -> Result<Vec<usize>> {
    let mut indices = selected_bodies(scene, selection);
    let is_empty = indices.is_empty();
    indices.retain(|index| *index != target);
    let is_itself = indices.is_empty();
    indices.retain(|index| !ScenePart::Body(*index).is_locked(scene.scene()));
    indices.sort_unstable();
    match (is_empty, is_itself, indices.is_empty()) {
        (true, ..) => Err(ActionError::NothingSelected),
        (_, true, _) => Err(ActionError::WithinItself),
        (.., true) => Err(ActionError::Locked),
        _ => Ok(indices),
    }
}

/// Whether there is something to be moved and a place for it; limits are not tried.
pub(super) fn check(scene: &EditedScene, selection: &Selection, slot: Option<PartSlot>) -> Result<()> {
    let slot = slot_of(scene, selection, slot)?;
    let (index, _) = target(scene, &slot)?;
    match focused(scene, selection) {
        Some(_) => check_part(&free(scene, selection)?, &slot, index),
        None => sources(scene, selection, index).map(drop),
    }
}

fn check_part(focus: &FocusedPart<'_>, slot: &PartSlot, target: usize) -> Result<()> {
    let is_itself = focus.index == target && slot.within.is_within(focus.path);
    if is_itself { Err(ActionError::WithinItself) } else { Ok(()) }
}

/// The selected bodies, or the part that is meant, become parts of what has the slot.
pub(super) fn nest(scene: &EditedScene, selection: &Selection, slot: Option<PartSlot>) -> Result {
    let slot = slot_of(scene, selection, slot)?;
    let (index, _) = target(scene, &slot)?;
    match focused(scene, selection) {
        Some(_) => {
            let focus = free(scene, selection)?;
            check_part(&focus, &slot, index)?;
            if focus.index == index {
                move_within(scene, &focus, &slot)
            } else {
                move_part(scene, &focus, &slot)
            }
        }
        None => nest_bodies(scene, &sources(scene, selection, index)?, &slot),
    }
}

/// Bodies become parts.
pub(super) fn nest_bodies(scene: &EditedScene, sources: &[usize], slot: &PartSlot) -> Result {
    let (index, body) = target(scene, slot)?;
    let mut whole = body.clone();
    let parts: Vec<ScenePart> = sources.iter().copied().map(ScenePart::Body).collect();
    let mut last = None;
    let mut place = slot.place;
    for source in sources.iter().filter_map(|source| scene.scene().bodies.get(*source)) {
        let incoming = IncomingPart { part: part_of_body(source), material: source.material.clone() };
        let path = insert(&mut whole, (slot.within, place), incoming, DAffine3::IDENTITY)?;
        place = path.place().map_or(place, |place| place + 1);
        last = Some(path);
    }
    let subject = subject(scene.scene(), &parts);
    let mut nested = scene.clone();
    replace(&mut nested, index, whole);
    nested.remove(&parts.into_iter().collect());
    Ok(ActionOutcome { scene: nested, selection: of_part(slot.whole, last), subject })
}

/// A part goes to another place of its body.
fn move_within(scene: &EditedScene, focus: &FocusedPart<'_>, slot: &PartSlot) -> Result {
    let mut whole = focus.body.clone();
    let is_same = focus.path.parent() == Some(slot.within);
    let incoming = incoming(focus);
    let path = if is_same {
        // Nothing is carried to another frame: the numbers stay as they are.
        let parts = slot.within.parts_mut(&mut whole).ok_or(ActionError::NotJoined)?;
        let place = slot.place.min(parts.len());
        parts.insert(place, focus.part.clone());
        slot.within.child(place).ok_or(ActionError::TooDeep)?
    } else {
        insert(&mut whole, (slot.within, slot.place), incoming, focus.path.frame_around(focus.body))?
    };
    let gone = take(&mut whole, focus.path.after_insertion(path)).ok_or(ActionError::NoSuchItem)?;
    let path = path.after_removal(gone);
    let mut moved = scene.clone();
    replace(&mut moved, focus.index, whole);
    Ok(ActionOutcome { scene: moved, selection: of_part(slot.whole, path), subject: focus.part.name.clone() })
}

/// A part goes to another body.
fn move_part(scene: &EditedScene, focus: &FocusedPart<'_>, slot: &PartSlot) -> Result {
    let (index, body) = target(scene, slot)?;
    let mut whole = body.clone();
    let frame = focus.path.frame_around(focus.body);
    let path = insert(&mut whole, (slot.within, slot.place), incoming(focus), frame)?;
    let mut moved = scene.clone();
    replace(&mut moved, index, whole);
    leave(&mut moved, focus)?;
    let selection = of_part(slot.whole, Some(path));
    Ok(ActionOutcome { scene: moved, selection, subject: focus.part.name.clone() })
}

/// Whether the part that is meant can become a body.
pub(super) fn check_out(scene: &EditedScene, selection: &Selection) -> Result<()> {
    free(scene, selection).map(drop)
}

/// The part that is meant becomes a body, before the one that is at `place` now or after what it was a part of.
pub(super) fn take_out(scene: &EditedScene, selection: &Selection, place: Option<usize>) -> Result {
    let focus = free(scene, selection)?;
    let bodies = &scene.scene().bodies;
    let place = place.unwrap_or(focus.index + 1).min(bodies.len());
    let wanted = if focus.part.name.is_empty() { &focus.body.name } else { &focus.part.name };
    let name = UsedNames::of(bodies.iter().map(|body| body.name.as_str())).take(wanted);
    let body = body_as_seen(&focus, name)?;
    let mut apart = scene.clone();
    apart.append([], [], [body]);
    let count = apart.scene().bodies.len();
    let new = count - 1;
    let order: Vec<usize> = (0..place).chain([new]).chain(place..new).collect();
    apart.reorder(ScenePart::Body, &order);
    let item = apart.item(ScenePart::Body(place));
    let whole = scene.item(ScenePart::Body(focus.index)).and_then(|item| apart.part(item));
    let Some(ScenePart::Body(index)) = whole else { return Err(ActionError::NoSuchItem) };
    leave(&mut apart, &FocusedPart { index, ..focus })?;
    let selection = item.map_or_else(Selection::none, Selection::one);
    Ok(ActionOutcome { scene: apart, selection, subject: focus.part.name.clone() })
}

/// The part that is meant as a body that looks the same.
pub(super) fn body_as_seen(focus: &FocusedPart<'_>, name: String) -> Result<Body> {
    let frame = focus.path.frame_around(focus.body);
    let body = body_of_part(focus.part, focus.path.material(focus.body), frame, name)?;
    let Body { hidden, shadow, contact, .. } = *focus.body;
    Ok(Body { hidden, shadow, contact, ..body })
}

/// Takes the part out of its body, and the body away when nothing is left of it.
fn leave(scene: &mut EditedScene, focus: &FocusedPart<'_>) -> Result<()> {
    let mut left = focus.body.clone();
    let gone = take(&mut left, focus.path).ok_or(ActionError::NoSuchItem)?;
    if gone.is_whole() {
        scene.remove(&HashSet::from([ScenePart::Body(focus.index)]));
    } else {
        replace(scene, focus.index, left);
    }
    Ok(())
}

/// Pasted bodies become parts beside the one that is meant; one that would stand exactly where it does is moved aside.
pub(super) fn paste_beside(pasted: ActionOutcome, scene: &EditedScene, selection: &Selection) -> Result {
    let sources = selected_bodies(&pasted.scene, &pasted.selection);
    let (Some(focus), Some(whole)) = (focused(scene, selection), selection.primary()) else {
        return Ok(pasted);
    };
    let (Some(within), Some(place), false) = (focus.path.parent(), focus.path.place(), sources.is_empty())
    else {
        return Ok(pasted);
    };
    let slot = PartSlot { whole, within, place: place + 1 };
    let mut outcome = nest_bodies(&pasted.scene, &sources, &slot)?;
    outcome.scene.edit(|scene| {
        let Some(body) = scene.bodies.get_mut(focus.index) else { return };
        let Some(parts) = within.parts_mut(body) else { return };
        let origins: Vec<_> = parts.iter().map(|part| part.placement.origin()).collect();
        let new = place + 1..=place + sources.len();
        let is_new = |at: usize| new.contains(&at);
        for (at, part) in parts.iter_mut().enumerate().filter(|(at, _)| is_new(*at)) {
            let own = part.placement.origin();
            let mut others = origins.iter().enumerate().filter(|(other, _)| *other != at && !is_new(*other));
            if others.any(|(_, other)| other.distance(own) < 1e-9) {
                part.placement = part.placement.moved_by(aside(&focus));
            }
        }
    });
    Ok(outcome)
}

fn of_part(whole: Item, path: Option<PartPath>) -> Selection {
    Selection::of_part(whole, path.unwrap_or(PartPath::WHOLE))
}

fn replace(scene: &mut EditedScene, index: usize, new: Body) {
    scene.edit(|scene| {
        if let Some(body) = scene.bodies.get_mut(index) {
            *body = new;
        }
    });
}

fn incoming(focus: &FocusedPart<'_>) -> IncomingPart {
    IncomingPart { part: focus.part.clone(), material: focus.path.material(focus.body).clone() }
}

fn part_of_body(body: &Body) -> BodyPart {
    BodyPart {
        name: body.name.clone(),
        shape: body.shape,
        placement: body.placement,
        material: None,
        parts: body.parts.clone(),
        parametric: body.parametric.clone(),
        instance: body.instance.clone(),
    }
}

/// Puts a part, whose frame stands in the world as `world_from_around` says, among the parts of what `within` leads to.
fn insert(
    whole: &mut Body,
    (within, place): (PartPath, usize),
    IncomingPart { mut part, material }: IncomingPart,
    world_from_around: DAffine3,
) -> Result<PartPath> {
    let around_from_world = within.frame(whole).inverse();
    let sheared = ActionError::Sheared { name: part.name.clone() };
    (part.shape, part.placement) =
        carried(&part.form(), around_from_world * world_from_around).ok_or(sheared)?;
    part.material = Some(material).filter(|material| within.material(whole) != material);
    let parts = within.parts_mut(whole).ok_or(ActionError::NotJoined)?;
    part.name = UsedNames::of(parts.iter().map(|part| part.name.as_str())).take(&part.name);
    let place = place.min(parts.len());
    let path = within.child(place).ok_or(ActionError::TooDeep)?;
    if path.depth() + depth_of(&part) > Shape::MAX_DEPTH {
        return Err(ActionError::TooDeep);
    }
    parts.insert(place, part);
    let too_many = (0..path.depth()).any(|depth| has_too_many(whole, path.up_to(depth)));
    if too_many { Err(ActionError::TooManyParts) } else { Ok(path) }
}

/// How deep the parts within a part are nested.
fn depth_of(part: &BodyPart) -> usize {
    let parts = crate::part_path::joined_parts(&part.form()).unwrap_or_default();
    parts.iter().map(|part| 1 + depth_of(part)).max().unwrap_or_default()
}

fn has_too_many(whole: &Body, path: PartPath) -> bool {
    let Some(form) = path.form(whole).filter(|form| form.shape != Shape::Group) else { return false };
    let mut count = 0_usize;
    form.each_simple(DAffine3::IDENTITY, &mut |_| count += 1);
    count > Shape::MAX_PARTS
}

/// A part as a body that looks the same: of this material, its frame standing in the world as `world_from_around` says.
pub(super) fn body_of_part(
    part: &BodyPart,
    material: &MaterialChoice,
    world_from_around: DAffine3,
    name: String,
) -> Result<Body> {
    let sheared = || ActionError::Sheared { name: name.clone() };
    let (shape, placement) = carried(&part.form(), world_from_around).ok_or_else(sheared)?;
    Ok(Body {
        name,
        shape,
        placement,
        material: material.clone(),
        hidden: false,
        shadow: Shadow::default(),
        contact: BodyContact::default(),
        locked: false,
        parts: part.parts.clone(),
        parametric: part.parametric.clone(),
        instance: part.instance.clone(),
    })
}
