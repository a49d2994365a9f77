//! Discrete acts on the document, for menus, shortcuts and a command palette.

mod add;
mod flags;
mod fragment;
mod instance;
mod join;
mod list;
mod material;
mod nest;
mod outcome;
mod part;
mod place;
mod select;

use std::path::Path;

use catoptric_scene::{Diagnostics, MaterialChoice, Shape, ShapeKind};
use glam::DVec3;

use crate::document::{Editor, RefusedChange};
use crate::edited_scene::EditedScene;
use crate::identity::Item;
use crate::label::Label;
use crate::new_body::NewBodyPlacement;
use crate::part_path::PartPath;
use crate::selection::Selection;
use flags::Flag;
use list::ListMove;
pub use nest::PartSlot;
pub(crate) use outcome::{ActionOutcome, subject};
use part::PartAct;

/// A discrete change of a document. Each is one undo step, except those that only select, undo or redo. Locked bodies
/// and lights do not change unless stated otherwise.
///
/// While a [part](Selection::part) of a body is meant, what can be done to a part is done to it: copies, deletions, order,
/// materials, and what is pasted becomes a part beside it. Hiding and locking are of the whole.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// Adds a body in a color of its own and selects it.
    AddBody {
        /// The body's shape.
        shape: ShapeKind,
        /// Where it stands, and how large it is.
        placement: NewBodyPlacement,
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
    /// Moves what is selected, of the primary one's kind, one place down in its list; locked ones too.
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
        /// The new name.
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
    /// Makes one body of the selected ones, which become its parts; the first chosen is what others are cut from,
    /// and gives its material to the whole.
    Join {
        /// The shape of the whole, one that has parts.
        shape: ShapeKind,
        /// What to call it, made unique by a number; the shape's key when empty.
        name: String,
    },
    /// Makes bodies of the parts of the selected bodies.
    TakeApart,
    /// Adds an instance of each selected body, or another one of an instance, and selects these.
    DuplicateAsInstance,
    /// Makes the selected instances bodies of their own, which look the same.
    MakeOwn,
    /// Makes the selected bodies, or the part that is meant, parts of what has the slot; without one, of the primary
    /// body, at the end. They stay where they are and look as they did.
    Nest(Option<PartSlot>),
    /// Makes a body of the part that is meant, before the one that is at this place now or after its whole. It stays where
    /// it is and looks as it did; a whole without parts goes.
    TakeOut(Option<usize>),
    /// Gives the part that is meant the material of what it is a part of.
    MaterialOfWhole,
    /// Gives another name to a part, also of a locked body. A name that is taken beside it is made unique by a number.
    RenamePart {
        /// The body.
        whole: Item,
        /// The part of it.
        part: PartPath,
        /// The new name; may be empty.
        name: String,
    },
    /// Means the first part of the selected body, or of the part that is meant.
    SelectPart,
    /// Means what is around the part that is meant.
    SelectWhole,
    /// Deletes the named materials that no body uses.
    RemoveUnusedMaterials,
    /// Takes the last step back.
    Undo,
    /// Does the step again that was taken back last.
    Redo,
}

