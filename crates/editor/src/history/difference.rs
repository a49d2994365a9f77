//! The difference of two scenes, as small as the edit between them.

use std::sync::Arc;

use catoptric_scene::{Body, Camera, Environment, HasImages as _, Image, Light, NamedMaterial, Tracing};

use crate::edited_scene::EditedScene;
use crate::identity::{IdList, ItemId};
use crate::sequence::Sequence;

/// The changes that make one scene into another, and back.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Difference {
    camera: Option<[Camera; 2]>,
    environment: Option<[Environment; 2]>,
    tracing: Option<[Tracing; 2]>,
    materials: ListDifference<NamedMaterial>,
    lights: ListDifference<Light>,
    bodies: ListDifference<Body>,
    material_ids: ListDifference<ItemId>,
    light_ids: ListDifference<ItemId>,
    body_ids: ListDifference<ItemId>,
}

/// The changes of a list.
#[derive(Clone, Debug, PartialEq)]
enum ListDifference<T> {
    /// Some elements, each with its place and its values before and after.
    Elements(Vec<(usize, [T; 2])>),
    /// A part of the list from a place on, as it was before and after.
    Part(usize, [Vec<T>; 2]),
}

const BEFORE: usize = 0;
const AFTER: usize = 1;

impl Difference {
    /// The difference between two scenes; `None` when there is none.
    pub(crate) fn between(before: &EditedScene, after: &EditedScene) -> Option<Self> {
        let ids_before = &before.identities;
        let ids_after = &after.identities;
        let (before, after) = (&before.scene, &after.scene);
        let difference = Self {
            camera: values(&before.camera, &after.camera),
            environment: values(&before.environment, &after.environment),
            tracing: values(&before.tracing, &after.tracing),
            materials: ListDifference::between(&before.materials, &after.materials),
            lights: ListDifference::between(&before.lights, &after.lights),
            bodies: ListDifference::between(&before.bodies, &after.bodies),
            material_ids: ListDifference::between(ids_before.materials.ids(), ids_after.materials.ids()),
            light_ids: ListDifference::between(ids_before.lights.ids(), ids_after.lights.ids()),
            body_ids: ListDifference::between(ids_before.bodies.ids(), ids_after.bodies.ids()),
        };
        (!difference.is_empty()).then_some(difference)
    }

    fn is_empty(&self) -> bool {
        self.camera.is_none()
            && self.environment.is_none()
            && self.tracing.is_none()
            && self.materials.is_empty()
            && self.lights.is_empty()
            && self.bodies.is_empty()
            && !self.has_other_ids()
    }

    fn has_other_ids(&self) -> bool {
        !(self.material_ids.is_empty() && self.light_ids.is_empty() && self.body_ids.is_empty())
    }

    /// Whether the two have different cameras.
    pub(crate) fn moves_camera(&self) -> bool {
        self.camera.is_some()
    }

    /// Makes the scene before of the one after.
    pub(crate) fn undo(&self, scene: &mut EditedScene) {
        self.take::<BEFORE>(scene);
    }

    /// Makes the scene after of the one before.
    pub(crate) fn redo(&self, scene: &mut EditedScene) {
        self.take::<AFTER>(scene);
    }

    /// Changes the pictures of both sides.
    pub(crate) fn edit_images(&mut self, edit: &mut dyn FnMut(&mut Image)) {
        self.environment.iter_mut().flatten().for_each(|environment| environment.edit_images(edit));
        self.materials.each(|named| named.edit_images(edit));
        self.bodies.each(|body| body.edit_images(edit));
    }

    fn take<const SIDE: usize>(&self, edited: &mut EditedScene) {
        let scene = Arc::make_mut(&mut edited.scene);
        if let Some(camera) = self.camera {
            scene.camera = camera[SIDE];
        }
        if let Some(environment) = &self.environment {
            scene.environment = environment[SIDE].clone();
        }
        if let Some(tracing) = self.tracing {
            scene.tracing = tracing[SIDE];
        }
        self.materials.take::<SIDE>(&mut scene.materials);
        self.lights.take::<SIDE>(&mut scene.lights);
        self.bodies.take::<SIDE>(&mut scene.bodies);
        if self.has_other_ids() {
            let identities = Arc::make_mut(&mut edited.identities);
            self.material_ids.take_ids::<SIDE>(&mut identities.materials);
            self.light_ids.take_ids::<SIDE>(&mut identities.lights);
            self.body_ids.take_ids::<SIDE>(&mut identities.bodies);
        }
    }
}

fn values<T: Clone + PartialEq>(before: &T, after: &T) -> Option<[T; 2]> {
    (before != after).then(|| [before.clone(), after.clone()])
}

