//! Materials of the stage.

use std::collections::HashMap;

use super::numbers;
use catoptric_scene::{Material, MaterialChoice, Scene};

/// Coefficients of a surface, in single precision.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StageMaterial {
    /// Color C.
    pub color: [f32; 3],
    /// k_a.
    pub ambient: f32,
    /// k_d.
    pub diffuse: f32,
    /// k_s.
    pub specular: f32,
    /// Exponent n.
    pub shininess: f32,
    /// k_r.
    pub reflection: f32,
    /// k_t·τ, what one crossing of the surface lets through.
    pub filter: [f32; 3],
    /// Index of refraction.
    pub ior: f32,
}

impl StageMaterial {
    fn new(material: &Material) -> Self {
        Self {
            color: numbers(material.color),
            ambient: material.ambient as f32,
            diffuse: material.diffuse as f32,
            specular: material.specular as f32,
            shininess: material.shininess as f32,
            reflection: material.reflection() as f32,
            filter: numbers(material.tint).map(|tint| tint * material.transmission as f32),
            ior: material.ior as f32,
        }
    }

    /// Whether a ray can pass at all.
    pub(crate) fn is_transparent(&self) -> bool {
        self.filter != [0.0; 3]
    }
}

/// Finds and prepares the materials that a scene's bodies use, each distinct one once.
pub(super) struct MaterialTable<'a> {
    named: HashMap<&'a str, &'a Material>,
    indices: HashMap<[u64; 13], u32>,
    prepared: Vec<StageMaterial>,
}

impl<'a> MaterialTable<'a> {
    pub(super) fn new(scene: &'a Scene) -> Self {
        let named = scene.materials.iter().map(|named| (named.name.as_str(), &named.material)).collect();
        Self { named, indices: HashMap::new(), prepared: Vec::new() }
    }

    /// The index of a body's material and its source, or `None` if it is not defined.
    pub(super) fn find(&mut self, choice: &'a MaterialChoice) -> Option<(u32, &'a Material)> {
        let material = match choice {
            MaterialChoice::Inline(material) => material,
            MaterialChoice::Named(name) => *self.named.get(name.as_str())?,
        };
        let prepared = &mut self.prepared;
        let index = *self.indices.entry(bits(material)).or_insert_with(|| {
            prepared.push(StageMaterial::new(material));
            prepared.len() as u32 - 1
        });
        Some((index, material))
    }

    /// The prepared material of an index that [`Self::find`] gave.
    pub(super) fn prepared(&self, index: u32) -> &StageMaterial {
        &self.prepared[index as usize]
    }

    pub(super) fn into_prepared(self) -> Vec<StageMaterial> {
        self.prepared
    }
}

/// All numbers that reach a [`StageMaterial`], for comparing exactly.
fn bits(material: &Material) -> [u64; 13] {
    let Material {
        color,
        ambient,
        diffuse,
        specular,
        shininess,
        reflection: _,
        transmission,
        ior,
        tint,
        checker: _,
    } = *material;
    [
        color.r,
        color.g,
        color.b,
        tint.r,
        tint.g,
        tint.b,
        ambient,
        diffuse,
        specular,
        shininess,
        material.reflection(),
        transmission,
        ior,
    ]
    .map(f64::to_bits)
}
