//! The outcome of an action, before the document takes it over.

use catoptric_scene::{Body, Scene, ScenePart};

use super::ActionError;
use crate::edited_scene::EditedScene;
use crate::selection::Selection;

/// The scene and the selection after an action.
pub(crate) struct ActionOutcome {
    pub(crate) scene: EditedScene,
    /// What is selected then, as far as it is left.
    pub(crate) selection: Selection,
    /// The name of what was edited; empty when it is several things.
    pub(crate) subject: String,
}

pub(crate) type Result<T = ActionOutcome> = std::result::Result<T, ActionError>;

impl ActionOutcome {
    /// Values of these parts edited, the selection kept.
    pub(crate) fn edited(
        scene: &EditedScene,
        selection: &Selection,
        parts: &[ScenePart],
        edit: impl FnOnce(&mut Scene),
    ) -> Self {
        let subject = subject(scene.scene(), parts);
        let mut scene = scene.clone();
        scene.edit(edit);
        Self { scene, selection: selection.clone(), subject }
    }
}

/// The name of the only part.
pub(crate) fn subject(scene: &Scene, parts: &[ScenePart]) -> String {
    if let [part] = parts { part.name(scene).to_owned() } else { String::new() }
}

/// The places of the selected bodies, in the order of choosing.
pub(super) fn selected_bodies(scene: &EditedScene, selection: &Selection) -> Vec<usize> {
    let body = |part| if let ScenePart::Body(index) = part { Some(index) } else { None };
    scene.parts_of(selection).filter_map(body).collect()
}

/// The selected bodies that are not locked, in the scene's order.
pub(super) fn free_bodies(scene: &EditedScene, selection: &Selection) -> Result<Vec<usize>> {
    let mut indices = selected_bodies(scene, selection);
    if indices.is_empty() {
        return Err(ActionError::NothingSelected);
    }
    indices.retain(|index| !ScenePart::Body(*index).is_locked(scene.scene()));
    indices.sort_unstable();
    if indices.is_empty() { Err(ActionError::Locked) } else { Ok(indices) }
}

/// Edits the selected bodies that are not locked and that `wants` accepts.
pub(super) fn edit_bodies(
    scene: &EditedScene,
    selection: &Selection,
    wants: impl Fn(&Body) -> bool,
    edit: impl Fn(&mut Body),
) -> Result {
    let indices = wanting(scene, selection, wants)?;
    let parts: Vec<ScenePart> = indices.iter().copied().map(ScenePart::Body).collect();
    Ok(ActionOutcome::edited(scene, selection, &parts, |scene| {
        for index in indices {
            if let Some(body) = scene.bodies.get_mut(index) {
                edit(body);
            }
        }
    }))
}

/// The selected bodies that are not locked and that `wants` accepts, at least one.
pub(super) fn wanting(
    scene: &EditedScene,
    selection: &Selection,
    wants: impl Fn(&Body) -> bool,
) -> Result<Vec<usize>> {
    let mut indices = free_bodies(scene, selection)?;
    indices.retain(|index| scene.scene().bodies.get(*index).is_some_and(&wants));
    if indices.is_empty() { Err(ActionError::NothingToDo) } else { Ok(indices) }
}