impl<T: Clone + PartialEq> ListDifference<T> {
    fn between<L: Sequence<T>>(before: &L, after: &L) -> Self {
        let (count, new_count) = (before.count(), after.count());
        if count == new_count {
            let sides = |index: usize| Some((index, [before.at(index)?, after.at(index)?]));
            let pairs = before.apart(after).filter_map(sides).filter(|(_, [before, after])| before != after);
            return Self::Elements(pairs.map(|(index, sides)| (index, sides.map(T::clone))).collect());
        }
        let least = count.min(new_count);
        let is_same = |old: usize, new: usize| before.at(old) == after.at(new);
        let head = (0..least).take_while(|&at| is_same(at, at)).count();
        let tail = (1..=least - head).take_while(|&back| is_same(count - back, new_count - back)).count();
        let middle =
            |list: &L| (head..list.count() - tail).filter_map(|index| list.at(index).cloned()).collect();
        Self::Part(head, [middle(before), middle(after)])
    }

    fn is_empty(&self) -> bool {
        matches!(self, Self::Elements(elements) if elements.is_empty())
    }

    /// Changes all elements of both sides.
    fn each(&mut self, edit: impl FnMut(&mut T)) {
        match self {
            Self::Elements(elements) => elements.iter_mut().flat_map(|(_, sides)| sides).for_each(edit),
            Self::Part(_, sides) => sides.iter_mut().flatten().for_each(edit),
        }
    }

    /// Brings a list from one side to the other. A list that is on neither side is a fault of the caller; it is left
    /// as it is where it does not fit.
    fn take<const SIDE: usize>(&self, list: &mut impl Sequence<T>) {
        match self {
            Self::Elements(elements) => {
                for (index, sides) in elements {
                    if let Some(element) = list.at_mut(*index) {
                        element.clone_from(&sides[SIDE]);
                    }
                }
            }
            Self::Part(start, sides) => {
                let end = start + sides[1 - SIDE].len();
                debug_assert!(end <= list.count(), "the step was made for another list");
                if end <= list.count() {
                    list.replace(*start..end, &sides[SIDE]);
                }
            }
        }
    }
}

impl ListDifference<ItemId> {
    fn take_ids<const SIDE: usize>(&self, list: &mut IdList) {
        if !self.is_empty() {
            self.take::<SIDE>(list.edit());
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use catoptric_scene::{Scene, ScenePart};
    use glam::DVec3;

    use super::*;

    fn scene() -> EditedScene {
        let body = |index: usize| Body { name: index.to_string(), ..Body::default() };
        let scene = Scene { bodies: (0..1000).map(body).collect(), ..Scene::default() };
        EditedScene::new(Arc::new(scene))
    }

    fn ids(scene: &EditedScene) -> Vec<ItemId> {
        scene.identities.bodies.ids().to_vec()
    }

    /// How many bodies the difference of an edit holds; the edit is undone and done again on the way.
    fn size(edit: impl FnOnce(&mut Scene)) -> usize {
        let before = scene();
        let mut after = Scene::clone(before.scene());
        edit(&mut after);
        let difference = checked(&before, &before.revised(Arc::new(after)));
        count(&difference.bodies)
    }

    /// The difference, which is undone and done again.
    fn checked(before: &EditedScene, after: &EditedScene) -> Difference {
        let difference = Difference::between(before, after).unwrap();
        let mut scene = after.clone();
        difference.undo(&mut scene);
        assert_eq!((scene.scene(), ids(&scene)), (before.scene(), ids(before)));
        difference.redo(&mut scene);
        assert_eq!((scene.scene(), ids(&scene)), (after.scene(), ids(after)));
        difference
    }

    fn count<T>(difference: &ListDifference<T>) -> usize {
        match difference {
            ListDifference::Elements(elements) => 2 * elements.len(),
            ListDifference::Part(_, sides) => sides[0].len() + sides[1].len(),
        }
    }

    #[test]
    fn identities_add_as_little_as_the_edit() {
        let before = scene();
        let mut after = before.clone();
        after.remove(&HashSet::from([ScenePart::Body(500)]));
        assert_eq!(count(&checked(&before, &after).body_ids), 1);
        let mut moved = before.clone();
        moved.edit(|scene| scene.bodies[500].hidden = true);
        assert_eq!(count(&checked(&before, &moved).body_ids), 0);
        let mut swapped = before.clone();
        let order: Vec<usize> = (0..998).chain([999, 998]).collect();
        swapped.reorder(ScenePart::Body, &order);
        assert_eq!(count(&checked(&before, &swapped).body_ids), 4);
    }

    #[test]
    fn a_difference_is_as_small_as_the_edit() {
        assert_eq!(size(|scene| scene.camera.position = DVec3::ONE), 0);
        assert_eq!(size(|scene| scene.bodies[500].hidden = true), 2);
        assert_eq!(size(|scene| [0, 999].into_iter().for_each(|at| scene.bodies[at].hidden = true)), 4);
        assert_eq!(size(|scene| scene.bodies.swap(3, 4)), 4);
        assert_eq!(size(|scene| drop(scene.bodies.remove(500))), 1);
        assert_eq!(size(|scene| scene.bodies.insert(0, Body::default())), 1);
        assert_eq!(size(|scene| scene.bodies.push(scene.bodies[999].clone())), 1);
        assert_eq!(size(|scene| scene.bodies.splice(10..20, [])), 10);
        assert_eq!(size(|scene| scene.bodies.clear()), 1000);
        let scene = scene();
        assert_eq!(Difference::between(&scene, &scene.clone()), None);
    }
}
