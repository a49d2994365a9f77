//! Hidden and locked bodies and lights.

use catoptric_scene::{Scene, ScenePart};

use super::ActionError;
use super::outcome::{ActionOutcome, Result};
use crate::edited_scene::EditedScene;
use crate::identity::Item;
use crate::selection::Selection;

/// One of the two flags.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Flag {
    Hidden,
    Locked,
}

impl Flag {
    fn of(self, part: ScenePart, scene: &Scene) -> bool {
        match self {
            Self::Hidden => part.is_hidden(scene),
            Self::Locked => part.is_locked(scene),
        }
    }

    fn set(self, part: ScenePart, scene: &mut Scene, to: bool) {
        let flags = match part {
            ScenePart::Body(index) => {
                scene.bodies.get_mut(index).map(|body| (&mut body.hidden, &mut body.locked))
            }
            ScenePart::Light(index) => {
                scene.lights.get_mut(index).map(|light| (&mut light.hidden, &mut light.locked))
            }
            _ => None,
        };
        if let Some((hidden, locked)) = flags {
            *(if self == Self::Hidden { hidden } else { locked }) = to;
        }
    }
}

/// All lights and bodies of a scene.
pub(super) fn all(scene: &Scene) -> impl DoubleEndedIterator<Item = ScenePart> + use<> {
    (0..scene.bodies.len()).map(ScenePart::Body).chain((0..scene.lights.len()).map(ScenePart::Light))
}

/// The selected bodies and lights, and what a toggle sets their flag to: true, unless all have it already.
pub(super) fn check_toggle(
    scene: &EditedScene,
    selection: &Selection,
    flag: Flag,
) -> Result<(Vec<ScenePart>, bool)> {
    let parts: Vec<ScenePart> = scene
        .parts_of(selection)
        .filter(|part| matches!(part, ScenePart::Body(_) | ScenePart::Light(_)))
        .collect();
    if parts.is_empty() {
        return Err(ActionError::NothingSelected);
    }
    let to = !parts.iter().all(|part| flag.of(*part, scene.scene()));
    Ok((parts, to))
}

pub(super) fn toggle(scene: &EditedScene, selection: &Selection, flag: Flag) -> Result {
    let (parts, to) = check_toggle(scene, selection, flag)?;
    Ok(set_all(scene, selection, flag, &parts, to))
}

/// The place of a body or light whose flag is not set to this yet.
pub(super) fn check_set(scene: &EditedScene, flag: Flag, item: Item, to: bool) -> Result<ScenePart> {
    let part = scene.part(item).filter(|part| matches!(part, ScenePart::Body(_) | ScenePart::Light(_)));
    let part = part.ok_or(ActionError::NoSuchItem)?;
    if flag.of(part, scene.scene()) == to { Err(ActionError::NothingToDo) } else { Ok(part) }
}

pub(super) fn set(scene: &EditedScene, selection: &Selection, flag: Flag, item: Item, to: bool) -> Result {
    let part = check_set(scene, flag, item, to)?;
    Ok(set_all(scene, selection, flag, &[part], to))
}

/// All bodies and lights that have a flag.
pub(super) fn check_clear(scene: &EditedScene, flag: Flag) -> Result<Vec<ScenePart>> {
    let parts: Vec<ScenePart> = all(scene.scene()).filter(|part| flag.of(*part, scene.scene())).collect();
    if parts.is_empty() { Err(ActionError::NothingToDo) } else { Ok(parts) }
}

pub(super) fn clear(scene: &EditedScene, selection: &Selection, flag: Flag) -> Result {
    let parts = check_clear(scene, flag)?;
    Ok(set_all(scene, selection, flag, &parts, false))
}

fn set_all(
    scene: &EditedScene,
    selection: &Selection,
    flag: Flag,
    parts: &[ScenePart],
    to: bool,
) -> ActionOutcome {
    ActionOutcome::edited(scene, selection, parts, |scene| {
        for part in parts {
            flag.set(*part, scene, to);
        }
    })
}