/// The reason why an action could not be done; nothing has changed.
#[derive(Debug, thiserror::Error)]
pub enum ActionError {
    /// Nothing is selected that it could be done to.
    #[error("nothing is selected that this could be done to")]
    NothingSelected,
    /// All that is selected is locked.
    #[error("everything selected is locked")]
    Locked,
    /// Only one body is selected, but it takes more.
    #[error("select two or more bodies")]
    OneBody,
    /// A part is turned within a whole that is stretched.
    #[error("the part {name} is sheared, which a body cannot be")]
    Sheared {
        /// The name that the body would have.
        name: String,
    },
    /// The body or part has no parts of its own to which others could be added.
    #[error("only a union, an intersection, a difference or a group has parts")]
    NotJoined,
    /// Something cannot be a part of itself.
    #[error("nothing can be a part of itself")]
    WithinItself,
    /// Parts would be nested too deep.
    #[error("parts can be nested {} deep at most", Shape::MAX_DEPTH)]
    TooDeep,
    /// A union, an intersection or a difference would have too many simple parts.
    #[error("a union, an intersection or a difference has {} simple parts at most", Shape::MAX_PARTS)]
    TooManyParts,
    /// The action would change nothing.
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
    Refused(#[from] RefusedChange),
}

impl Action {
    /// Every key that [`Self::key`] and the labels of this crate have, for a test that a catalogue has them all.
    pub const KEYS: &'static [&'static str] = &[
        "edit-add-sphere",
        "edit-add-cube",
        "edit-add-cylinder",
        "edit-add-cone",
        "edit-add-paraboloid",
        "edit-add-plane",
        "edit-add-lens",
        "edit-add-mirror-dish",
        "edit-add-tube",
        "edit-add-ring",
        "edit-add-bowl",
        "edit-add-prism",
        "edit-add-wedge",
        "edit-add-open-cylinder",
        "edit-add-open-cone",
        "edit-add-disc",
        "edit-add-rectangle",
        "edit-add-triangle",
        "edit-add-light",
        "edit-add-material",
        "edit-duplicate",
        "edit-delete",
        "edit-toggle-hidden",
        "edit-toggle-locked",
        "edit-hide",
        "edit-show",
        "edit-lock",
        "edit-unlock",
        "edit-show-all",
        "edit-unlock-all",
        "edit-move-up",
        "edit-move-down",
        "edit-reorder",
        "edit-select-all",
        "edit-select-none",
        "edit-invert-selection",
        "edit-select-next",
        "edit-select-previous",
        "edit-rename",
        "edit-cut",
        "edit-paste",
        "edit-assign-material",
        "edit-share-material",
        "edit-make-material-unique",
        "edit-drop-to-ground",
        "edit-reset-placement",
        "edit-join-union",
        "edit-join-intersection",
        "edit-join-difference",
        "edit-join-group",
        "edit-take-apart",
        "edit-duplicate-as-instance",
        "edit-make-own",
        "edit-nest",
        "edit-take-out",
        "edit-material-of-whole",
        "edit-select-part",
        "edit-select-whole",
        "edit-remove-unused-materials",
        "edit-undo",
        "edit-redo",
        "edit-revert",
    ];

