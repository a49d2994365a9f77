//! The selection.

use std::collections::HashMap;

use catoptric_scene::{Scene, ScenePart};

/// A thing of a scene that can be selected and inspected. Numbers are places in the scene's lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Item {
    /// The camera.
    Camera,
    /// The background and the ambient light.
    Environment,
    /// The limits of tracing.
    Tracing,
    /// A named material.
    Material(usize),
    /// A light.
    Light(usize),
    /// A body.
    Body(usize),
}

impl Item {
    /// Whether `scene` has this thing.
    pub fn is_in(self, scene: &Scene) -> bool {
        match self {
            Self::Camera | Self::Environment | Self::Tracing => true,
            Self::Material(index) => index < scene.materials.len(),
            Self::Light(index) => index < scene.lights.len(),
            Self::Body(index) => index < scene.bodies.len(),
        }
    }

    /// Whether the same thing stands at this place in two scenes; what every scene has counts as the same.
    fn is_same(self, one: &Scene, other: &Scene) -> bool {
        match self {
            Self::Camera | Self::Environment | Self::Tracing => true,
            Self::Material(index) => one.materials.get(index) == other.materials.get(index),
            Self::Light(index) => one.lights.get(index) == other.lights.get(index),
            Self::Body(index) => one.bodies.get(index) == other.bodies.get(index),
        }
    }

    /// The name in the scene; empty for what has none.
    pub fn name(self, scene: &Scene) -> &str {
        let name = match self {
            Self::Camera | Self::Environment | Self::Tracing => None,
            Self::Material(index) => scene.materials.get(index).map(|named| &named.name),
            Self::Light(index) => scene.lights.get(index).map(|light| &light.name),
            Self::Body(index) => scene.bodies.get(index).map(|body| &body.name),
        };
        name.map_or("", String::as_str)
    }

    /// Whether it is hidden; only bodies and lights can be.
    pub fn is_hidden(self, scene: &Scene) -> bool {
        match self {
            Self::Light(index) => scene.lights.get(index).is_some_and(|light| light.hidden),
            Self::Body(index) => scene.bodies.get(index).is_some_and(|body| body.hidden),
            _ => false,
        }
    }

    /// Whether it is locked; only bodies and lights can be.
    pub fn is_locked(self, scene: &Scene) -> bool {
        match self {
            Self::Light(index) => scene.lights.get(index).is_some_and(|light| light.locked),
            Self::Body(index) => scene.bodies.get(index).is_some_and(|body| body.locked),
            _ => false,
        }
    }

    /// The part of the scene that problems of this thing are in.
    pub fn part(self) -> ScenePart {
        match self {
            Self::Camera => ScenePart::Camera,
            Self::Environment => ScenePart::Environment,
            Self::Tracing => ScenePart::Tracing,
            Self::Material(index) => ScenePart::Material(index),
            Self::Light(index) => ScenePart::Light(index),
            Self::Body(index) => ScenePart::Body(index),
        }
    }
}

/// Selected things, in the order in which they were chosen, none twice. The last one is the primary one: the one that
/// an inspector shows.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    items: Vec<Item>,
}

impl Selection {
    /// Nothing.
    pub const fn none() -> Self {
        Self { items: Vec::new() }
    }

    /// A selection of one thing.
    pub fn one(item: Item) -> Self {
        Self { items: vec![item] }
    }

    /// Selects this one thing instead of what was selected.
    pub fn set(&mut self, item: Item) {
        self.items.clear();
        self.items.push(item);
    }

    /// Adds a thing, and makes it the primary one.
    pub fn add(&mut self, item: Item) {
        self.remove(item);
        self.items.push(item);
    }

    /// Takes a thing out.
    pub fn remove(&mut self, item: Item) {
        self.items.retain(|other| *other != item);
    }

    /// Takes a thing out if it is selected, and adds it otherwise.
    pub fn toggle(&mut self, item: Item) {
        if self.contains(item) {
            self.remove(item);
        } else {
            self.items.push(item);
        }
    }

    /// Selects nothing.
    pub fn clear(&mut self) {
        self.items.clear();
    }

    /// Whether a thing is selected.
    pub fn contains(&self, item: Item) -> bool {
        self.items.contains(&item)
    }

    /// Whether nothing is selected.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// How many things are selected.
    pub fn len(&self) -> usize {
        self.items.len()
    }

    /// The thing chosen last.
    pub fn primary(&self) -> Option<Item> {
        self.items.last().copied()
    }

    /// The selected things, the primary one last.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = Item> + '_ {
        self.items.iter().copied()
    }

    /// The places of the selected bodies, in the order of choosing.
    pub fn bodies(&self) -> impl DoubleEndedIterator<Item = usize> + '_ {
        self.iter().filter_map(|item| if let Item::Body(index) = item { Some(index) } else { None })
    }

    /// The places of the selected lights, in the order of choosing.
    pub fn lights(&self) -> impl DoubleEndedIterator<Item = usize> + '_ {
        self.iter().filter_map(|item| if let Item::Light(index) = item { Some(index) } else { None })
    }

    /// The places of the selected named materials, in the order of choosing.
    pub fn materials(&self) -> impl DoubleEndedIterator<Item = usize> + '_ {
        self.iter().filter_map(|item| if let Item::Material(index) = item { Some(index) } else { None })
    }

    /// Each item replaced by what `to` makes of it, or dropped.
    pub(crate) fn mapped(&self, to: impl Fn(Item) -> Option<Item>) -> Self {
        self.iter().filter_map(to).collect()
    }

    /// The selection in another version of its scene: by name, and where there is none, by place if what stands there
    /// is the same.
    pub(crate) fn carried(&self, from: &Scene, to: &Scene) -> Self {
        let materials = (0..to.materials.len()).map(Item::Material);
        let lights = (0..to.lights.len()).map(Item::Light);
        let all = materials.chain(lights).chain((0..to.bodies.len()).map(Item::Body));
        let named: HashMap<_, Item> =
            all.map(|item| ((std::mem::discriminant(&item), item.name(to)), item)).collect();
        self.mapped(|item| match item.name(from) {
            "" => item.is_same(from, to).then_some(item),
            name => named.get(&(std::mem::discriminant(&item), name)).copied(),
        })
    }

    /// Drops what `scene` does not have.
    pub(crate) fn keep_in(&mut self, scene: &Scene) {
        self.items.retain(|item| item.is_in(scene));
    }
}

impl FromIterator<Item> for Selection {
    /// Of equal items the first counts.
    fn from_iter<T: IntoIterator<Item = Item>>(items: T) -> Self {
        let mut seen = std::collections::HashSet::new();
        Self { items: items.into_iter().filter(|item| seen.insert(*item)).collect() }
    }
}

impl From<Item> for Selection {
    fn from(item: Item) -> Self {
        Self::one(item)
    }
}
