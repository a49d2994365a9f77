//! Acts on the part of a joined body that is meant.

use catoptric_scene::{Body, BodyPart, MaterialChoice, NamedMaterial, Placement, ScenePart};
use glam::DVec3;

use super::ActionError;
use super::list::own;
use super::outcome::{ActionOutcome, Result};
use crate::bounds;
use crate::edited_scene::EditedScene;
use crate::identity::Item;
use crate::names::UsedNames;
use crate::part_path::PartPath;
use crate::selection::Selection;

/// How far a copy is moved aside that has no end, meters.
const ASIDE: f64 = 0.5;

/// A part that is meant, in the body at a place.
#[derive(Clone, Copy)]
pub(super) struct FocusedPart<'a> {
    pub(super) index: usize,
    pub(super) body: &'a Body,
    pub(super) path: PartPath,
    pub(super) part: &'a BodyPart,
}

/// What an action does to a part instead of to the body.
#[derive(Clone, Copy)]
pub(super) enum PartAct<'a> {
    Duplicate,
    Delete,
    Up,
    Down,
    Assign(Option<&'a MaterialChoice>),
    Share,
    MakeUnique,
    ResetPlacement,
    /// What only a whole body can have done to it.
    Nothing,
}

/// The part that is meant.
pub(super) fn focused<'a>(scene: &'a EditedScene, selection: &Selection) -> Option<FocusedPart<'a>> {
    let (index, path) = scene.part_in(selection)?;
    let body = scene.scene().bodies.get(index)?;
    Some(FocusedPart { index, body, path, part: path.part(body)? })
}

/// The part that is meant, if it can be changed.
pub(super) fn free<'a>(scene: &'a EditedScene, selection: &Selection) -> Result<FocusedPart<'a>> {
    let focus = focused(scene, selection).ok_or(ActionError::NothingSelected)?;
    if focus.body.locked { Err(ActionError::Locked) } else { Ok(focus) }
}

/// The part, changed in a copy of the scene. The edit gets the body and tells the way to the part that is then meant.
fn edited(
    scene: &EditedScene,
    focus: &FocusedPart<'_>,
    edit: impl FnOnce(&mut Body) -> Option<PartPath>,
) -> ActionOutcome {
    let subject = focus.part.name.clone();
    let item = scene.item(ScenePart::Body(focus.index));
    let mut scene = scene.clone();
    let mut path = None;
    scene.edit(|scene| path = scene.bodies.get_mut(focus.index).and_then(edit));
    let selection = item.map(|item| Selection::of_part(item, path.unwrap_or(PartPath::WHOLE)));
    ActionOutcome { scene, selection: selection.unwrap_or_default(), subject }
}

/// The place that a part gets by a step up or down among its like.
fn step(focus: &FocusedPart<'_>, is_down: bool) -> Result<[usize; 2]> {
    let from = focus.path.place().ok_or(ActionError::NothingToDo)?;
    let to = if is_down { Some(from + 1) } else { from.checked_sub(1) };
    let count = siblings(focus).len();
    to.filter(|to| *to < count).map(|to| [from, to]).ok_or(ActionError::NothingToDo)
}

fn siblings<'a>(focus: &FocusedPart<'a>) -> &'a [BodyPart] {
    focus.path.parent().and_then(|around| around.parts(focus.body)).unwrap_or_default()
}

fn is_turned(part: &BodyPart) -> bool {
    part.placement != Placement::at(part.placement.origin())
}

fn is_named(focus: &FocusedPart<'_>) -> bool {
    let within = focus.path.as_body(focus.body);
    within.is_some_and(|part| part.materials().any(|choice| choice.name().is_some()))
}

