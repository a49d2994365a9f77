//! A scene whose things have identities.

use std::collections::HashSet;
use std::sync::Arc;

use catoptric_scene::{Body, Light, NamedMaterial, Scene, ScenePart};

use crate::identity::{IdList, Identities, Item, ItemId, matched};
use crate::part_path::PartPath;
use crate::selection::Selection;

/// The scene of an open document, and the identities of its materials, lights and bodies. A copy shares all of it.
#[derive(Clone, Debug)]
pub struct EditedScene {
    pub(crate) scene: Arc<Scene>,
    pub(crate) identities: Arc<Identities>,
}

/// Makes a part of a place in its list.
pub(crate) type PartAt = fn(usize) -> ScenePart;

impl EditedScene {
    /// A scene of new things.
    pub(crate) fn new(scene: Arc<Scene>) -> Self {
        let identities = Identities {
            materials: IdList::fresh(scene.materials.len()),
            lights: IdList::fresh(scene.lights.len()),
            bodies: IdList::fresh(scene.bodies.len()),
        };
        Self { scene, identities: Arc::new(identities) }
    }

    /// Another version of this scene: things of one name are the same, those without a name by their values, then by
    /// their places.
    pub(crate) fn revised(&self, scene: Arc<Scene>) -> Self {
        let identities = matched(&self.scene, &self.identities, &scene);
        Self { scene, identities: Arc::new(identities) }
    }

    /// The scene.
    pub fn scene(&self) -> &Arc<Scene> {
        &self.scene
    }

    /// Where a thing stands now; `None` when the scene does not have it.
    pub fn part(&self, item: Item) -> Option<ScenePart> {
        Some(match item {
            Item::Camera => ScenePart::Camera,
            Item::Environment => ScenePart::Environment,
            Item::Tracing => ScenePart::Tracing,
            Item::Material(id) => ScenePart::Material(self.identities.materials.place(id)?),
            Item::Light(id) => ScenePart::Light(self.identities.lights.place(id)?),
            Item::Body(id) => ScenePart::Body(self.identities.bodies.place(id)?),
        })
    }

    /// The thing that stands at a place now; `None` when there is none.
    pub fn item(&self, part: ScenePart) -> Option<Item> {
        let identities = &self.identities;
        Some(match part {
            ScenePart::Camera => Item::Camera,
            ScenePart::Environment => Item::Environment,
            ScenePart::Tracing => Item::Tracing,
            ScenePart::Material(index) => Item::Material(*identities.materials.ids().get(index)?),
            ScenePart::Light(index) => Item::Light(*identities.lights.ids().get(index)?),
            ScenePart::Body(index) => Item::Body(*identities.bodies.ids().get(index)?),
        })
    }

    /// Whether the scene has a thing.
    pub fn contains(&self, item: Item) -> bool {
        self.part(item).is_some()
    }

