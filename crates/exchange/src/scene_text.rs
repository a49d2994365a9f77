//! Scenes that are being written in another format.

use std::borrow::Cow;
use std::fmt;

use catoptric_scene::{
    Body, Camera, Color, Falloff, Form, Language, Light, Material, MaterialChoice, Matte, Phong, Projection,
    Scene, Sentence, Shadow, Shape, Surroundings, Tracing,
};
use glam::DVec3;

use crate::message::Message;
use crate::phrase::Title;

/// How a scene is written in another format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExportOptions {
    /// Whether what the format cannot say is left out. Default false: it is an error.
    pub is_approximate: bool,
    /// Width and height of the picture, pixels, for formats that say them. Default [`crate::DEFAULT_SIZE`].
    pub size: Option<[u32; 2]>,
}

/// A scene in another format.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportedScene {
    /// The text of the file.
    pub text: String,
    /// What the format cannot say, and is left out.
    pub lost: Vec<Sentence>,
}

/// A format cannot say what a scene has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExportError {
    /// All that it cannot say.
    pub lost: Vec<Sentence>,
}

/// In English, one line for each.
impl fmt::Display for ExportError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<_> = self.lost.iter().map(|sentence| sentence.text(Language::English)).collect();
        out.write_str(&lines.join("\n"))
    }
}

impl std::error::Error for ExportError {}

/// A text that is being written, and what it cannot say.
#[derive(Debug, Default)]
pub(crate) struct SceneText {
    pub(crate) text: String,
    lost: Vec<Sentence>,
}

impl SceneText {
    /// Remembers that something cannot be said; once, if it is said of several parts.
    pub(crate) fn lose(&mut self, message: Message) {
        let sentence = message.into();
        if self.lost.last() != Some(&sentence) {
            self.lost.push(sentence);
        }
    }

    /// Adds a line.
    pub(crate) fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// Reports what no other format says.
    pub(crate) fn environment(&mut self, scene: &Scene) {
        if scene.environment.surroundings != Surroundings::Even {
            self.lose(Message::LosesSurroundings);
        }
        if scene.tracing != Tracing::default() {
            self.lose(Message::LosesTracing);
        }
        if scene.has_cemented() {
            self.lose(Message::LosesContact);
        }
    }

    /// The lights that give light, and what the format cannot say about them.
    pub(crate) fn lights<'s>(&mut self, scene: &'s Scene) -> Vec<(Title, &'s Light)> {
        let mut lights = Vec::new();
        for (index, light) in scene.lights.iter().enumerate().filter(|(_, light)| !light.hidden) {
            let title = Title::Light(index + 1, light.name.clone());
            if light.falloff != Falloff::None || light.radius > 0.0 {
                self.lose(Message::LosesFalloff { title: title.clone() });
            }
            lights.push((title, light));
        }
        lights
    }

    /// The bodies that are seen, with their materials; of those of parts but for surfaces with sizes of their own, and of other
    /// models than Phong's, that they are lost.
    pub(crate) fn bodies<'s>(&mut self, scene: &'s Scene) -> Vec<(Title, &'s Body, Cow<'s, Phong>)> {
        let mut bodies = Vec::new();
        for (title, body) in seen_bodies(scene) {
            let is_sized_surface = body.shape.is_surface() && body.form().parametric().is_some();
            if body.shape.is_compound() && !is_sized_surface {
                self.lose(Message::LosesParts { title });
            } else if let Some(material) = self.surface(scene, &body.material, &title) {
                let is_clear = material.transmission > 0.0;
                if body.shadow == Shadow::None || body.shadow == Shadow::Full && is_clear {
                    self.lose(Message::LosesShadow { title: title.clone() });
                }
                if material.weighs_by_angle() {
                    self.lose(Message::LosesFresnel { title: title.clone() });
                }
                bodies.push((title, body, material));
            }
        }
        bodies
    }

    /// That it is lost from which side alone a surface is seen.
    pub(crate) fn side(&mut self, form: &Form<'_>, title: &Title) {
        if form.shape.is_surface() && form.shape != Shape::SURFACE {
            self.lose(Message::LosesSide { title: title.clone() });
        }
    }

    /// A material as Phong's coefficients, or that it is lost.
    pub(crate) fn surface<'s>(
        &mut self,
        scene: &'s Scene,
        choice: &'s MaterialChoice,
        title: &Title,
    ) -> Option<Cow<'s, Phong>> {
        let material = phong(scene, choice);
        match &material {
            Some(phong) if phong.pattern.texture.is_some() => {
                self.lose(Message::LosesTexture { title: title.clone() });
            }
            Some(_) => {}
            None => self.lose(Message::LosesMaterial { title: title.clone() }),
        }
        material
    }

    /// The vertical angle of view, degrees.
    pub(crate) fn fov(&mut self, camera: &Camera) -> f64 {
        match camera.projection {
            Projection::Perspective { fov_degrees } => fov_degrees,
            Projection::Parallel { .. } => {
                self.lose(Message::LosesParallel);
                45.0
            }
        }
    }

    pub(crate) fn finish(self, options: &ExportOptions) -> Result<ExportedScene, ExportError> {
        if self.lost.is_empty() || options.is_approximate {
            return Ok(ExportedScene { text: self.text, lost: self.lost });
        }
        Err(ExportError { lost: self.lost })
    }
}

/// The bodies that are seen.
pub(crate) fn seen_bodies(scene: &Scene) -> impl Iterator<Item = (Title, &Body)> {
    let seen = scene.bodies.iter().enumerate().filter(|(_, body)| !body.hidden);
    seen.map(|(index, body)| (Title::Body(index + 1, body.name.clone()), body))
}

/// The material as Phong's coefficients, if it can be told by them.
fn phong<'s>(scene: &'s Scene, choice: &'s MaterialChoice) -> Option<Cow<'s, Phong>> {
    match scene.material(choice)? {
        Material::Phong(phong) => Some(Cow::Borrowed(phong)),
        Material::Matte(Matte { pattern, ambient }) => Some(Cow::Owned(Phong {
            pattern: pattern.clone(),
            ambient: *ambient,
            diffuse: 1.0,
            ..Phong::default()
        })),
        _ => None,
    }
}

/// Three numbers with a separator.
pub(crate) fn three(values: DVec3, separator: &str) -> String {
    values.to_array().map(decimal).join(separator)
}

/// A color with a separator.
pub(crate) fn components(color: Color, separator: &str) -> String {
    color.to_array().map(decimal).join(separator)
}

/// A number as short as it can be, without the noise of the last digits, never as −0.
pub(crate) fn decimal(value: f64) -> String {
    let rounded = format!("{value:.12e}").parse::<f64>().unwrap_or(value);
    (rounded + 0.0).to_string()
}

/// The color multiplied.
pub(crate) fn times(color: Color, factor: f64) -> Color {
    color.to_array().map(|component| component * factor).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_short() {
        assert_eq!(
            [0.1 + 0.2, -0.0, 1e-7, 1.0 / 3.0].map(decimal),
            ["0.3", "0", "0.0000001", "0.3333333333333"]
        );
    }
}