pub(super) fn check(scene: &EditedScene, selection: &Selection, act: PartAct<'_>) -> Result<()> {
    let focus = match act {
        PartAct::Duplicate => focused(scene, selection).ok_or(ActionError::NothingSelected)?,
        _ => free(scene, selection)?,
    };
    let has_work = match act {
        PartAct::Duplicate | PartAct::Delete => true,
        PartAct::Up => return step(&focus, false).map(drop),
        PartAct::Down => return step(&focus, true).map(drop),
        PartAct::Assign(choice) => {
            if choice.is_some_and(|choice| scene.scene().material(choice).is_none()) {
                return Err(ActionError::NoSuchItem);
            }
            focus.part.material.as_ref() != choice
        }
        PartAct::Share => !matches!(focus.part.material, Some(MaterialChoice::Named(_))),
        PartAct::MakeUnique => focus.part.material.is_none() || is_named(&focus),
        PartAct::ResetPlacement => is_turned(focus.part),
        PartAct::Nothing => false,
    };
    if has_work { Ok(()) } else { Err(ActionError::NothingToDo) }
}

pub(super) fn outcome(scene: &EditedScene, selection: &Selection, act: PartAct<'_>) -> Result {
    check(scene, selection, act)?;
    let focus = focused(scene, selection).ok_or(ActionError::NothingSelected)?;
    let path = focus.path;
    let change = |change: &dyn Fn(&mut BodyPart)| {
        Ok(edited(scene, &focus, |body| {
            path.part_mut(body).map(change);
            Some(path)
        }))
    };
    match act {
        PartAct::Duplicate => Ok(duplicate(scene, &focus)),
        PartAct::Delete => Ok(delete(scene, &focus)),
        PartAct::Up => swap(scene, &focus, step(&focus, false)?),
        PartAct::Down => swap(scene, &focus, step(&focus, true)?),
        PartAct::Assign(choice) => change(&|part| part.material = choice.cloned()),
        PartAct::Share => Ok(share(scene, &focus)),
        PartAct::MakeUnique => change(&|part| make_unique(scene, &focus, part)),
        PartAct::ResetPlacement => change(&|part| {
            part.shape = part.form().sized_shape();
            part.placement = Placement::at(part.placement.origin());
        }),
        PartAct::Nothing => Err(ActionError::NothingToDo),
    }
}

/// A copy stands a little aside, after the part.
fn duplicate(scene: &EditedScene, focus: &FocusedPart<'_>) -> ActionOutcome {
    let mut copy = focus.part.clone();
    let mut names = UsedNames::of(siblings(focus).iter().map(|part| part.name.as_str()));
    copy.name = names.take(&copy.name);
    copy.placement = copy.placement.moved_by(aside(focus));
    edited(scene, focus, |body| {
        let place = focus.path.place()? + 1;
        focus.path.parent()?.parts_mut(body)?.insert(place, copy);
        focus.path.sibling(place)
    })
}

/// The step that brings a copy of a part out of the part.
pub(super) fn aside(focus: &FocusedPart<'_>) -> DVec3 {
    let ball = focus.path.as_body(focus.body).and_then(|part| bounds::ball_of_body(&part));
    let step = ball.map_or(ASIDE, |ball| 0.5 * ball.radius);
    DVec3::new(step, 0.0, step)
}

/// Afterwards the part that follows is meant, the one before or what is around.
fn delete(scene: &EditedScene, focus: &FocusedPart<'_>) -> ActionOutcome {
    let mut is_empty = false;
    let mut outcome = edited(scene, focus, |body| {
        let gone = take(body, focus.path)?;
        is_empty = gone.is_whole();
        let around = gone.parent()?;
        let last = around.parts(body)?.len().checked_sub(1)?;
        around.child(gone.place()?.min(last))
    });
    if is_empty {
        outcome.scene.remove(&[ScenePart::Body(focus.index)].into());
        outcome.subject.clone_from(&focus.body.name);
    }
    outcome
}

/// Takes a part out of a body, and with it the wholes around it that have no other part; returns the way to all that has
/// gone. When nothing is left of the body, that is the way to the whole, and the body is as it was.
pub(super) fn take(body: &mut Body, path: PartPath) -> Option<PartPath> {
    path.part(body)?;
    let mut gone = path;
    while let Some(around) = gone.parent()
        && around.parts(body)?.len() == 1
    {
        gone = around;
    }
    if let Some(around) = gone.parent() {
        around.parts_mut(body)?.remove(gone.place()?);
    }
    Some(gone)
}

