//! Materials: Whitted's and Phong's coefficients, and what surfaces of glass, metal and plastic do.

use catoptric_optics::{CLEAR, ClearSubstance, Dispersion, METALS, Metal, fresnel};
use glam::DVec3;

use crate::color::Color;
use crate::image::Image;

/// The reflection model of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Model {
    /// The coefficients of
    /// `I = k_a·C·I_a + Σ_j V_j·A(d_j)·I_j·[k_d·C·(n̂·L̂_j) + k_s·(Ŝ·R̂_j)ⁿ] + k_r·I_reflected + k_t·τ·I_refracted`
    /// (Phong 1975; Whitted 1980, eq. 2), independent of each other.
    #[default]
    Phong,
    /// The smooth or rough boundary of a clear substance: reflects by Fresnel's formulas, and lets through the rest.
    Dielectric,
    /// The smooth or rough surface of a metal: reflects by Fresnel's formulas, and lets nothing through.
    Conductor,
    /// Reflects its color under every angle.
    Mirror,
    /// Scatters its color to all sides (J. H. Lambert 1760).
    Matte,
    /// Matte under a clear coat: plastic, lacquer, glazed ceramic.
    Coated,
}

impl Model {
    /// All, in the order of the format.
    pub const ALL: [Self; 6] =
        [Self::Phong, Self::Dielectric, Self::Conductor, Self::Mirror, Self::Matte, Self::Coated];

    /// The word in scene files.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Phong => "phong",
            Self::Dielectric => "dielectric",
            Self::Conductor => "conductor",
            Self::Mirror => "mirror",
            Self::Matte => "matte",
            Self::Coated => "coated",
        }
    }

    /// Whether the body's color, texture and checker are seen.
    pub const fn has_color(self) -> bool {
        !matches!(self, Self::Dielectric | Self::Conductor)
    }

    /// The model of this word.
    pub fn of_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|model| model.key() == key)
    }
}

/// The substance of a conductor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Conductor {
    /// A measured metal.
    Metal(&'static Metal),
    /// Refractive index n and extinction coefficient k for red, green and blue light.
    Index {
        /// n.
        n: DVec3,
        /// k.
        k: DVec3,
    },
}

impl Default for Conductor {
    fn default() -> Self {
        Self::Metal(&METALS[DEFAULT_METAL])
    }
}

/// The metal that a conductor is unless it says otherwise.
pub(crate) const DEFAULT_METAL: usize = {
    let mut at = 0;
    while !is_same(METALS[at].name, "silver") {
        at += 1;
    }
    at
};

/// Names of metals, for scene files.
pub(crate) const METAL_NAMES: [&str; METALS.len()] = {
    let mut names = [""; METALS.len()];
    let mut at = 0;
    while at < names.len() {
        names[at] = METALS[at].name;
        at += 1;
    }
    names
};

/// Names of clear substances, for scene files.
pub(crate) const SUBSTANCE_NAMES: [&str; CLEAR.len()] = {
    let mut names = [""; CLEAR.len()];
    let mut at = 0;
    while at < names.len() {
        names[at] = CLEAR[at].name;
        at += 1;
    }
    names
};

const fn is_same(one: &str, other: &str) -> bool {
    let (one, other) = (one.as_bytes(), other.as_bytes());
    let mut at = 0;
    while at < one.len() && at < other.len() && one[at] == other[at] {
        at += 1;
    }
    at == one.len() && at == other.len()
}

