//! Where materials are kept: in the list of the scene, in a body, in a part of one.

use std::collections::{HashMap, HashSet};

use catoptric_editor::{EditedScene, Editor, Item, Label, PartPath, RefusedChange};
use catoptric_scene::{Material, MaterialChoice, Scene, ScenePart};

use super::sheet::SheetPlace;

/// The owner of a material as it stays in the open document: a thing, and the way to its part.
pub(super) type OwnerKey = (Item, PartPath);

/// The owner of a material: the scene's list, a body or a part of one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum MaterialOwner {
    /// The scene's list, at this place.
    Named(usize),
    /// The body at this place.
    Body(usize),
    /// A part of the body at this place.
    Part(usize, PartPath),
}

impl MaterialOwner {
    /// Where the scene has it, or what it is a part of.
    pub(super) fn part(self) -> ScenePart {
        match self {
            Self::Named(index) => ScenePart::Material(index),
            Self::Body(index) | Self::Part(index, _) => ScenePart::Body(index),
        }
    }

    /// Where the scene has it.
    pub(super) fn place(self) -> SheetPlace {
        let within = if let Self::Part(_, path) = self { path } else { PartPath::WHOLE };
        SheetPlace { part: self.part(), within }
    }

    /// What it is, whatever its place.
    pub(super) fn key(self, edited: &EditedScene) -> Option<OwnerKey> {
        let SheetPlace { part, within } = self.place();
        Some((edited.item(part)?, within))
    }
}

/// Where the materials of some bodies are kept, each once.
pub(super) fn homes_of(scene: &Scene, bodies: &[usize]) -> Vec<MaterialOwner> {
    let named: HashMap<&str, usize> =
        scene.materials.iter().enumerate().map(|(index, named)| (named.name.as_str(), index)).collect();
    let mut seen = HashSet::new();
    let home = |&index: &usize| match &scene.bodies.get(index)?.material {
        MaterialChoice::Inline(_) => Some(MaterialOwner::Body(index)),
        MaterialChoice::Named(name) => named.get(name.as_str()).map(|&index| MaterialOwner::Named(index)),
    };
    bodies.iter().filter_map(home).filter(|&home| seen.insert(home)).collect()
}

/// Where the material of a body is kept.
pub(super) fn home_of(scene: &Scene, body: usize) -> Option<MaterialOwner> {
    match &scene.bodies.get(body)?.material {
        MaterialChoice::Inline(_) => Some(MaterialOwner::Body(body)),
        MaterialChoice::Named(name) => {
            scene.materials.iter().position(|named| named.name == *name).map(MaterialOwner::Named)
        }
    }
}

/// Where the material of a part is kept; `None` for one that is made of what the whole is.
pub(super) fn home_of_part(scene: &Scene, index: usize, path: PartPath) -> Option<MaterialOwner> {
    match path.part(scene.bodies.get(index)?)?.material.as_ref()? {
        MaterialChoice::Inline(_) => Some(MaterialOwner::Part(index, path)),
        MaterialChoice::Named(name) => {
            scene.materials.iter().position(|named| named.name == *name).map(MaterialOwner::Named)
        }
    }
}

/// The material of an owner.
pub(super) fn material_at(scene: &Scene, home: MaterialOwner) -> Option<&Material> {
    match home {
        MaterialOwner::Named(index) => scene.materials.get(index).map(|named| &named.material),
        MaterialOwner::Body(index) => match &scene.bodies.get(index)?.material {
            MaterialChoice::Inline(material) => Some(material),
            MaterialChoice::Named(_) => None,
        },
        MaterialOwner::Part(index, path) => match path.part(scene.bodies.get(index)?)?.material.as_ref()? {
            MaterialChoice::Inline(material) => Some(material),
            MaterialChoice::Named(_) => None,
        },
    }
}

/// Changes the materials of owners.
pub(super) fn apply(
    editor: &mut Editor,
    homes: &[MaterialOwner],
    label: Label,
    change: &mut dyn FnMut(usize, &mut Material),
) -> Result<bool, RefusedChange> {
    match homes {
        [MaterialOwner::Named(index)] => {
            editor.change_material(*index, label, |material| change(0, material))
        }
        [MaterialOwner::Body(index)] => editor.change_body(*index, label, |body| {
            if let MaterialChoice::Inline(material) = &mut body.material {
                change(0, material);
            }
        }),
        [MaterialOwner::Part(index, path)] => editor.change_part(*index, *path, label, |part| {
            if let Some(MaterialChoice::Inline(material)) = &mut part.material {
                change(0, material);
            }
        }),
        _ => editor.change(label, |scene| {
            for (place, home) in homes.iter().enumerate() {
                let material = match *home {
                    MaterialOwner::Named(index) => {
                        scene.materials.get_mut(index).map(|named| &mut named.material)
                    }
                    MaterialOwner::Body(index) => {
                        match scene.bodies.get_mut(index).map(|body| &mut body.material) {
                            Some(MaterialChoice::Inline(material)) => Some(&mut **material),
                            _ => None,
                        }
                    }
                    // A part is selected alone.
                    MaterialOwner::Part(..) => None,
                };
                if let Some(material) = material {
                    change(place, material);
                }
            }
        }),
    }
}
