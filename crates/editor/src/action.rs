//! Discrete acts on the document, for menus, shortcuts and a command palette.

use catoptric_scene::{Diagnostics, MaterialChoice, ShapeKind};
use glam::DVec3;

use crate::document::{Editor, Refused};
use crate::selection::Item;

/// Something that can be done to a document in one go. Each is one undo step, but for those that only select, undo or
/// redo. Locked bodies and lights stay as they are, where nothing else is said.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Adds a body of default size that stands on the ground y = 0 at or beside a place, in a color of its own, and
    /// selects it.
    AddBody {
        /// Its shape.
        shape: ShapeKind,
        /// Where, meters; the height does not count.
        at: DVec3,
        /// What to call it, made unique by a number; the shape's key when empty.
        name: String,
    },
    /// Adds a light and selects it.
    AddLight {
        /// Where, meters.
        at: DVec3,
        /// What to call it, made unique by a number; `light` when empty.
        name: String,
    },
    /// Adds a named material with its defaults and selects it.
    AddMaterial {
        /// What to call it, made unique by a number; `material` when empty.
        name: String,
    },
    /// Copies the selected bodies, lights and materials, a little aside, and selects the copies, which are not locked.
    Duplicate,
    /// Deletes the selected bodies, lights and materials. Bodies of a deleted material keep it as their own.
    Delete,
    /// Hides the selected bodies and lights, locked ones too; shows them when all are hidden.
    ToggleHidden,
    /// Locks the selected bodies and lights; unlocks them when all are locked.
    ToggleLocked,
    /// Hides or shows one body or light, locked or not, whatever is selected.
    SetHidden {
        /// The body or light.
        item: Item,
        /// Whether to hide it.
        hidden: bool,
    },
    /// Locks or unlocks one body or light, whatever is selected.
    SetLocked {
        /// The body or light.
        item: Item,
        /// Whether to lock it.
        locked: bool,
    },
    /// Shows all hidden bodies and lights, locked ones too.
    ShowAll,
    /// Unlocks all bodies and lights.
    UnlockAll,
    /// Moves what is selected, of the primary one's kind, one place up in its list; locked ones too.
    MoveUp,
    /// The same, one place down.
    MoveDown,
    /// Moves what is selected, of the primary one's kind, to stand together before the element that is at this place
    /// now, or at the end; locked ones too.
    MoveToIndex(usize),
    /// Selects all bodies and lights that are neither hidden nor locked.
    SelectAll,
    /// Selects nothing.
    SelectNone,
    /// Of all bodies and lights that are neither hidden nor locked, selects those that are not selected.
    InvertSelection,
    /// Selects the body or light after the primary one, the first after the last; hidden ones are passed over.
    SelectNext,
    /// Selects the body or light before the primary one.
    SelectPrevious,
    /// Gives another name to a body, light or material, locked or not; bodies of a material follow. A name that is
    /// taken is made unique by a number. Bodies and lights may have an empty name.
    Rename {
        /// The body, light or material.
        item: Item,
        /// Its name.
        name: String,
    },
    /// Deletes as [`Action::Delete`] does; take [`Editor::copy`] first.
    Cut,
    /// Adds the bodies, lights and materials of a scene file's text, and selects the bodies and lights.
    Paste(String),
    /// Makes the selected bodies of this.
    AssignMaterial(MaterialChoice),
    /// Makes a named material of the primary body's own, and makes all selected bodies of it.
    ShareMaterial,
    /// Gives each selected body a copy of its named material as its own.
    MakeMaterialUnique,
    /// Moves each selected body up or down until it stands on the ground y = 0.
    DropToGround,
    /// Takes turns and scales of the selected bodies back; their places stay.
    ResetPlacement,
    /// Deletes the named materials that no body uses.
    RemoveUnusedMaterials,
    /// Takes the last step back.
    Undo,
    /// Does the step again that was taken back last.
    Redo,
}

/// Why an action could not be done; nothing has changed.
#[derive(Debug, thiserror::Error)]
pub enum ActionError {
    /// Nothing is selected that it could be done to.
    #[error("nothing is selected that this could be done to")]
    NothingSelected,
    /// All that is selected is locked.
    #[error("everything selected is locked")]
    Locked,
    /// It would change nothing.
    #[error("there is nothing to do")]
    NothingToDo,
    /// There is no such body, light or material.
    #[error("there is no such thing in the scene")]
    NoSuchItem,
    /// A material needs a name.
    #[error("a material needs a name")]
    EmptyName,
    /// The pasted text is no scene.
    #[error("this is not the text of a scene:\n{0}")]
    BadText(Diagnostics),
    /// The pasted text is a scene without bodies, lights and materials.
    #[error("there is nothing in the text that could be pasted")]
    NothingToPaste,
    /// The scene would have problems.
    #[error(transparent)]
    Refused(#[from] Refused),
}

impl Editor {
    /// Does it; an open gesture is settled first.
    ///
    /// # Errors
    /// Why it could not be done. Nothing has changed then, but that the open gesture is settled.
    pub fn apply(&mut self, action: Action) -> Result<(), ActionError> {
        self.settle();
        match action {
            Action::Undo => self.undo().then_some(()).ok_or(ActionError::NothingToDo),
            Action::Redo => self.redo().then_some(()).ok_or(ActionError::NothingToDo),
            _ => Err(ActionError::NothingToDo),
        }
    }

    /// Whether [`Self::apply`] has something to do. Cheap enough for every frame: a text to be pasted is not read, and
    /// limits of numbers are not tried.
    pub fn can(&self, action: &Action) -> bool {
        match action {
            Action::Undo => self.can_undo(),
            Action::Redo => self.can_redo(),
            _ => false,
        }
    }

    /// The selected bodies and lights, and the materials they name or that are selected, as the text of a scene file:
    /// what a clipboard carries. `None` when nothing of that is selected.
    pub fn copy(&self) -> Option<String> {
        None
    }
}