/// The material of a surface. The model decides which numbers count; a scene file has no others. None is negative.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// What the surface does with light. Default [`Model::Phong`].
    pub model: Model,
    /// Color C of the body; of a mirror, what it reflects. Default gray 0.8.
    pub color: Color,
    /// Ambient coefficient k_a. Default 0.1.
    pub ambient: f64,
    /// Diffuse coefficient k_d. Default 0.9.
    pub diffuse: f64,
    /// Highlight coefficient k_s. Default 0.
    pub specular: f64,
    /// Highlight exponent n. Default 32.
    pub shininess: f64,
    /// Reflection coefficient k_r; `None` (the default) takes the same value as `specular`, and 1 for a mirror.
    pub reflection: Option<f64>,
    /// Transmission coefficient k_t; 0 (the default) is opaque.
    pub transmission: f64,
    /// Index of refraction η relative to air. Default 1.5.
    pub ior: f64,
    /// Tint τ of transmitted light. Default white.
    pub tint: Color,
    /// A picture on the body, in the place of its color. Default none.
    ///
    /// It is wrapped once around spheres, cylinders and cones, seen upright from outside, its middle towards z; it
    /// covers each face of a cube and, as far as a circle goes, each cap; on a plane it is repeated every meter.
    pub texture: Option<Image>,
    /// A second color in a checkerboard. Default none.
    pub checker: Option<Checker>,
    /// What a dielectric is made of, in the place of `ior`. Default none.
    pub substance: Option<&'static ClearSubstance>,
    /// Whether a dielectric bends light of different colors differently. Default false.
    pub dispersion: bool,
    /// How much it does so, unless it is a `substance`: the Abbe number. Default 58.
    pub abbe: f64,
    /// Color that white light has after [`attenuation_distance`](Self::attenuation_distance) in a dielectric. Default
    /// white.
    pub attenuation_color: Color,
    /// Meters. Default 1.
    pub attenuation_distance: f64,
    /// What a conductor is. Default silver.
    pub conductor: Conductor,
    /// How rough the surface is that reflects, 0 (the default, smooth) to 1: the square root of the width α of the
    /// slopes of its facets.
    pub roughness: f64,
}

impl Material {
    /// Reflection coefficient k_r after its default.
    pub fn reflection(&self) -> f64 {
        self.reflection.unwrap_or(if self.model == Model::Mirror { 1.0 } else { self.specular })
    }

    /// The most that its color can be, of each channel, but for a checker's: of a texture, that of its pixels.
    pub fn brightest(&self) -> Color {
        match &self.texture {
            Some(image) if image.pixels().is_some() && self.model.has_color() => image.brightest(),
            _ => self.color,
        }
    }

    /// A color that stands for it in a list: that of its ground, of its reflection, or of its depth.
    pub fn emblem(&self) -> Color {
        match (self.model, self.conductor) {
            (Model::Dielectric, _) => self.attenuation_color,
            (Model::Conductor, Conductor::Metal(metal)) => Color::from(metal.reflectance(1.0, 1.0)),
            (Model::Conductor, Conductor::Index { n, k }) => {
                let straight = |n, k| fresnel::conductor(1.0, n, k).mean();
                Color::new(straight(n.x, k.x), straight(n.y, k.y), straight(n.z, k.z))
            }
            _ => match &self.texture {
                Some(image) if image.pixels().is_some() => image.mean(),
                _ => self.color,
            },
        }
    }

    /// What it reflects, in the strongest channel.
    pub fn reflects(&self) -> Share {
        let largest = |color: Color| color.to_array().into_iter().fold(0.0, f64::max);
        let fresnel = |straight: f64| Share { straight, most: 1.0 };
        match self.model {
            Model::Phong => Share::always(self.reflection()),
            Model::Matte => Share::always(0.0),
            Model::Mirror => {
                let checker = self.checker.map_or(0.0, |checker| largest(checker.color));
                Share::always(self.reflection() * largest(self.brightest()).max(checker))
            }
            Model::Dielectric if self.ior() == 1.0 => Share::always(0.0),
            Model::Dielectric | Model::Coated => fresnel(fresnel::dielectric(1.0, self.ior()).mean()),
            Model::Conductor => fresnel(match self.conductor {
                Conductor::Metal(metal) => {
                    metal.reflectance(1.0, 1.0).into_iter().fold(0.0, f64::max).min(1.0)
                }
                Conductor::Index { n, k } => {
                    let channels = n.to_array().into_iter().zip(k.to_array());
                    channels.map(|(n, k)| fresnel::conductor(1.0, n, k).mean()).fold(0.0, f64::max)
                }
            }),
        }
    }

