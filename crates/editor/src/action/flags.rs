//! Hidden and locked bodies and lights.

use catoptric_scene::Scene;

use super::ActionError;
use super::outcome::{ActionOutcome, Result};
use crate::selection::{Item, Selection};

/// One of the two flags.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Flag {
    Hidden,
    Locked,
}

impl Flag {
    fn of(self, item: Item, scene: &Scene) -> bool {
        match self {
            Self::Hidden => item.is_hidden(scene),
            Self::Locked => item.is_locked(scene),
        }
    }

    fn set(self, item: Item, scene: &mut Scene, to: bool) {
        let flags = match item {
            Item::Body(index) => scene.bodies.get_mut(index).map(|body| (&mut body.hidden, &mut body.locked)),
            Item::Light(index) => {
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
pub(super) fn all(scene: &Scene) -> impl DoubleEndedIterator<Item = Item> + use<> {
    (0..scene.bodies.len()).map(Item::Body).chain((0..scene.lights.len()).map(Item::Light))
}

/// The selected bodies and lights, and what a toggle sets their flag to: true, unless all have it already.
pub(super) fn check_toggle(scene: &Scene, selection: &Selection, flag: Flag) -> Result<(Vec<Item>, bool)> {
    let items: Vec<Item> =
        selection.iter().filter(|item| matches!(item, Item::Body(_) | Item::Light(_))).collect();
    if items.is_empty() {
        return Err(ActionError::NothingSelected);
    }
    let to = !items.iter().all(|item| flag.of(*item, scene));
    Ok((items, to))
}

pub(super) fn toggle(scene: &Scene, selection: &Selection, flag: Flag) -> Result {
    let (items, to) = check_toggle(scene, selection, flag)?;
    Ok(set_all(scene, selection, flag, &items, to))
}

pub(super) fn check_set(scene: &Scene, flag: Flag, item: Item, to: bool) -> Result<()> {
    if !matches!(item, Item::Body(_) | Item::Light(_)) || !item.is_in(scene) {
        return Err(ActionError::NoSuchItem);
    }
    if flag.of(item, scene) == to { Err(ActionError::NothingToDo) } else { Ok(()) }
}

pub(super) fn set(scene: &Scene, selection: &Selection, flag: Flag, item: Item, to: bool) -> Result {
    check_set(scene, flag, item, to)?;
    Ok(set_all(scene, selection, flag, &[item], to))
}

/// All bodies and lights that have a flag.
pub(super) fn check_clear(scene: &Scene, flag: Flag) -> Result<Vec<Item>> {
    let items: Vec<Item> = all(scene).filter(|item| flag.of(*item, scene)).collect();
    if items.is_empty() { Err(ActionError::NothingToDo) } else { Ok(items) }
}

pub(super) fn clear(scene: &Scene, selection: &Selection, flag: Flag) -> Result {
    let items = check_clear(scene, flag)?;
    Ok(set_all(scene, selection, flag, &items, false))
}

fn set_all(scene: &Scene, selection: &Selection, flag: Flag, items: &[Item], to: bool) -> ActionOutcome {
    ActionOutcome::edited(scene, selection, items, |scene| {
        for item in items {
            flag.set(*item, scene, to);
        }
    })
}
