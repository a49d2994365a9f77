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
    pub(super) fn new(material: &Material) -> Self {
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

/// The named materials of a scene.
pub(super) type NamedMaterials<'a> = HashMap<&'a str, &'a Material>;

/// The materials that some bodies use, each distinct one once, in the order of their first use.
#[derive(Default)]
pub(super) struct MaterialTable<'a> {
    indices: HashMap<[u64; 13], u32>,
    of_names: HashMap<&'a str, (u32, &'a Material)>,
    prepared: Vec<StageMaterial>,
    keys: Vec<[u64; 13]>,
}

impl<'a> MaterialTable<'a> {
    /// The named materials of `scene`; of two with one name the last.
    pub(super) fn named(scene: &'a Scene) -> NamedMaterials<'a> {
        scene.materials.iter().map(|named| (named.name.as_str(), &named.material)).collect()
    }

    /// The index of a body's material and its source, or `None` if it is not defined.
    pub(super) fn find(
        &mut self,
        named: &NamedMaterials<'a>,
        choice: &'a MaterialChoice,
    ) -> Option<(u32, &'a Material)> {
        match choice {
            MaterialChoice::Inline(material) => {
                Some((self.index(bits(material), || StageMaterial::new(material)), material))
            }
            MaterialChoice::Named(name) => {
                if let Some(found) = self.of_names.get(name.as_str()) {
                    return Some(*found);
                }
                let material = *named.get(name.as_str())?;
                let index = self.index(bits(material), || StageMaterial::new(material));
                self.of_names.insert(name, (index, material));
                Some((index, material))
            }
        }
    }

    fn index(&mut self, key: [u64; 13], prepare: impl FnOnce() -> StageMaterial) -> u32 {
        *self.indices.entry(key).or_insert_with(|| {
            self.prepared.push(prepare());
            self.keys.push(key);
            self.prepared.len() as u32 - 1
        })
    }

    /// Takes over the materials of another table and returns their indices in this one.
    pub(super) fn append(&mut self, other: &Self) -> Vec<u32> {
        let materials = other.keys.iter().zip(&other.prepared);
        materials.map(|(key, material)| self.index(*key, || *material)).collect()
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
