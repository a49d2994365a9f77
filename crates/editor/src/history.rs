//! The undo history.

mod difference;

use catoptric_scene::Image;

use crate::edited_scene::EditedScene;
use crate::label::Label;
use crate::selection::Selection;
pub(crate) use difference::Difference;

/// One undo step.
#[derive(Clone, Debug)]
pub(crate) struct UndoStep {
    pub(crate) label: Label,
    pub(crate) difference: Difference,
    pub(crate) selection_before: Selection,
    pub(crate) selection_after: Selection,
    /// Whether it only looked around: see [`crate::Editor::navigate`].
    pub(crate) is_navigation: bool,
}

/// All steps since the document was opened, and how many of them are done.
#[derive(Clone, Debug, Default)]
pub(crate) struct History {
    steps: Vec<UndoStep>,
    done: usize,
}

impl History {
    /// Adds a step that has just been done; what was undone before is forgotten.
    pub(crate) fn push(&mut self, step: UndoStep) {
        self.steps.truncate(self.done);
        self.steps.push(step);
        self.done = self.steps.len();
    }

    pub(crate) fn steps(&self) -> &[UndoStep] {
        &self.steps
    }

    pub(crate) fn done(&self) -> usize {
        self.done
    }

    /// Whether nothing but navigation has moved the camera, in the steps that are done.
    pub(crate) fn has_only_navigated(&self) -> bool {
        let mut done = self.steps.iter().take(self.done);
        done.all(|step| step.is_navigation || !step.difference.moves_camera())
    }

    /// The step that would be undone next.
    pub(crate) fn last_done(&self) -> Option<&UndoStep> {
        self.steps.get(self.done.checked_sub(1)?)
    }

    /// The step that would be done again next.
    pub(crate) fn first_undone(&self) -> Option<&UndoStep> {
        self.steps.get(self.done)
    }

    /// Changes the pictures of all steps.
    pub(crate) fn edit_images(&mut self, edit: &mut dyn FnMut(&mut Image)) {
        self.steps.iter_mut().for_each(|step| step.difference.edit_images(edit));
    }

    /// Takes the scene one step back, and returns the selection of that time.
    pub(crate) fn undo(&mut self, scene: &mut EditedScene) -> Option<Selection> {
        let step = self.last_done()?;
        step.difference.undo(scene);
        let selection = step.selection_before.clone();
        self.done -= 1;
        Some(selection)
    }

    /// Takes the scene one step forward again, and returns the selection of that time.
    pub(crate) fn redo(&mut self, scene: &mut EditedScene) -> Option<Selection> {
        let step = self.first_undone()?;
        step.difference.redo(scene);
        let selection = step.selection_after.clone();
        self.done += 1;
        Some(selection)
    }
}
