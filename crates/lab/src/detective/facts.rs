//! What a scene can show at all.

use catoptric_scene::{Anchor, Material, Scene, ShapeKind};
use glam::DVec3;

/// What a scene has, so that only faults are tried that could be seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct SceneFacts {
    pub(super) is_lit: bool,
    pub(super) has_highlights: bool,
    pub(super) reflects: bool,
    pub(super) transmits: bool,
    /// Whether a body weighs reflection and refraction by the angle.
    pub(super) is_weighed: bool,
    /// Whether a body is scaled unevenly.
    pub(super) is_scaled: bool,
    pub(super) has_patterns: bool,
    /// Whether a body has a radius.
    pub(super) is_round: bool,
    pub(super) has_cylinders: bool,
    /// Whether a cone is placed by its ends.
    pub(super) has_cones: bool,
}

impl SceneFacts {
    pub(super) fn of(scene: &Scene) -> Self {
        let mut facts = Self { is_lit: scene.lights.iter().any(|light| !light.hidden), ..Self::default() };
        for body in scene.bodies.iter().filter(|body| !body.hidden) {
            let scale = body.placement.scale;
            facts.is_scaled |= scale.abs() != DVec3::splat(scale.x.abs());
            facts.is_round |= body.shape.number("radius").is_some();
            facts.has_cylinders |= body.shape.kind() == ShapeKind::Cylinder;
            facts.has_cones |=
                body.shape.kind() == ShapeKind::Cone && matches!(body.placement.anchor, Anchor::Axis { .. });
            for material in body.materials().filter_map(|choice| scene.material(choice)) {
                facts.has_patterns |= material
                    .pattern()
                    .is_some_and(|pattern| pattern.solid.is_some() || pattern.texture.is_some());
                match material {
                    Material::Phong(phong) => {
                        facts.has_highlights |= phong.specular > 0.0;
                        facts.reflects |= phong.reflection() > 0.0;
                        facts.transmits |= phong.transmission > 0.0;
                        facts.is_weighed |= phong.weighs_by_angle() && phong.reflection() > 0.0;
                    }
                    Material::Matte(_) => {}
                    _ => {
                        facts.reflects = true;
                        facts.transmits = true;
                    }
                }
            }
        }
        facts
    }
}
