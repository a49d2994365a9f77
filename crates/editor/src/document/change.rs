//! Changes of the scene, each a part of a gesture.

use std::sync::Arc;

use catoptric_scene::{
    Body, BodyPart, Camera, Environment, Light, Material, Problem, Scene, ScenePart, Tracing,
};

use super::{Difference, EditedScene, Editor, Gesture, RefusedChange, Selection, UndoStep};
use crate::label::Label;
use crate::part_path::PartPath;

/// Changes of more elements than this are checked by a check of the whole scene.
const MOST_PARTS: usize = 16;

impl Editor {
    /// Changes the scene at once. Consecutive changes with equal labels are one gesture and, when it is settled, one
    /// undo step; another label settles the open gesture first. Returns whether this changed anything.
    ///
    /// The whole scene is checked. Where only one part changes, the methods below cost less, and it may get another
    /// name. Here things of one name are the same, those without a name by their values, then by their places.
    ///
    /// # Errors
    /// When the scene would have problems that it does not have now. It stays as it was, and so does the gesture.
    pub fn change(&mut self, label: Label, edit: impl FnOnce(&mut Scene)) -> Result<bool, RefusedChange> {
        self.settle_unless(&label);
        let mut scene = Scene::clone(self.scene());
        edit(&mut scene);
        scene.follow_instances();
        if scene == **self.scene() {
            return Ok(false);
        }
        self.refuse_problems(&scene)?;
        let edited = self.edited.revised(Arc::new(scene));
        let start = std::mem::replace(&mut self.edited, edited);
        self.open_at(label, Some(start));
        self.edited.clip(&mut self.selection);
        self.revision += 1;
        Ok(true)
    }

    /// Changes one body; one that does not exist stays so.
    ///
    /// # Errors
    /// Those of [`Self::change`].
    pub fn change_body(
        &mut self,
        index: usize,
        label: Label,
        edit: impl FnOnce(&mut Body),
    ) -> Result<bool, RefusedChange> {
        let mut edit = Some(edit);
        self.change_bodies([index], label, |_, body| {
            if let Some(edit) = edit.take() {
                edit(body);
            }
        })
    }

    /// Changes a part of a body; one that does not exist stays so.
    ///
    /// # Errors
    /// Those of [`Self::change`].
    pub fn change_part(
        &mut self,
        index: usize,
        part: PartPath,
        label: Label,
        edit: impl FnOnce(&mut BodyPart),
    ) -> Result<bool, RefusedChange> {
        self.change_body(index, label, |body| {
            if let Some(part) = part.part_mut(body) {
                edit(part);
            }
        })
    }

    /// Changes several bodies, all or none; `edit` gets the place of each.
    ///
    /// # Errors
    /// Those of [`Self::change`].
    pub fn change_bodies(
        &mut self,
        indices: impl IntoIterator<Item = usize>,
        label: Label,
        edit: impl FnMut(usize, &mut Body),
    ) -> Result<bool, RefusedChange> {
        self.change_elements(
            indices,
            label,
            |scene, index| scene.bodies.get_mut(index),
            ScenePart::Body,
            edit,
        )
    }

    /// Changes one light; one that does not exist stays so.
    ///
    /// # Errors
    /// Those of [`Self::change`].
    pub fn change_light(
        &mut self,
        index: usize,
        label: Label,
        edit: impl FnOnce(&mut Light),
    ) -> Result<bool, RefusedChange> {
        let mut edit = Some(edit);
        self.change_lights([index], label, |_, light| {
            if let Some(edit) = edit.take() {
                edit(light);
            }
        })
    }

    /// Changes several lights, all or none; `edit` gets the place of each.
    ///
    /// # Errors
    /// Those of [`Self::change`].
    pub fn change_lights(
        &mut self,
        indices: impl IntoIterator<Item = usize>,
        label: Label,
        edit: impl FnMut(usize, &mut Light),
    ) -> Result<bool, RefusedChange> {
        self.change_elements(
            indices,
            label,
            |scene, index| scene.lights.get_mut(index),
            ScenePart::Light,
            edit,
        )
    }

