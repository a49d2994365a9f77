//! The names of bodies and lights in reports.

use std::collections::BTreeMap;

use catoptric_scene::{Scene, quoted_name};

/// The names of a scene's bodies and lights in reports: those of the file, or descriptions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DisplayNames {
    /// By the place in the scene.
    bodies: BTreeMap<usize, String>,
    /// Addresses of simple parts within a body, by its place in the scene and theirs among its parts.
    parts: BTreeMap<(usize, usize), String>,
    /// Of those that are not hidden.
    lights: Vec<String>,
}

impl DisplayNames {
    /// The names of lights; those of bodies are added when they are met.
    pub(super) fn of_lights(scene: &Scene) -> Self {
        let lights = scene.lights.iter().enumerate().filter(|(_, light)| !light.hidden);
        let name = |(number, light): (usize, &catoptric_scene::Light)| match light.name.as_str() {
            "" => format!("light {}", number + 1),
            name => quoted_name(name),
        };
        Self { bodies: BTreeMap::new(), parts: BTreeMap::new(), lights: lights.map(name).collect() }
    }

    /// Looks up the name of a body, and the address of a simple part of it.
    pub(super) fn meet(&mut self, scene: &Scene, body: usize, part: Option<usize>) {
        if let Some(part) = part
            && !self.parts.contains_key(&(body, part))
        {
            let address = scene.bodies.get(body).and_then(|body| body.form().part_address(part));
            self.parts.extend(address.map(|address| ((body, part), address)));
        }
        let name = || match scene.bodies.get(body) {
            Some(found) if !found.name.is_empty() => quoted_name(&found.name),
            Some(found) => format!("{} {}", found.body_shape().key(), body + 1),
            None => format!("body {}", body + 1),
        };
        self.bodies.entry(body).or_insert_with(name);
    }

    /// The name of the body at this place in the scene, in quotes, or its shape and number counted from 1. Bodies that
    /// no ray of the audit meets are known by number only.
    pub fn body(&self, body: usize) -> String {
        self.bodies.get(&body).cloned().unwrap_or_else(|| format!("body {}", body + 1))
    }

    /// The address within a body of a simple part that is met, `parts.front`; `None` for a body without parts.
    pub fn part(&self, body: usize, part: Option<usize>) -> Option<&str> {
        self.parts.get(&(body, part?)).map(String::as_str)
    }

    /// The name of a body as [`Self::body`] has it, with the part whose surface is met.
    pub(super) fn surface(&self, body: usize, part: Option<usize>) -> String {
        let name = self.body(body);
        self.part(body, part).map_or_else(|| name.clone(), |part| format!("{name}, {part}"))
    }

    /// The name in quotes, or the number, of a light: its place among the scene's lights that are not hidden.
    pub fn light(&self, light: usize) -> String {
        self.lights.get(light).cloned().unwrap_or_else(|| format!("light {}", light + 1))
    }
}
