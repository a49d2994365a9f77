//! The outcome of an action, before the document takes it over.

use catoptric_scene::{Body, Scene};

use super::ActionError;
use crate::selection::{Item, Selection};

/// The scene and the selection after an action.
pub(crate) struct ActionOutcome {
    pub(crate) scene: Scene,
    pub(crate) selection: Selection,
    /// The name of what was edited; empty when it is several things.
    pub(crate) subject: String,
}

pub(crate) type Result<T = ActionOutcome> = std::result::Result<T, ActionError>;

impl ActionOutcome {
    /// The selected things at these items edited, the selection kept.
    pub(crate) fn edited(
        scene: &Scene,
        selection: &Selection,
        items: &[Item],
        edit: impl FnOnce(&mut Scene),
    ) -> Self {
        let subject = subject(scene, items);
        let mut scene = scene.clone();
        edit(&mut scene);
        Self { scene, selection: selection.clone(), subject }
    }
}

/// The name of the only item.
pub(crate) fn subject(scene: &Scene, items: &[Item]) -> String {
    if let [item] = items { item.name(scene).to_owned() } else { String::new() }
}

/// The selected bodies that are not locked, in the scene's order.
pub(super) fn free_bodies(scene: &Scene, selection: &Selection) -> Result<Vec<usize>> {
    let mut indices: Vec<usize> = selection.bodies().collect();
    if indices.is_empty() {
        return Err(ActionError::NothingSelected);
    }
    indices.retain(|index| !Item::Body(*index).is_locked(scene));
    indices.sort_unstable();
    if indices.is_empty() { Err(ActionError::Locked) } else { Ok(indices) }
}

/// Edits the selected bodies that are not locked and that `wants` accepts.
pub(super) fn edit_bodies(
    scene: &Scene,
    selection: &Selection,
    wants: impl Fn(&Body) -> bool,
    edit: impl Fn(&mut Body),
) -> Result {
    let indices = wanting(scene, selection, wants)?;
    let items: Vec<Item> = indices.iter().copied().map(Item::Body).collect();
    Ok(ActionOutcome::edited(scene, selection, &items, |scene| {
        for index in indices {
            if let Some(body) = scene.bodies.get_mut(index) {
                edit(body);
            }
        }
    }))
}

/// The selected bodies that are not locked and that `wants` accepts, at least one.
pub(super) fn wanting(
    scene: &Scene,
    selection: &Selection,
    wants: impl Fn(&Body) -> bool,
) -> Result<Vec<usize>> {
    let mut indices = free_bodies(scene, selection)?;
    indices.retain(|index| scene.bodies.get(*index).is_some_and(&wants));
    if indices.is_empty() { Err(ActionError::NothingToDo) } else { Ok(indices) }
}