fn swap(scene: &EditedScene, focus: &FocusedPart<'_>, [from, to]: [usize; 2]) -> Result {
    Ok(edited(scene, focus, |body| {
        focus.path.parent()?.parts_mut(body)?.swap(from, to);
        focus.path.sibling(to)
    }))
}

/// What is seen of a part becomes a material of the scene.
fn share(scene: &EditedScene, focus: &FocusedPart<'_>) -> ActionOutcome {
    let seen = focus.path.material(focus.body);
    let mut with = scene.clone();
    let choice = match seen {
        MaterialChoice::Named(_) => seen.clone(),
        MaterialChoice::Inline(material) => {
            let mut names = UsedNames::of_materials(scene.scene());
            let name = names.take(if focus.part.name.is_empty() { "material" } else { &focus.part.name });
            with.append([NamedMaterial { name: name.clone(), material: (**material).clone() }], [], []);
            MaterialChoice::Named(name)
        }
    };
    edited(&with, focus, |body| {
        focus.path.part_mut(body)?.material = Some(choice);
        Some(focus.path)
    })
}

/// Gives a part its own material, a copy of what is seen, and likewise the parts within that have one of a name.
fn make_unique(scene: &EditedScene, focus: &FocusedPart<'_>, part: &mut BodyPart) {
    let Some(mut within) = focus.path.as_body(focus.body) else { return };
    within.each_material_mut(&mut |choice| {
        if choice.name().is_some() {
            *choice = own(scene.scene(), choice);
        }
    });
    part.material = Some(within.material);
    part.parts = within.parts;
}

/// The body, the part and the name that it would get.
pub(super) fn check_rename<'a>(
    scene: &'a EditedScene,
    whole: Item,
    path: PartPath,
    name: &str,
) -> Result<(FocusedPart<'a>, String)> {
    let focus = focused(scene, &Selection::of_part(whole, path)).ok_or(ActionError::NoSuchItem)?;
    let old = &focus.part.name;
    let others = siblings(&focus).iter().map(|part| part.name.as_str()).filter(|other| other != old);
    let name = UsedNames::of(others).take(name.trim());
    if name == *old { Err(ActionError::NothingToDo) } else { Ok((focus, name)) }
}

pub(super) fn rename(
    scene: &EditedScene,
    selection: &Selection,
    (whole, path): (Item, PartPath),
    name: &str,
) -> Result {
    let (focus, name) = check_rename(scene, whole, path, name)?;
    let mut outcome = edited(scene, &focus, |body| {
        path.part_mut(body)?.name.clone_from(&name);
        Some(path)
    });
    outcome.selection = selection.clone();
    outcome.subject = name;
    Ok(outcome)
}

/// The part after the one that is meant among its like, the first after the last, or the part before.
pub(super) fn next(focus: &FocusedPart<'_>, selection: &Selection, is_forward: bool) -> Selection {
    let count = siblings(focus).len();
    let place = focus.path.place().map(|place| match is_forward {
        true => (place + 1) % count,
        false => (place + count - 1) % count,
    });
    let path = place.and_then(|place| focus.path.sibling(place));
    selection.primary().zip(path).map_or_else(Selection::none, |(item, path)| Selection::of_part(item, path))
}

/// The first part of what is selected alone; as it was where there is none.
pub(super) fn first_part(scene: &EditedScene, selection: &Selection) -> Selection {
    let found = || {
        let item = selection.primary().filter(|_| selection.len() == 1)?;
        let Some(ScenePart::Body(index)) = scene.part(item) else { return None };
        let path = selection.part().unwrap_or(PartPath::WHOLE).child(0)?;
        path.part(scene.scene().bodies.get(index)?)?;
        Some(Selection::of_part(item, path))
    };
    found().unwrap_or_else(|| selection.clone())
}

/// What is around the part that is meant.
pub(super) fn around(selection: &Selection) -> Selection {
    let around = selection.part().and_then(PartPath::parent);
    selection
        .primary()
        .zip(around)
        .map_or_else(|| selection.clone(), |(item, around)| Selection::of_part(item, around))
}
