//! Materials of the scene.

use std::borrow::Cow;
use std::collections::HashMap;
use std::hash::{Hash, Hasher};

use catoptric_optics::{Dispersion, fresnel};
use catoptric_scene::{
    Attenuation, Coated, Conductor, Dielectric, Image, Material, MaterialChoice, Matte, MetalOptics, Mirror,
    Pattern, Phong, Scene, ThinDielectric,
};

use crate::geometry::body::RenderBody;
use crate::simd::vector::Vector;
use crate::simd::{Float32, Width};
use crate::transport::color::linear_rgb;
use crate::transport::surface::exponential;
use crate::transport::surface::model::MaterialModel;
use crate::transport::surface::model::coated::CoatedMaterial;
use crate::transport::surface::model::conductor::ConductorTable;
use crate::transport::surface::model::thin_dielectric::ThinDielectricMaterial;
use crate::transport::texture::ImageTexture;

/// Coefficients of a surface, in single precision.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct RenderMaterial {
    /// Color C.
    pub color: [f32; 3],
    /// A picture in its place.
    pub texture: Option<ImageTexture>,
    /// k_a.
    pub ambient: f32,
    /// k_d.
    pub diffuse: f32,
    /// k_s.
    pub specular: f32,
    /// Exponent n.
    pub shininess: f32,
    /// k_r; of what reflects by a law of its own, what it reflects of light that falls on it straight.
    pub reflection: f32,
    /// What one crossing of the surface lets through: k_t·τ, or what is not reflected of light that falls on it straight.
    pub filter: [f32; 3],
    /// Index of refraction.
    pub ior: f32,
    /// How much it reflects under which angle.
    pub law: MaterialModel,
    /// The index of refraction by wavelength, if it differs.
    pub dispersion: Option<Dispersion>,
    /// Width of the slopes of its facets, α; 0 is smooth.
    pub alpha: f32,
    /// What light loses in the body, for each meter: the negative logarithm of what is left of it.
    pub absorption: [f32; 3],
}

impl RenderMaterial {
    pub(crate) fn new(material: &Material) -> Self {
        match material {
            Material::Phong(phong) => Self::phong(phong),
            Material::Dielectric(dielectric) => Self::dielectric(dielectric),
            Material::Conductor(conductor) => Self::conductor(conductor),
            Material::Mirror(mirror) => Self {
                reflection: mirror.reflection() as f32,
                law: MaterialModel::Mirror,
                alpha: alpha(mirror.roughness),
                ..Self::black(&mirror.pattern)
            },
            Material::Matte(Matte { pattern, ambient }) => {
                Self { ambient: *ambient as f32, diffuse: 1.0, ..Self::black(pattern) }
            }
            Material::Coated(coated) => Self::coated(coated),
            Material::ThinDielectric(sheet) => Self::thin_dielectric(sheet),
        }
    }

    /// A smooth surface that neither scatters, reflects nor lets through light.
    fn black(pattern: &Pattern) -> Self {
        Self {
            color: linear_rgb(pattern.color),
            texture: ImageTexture::new(pattern),
            ambient: 0.0,
            diffuse: 0.0,
            specular: 0.0,
            shininess: 1.0,
            reflection: 0.0,
            filter: [0.0; 3],
            ior: 1.0,
            law: MaterialModel::Constant,
            dispersion: None,
            alpha: 0.0,
            absorption: [0.0; 3],
        }
    }

    fn phong(phong: &Phong) -> Self {
        Self {
            ambient: phong.ambient as f32,
            diffuse: phong.diffuse as f32,
            specular: phong.specular as f32,
            shininess: phong.shininess as f32,
            reflection: phong.reflection() as f32,
            filter: linear_rgb(phong.tint).map(|tint| tint * phong.transmission as f32),
            ior: phong.ior as f32,
            law: if phong.weighs_by_angle() { MaterialModel::Schlick } else { MaterialModel::Constant },
            ..Self::black(&phong.pattern)
        }
    }

    fn dielectric(dielectric: &Dielectric) -> Self {
        let ior = dielectric.index.ior();
        let reflection = reflectance(ior);
        Self {
            reflection: reflection as f32,
            filter: [(1.0 - reflection) as f32; 3],
            ior: ior as f32,
            law: MaterialModel::Dielectric,
            dispersion: dielectric.dispersion(),
            alpha: alpha(dielectric.roughness),
            absorption: absorption(&dielectric.attenuation),
            ..Self::black(&Pattern::default())
        }
    }