    /// What it lets through, in the strongest channel; of what is lost in the body nothing is known here.
    pub fn lets_through(&self) -> Share {
        match self.model {
            Model::Phong => {
                Share::always(self.transmission * self.tint.to_array().into_iter().fold(0.0, f64::max))
            }
            Model::Dielectric => {
                let straight = 1.0 - fresnel::dielectric(1.0, self.ior()).mean();
                Share { straight, most: 1.0 }
            }
            Model::Conductor | Model::Mirror | Model::Matte | Model::Coated => Share::always(0.0),
        }
    }

    /// Whether lights are seen in it as highlights.
    pub fn has_highlight(&self) -> bool {
        self.model == Model::Phong && self.specular > 0.0
    }

    /// Whether it reflects and refracts by facets that are turned every which way: it has neither image points nor
    /// focal points.
    pub fn is_rough(&self) -> bool {
        self.roughness > 0.0 && !matches!(self.model, Model::Phong | Model::Matte)
    }

    /// The index of refraction by wavelength, if it differs.
    pub fn dispersion(&self) -> Option<Dispersion> {
        let differs = self.dispersion && self.model == Model::Dielectric;
        differs.then(|| match self.substance {
            Some(substance) => substance.dispersion,
            None => Dispersion::from_abbe(self.ior, self.abbe),
        })
    }

    /// The index of refraction of yellow light, relative to air.
    pub fn ior(&self) -> f64 {
        match self.substance {
            Some(substance) if self.model == Model::Dielectric => {
                substance.dispersion.index(catoptric_optics::FraunhoferLines::D)
            }
            _ => self.ior,
        }
    }
}

/// The share of the incident light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// Of light that falls in straight.
    pub straight: f64,
    /// Under the angle where it is most.
    pub most: f64,
}

impl Share {
    /// An equal share under every angle.
    const fn always(share: f64) -> Self {
        Self { straight: share, most: share }
    }
}

impl Default for Material {
    fn default() -> Self {
        Self {
            model: Model::Phong,
            color: Color::gray(0.8),
            ambient: 0.1,
            diffuse: 0.9,
            specular: 0.0,
            shininess: 32.0,
            reflection: None,
            transmission: 0.0,
            ior: 1.5,
            tint: Color::WHITE,
            texture: None,
            checker: None,
            substance: None,
            dispersion: false,
            abbe: 58.0,
            attenuation_color: Color::WHITE,
            attenuation_distance: 1.0,
            conductor: Conductor::default(),
            roughness: 0.0,
        }
    }
}

/// Checkerboard: the cell (⌊x/s⌋ + ⌊y/s⌋ + ⌊z/s⌋) of a point takes the material's color when even, this one when odd.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checker {
    /// Color of odd cells. Default gray 0.2.
    pub color: Color,
    /// Edge length s of a cell, meters. Default 1.
    pub size: f64,
    /// Whose x, y and z these are. Default the world's.
    pub space: CheckerSpace,
}

impl Default for Checker {
    fn default() -> Self {
        Self { color: Color::gray(0.2), size: 1.0, space: CheckerSpace::World }
    }
}

/// The space in which a checkerboard is laid out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum CheckerSpace {
    /// The world: bodies move through it.
    #[default]
    World,
    /// The body, from its own origin, along its own axes: it moves and turns with the body. Cells keep their size when
    /// the body is scaled.
    Body,
}

impl CheckerSpace {
    /// Both, in the order of the format.
    pub const ALL: [Self; 2] = [Self::World, Self::Body];

    /// The word in scene files.
    pub const fn key(self) -> &'static str {
        match self {
            Self::World => "world",
            Self::Body => "body",
        }
    }
}

/// A material that bodies share by name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedMaterial {
    /// Unique name.
    pub name: String,
    /// The coefficients.
    pub material: Material,
}

/// The material of a body: its own or a named one.
#[derive(Clone, Debug, PartialEq)]
pub enum MaterialChoice {
    /// One of the scene's named materials.
    Named(String),
    /// The body's own.
    Inline(Box<Material>),
}

impl MaterialChoice {
    /// The name, unless it is the body's own.
    pub fn name(&self) -> Option<&str> {
        match self {
            Self::Named(name) => Some(name),
            Self::Inline(_) => None,
        }
    }
}

impl Default for MaterialChoice {
    fn default() -> Self {
        Self::Inline(Box::default())
    }
}
