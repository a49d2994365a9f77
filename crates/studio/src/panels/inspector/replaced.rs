//! Materials that a change of the model replaced: when their model comes back, their numbers do.

use std::collections::HashMap;

use catoptric_scene::{Material, Model};

use super::material_owner::OwnerKey;

/// The last material of each model that an owner had, in the open document.
#[derive(Default)]
pub(crate) struct ReplacedMaterials(HashMap<(OwnerKey, Model), Material>);

impl ReplacedMaterials {
    /// The material of an owner in another model: with the numbers that it last had in it, but for those that the
    /// present model has too. The present material is remembered.
    pub(super) fn replace(&mut self, owner: OwnerKey, material: &Material, model: Model) -> Material {
        if material.model() == model {
            return material.clone();
        }
        let key = (owner, model);
        let new = match self.0.get(&key) {
            Some(before) => before.clone().with_shared(material),
            None => material.with_model(model),
        };
        self.0.insert((owner, material.model()), material.clone());
        new
    }
}

#[cfg(test)]
mod tests {
    use catoptric_editor::{Editor, PartPath};
    use catoptric_scene::{Body, Color, Dielectric, Phong, Scene};

    use super::*;

    #[test]
    fn a_model_that_comes_back_has_its_numbers_and_takes_over_newer_ones() {
        let bodies = [Body::default(), Body::default()].into();
        let editor = Editor::new(Scene { bodies, ..Scene::default() });
        let owners = editor.edited().bodies().map(|body| (body, PartPath::WHOLE));
        let [ball, other] = owners.collect::<Vec<_>>().try_into().unwrap();
        let mut replaced = ReplacedMaterials::default();
        let phong = Phong { diffuse: 0.3, specular: 0.7, tint: Color::BLACK, ..Phong::default() };
        let clear = replaced.replace(ball, &phong.clone().into(), Model::Dielectric);
        let Material::Dielectric(clear) = clear else { panic!() };
        let glass = Dielectric { index: 1.7.into(), dispersion: true, roughness: 0.2, ..clear };
        let back = replaced.replace(ball, &glass.clone().into(), Model::Phong);
        assert_eq!(back, Phong { ior: 1.7, ..phong.clone() }.into());
        assert_eq!(replaced.replace(ball, &back, Model::Dielectric), glass.into());
        assert_eq!(replaced.replace(other, &phong.into(), Model::Dielectric), Model::Dielectric.into());
    }
}
