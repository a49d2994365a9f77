//! The document and its gestures.

mod change;
mod images;
mod saving;

use std::path::PathBuf;
use std::sync::Arc;

use catoptric_scene::{Problem, Scene, ScenePart};

use crate::edited_scene::EditedScene;
use crate::history::{Difference, History, UndoStep};
use crate::label::Label;
use crate::part_path::PartPath;
use crate::selection::Selection;
pub(crate) use images::mover;
pub use saving::SceneWriter;

/// A change that was refused, since no file can express the scene; the scene has not changed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", problems.iter().map(Problem::to_string).collect::<Vec<_>>().join("; "))]
pub struct RefusedChange {
    /// What would have been wrong, at least one.
    pub problems: Vec<Problem>,
}

/// A change that has begun and not ended.
#[derive(Clone, Debug)]
struct Gesture {
    label: Label,
    start: EditedScene,
    selection: Selection,
    /// Whether all of it is navigation: see [`Editor::navigate`].
    is_navigation: bool,
}

/// An open document.
///
/// The scene is shared: a clone of [`Editor::scene`] is a snapshot that later edits do not touch.
#[derive(Clone, Debug)]
pub struct Editor {
    edited: EditedScene,
    revision: u64,
    selection: Selection,
    history: History,
    gesture: Option<Gesture>,
    path: Option<PathBuf>,
    title: String,
    /// The text that the scene was read from or saved as.
    text: Arc<str>,
    /// The scene that was saved or read; none when no file has it.
    saved: Option<Arc<Scene>>,
}

impl Editor {
    /// A new document without a file.
    pub fn new(scene: Scene) -> Self {
        Self::untitled("", "", scene)
    }

    /// A document that was read from the file at `path`, with the text of the file.
    pub fn open(path: impl Into<PathBuf>, text: impl Into<Arc<str>>, scene: Scene) -> Self {
        let mut editor = Self::untitled("", text, scene);
        editor.set_path(path.into());
        editor
    }

    /// A document with a title and a text but without a file, such as an example.
    pub fn untitled(title: impl Into<String>, text: impl Into<Arc<str>>, scene: Scene) -> Self {
        let scene = Arc::new(scene);
        Self {
            saved: Some(Arc::clone(&scene)),
            edited: EditedScene::new(scene),
            revision: 0,
            selection: Selection::none(),
            history: History::default(),
            gesture: None,
            path: None,
            title: title.into(),
            text: text.into(),
        }
    }

    /// A document that no file has: one recovered after a crash, or the good part of a file with errors. It counts as
    /// changed until it is saved. `path` is the file that it belongs to, if any; without one, `title` is its title.
    pub fn unsaved(
        path: Option<PathBuf>,
        title: impl Into<String>,
        text: impl Into<Arc<str>>,
        scene: Scene,
    ) -> Self {
        let mut editor = Self::untitled(title, text, scene);
        if let Some(path) = path {
            editor.set_path(path);
        }
        editor.saved = None;
        editor
    }

    /// Makes this document the successor of another in the same window: its [revision](Self::revision) is greater, and
    /// if both are of one file, things of one name are the same.
    #[must_use]
    pub fn succeeding(mut self, before: &Self) -> Self {
        self.revision = self.revision.max(before.revision + 1);
        if self.path.is_some() && self.path == before.path {
            self.edited = before.edited.revised(self.edited.scene);
        }
        self
    }

