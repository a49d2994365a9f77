//! The scene on which materials are shown.

use std::sync::OnceLock;

use catoptric_scene::format::read;
use catoptric_scene::{Material, MaterialChoice, Scene};
use catoptric_tracer::RenderSettings;

/// Samples for each pixel of smooth surfaces, and of those that scatter.
const SAMPLES: [u32; 2] = [16, 64];

/// A material, and the width and height of its preview in pixels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MaterialPreview {
    pub(super) material: Box<Material>,
    pub(super) side: u32,
}

impl MaterialPreview {
    /// How it is traced.
    pub(super) fn settings(&self) -> RenderSettings {
        let material = &self.material;
        let is_rough = material.is_rough();
        let [smooth, scattered] = SAMPLES;
        let samples = if is_rough || material.dispersion().is_some() { scattered } else { smooth };
        RenderSettings { width: self.side, height: self.side, samples }
    }

    /// What is traced.
    pub(super) fn scene(&self) -> Option<Scene> {
        static STAGE: OnceLock<Option<Scene>> = OnceLock::new();
        let render_scene = STAGE
            .get_or_init(|| read(include_str!("preview.toml")).into_result().ok().map(|read| read.value));
        let mut scene = render_scene.clone()?;
        let ball = scene.bodies.iter_mut().find(|body| body.name == "ball")?;
        ball.material = MaterialChoice::Inline(self.material.clone());
        Some(scene)
    }
}

#[cfg(test)]
mod tests {
    use catoptric_scene::{Conductor, Model};

    use super::*;

    #[test]
    fn the_scene_of_previews_can_be_read_and_shows_the_material() {
        let material = Box::new(Material::from(Model::Conductor));
        let preview = MaterialPreview { material: material.clone(), side: 96 };
        let scene = preview.scene().unwrap();
        let is_shown = |choice: &MaterialChoice| *choice == MaterialChoice::Inline(material.clone());
        assert_eq!(scene.bodies.iter().filter(|body| is_shown(&body.material)).count(), 1);
        assert!(catoptric_tracer::RenderScene::build(&scene).is_ok());
        assert_eq!(preview.settings().samples, 16);
        let rough = Conductor { roughness: 0.2, ..Conductor::default() };
        let rough = MaterialPreview { material: Box::new(rough.into()), side: 96 };
        assert_eq!(rough.settings().samples, 64);
    }
}