    fn conductor(conductor: &Conductor) -> Self {
        let curve = ConductorTable::of(&conductor.metal);
        let [red, green, blue] = curve.at(1.0);
        Self {
            reflection: (red + green + blue) / 3.0,
            law: MaterialModel::Conductor(curve),
            alpha: alpha(conductor.roughness),
            ..Self::black(&Pattern::default())
        }
    }

    fn coated(coated: &Coated) -> Self {
        Self {
            color: linear_rgb(coated.pattern.color).map(|part| part.min(1.0)),
            ambient: coated.ambient as f32,
            diffuse: 1.0,
            reflection: reflectance(coated.ior) as f32,
            law: MaterialModel::Coat(CoatedMaterial::new(coated.ior)),
            alpha: alpha(coated.roughness),
            ..Self::black(&coated.pattern)
        }
    }

    fn thin_dielectric(sheet: &ThinDielectric) -> Self {
        let reflection = fresnel::sheet(1.0, sheet.ior).mean() as f32;
        let tint = linear_rgb(sheet.tint);
        Self {
            reflection,
            filter: tint.map(|tint| tint * (1.0 - reflection)),
            law: MaterialModel::ThinDielectric(ThinDielectricMaterial::new(sheet.ior, tint)),
            ..Self::black(&Pattern::default())
        }
    }

    /// The color of a body, but for its pattern, where rays `lanes` met it, at these points of its own frame.
    #[inline(always)]
    pub(crate) fn color_at<W: Width>(
        &self,
        w: W,
        body: &RenderBody,
        in_body: Vector<W::R>,
        lanes: W::M,
    ) -> Vector<W::R> {
        match &self.texture {
            None => Vector::splat(w.real(0.0), self.color),
            Some(texture) => texture.colors(w, body.canonical(), in_body, lanes),
        }
    }

    /// Whether a ray can pass at all.
    pub(crate) fn is_transparent(&self) -> bool {
        self.filter != [0.0; 3]
    }

    /// Whether it is more than Phong's model with plain colors: a law of its own, a texture.
    pub(crate) fn is_full(&self) -> bool {
        !matches!(self.law, MaterialModel::Constant) || self.texture.is_some()
    }

    /// Whether light is lost in the body.
    pub(crate) fn absorbs(&self) -> bool {
        self.absorption != [0.0; 3]
    }

    /// The share of light that is left after a way of this length in the body, meters.
    #[inline(always)]
    pub(crate) fn left_after<R: Float32>(&self, way: R) -> Vector<R> {
        Vector::splat(way, self.absorption).map(
            #[inline(always)]
            |loss| exponential(-(loss * way)),
        )
    }
}

/// The width of the slopes of facets, evenly stepped for the eye (B. Burley 2012, Physically based shading at Disney).
fn alpha(roughness: f64) -> f32 {
    /// Directions of single precision are not told apart more finely, and 1/α⁴ stays finite.
    const LEAST: f64 = 1e-6;
    if roughness > 0.0 { (roughness * roughness).max(LEAST) as f32 } else { 0.0 }
}

/// The reflectance of a clear surface in air for light that falls in straight.
fn reflectance(ior: f64) -> f64 {
    fresnel::dielectric(1.0, ior).mean()
}

/// The law of P. Bouguer (1729), J. H. Lambert (1760) and A. Beer (1852), for each meter.
fn absorption(attenuation: &Attenuation) -> [f32; 3] {
    /// After a micrometer nothing is left; more would be infinite in products.
    const MOST: f64 = 1e8;
    let left = attenuation.color.to_array();
    left.map(|left| (-left.min(1.0).ln() / attenuation.distance).clamp(0.0, MOST) as f32)
}

/// The named materials of a scene.
pub(crate) type NamedMaterials<'a> = HashMap<&'a str, &'a Material>;

/// The materials that some bodies use, each distinct one once, in the order of their first use.
#[derive(Default)]
pub(crate) struct MaterialTable<'a> {
    indices: HashMap<MaterialKey<'a>, u32>,
    of_names: HashMap<&'a str, (u32, &'a Material)>,
    prepared: Vec<RenderMaterial>,
    keys: Vec<MaterialKey<'a>>,
}