    /// The named materials in their order.
    pub fn materials(&self) -> impl DoubleEndedIterator<Item = Item> + '_ {
        self.identities.materials.ids().iter().copied().map(Item::Material)
    }

    /// The lights in their order.
    pub fn lights(&self) -> impl DoubleEndedIterator<Item = Item> + '_ {
        self.identities.lights.ids().iter().copied().map(Item::Light)
    }

    /// The bodies in their order.
    pub fn bodies(&self) -> impl DoubleEndedIterator<Item = Item> + '_ {
        self.identities.bodies.ids().iter().copied().map(Item::Body)
    }

    /// The places of selected things, in the order of choosing.
    pub fn parts_of(&self, selection: &Selection) -> impl DoubleEndedIterator<Item = ScenePart> {
        selection.iter().filter_map(|item| self.part(item))
    }

    /// The place of the selected body of which a part is meant, and the way to the part.
    pub fn part_in(&self, selection: &Selection) -> Option<(usize, PartPath)> {
        let path = selection.part()?;
        let Some(ScenePart::Body(index)) = self.part(selection.primary()?) else { return None };
        path.part(self.scene.bodies.get(index)?)?;
        Some((index, path))
    }

    /// Drops from a selection what the scene does not have.
    pub(crate) fn clip(&self, selection: &mut Selection) {
        selection.retain(|item| self.contains(item));
        if self.part_in(selection).is_none() {
            selection.forget_part();
        }
    }

    /// The name of a thing; empty for what has none.
    pub fn name(&self, item: Item) -> &str {
        self.part(item).map_or("", |part| part.name(&self.scene))
    }

    /// Whether a thing is hidden; only bodies and lights can be.
    pub fn is_hidden(&self, item: Item) -> bool {
        self.part(item).is_some_and(|part| part.is_hidden(&self.scene))
    }

    /// Whether a thing is locked; only bodies and lights can be.
    pub fn is_locked(&self, item: Item) -> bool {
        self.part(item).is_some_and(|part| part.is_locked(&self.scene))
    }

    /// Holds the identities against the scene; for tests.
    pub(crate) fn check_identities(&self) -> Result<(), String> {
        let Identities { materials, lights, bodies } = &*self.identities;
        let counts = [self.scene.materials.len(), self.scene.lights.len(), self.scene.bodies.len()];
        for (list, count) in [materials, lights, bodies].into_iter().zip(counts) {
            let is_found = |(place, id): (usize, &ItemId)| list.place(*id) == Some(place);
            if list.ids().len() != count || !list.ids().iter().enumerate().all(is_found) {
                return Err(format!("{count} things have these identities: {list:?}"));
            }
        }
        Ok(())
    }

    /// Changes values of the scene, and no list's length or order.
    pub(crate) fn edit(&mut self, edit: impl FnOnce(&mut Scene)) {
        edit(Arc::make_mut(&mut self.scene));
    }

    /// Adds new things at the end of the lists.
    pub(crate) fn append(
        &mut self,
        materials: impl IntoIterator<Item = NamedMaterial>,
        lights: impl IntoIterator<Item = Light>,
        bodies: impl IntoIterator<Item = Body>,
    ) {
        let scene = Arc::make_mut(&mut self.scene);
        scene.materials.extend(materials);
        scene.lights.extend(lights);
        scene.bodies.extend(bodies);
        let identities = Arc::make_mut(&mut self.identities);
        identities.materials.grow(scene.materials.len());
        identities.lights.grow(scene.lights.len());
        identities.bodies.grow(scene.bodies.len());
    }

    /// Takes things away.
    pub(crate) fn remove(&mut self, gone: &HashSet<ScenePart>) {
        let scene = Arc::make_mut(&mut self.scene);
        let identities = Arc::make_mut(&mut self.identities);
        scene.materials.retain(stays(gone, ScenePart::Material));
        identities.materials.edit().retain(stays(gone, ScenePart::Material));
        scene.lights.retain(stays(gone, ScenePart::Light));
        identities.lights.edit().retain(stays(gone, ScenePart::Light));
        if gone.iter().any(|part| matches!(part, ScenePart::Body(_))) {
            scene.bodies.retain(stays(gone, ScenePart::Body));
            identities.bodies.edit().retain(stays(gone, ScenePart::Body));
        }
    }

    /// Gives a list another order: for each new place the old one.
    pub(crate) fn reorder(&mut self, kind: PartAt, order: &[usize]) {
        let scene = Arc::make_mut(&mut self.scene);
        let identities = Arc::make_mut(&mut self.identities);
        let ids = match kind(0) {
            ScenePart::Material(_) => {
                permute(&mut scene.materials, order);
                &mut identities.materials
            }
            ScenePart::Light(_) => {
                permute(&mut scene.lights, order);
                &mut identities.lights
            }
            ScenePart::Body(_) => {
                scene.bodies.change(|bodies| permute(bodies, order));
                &mut identities.bodies
            }
            ScenePart::Camera | ScenePart::Environment | ScenePart::Tracing => return,
        };
        ids.edit().change(|ids: &mut Vec<ItemId>| permute(ids, order));
    }
}

/// Whether the next element of a list is not gone.
fn stays<T>(gone: &HashSet<ScenePart>, kind: PartAt) -> impl FnMut(&T) -> bool {
    let mut indices = 0..;
    move |_| indices.next().is_some_and(|index| !gone.contains(&kind(index)))
}

fn permute<T: Clone>(list: &mut Vec<T>, order: &[usize]) {
    *list = order.iter().filter_map(|index| list.get(*index).cloned()).collect();
}
