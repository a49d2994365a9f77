//! Materials of the scene.

use std::collections::HashMap;

use catoptric_optics::{CLEAR, Dispersion, METALS, fresnel};
use catoptric_scene::{Color, Conductor, Material, MaterialChoice, Model, Scene};

use crate::geometry::body::RenderBody;
use crate::simd::vector::Vector;
use crate::simd::{Float32, Width};
use crate::transport::color::linear_rgb;
use crate::transport::surface::exponential;
use crate::transport::surface::model::MaterialModel;
use crate::transport::surface::model::coated::CoatedMaterial;
use crate::transport::surface::model::conductor::ConductorTable;
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
        let plain = Self {
            color: linear_rgb(material.color),
            texture: ImageTexture::new(material),
            ambient: material.ambient as f32,
            diffuse: 0.0,
            specular: 0.0,
            shininess: 1.0,
            reflection: 0.0,
            filter: [0.0; 3],
            ior: 1.0,
            law: MaterialModel::Constant,
            dispersion: material.dispersion(),
            alpha: match material.model {
                Model::Phong | Model::Matte => 0.0,
                _ => alpha(material.roughness),
            },
            absorption: [0.0; 3],
        };
        let straight = |ior: f64| fresnel::dielectric(1.0, ior).mean();
        match material.model {
            Model::Phong => Self {
                diffuse: material.diffuse as f32,
                specular: material.specular as f32,
                shininess: material.shininess as f32,
                reflection: material.reflection() as f32,
                filter: linear_rgb(material.tint).map(|tint| tint * material.transmission as f32),
                ior: material.ior as f32,
                ..plain
            },
            Model::Matte => Self { diffuse: 1.0, ..plain },
            Model::Mirror => Self {
                ambient: 0.0,
                reflection: material.reflection() as f32,
                law: MaterialModel::Mirror,
                ..plain
            },
            Model::Dielectric => {
                let reflection = straight(material.ior());
                Self {
                    ambient: 0.0,
                    reflection: reflection as f32,
                    filter: [(1.0 - reflection) as f32; 3],
                    ior: material.ior() as f32,
                    law: MaterialModel::Dielectric,
                    absorption: absorption(material),
                    ..plain
                }
            }
            Model::Conductor => {
                let curve = ConductorTable::of(&material.conductor);
                let [red, green, blue] = curve.at(1.0);
                let reflection = (red + green + blue) / 3.0;
                Self { ambient: 0.0, reflection, law: MaterialModel::Conductor(curve), ..plain }
            }
            Model::Coated => Self {
                color: linear_rgb(material.color).map(|part| part.min(1.0)),
                diffuse: 1.0,
                reflection: straight(material.ior) as f32,
                law: MaterialModel::Coat(CoatedMaterial::new(material.ior)),
                ..plain
            },
        }
    }

    /// The color of a body, but for its checker, where rays `lanes` met it, at these points of its own frame.
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

/// The law of P. Bouguer (1729), J. H. Lambert (1760) and A. Beer (1852), for each meter.
fn absorption(material: &Material) -> [f32; 3] {
    /// After a micrometer nothing is left; more would be infinite in products.
    const MOST: f64 = 1e8;
    let left = material.attenuation_color.to_array();
    left.map(|left| (-left.min(1.0).ln() / material.attenuation_distance).clamp(0.0, MOST) as f32)
}

/// The named materials of a scene.
pub(crate) type NamedMaterials<'a> = HashMap<&'a str, &'a Material>;

/// The materials that some bodies use, each distinct one once, in the order of their first use.
#[derive(Default)]
pub(crate) struct MaterialTable<'a> {
    indices: HashMap<MaterialKey, u32>,
    of_names: HashMap<&'a str, (u32, &'a Material)>,
    prepared: Vec<RenderMaterial>,
    keys: Vec<MaterialKey>,
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
                Some((self.index(key(material), || RenderMaterial::new(material)), material))
            }
            MaterialChoice::Named(name) => {
                if let Some(found) = self.of_names.get(name.as_str()) {
                    return Some(*found);
                }
                let material = *named.get(name.as_str())?;
                let index = self.index(key(material), || RenderMaterial::new(material));
                self.of_names.insert(name, (index, material));
                Some((index, material))
            }
        }
    }

    fn index(&mut self, key: MaterialKey, prepare: impl FnOnce() -> RenderMaterial) -> u32 {
        *self.indices.entry(key).or_insert_with(|| {
            self.prepared.push(prepare());
            self.keys.push(key);
            self.prepared.len() as u32 - 1
        })
    }

    /// Takes over the materials of another table and returns their indices in this one.
    pub(crate) fn append(&mut self, other: &Self) -> Vec<u32> {
        let materials = other.keys.iter().zip(&other.prepared);
        materials.map(|(key, material)| self.index(*key, || material.clone())).collect()
    }

    /// The prepared material of an index that [`Self::find`] gave.
    pub(crate) fn prepared(&self, index: u32) -> &RenderMaterial {
        &self.prepared[index as usize]
    }

    pub(crate) fn into_prepared(self) -> Vec<RenderMaterial> {
        self.prepared
    }
}

/// The model, the picture, and all numbers that reach a [`RenderMaterial`], for comparing exactly.
type MaterialKey = (Model, Option<u64>, [u64; 13]);

fn key(material: &Material) -> MaterialKey {
    let m = material;
    let Color { r, g, b } = m.color;
    let mut numbers = [0.0; 13];
    let mut put = |values: &[f64]| {
        for (number, value) in numbers.iter_mut().zip(values) {
            *number = *value;
        }
    };
    match m.model {
        Model::Phong => put(&[
            r,
            g,
            b,
            m.tint.r,
            m.tint.g,
            m.tint.b,
            m.ambient,
            m.diffuse,
            m.specular,
            m.shininess,
            m.reflection(),
            m.transmission,
            m.ior,
        ]),
        Model::Dielectric => {
            let left = m.attenuation_color;
            put(&[
                m.ior(),
                left.r,
                left.g,
                left.b,
                m.attenuation_distance,
                m.roughness,
                f64::from(u8::from(m.dispersion)),
                m.abbe,
                m.substance.map_or(-1.0, |clear| place_of(CLEAR.iter().map(|other| other.name), clear.name)),
            ]);
        }
        Model::Conductor => match m.conductor {
            Conductor::Metal(metal) => {
                let place = place_of(METALS.iter().map(|other| other.name), metal.name);
                put(&[1.0, place, m.roughness]);
            }
            Conductor::Index { n, k } => put(&[2.0, n.x, n.y, n.z, k.x, k.y, k.z, m.roughness]),
        },
        Model::Mirror => put(&[r, g, b, m.reflection(), m.roughness]),
        Model::Matte => put(&[r, g, b, m.ambient]),
        Model::Coated => put(&[r, g, b, m.ambient, m.ior, m.roughness]),
    }
    (m.model, ImageTexture::new(m).map(|texture| texture.number()), numbers.map(f64::to_bits))
}

/// The place of a name among others, to be told from them.
fn place_of<'t>(mut names: impl Iterator<Item = &'t str>, name: &str) -> f64 {
    names.position(|other| other == name).map_or(-1.0, |place| place as f64)
}