impl<'a> MaterialTable<'a> {
    /// The named materials of `scene`; of two with one name the last.
    pub(crate) fn named(scene: &'a Scene) -> NamedMaterials<'a> {
        scene.materials.iter().map(|named| (named.name.as_str(), &named.material)).collect()
    }

    /// The index of a body's material and its source, or `None` if it is not defined.
    pub(crate) fn find(
        &mut self,
        named: &NamedMaterials<'a>,
        choice: &'a MaterialChoice,
    ) -> Option<(u32, &'a Material)> {
        match choice {
            MaterialChoice::Inline(material) => {
                Some((self.index(MaterialKey::new(material), || RenderMaterial::new(material)), material))
            }
            MaterialChoice::Named(name) => {
                if let Some(found) = self.of_names.get(name.as_str()) {
                    return Some(*found);
                }
                let material = *named.get(name.as_str())?;
                let index = self.index(MaterialKey::new(material), || RenderMaterial::new(material));
                self.of_names.insert(name, (index, material));
                Some((index, material))
            }
        }
    }

    fn index(&mut self, key: MaterialKey<'a>, prepare: impl FnOnce() -> RenderMaterial) -> u32 {
        *self.indices.entry(key).or_insert_with_key(|key| {
            self.prepared.push(prepare());
            self.keys.push(key.clone());
            self.prepared.len() as u32 - 1
        })
    }

    /// Takes over the materials of another table and returns their indices in this one.
    pub(crate) fn append(&mut self, other: &Self) -> Vec<u32> {
        let materials = other.keys.iter().zip(&other.prepared);
        materials.map(|(key, material)| self.index(key.clone(), || material.clone())).collect()
    }

    /// The prepared material of an index that [`Self::find`] gave.
    pub(crate) fn prepared(&self, index: u32) -> &RenderMaterial {
        &self.prepared[index as usize]
    }

    pub(crate) fn into_prepared(self) -> Vec<RenderMaterial> {
        self.prepared
    }
}

/// What a [`RenderMaterial`] is prepared from, as the key of a table: a material without its pattern.
#[derive(Clone, PartialEq)]
struct MaterialKey<'a>(Cow<'a, Material>);

/// A material with a number that is NaN equals nothing, itself included: it is prepared for each body anew.
impl Eq for MaterialKey<'_> {}

impl<'a> MaterialKey<'a> {
    fn new(material: &'a Material) -> Self {
        let mut key = Cow::Borrowed(material);
        if material.pattern().is_some_and(|pattern| pattern.solid.is_some())
            && let Some(pattern) = key.to_mut().pattern_mut()
        {
            pattern.solid = None;
        }
        Self(key)
    }
}

impl Hash for MaterialKey<'_> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.model().hash(state);
        match &*self.0 {
            Material::Phong(Phong {
                pattern,
                ambient,
                diffuse,
                specular,
                shininess,
                reflection,
                transmission,
                ior,
                tint,
                fresnel,
            }) => {
                fresnel.hash(state);
                hash_pattern(pattern, state);
                hash_numbers(&[*ambient, *diffuse, *specular, *shininess, *transmission, *ior], state);
                hash_numbers(reflection.as_slice(), state);
                hash_numbers(&tint.to_array(), state);
            }
            Material::Dielectric(Dielectric { index, dispersion, attenuation, roughness }) => {
                hash_numbers(&[index.ior(), attenuation.distance, *roughness], state);
                hash_numbers(&attenuation.color.to_array(), state);
                dispersion.hash(state);
            }
            Material::Conductor(Conductor { metal, roughness }) => {
                match metal {
                    MetalOptics::Metal(metal) => metal.name.hash(state),
                    MetalOptics::Index { n, k } => {
                        hash_numbers(&n.to_array(), state);
                        hash_numbers(&k.to_array(), state);
                    }
                }
                hash_numbers(&[*roughness], state);
            }
            Material::Mirror(Mirror { pattern, reflection, roughness }) => {
                hash_pattern(pattern, state);
                hash_numbers(reflection.as_slice(), state);
                hash_numbers(&[*roughness], state);
            }
            Material::Matte(Matte { pattern, ambient }) => {
                hash_pattern(pattern, state);
                hash_numbers(&[*ambient], state);
            }
            Material::ThinDielectric(ThinDielectric { ior, tint }) => {
                hash_numbers(&[*ior], state);
                hash_numbers(&tint.to_array(), state);
            }
            Material::Coated(Coated { pattern, ambient, ior, roughness }) => {
                hash_pattern(pattern, state);
                hash_numbers(&[*ambient, *ior, *roughness], state);
            }
        }
    }
}

fn hash_pattern(pattern: &Pattern, state: &mut impl Hasher) {
    hash_numbers(&pattern.color.to_array(), state);
    pattern.texture.as_ref().map(Image::source).hash(state);
}

fn hash_numbers(numbers: &[f64], state: &mut impl Hasher) {
    for number in numbers {
        // Adding zero gives both zeros, which are equal, the same bits.
        (number + 0.0).to_bits().hash(state);
    }
}