    /// Changes the coefficients of a named material; one that does not exist stays so. Its name is changed by
    /// [`crate::Action::Rename`].
    ///
    /// # Errors
    /// Those of [`Self::change`].
    pub fn change_material(
        &mut self,
        index: usize,
        label: Label,
        edit: impl FnOnce(&mut Material),
    ) -> Result<bool, RefusedChange> {
        let mut edit = Some(edit);
        self.change_elements(
            [index],
            label,
            |scene, index| scene.materials.get_mut(index),
            ScenePart::Material,
            |_, named| {
                if let Some(edit) = edit.take() {
                    edit(&mut named.material);
                }
            },
        )
    }

    /// Changes the camera.
    ///
    /// # Errors
    /// Those of [`Self::change`].
    pub fn change_camera(
        &mut self,
        label: Label,
        edit: impl FnOnce(&mut Camera),
    ) -> Result<bool, RefusedChange> {
        self.change_value(label, |scene| &mut scene.camera, ScenePart::Camera, edit)
    }

    /// Moves the camera by looking around, as with [`Self::change_camera`]: it can be undone, and pictures show it. In
    /// a document without a file it is no [work](Self::has_unsaved_work).
    ///
    /// # Errors
    /// Those of [`Self::change`].
    pub fn navigate(&mut self, label: Label, camera: Camera) -> Result<bool, RefusedChange> {
        let open = self.gesture.as_ref().filter(|gesture| gesture.label == label);
        let is_navigation = open.is_none_or(|gesture| gesture.is_navigation);
        let has_changed = self.change_camera(label, |own| *own = camera)?;
        if let Some(gesture) = self.gesture.as_mut().filter(|_| has_changed) {
            gesture.is_navigation = is_navigation;
        }
        Ok(has_changed)
    }

    /// Changes the environment.
    ///
    /// # Errors
    /// Those of [`Self::change`].
    pub fn change_environment(
        &mut self,
        label: Label,
        edit: impl FnOnce(&mut Environment),
    ) -> Result<bool, RefusedChange> {
        self.change_value(label, |scene| &mut scene.environment, ScenePart::Environment, edit)
    }

    /// Changes the limits of tracing.
    ///
    /// # Errors
    /// Those of [`Self::change`].
    pub fn change_tracing(
        &mut self,
        label: Label,
        edit: impl FnOnce(&mut Tracing),
    ) -> Result<bool, RefusedChange> {
        self.change_value(label, |scene| &mut scene.tracing, ScenePart::Tracing, edit)
    }

    /// Takes over a whole new scene and what it has of a selection as one undo step, no gesture being open. Returns
    /// whether this changed anything; another selection alone is no step.
    ///
    /// # Errors
    /// Those of [`Self::change`].
    pub(crate) fn step(
        &mut self,
        label: Label,
        edited: EditedScene,
        mut selection: Selection,
    ) -> Result<bool, RefusedChange> {
        let mut edited = edited;
        edited.edit(|scene| {
            scene.free_lost_instances();
            scene.follow_instances();
        });
        edited.clip(&mut selection);
        let Some(difference) = Difference::between(&self.edited, &edited) else {
            let is_new = self.selection != selection;
            self.selection = selection;
            return Ok(is_new);
        };
        self.refuse_problems(edited.scene())?;
        self.edited = edited;
        self.revision += 1;
        let selection_before = std::mem::replace(&mut self.selection, selection);
        let selection_after = self.selection.clone();
        let is_navigation = false;
        self.history.push(UndoStep { label, difference, selection_before, selection_after, is_navigation });
        Ok(true)
    }

    fn refuse_problems(&self, scene: &Scene) -> Result<(), RefusedChange> {
        let problems = scene.check();
        if problems.is_empty() { Ok(()) } else { only_known(problems, || self.scene().check()) }
    }

    fn change_value<T: Clone + PartialEq>(
        &mut self,
        label: Label,
        value_of: impl Fn(&mut Scene) -> &mut T,
        part: ScenePart,
        edit: impl FnOnce(&mut T),
    ) -> Result<bool, RefusedChange> {
        let swap = |scene: &mut Scene, value: &mut T| std::mem::swap(value_of(scene), value);
        self.settle_unless(&label);
        let before = self.scene_before();
        let scene = Arc::make_mut(&mut self.edited.scene);
        let mut old = value_of(scene).clone();
        edit(value_of(scene));
        let has_changed = *value_of(scene) != old;
        let problems = scene.check_part(part);
        let mut checked = Ok(());
        if !problems.is_empty() {
            swap(scene, &mut old);
            checked = only_known(problems, || scene.check_part(part));
            if checked.is_ok() {
                swap(scene, &mut old);
            }
        }
        self.finish_change(label, before, checked.map(|()| has_changed))
    }

