//! What a scene can show at all.

use catoptric_scene::{Anchor, Material, Scene, ShapeKind};
use glam::DVec3;

use super::scene_mistake::BodyKind;

/// What a scene has, so that only faults are tried that could be seen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct SceneFacts {
    pub(super) is_lit: bool,
    pub(super) has_highlights: bool,
    pub(super) reflects: bool,
    pub(super) transmits: bool,
    /// Whether a body weighs reflection and refraction by the angle.
    pub(super) is_weighed: bool,
    /// Whether a body is scaled unevenly.
    pub(super) is_scaled: bool,
    /// Whether a body is scaled at all.
    pub(super) is_stretched: bool,
    /// The most axes about which a body is turned.
    pub(super) turns: usize,
    pub(super) has_patterns: bool,
    /// Whether a pattern has cells of another size than 1.
    pub(super) has_sized_patterns: bool,
    /// Whether a body has a radius.
    pub(super) is_round: bool,
    pub(super) has_cylinders: bool,
    pub(super) has_cones: bool,
    /// Which kinds there are.
    pub(super) kinds: [bool; BodyKind::ALL.len()],
}

impl SceneFacts {
    pub(super) fn of(scene: &Scene) -> Self {
        let mut facts = Self { is_lit: scene.lights.iter().any(|light| !light.hidden), ..Self::default() };
        for body in scene.bodies.iter().filter(|body| !body.hidden) {
            let scale = body.placement.scale;
            facts.is_scaled |= scale.abs() != DVec3::splat(scale.x.abs());
            facts.is_stretched |= scale != DVec3::ONE;
            if let Anchor::Frame { rotation_degrees, .. } = body.placement.anchor {
                let turns = rotation_degrees.to_array().iter().filter(|angle| **angle != 0.0).count();
                facts.turns = facts.turns.max(turns);
            }
            facts.is_round |= body.shape.number("radius").is_some();
            facts.has_cylinders |= body.shape.kind() == ShapeKind::Cylinder;
            facts.has_cones |= body.shape.kind() == ShapeKind::Cone;
            for (has, kind) in facts.kinds.iter_mut().zip(BodyKind::ALL) {
                *has |= kind.has(body);
            }
            for material in body.materials().filter_map(|choice| scene.material(choice)) {
                facts.add_material(material);
            }
        }
        facts
    }

    /// Whether there are bodies of a kind.
    pub(super) fn has_kind(&self, kind: BodyKind) -> bool {
        self.kinds.iter().zip(BodyKind::ALL).any(|(has, own)| *has && own == kind)
    }

    fn add_material(&mut self, material: &Material) {
        if let Some(pattern) = material.pattern() {
            self.has_patterns |= pattern.solid.is_some() || pattern.texture.is_some();
            self.has_sized_patterns |= pattern.solid.as_ref().is_some_and(|solid| solid.size != 1.0);
        }
        match material {
            Material::Phong(phong) => {
                self.has_highlights |= phong.specular > 0.0;
                self.reflects |= phong.reflection() > 0.0;
                self.transmits |= phong.transmission > 0.0;
                self.is_weighed |= phong.weighs_by_angle() && phong.reflection() > 0.0;
            }
            Material::Matte(_) => {}
            _ => {
                self.reflects = true;
                self.transmits = true;
            }
        }
    }
}
