//! The pictures of a scene: those that its surroundings and materials take from files.

use std::collections::HashMap;

use crate::Scene;
use crate::body::Body;
use crate::environment::{Environment, Surroundings};
use crate::image::{Image, ImageError, ImageSource, Resources};
use crate::material::{Material, MaterialChoice, NamedMaterial};

/// A value that contains pictures.
pub trait HasImages {
    /// Changes its pictures.
    fn edit_images(&mut self, edit: &mut dyn FnMut(&mut Image));
}

impl HasImages for Environment {
    fn edit_images(&mut self, edit: &mut dyn FnMut(&mut Image)) {
        if let Surroundings::Picture(image) = &mut self.surroundings {
            edit(image);
        }
    }
}

impl HasImages for Material {
    fn edit_images(&mut self, edit: &mut dyn FnMut(&mut Image)) {
        self.pattern_mut().and_then(|pattern| pattern.texture.as_mut()).map(edit);
    }
}

impl HasImages for NamedMaterial {
    fn edit_images(&mut self, edit: &mut dyn FnMut(&mut Image)) {
        self.material.edit_images(edit);
    }
}

impl HasImages for Body {
    fn edit_images(&mut self, edit: &mut dyn FnMut(&mut Image)) {
        self.each_material_mut(&mut |choice| {
            if let MaterialChoice::Inline(material) = choice {
                material.edit_images(edit);
            }
        });
    }
}

/// All pictures of the scene; bodies without are not touched.
impl HasImages for Scene {
    fn edit_images(&mut self, edit: &mut dyn FnMut(&mut Image)) {
        self.environment.edit_images(edit);
        self.materials.iter_mut().for_each(|named| named.edit_images(edit));
        let has_images = |body: &Body| body.materials().filter_map(inline).any(|own| texture(own).is_some());
        let bodies = self.bodies.iter().enumerate();
        let places: Vec<usize> =
            bodies.filter(|(_, body)| has_images(body)).map(|(place, _)| place).collect();
        for place in places {
            if let Some(body) = self.bodies.get_mut(place) {
                body.edit_images(edit);
            }
        }
        self.follow_instances();
    }
}

impl Scene {
    /// Opens all pictures of the scene that are not opened yet; see [`Image::open`].
    ///
    /// # Errors
    /// What is wrong with those that could not be opened, each source once, in the order of the scene.
    pub fn open_images(&mut self, resources: &dyn Resources) -> Result<(), Vec<ImageError>> {
        let mut opened: HashMap<ImageSource, Option<Image>> = HashMap::new();
        let mut errors = Vec::new();
        self.edit_images(&mut |image| {
            if image.pixels().is_some() {
                return;
            }
            let open = || Image::open(image.source(), resources).map_err(|error| errors.push(error)).ok();
            if let Some(found) = opened.entry(image.source().clone()).or_insert_with(open) {
                image.clone_from(found);
            }
        });
        if errors.is_empty() { Ok(()) } else { Err(errors) }
    }

    /// All pictures of the scene: the surroundings', those of shared materials, those of bodies.
    pub fn images(&self) -> impl Iterator<Item = &Image> {
        self.images_with(self.bodies.iter())
    }

    /// All pictures of the scene without those of bodies that it shares with `other`, such as the scene before an edit.
    /// However many bodies there are, only the neighbors of those that were edited are looked at.
    pub fn images_besides<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = &'a Image> {
        let places = self.bodies.unshared(&other.bodies);
        self.images_with(places.filter_map(|place| self.bodies.get(place)))
    }

    fn images_with<'a>(&'a self, bodies: impl Iterator<Item = &'a Body>) -> impl Iterator<Item = &'a Image> {
        let shared = self.materials.iter().map(|named| &named.material);
        let own = bodies.flat_map(Body::materials).filter_map(inline);
        self.environment.surroundings.picture().into_iter().chain(shared.chain(own).filter_map(texture))
    }
}

fn inline(choice: &MaterialChoice) -> Option<&Material> {
    match choice {
        MaterialChoice::Inline(material) => Some(material),
        MaterialChoice::Named(_) => None,
    }
}

fn texture(material: &Material) -> Option<&Image> {
    material.pattern()?.texture.as_ref()
}