    fn change_elements<T: Clone + PartialEq>(
        &mut self,
        indices: impl IntoIterator<Item = usize>,
        label: Label,
        element_of: impl Fn(&mut Scene, usize) -> Option<&mut T>,
        part: impl Fn(usize) -> ScenePart,
        mut edit: impl FnMut(usize, &mut T),
    ) -> Result<bool, RefusedChange> {
        self.settle_unless(&label);
        let before = self.scene_before();
        let scene = Arc::make_mut(&mut self.edited.scene);
        let mut old: Vec<(usize, T)> = Vec::new();
        for index in indices {
            let Some(element) = element_of(scene, index) else { continue };
            let before = element.clone();
            edit(index, element);
            if *element != before {
                old.push((index, before));
            }
        }
        let swap = |scene: &mut Scene, old: &mut Vec<(usize, T)>| {
            // Backwards, so that a place that was given twice ends as it began.
            for (index, value) in old.iter_mut().rev() {
                if let Some(element) = element_of(scene, *index) {
                    std::mem::swap(element, value);
                }
            }
            scene.follow_instances();
        };
        let check = |scene: &Scene, old: &[(usize, T)]| -> Vec<Problem> {
            // Each part's name is compared with all others.
            if old.len() > MOST_PARTS {
                return scene.check();
            }
            old.iter().flat_map(|(index, _)| scene.check_part(part(*index))).collect()
        };
        let has_changed = !old.is_empty();
        scene.follow_instances();
        let problems = check(scene, &old);
        let mut checked = Ok(());
        if !problems.is_empty() {
            swap(scene, &mut old);
            checked = only_known(problems, || check(scene, &old));
            if checked.is_ok() {
                old.reverse();
                swap(scene, &mut old);
            }
        }
        self.finish_change(label, before, checked.map(|()| has_changed))
    }

    fn finish_change(
        &mut self,
        label: Label,
        before: Option<EditedScene>,
        outcome: Result<bool, RefusedChange>,
    ) -> Result<bool, RefusedChange> {
        if matches!(outcome, Ok(true)) {
            self.open_at(label, before);
            if self.selection.part().is_some() {
                self.edited.clip(&mut self.selection);
            }
            self.revision += 1;
        } else if let Some(before) = before {
            // An equal scene, but the one that others hold: they see at once that nothing is new.
            self.edited = before;
        }
        outcome
    }

    fn settle_unless(&mut self, label: &Label) {
        if self.gesture.as_ref().is_some_and(|gesture| gesture.label != *label) {
            self.settle();
        }
    }

    /// The scene that a gesture starts from, or that is put back where a change comes to nothing. One that nobody else
    /// holds is edited in place once a gesture is open, so it must not be held here then.
    fn scene_before(&self) -> Option<EditedScene> {
        let is_copied = self.gesture.is_none() || Arc::strong_count(self.scene()) > 1;
        is_copied.then(|| self.edited.clone())
    }

    /// Opens a gesture, unless one is open. Either is no navigation, as far as it is known here.
    fn open_at(&mut self, label: Label, start: Option<EditedScene>) {
        match (&mut self.gesture, start) {
            (Some(gesture), _) => gesture.is_navigation = false,
            (None, Some(start)) => {
                let selection = self.selection.clone();
                self.gesture = Some(Gesture { label, start, selection, is_navigation: false });
            }
            (None, None) => {}
        }
    }
}

/// Refuses problems that were not there before. Names and places may have changed, so problems of one key count as the
/// same.
fn only_known(
    mut problems: Vec<Problem>,
    before: impl FnOnce() -> Vec<Problem>,
) -> Result<(), RefusedChange> {
    let mut known: Vec<&str> = before().iter().map(|problem| problem.key).collect();
    problems.retain(|problem| match known.iter().position(|key| *key == problem.key) {
        Some(place) => {
            known.swap_remove(place);
            false
        }
        None => true,
    });
    if problems.is_empty() { Ok(()) } else { Err(RefusedChange { problems }) }
}