    /// The key of its label in the history, for message catalogues: `edit-delete` … Acts that are no undo step have one
    /// too, for menus.
    pub const fn key(&self) -> &'static str {
        match self {
            Self::AddBody { shape, .. } | Self::Join { shape, .. } => match shape {
                ShapeKind::Sphere => "edit-add-sphere",
                ShapeKind::Cube => "edit-add-cube",
                ShapeKind::Cylinder => "edit-add-cylinder",
                ShapeKind::Cone => "edit-add-cone",
                ShapeKind::Paraboloid => "edit-add-paraboloid",
                ShapeKind::Plane => "edit-add-plane",
                ShapeKind::Lens => "edit-add-lens",
                ShapeKind::MirrorDish => "edit-add-mirror-dish",
                ShapeKind::Tube => "edit-add-tube",
                ShapeKind::Ring => "edit-add-ring",
                ShapeKind::Bowl => "edit-add-bowl",
                ShapeKind::Prism => "edit-add-prism",
                ShapeKind::Wedge => "edit-add-wedge",
                ShapeKind::OpenCylinder => "edit-add-open-cylinder",
                ShapeKind::OpenCone => "edit-add-open-cone",
                ShapeKind::Disc => "edit-add-disc",
                ShapeKind::Rectangle => "edit-add-rectangle",
                ShapeKind::Triangle => "edit-add-triangle",
                ShapeKind::Union => "edit-join-union",
                ShapeKind::Intersection => "edit-join-intersection",
                ShapeKind::Difference => "edit-join-difference",
                ShapeKind::Surface => "edit-join-surface",
                ShapeKind::Group => "edit-join-group",
            },
            Self::AddLight { .. } => "edit-add-light",
            Self::AddMaterial { .. } => "edit-add-material",
            Self::Duplicate => "edit-duplicate",
            Self::Delete => "edit-delete",
            Self::ToggleHidden => "edit-toggle-hidden",
            Self::ToggleLocked => "edit-toggle-locked",
            Self::SetHidden { hidden: true, .. } => "edit-hide",
            Self::SetHidden { hidden: false, .. } => "edit-show",
            Self::SetLocked { locked: true, .. } => "edit-lock",
            Self::SetLocked { locked: false, .. } => "edit-unlock",
            Self::ShowAll => "edit-show-all",
            Self::UnlockAll => "edit-unlock-all",
            Self::MoveUp => "edit-move-up",
            Self::MoveDown => "edit-move-down",
            Self::MoveToIndex(_) => "edit-reorder",
            Self::SelectAll => "edit-select-all",
            Self::SelectNone => "edit-select-none",
            Self::InvertSelection => "edit-invert-selection",
            Self::SelectNext => "edit-select-next",
            Self::SelectPrevious => "edit-select-previous",
            Self::Rename { .. } | Self::RenamePart { .. } => "edit-rename",
            Self::Cut => "edit-cut",
            Self::Paste(_) => "edit-paste",
            Self::AssignMaterial(_) => "edit-assign-material",
            Self::ShareMaterial => "edit-share-material",
            Self::MakeMaterialUnique => "edit-make-material-unique",
            Self::DropToGround => "edit-drop-to-ground",
            Self::ResetPlacement => "edit-reset-placement",
            Self::TakeApart => "edit-take-apart",
            Self::DuplicateAsInstance => "edit-duplicate-as-instance",
            Self::MakeOwn => "edit-make-own",
            Self::Nest(_) => "edit-nest",
            Self::TakeOut(_) => "edit-take-out",
            Self::MaterialOfWhole => "edit-material-of-whole",
            Self::SelectPart => "edit-select-part",
            Self::SelectWhole => "edit-select-whole",
            Self::RemoveUnusedMaterials => "edit-remove-unused-materials",
            Self::Undo => "edit-undo",
            Self::Redo => "edit-redo",
        }
    }

    /// What is selected after an act that only selects.
    fn selection(&self, scene: &EditedScene, selection: &Selection) -> Option<Selection> {
        Some(match self {
            Self::SelectAll => select::select_all(scene),
            Self::SelectNone => Selection::none(),
            Self::InvertSelection => select::invert(scene, selection),
            Self::SelectNext => select::next(scene, selection, true),
            Self::SelectPrevious => select::next(scene, selection, false),
            Self::SelectPart => part::first_part(scene, selection),
            Self::SelectWhole => part::around(selection),
            _ => return None,
        })
    }

    /// What is done to a part where the action is about what is selected.
    fn of_part(&self) -> Option<PartAct<'_>> {
        Some(match self {
            Self::Duplicate => PartAct::Duplicate,
            Self::Delete | Self::Cut => PartAct::Delete,
            Self::MoveUp => PartAct::Up,
            Self::MoveDown => PartAct::Down,
            Self::AssignMaterial(choice) => PartAct::Assign(Some(choice)),
            Self::ShareMaterial => PartAct::Share,
            Self::MakeMaterialUnique => PartAct::MakeUnique,
            Self::ResetPlacement => PartAct::ResetPlacement,
            Self::MoveToIndex(_) | Self::DropToGround | Self::TakeApart => PartAct::Nothing,
            _ => return None,
        })
    }

    /// Whether an act on the scene has something to do.
    fn check(&self, scene: &EditedScene, selection: &Selection) -> Result<(), ActionError> {
        if let Some(act) = self.of_part().filter(|_| selection.part().is_some()) {
            return part::check(scene, selection, act);
        }
        match self {
            // A body of parts is joined of others.
            Self::AddBody { shape, .. } if shape.is_compound() => Err(ActionError::NothingToDo),
            Self::AddBody { .. } | Self::AddLight { .. } | Self::AddMaterial { .. } => Ok(()),
            Self::Duplicate => list::check_duplicate(scene, selection).map(drop),
            Self::Delete | Self::Cut => list::check_delete(scene, selection).map(drop),
            Self::ToggleHidden => flags::check_toggle(scene, selection, Flag::Hidden).map(drop),
            Self::ToggleLocked => flags::check_toggle(scene, selection, Flag::Locked).map(drop),
            Self::SetHidden { item, hidden } => {
                flags::check_set(scene, Flag::Hidden, *item, *hidden).map(drop)
            }
            Self::SetLocked { item, locked } => {
                flags::check_set(scene, Flag::Locked, *item, *locked).map(drop)
            }
            Self::ShowAll => flags::check_clear(scene, Flag::Hidden).map(drop),
            Self::UnlockAll => flags::check_clear(scene, Flag::Locked).map(drop),
            Self::MoveUp => list::check_reorder(scene, selection, ListMove::Up).map(drop),
            Self::MoveDown => list::check_reorder(scene, selection, ListMove::Down).map(drop),
            Self::MoveToIndex(place) => list::check_reorder(scene, selection, ListMove::To(*place)).map(drop),
            Self::Rename { item, name } => material::check_rename(scene, *item, name).map(drop),
            Self::Paste(text) if text.trim().is_empty() => Err(ActionError::NothingToPaste),
            Self::Paste(_) => Ok(()),
            Self::AssignMaterial(choice) => material::check_assign(scene, selection, choice),
            Self::ShareMaterial => material::check_share(scene, selection).map(drop),
            Self::MakeMaterialUnique => material::check_make_unique(scene, selection),
            Self::DropToGround => place::check_drop(scene, selection),
            Self::ResetPlacement => place::check_reset(scene, selection),
            Self::Join { shape, .. } => join::check_join(scene, selection, *shape).map(drop),
            Self::TakeApart => join::check_take_apart(scene, selection).map(drop),
            Self::DuplicateAsInstance => instance::check_duplicate(scene, selection).map(drop),
            Self::MakeOwn => instance::check_make_own(scene, selection).map(drop),
            Self::Nest(slot) => nest::check(scene, selection, *slot),
            Self::TakeOut(_) => nest::check_out(scene, selection),
            Self::MaterialOfWhole => part::check(scene, selection, PartAct::Assign(None)),
            Self::RenamePart { whole, part, name } => {
                part::check_rename(scene, *whole, *part, name).map(drop)
            }
            Self::RemoveUnusedMaterials => material::check_unused(scene.scene()).map(drop),
            Self::SelectAll
            | Self::SelectNone
            | Self::InvertSelection
            | Self::SelectNext
            | Self::SelectPrevious
            | Self::SelectPart
            | Self::SelectWhole
            | Self::Undo
            | Self::Redo => Err(ActionError::NothingToDo),
        }
    }

    /// What an act makes of the scene, whose file is in `folder`.
    fn outcome(
        &self,
        scene: &EditedScene,
        selection: &Selection,
        folder: Option<&Path>,
    ) -> Result<ActionOutcome, ActionError> {
        if let Some(act) = self.of_part().filter(|_| selection.part().is_some()) {
            return part::outcome(scene, selection, act);
        }
        match self {
            Self::AddBody { shape, .. } if shape.is_compound() => Err(ActionError::NothingToDo),
            Self::AddBody { shape, placement, name } => Ok(add::body(scene, *shape, placement, name.trim())),
            Self::AddLight { at, name } => Ok(add::light(scene, *at, name.trim())),
            Self::AddMaterial { name } => Ok(add::named_material(scene, name.trim())),
            Self::Duplicate => list::duplicate(scene, selection),
            Self::Delete | Self::Cut => list::delete(scene, selection),
            Self::ToggleHidden => flags::toggle(scene, selection, Flag::Hidden),
            Self::ToggleLocked => flags::toggle(scene, selection, Flag::Locked),
            Self::SetHidden { item, hidden } => flags::set(scene, selection, Flag::Hidden, *item, *hidden),
            Self::SetLocked { item, locked } => flags::set(scene, selection, Flag::Locked, *item, *locked),
            Self::ShowAll => flags::clear(scene, selection, Flag::Hidden),
            Self::UnlockAll => flags::clear(scene, selection, Flag::Locked),
            Self::MoveUp => list::reorder(scene, selection, ListMove::Up),
            Self::MoveDown => list::reorder(scene, selection, ListMove::Down),
            Self::MoveToIndex(place) => list::reorder(scene, selection, ListMove::To(*place)),
            Self::Rename { item, name } => material::rename(scene, selection, *item, name),
            Self::Paste(text) => nest::paste_beside(fragment::paste(scene, text, folder)?, scene, selection),
            Self::AssignMaterial(choice) => material::assign(scene, selection, choice),
            Self::ShareMaterial => material::share(scene, selection),
            Self::MakeMaterialUnique => material::make_unique(scene, selection),
            Self::DropToGround => place::drop_to_ground(scene, selection),
            Self::ResetPlacement => place::reset(scene, selection),
            Self::Join { shape, name } => join::join(scene, selection, *shape, name.trim()),
            Self::TakeApart => join::take_apart(scene, selection),
            Self::DuplicateAsInstance => instance::duplicate(scene, selection),
            Self::MakeOwn => instance::make_own(scene, selection),
            Self::Nest(slot) => nest::nest(scene, selection, *slot),
            Self::TakeOut(place) => nest::take_out(scene, selection, *place),
            Self::MaterialOfWhole => part::outcome(scene, selection, PartAct::Assign(None)),
            Self::RenamePart { whole, part, name } => part::rename(scene, selection, (*whole, *part), name),
            Self::RemoveUnusedMaterials => material::remove_unused(scene, selection),
            Self::SelectAll
            | Self::SelectNone
            | Self::InvertSelection
            | Self::SelectNext
            | Self::SelectPrevious
            | Self::SelectPart
            | Self::SelectWhole
            | Self::Undo
            | Self::Redo => Err(ActionError::NothingToDo),
        }
    }
}