    /// The scene as it is now, also in the middle of a gesture.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.edited.scene
    }

    /// The scene as it is now, with the identities of its things.
    pub fn edited(&self) -> &EditedScene {
        &self.edited
    }

    /// A number that grows with every change of the scene, undo included.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// What is selected.
    pub fn selection(&self) -> &Selection {
        &self.selection
    }

    /// The places of the selected things, in the order of choosing.
    pub fn selected_parts(&self) -> impl DoubleEndedIterator<Item = ScenePart> {
        self.edited.parts_of(&self.selection)
    }

    /// The places of the selected bodies, in the order of choosing.
    pub fn selected_bodies(&self) -> impl DoubleEndedIterator<Item = usize> {
        self.selected_parts().filter_map(|part| if let ScenePart::Body(at) = part { Some(at) } else { None })
    }

    /// The places of the selected lights, in the order of choosing.
    pub fn selected_lights(&self) -> impl DoubleEndedIterator<Item = usize> {
        self.selected_parts().filter_map(|part| if let ScenePart::Light(at) = part { Some(at) } else { None })
    }

    /// The places of the selected named materials, in the order of choosing.
    pub fn selected_materials(&self) -> impl DoubleEndedIterator<Item = usize> {
        self.selected_parts()
            .filter_map(|part| if let ScenePart::Material(at) = part { Some(at) } else { None })
    }

    /// The place of the thing chosen last.
    pub fn primary_part(&self) -> Option<ScenePart> {
        self.edited.part(self.selection.primary()?)
    }

    /// The place of the selected body of which a part is meant, and the way to the part.
    pub fn selected_part(&self) -> Option<(usize, PartPath)> {
        self.edited.part_in(&self.selection)
    }

    /// Selects something else. What the scene does not have is left out. This is no undo step; steps remember what was
    /// selected before and after them.
    pub fn select(&mut self, selection: impl Into<Selection>) {
        self.selection = selection.into();
        self.edited.clip(&mut self.selection);
    }

    /// Selects what stands at these places now, as [`Self::select`] does.
    pub fn select_parts(&mut self, parts: impl IntoIterator<Item = ScenePart>) {
        self.selection = parts.into_iter().filter_map(|part| self.edited.item(part)).collect();
    }

    /// Whether a gesture is open.
    pub fn is_in_gesture(&self) -> bool {
        self.gesture.is_some()
    }

    /// The label of the open gesture.
    pub fn gesture_label(&self) -> Option<&Label> {
        self.gesture.as_ref().map(|gesture| &gesture.label)
    }

    /// Ends the open gesture: what it changed becomes one undo step. Returns whether there was such a change.
    pub fn settle(&mut self) -> bool {
        let Some(gesture) = self.gesture.take() else { return false };
        let Some(difference) = Difference::between(&gesture.start, &self.edited) else { return false };
        self.history.push(UndoStep {
            label: gesture.label,
            difference,
            selection_before: gesture.selection,
            selection_after: self.selection.clone(),
            is_navigation: gesture.is_navigation,
        });
        true
    }

    /// Ends the open gesture and restores the scene and the selection at its start. Returns whether one was open.
    pub fn abandon(&mut self) -> bool {
        let Some(gesture) = self.gesture.take() else { return false };
        if self.edited.scene != gesture.start.scene {
            self.revision += 1;
        }
        self.edited = gesture.start;
        self.selection = gesture.selection;
        true
    }

    /// Takes the last step back; an open gesture is settled first. Returns whether there was a step.
    pub fn undo(&mut self) -> bool {
        self.settle();
        let Some(selection) = self.history.undo(&mut self.edited) else { return false };
        self.revision += 1;
        self.selection = selection;
        true
    }

    /// Does the step again that was taken back last; an open gesture is settled first. Returns whether there was one.
    pub fn redo(&mut self) -> bool {
        self.settle();
        let Some(selection) = self.history.redo(&mut self.edited) else { return false };
        self.revision += 1;
        self.selection = selection;
        true
    }

    /// Whether there is something to undo.
    pub fn can_undo(&self) -> bool {
        self.undo_label().is_some()
    }

    /// Whether there is something to do again.
    pub fn can_redo(&self) -> bool {
        self.redo_label().is_some()
    }

    /// What [`Self::undo`] takes back: the open gesture, if it changed anything, or the last step.
    pub fn undo_label(&self) -> Option<&Label> {
        match &self.gesture {
            Some(gesture) if self.has_gesture_changed() => Some(&gesture.label),
            _ => self.history.last_done().map(|step| &step.label),
        }
    }

    /// What [`Self::redo`] does again. An open gesture that changed something leaves nothing to do again.
    pub fn redo_label(&self) -> Option<&Label> {
        let step = self.history.first_undone().filter(|_| !self.has_gesture_changed());
        step.map(|step| &step.label)
    }

    fn has_gesture_changed(&self) -> bool {
        self.gesture.as_ref().is_some_and(|gesture| gesture.start.scene != self.edited.scene)
    }

    /// All steps, the oldest first, those that were taken back included; [`Self::steps_done`] tells how many are done.
    /// An open gesture is no step yet.
    pub fn steps(&self) -> impl ExactSizeIterator<Item = &Label> {
        self.history.steps().iter().map(|step| &step.label)
    }

    /// How many of [`Self::steps`] are done.
    pub fn steps_done(&self) -> usize {
        self.history.done()
    }

    /// Undoes or redoes until so many steps are done, or as many as there are. An open gesture is settled first.
    pub fn go_to_step(&mut self, done: usize) {
        self.settle();
        while self.history.done() > done && self.undo() {}
        while self.history.done() < done && self.redo() {}
    }

    /// Holds everything against everything else; for tests.
    ///
    /// # Errors
    /// What is broken.
    pub fn check_invariants(&self) -> Result<(), String> {
        if let Some(problem) = self.scene().check().first() {
            return Err(format!("the scene has a problem: {problem}"));
        }
        self.edited.check_identities()?;
        if let Some(item) = self.selection.iter().find(|item| !self.edited.contains(*item)) {
            return Err(format!("{item:?} is selected, but the scene has none"));
        }
        if self.selection.part().is_some() && self.selected_part().is_none() {
            return Err(format!("a part is selected that the scene does not have: {:?}", self.selection));
        }
        let distinct: std::collections::HashSet<_> = self.selection.iter().collect();
        if distinct.len() != self.selection.len() {
            return Err(format!("something is selected twice: {:?}", self.selection));
        }
        let mut settled = self.clone();
        settled.settle();
        let now = settled.edited.clone();
        let is_as_before = |settled: &Self| Difference::between(&settled.edited, &now).is_none();
        if settled.undo() && !(settled.redo() && is_as_before(&settled)) {
            return Err("undoing and redoing gives another scene".to_owned());
        }
        if settled.redo() && !(settled.undo() && is_as_before(&settled)) {
            return Err("redoing and undoing gives another scene".to_owned());
        }
        Ok(())
    }
}
