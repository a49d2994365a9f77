//! The parts of a scene by their places.

use crate::Scene;

/// A part of a scene by its place, as long as the scene does not change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum ScenePart {
    /// The camera.
    Camera,
    /// The environment.
    Environment,
    /// The limits of tracing.
    Tracing,
    /// The named material at this index.
    Material(usize),
    /// The light at this index.
    Light(usize),
    /// The body at this index.
    Body(usize),
}

impl ScenePart {
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
}