impl Editor {
    /// Does it; an open gesture is settled first.
    ///
    /// # Errors
    /// Why it could not be done. Nothing has changed then, but that the open gesture is settled.
    #[expect(clippy::needless_pass_by_value, reason = "an action is made to be done")]
    pub fn apply(&mut self, action: Action) -> Result<(), ActionError> {
        self.settle();
        let is_done = match action {
            Action::Undo => self.undo(),
            Action::Redo => self.redo(),
            _ => match action.selection(self.edited(), self.selection()) {
                Some(selection) => {
                    let is_new = selection != *self.selection();
                    self.select(selection);
                    is_new
                }
                None => {
                    let ActionOutcome { scene, selection, subject } =
                        action.outcome(self.edited(), self.selection(), self.folder())?;
                    self.step(Label::new(action.key(), subject), scene, selection)?
                }
            },
        };
        if is_done { Ok(()) } else { Err(ActionError::NothingToDo) }
    }

    /// Whether [`Self::apply`] has something to do. Cheap enough for every frame: a text to be pasted is not read, and
    /// limits of numbers are not tried.
    pub fn can(&self, action: &Action) -> bool {
        match action {
            Action::Undo => self.can_undo(),
            Action::Redo => self.can_redo(),
            _ => match action.selection(self.edited(), self.selection()) {
                Some(selection) => selection != *self.selection(),
                None => action.check(self.edited(), self.selection()).is_ok(),
            },
        }
    }

    /// Why [`Self::apply`] would do nothing, for drops that are not let go yet: limits are tried, too.
    ///
    /// # Errors
    /// Those of [`Self::apply`].
    pub fn try_out(&self, action: &Action) -> Result<(), ActionError> {
        let outcome = action.outcome(self.edited(), self.selection(), self.folder())?;
        if outcome.scene.scene() == self.scene() { Err(ActionError::NothingToDo) } else { Ok(()) }
    }

    /// The selected bodies and lights, and the materials they name or that are selected, as the text of a scene file:
    /// what a clipboard carries. From a document that has a file, it has whole paths of pictures, for a
    /// document in any folder. `None` when nothing of that is selected.
    pub fn copy(&self) -> Option<String> {
        fragment::copy(self.edited(), self.selection(), self.folder())
    }
}
