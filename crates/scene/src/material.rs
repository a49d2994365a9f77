//! Materials: what surfaces do with light, by one of several models.

mod coated;
mod conductor;
mod dielectric;
mod matte;
mod mirror;
mod pattern;
mod phong;
mod solid;
mod thin_dielectric;

use catoptric_optics::Dispersion;

use crate::color::Color;
use crate::keyed::keyed;
pub use crate::material::coated::Coated;
pub use crate::material::conductor::{Conductor, MetalOptics};
pub(crate) use crate::material::conductor::{DEFAULT_METAL, METAL_NAMES};
pub(crate) use crate::material::dielectric::SUBSTANCE_NAMES;
pub use crate::material::dielectric::{Attenuation, Dielectric, RefractiveIndex};
pub use crate::material::matte::Matte;
pub use crate::material::mirror::Mirror;
pub use crate::material::pattern::Pattern;
pub use crate::material::phong::{FresnelTerm, Phong};
pub use crate::material::solid::{PatternSpace, SolidKind, SolidTexture};
pub use crate::material::thin_dielectric::ThinDielectric;

/// The material of a surface: its model with the model's own numbers, of which none is negative. Default Phong's.
#[derive(Clone, Debug, PartialEq)]
pub enum Material {
    /// Phong's and Whitted's coefficients.
    Phong(Phong),
    /// A clear substance.
    Dielectric(Dielectric),
    /// A metal.
    Conductor(Conductor),
    /// An ideal mirror.
    Mirror(Mirror),
    /// A surface that scatters light evenly.
    Matte(Matte),
    /// A matte surface under a clear coat.
    Coated(Coated),
    /// A thin sheet of a clear substance.
    ThinDielectric(ThinDielectric),
}

/// The model of a material.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Model {
    /// [`Phong`].
    #[default]
    Phong,
    /// [`Dielectric`].
    Dielectric,
    /// [`Conductor`].
    Conductor,
    /// [`Mirror`].
    Mirror,
    /// [`Matte`].
    Matte,
    /// [`Coated`].
    Coated,
    /// [`ThinDielectric`].
    ThinDielectric,
}

keyed!(Model {
    Phong = "phong",
    Dielectric = "dielectric",
    Conductor = "conductor",
    Mirror = "mirror",
    Matte = "matte",
    Coated = "coated",
    ThinDielectric = "thin-dielectric",
});

impl Material {
    /// The model.
    pub const fn model(&self) -> Model {
        match self {
            Self::Phong(_) => Model::Phong,
            Self::Dielectric(_) => Model::Dielectric,
            Self::Conductor(_) => Model::Conductor,
            Self::Mirror(_) => Model::Mirror,
            Self::Matte(_) => Model::Matte,
            Self::Coated(_) => Model::Coated,
            Self::ThinDielectric(_) => Model::ThinDielectric,
        }
    }

    /// The material as another model has it: what both models have is kept, the rest is at its default.
    #[must_use]
    pub fn with_model(&self, model: Model) -> Self {
        if model == self.model() { self.clone() } else { Self::from(model).with_shared(self) }
    }

    /// The material with the numbers of another as far as both models have them: pattern, ambient and reflection
    /// coefficient, index of refraction (unless it is a substance's), tint, roughness.
    #[must_use]
    pub fn with_shared(mut self, other: &Self) -> Self {
        if let (Some(own), Some(pattern)) = (self.pattern_mut(), other.pattern()) {
            own.clone_from(pattern);
        }
        if let (Some(own), Some(ambient)) = (self.ambient_mut(), other.ambient()) {
            *own = ambient;
        }
        if let (
            Self::Phong(Phong { reflection: own, .. }) | Self::Mirror(Mirror { reflection: own, .. }),
            Self::Phong(Phong { reflection, .. }) | Self::Mirror(Mirror { reflection, .. }),
        ) = (&mut self, other)
        {
            *own = *reflection;
        }
        if let (Some(own), Some(ior)) = (self.ior_mut(), other.ior()) {
            *own = ior;
        }
        if let (Some(own), Some(tint)) = (self.tint_mut(), other.tint()) {
            *own = tint;
        }
        if let (Some(own), Some(roughness)) = (self.roughness_mut(), other.roughness()) {
            *own = roughness;
        }
        self
    }

    /// Phong's coefficients, if that is the model.
    pub const fn as_phong(&self) -> Option<&Phong> {
        if let Self::Phong(phong) = self { Some(phong) } else { None }
    }

    /// Phong's coefficients, to be changed, if that is the model.
    pub const fn as_phong_mut(&mut self) -> Option<&mut Phong> {
        if let Self::Phong(phong) = self { Some(phong) } else { None }
    }

    /// The color of the body; `None` where the model has its color from the substance.
    pub const fn pattern(&self) -> Option<&Pattern> {
        match self {
            Self::Phong(Phong { pattern, .. })
            | Self::Mirror(Mirror { pattern, .. })
            | Self::Matte(Matte { pattern, .. })
            | Self::Coated(Coated { pattern, .. }) => Some(pattern),
            Self::Dielectric(_) | Self::Conductor(_) | Self::ThinDielectric(_) => None,
        }
    }

    /// The color of the body, to be changed.
    pub const fn pattern_mut(&mut self) -> Option<&mut Pattern> {
        match self {
            Self::Phong(Phong { pattern, .. })
            | Self::Mirror(Mirror { pattern, .. })
            | Self::Matte(Matte { pattern, .. })
            | Self::Coated(Coated { pattern, .. }) => Some(pattern),
            Self::Dielectric(_) | Self::Conductor(_) | Self::ThinDielectric(_) => None,
        }
    }

    /// The ambient coefficient k_a, where the model scatters light.
    pub const fn ambient(&self) -> Option<f64> {
        match *self {
            Self::Phong(Phong { ambient, .. })
            | Self::Matte(Matte { ambient, .. })
            | Self::Coated(Coated { ambient, .. }) => Some(ambient),
            Self::Dielectric(_) | Self::Conductor(_) | Self::Mirror(_) | Self::ThinDielectric(_) => None,
        }
    }

    /// The ambient coefficient k_a, to be changed.
    pub const fn ambient_mut(&mut self) -> Option<&mut f64> {
        match self {
            Self::Phong(Phong { ambient, .. })
            | Self::Matte(Matte { ambient, .. })
            | Self::Coated(Coated { ambient, .. }) => Some(ambient),
            Self::Dielectric(_) | Self::Conductor(_) | Self::Mirror(_) | Self::ThinDielectric(_) => None,
        }
    }

    /// The reflection coefficient k_r after its default, where the model has one.
    pub fn reflection(&self) -> Option<f64> {
        match self {
            Self::Phong(phong) => Some(phong.reflection()),
            Self::Mirror(mirror) => Some(mirror.reflection()),
            Self::Dielectric(_)
            | Self::Conductor(_)
            | Self::Matte(_)
            | Self::Coated(_)
            | Self::ThinDielectric(_) => None,
        }
    }

    /// The index of refraction of yellow light relative to air, where the model refracts light.
    pub fn ior(&self) -> Option<f64> {
        match self {
            Self::Phong(Phong { ior, .. })
            | Self::Coated(Coated { ior, .. })
            | Self::ThinDielectric(ThinDielectric { ior, .. }) => Some(*ior),
            Self::Dielectric(dielectric) => Some(dielectric.index.ior()),
            Self::Conductor(_) | Self::Mirror(_) | Self::Matte(_) => None,
        }
    }

    /// The index of refraction, to be changed; `None` also where it is a measured substance's.
    pub const fn ior_mut(&mut self) -> Option<&mut f64> {
        match self {
            Self::Phong(Phong { ior, .. })
            | Self::Coated(Coated { ior, .. })
            | Self::ThinDielectric(ThinDielectric { ior, .. })
            | Self::Dielectric(Dielectric { index: RefractiveIndex::Own { ior, .. }, .. }) => Some(ior),
            Self::Dielectric(_) | Self::Conductor(_) | Self::Mirror(_) | Self::Matte(_) => None,
        }
    }

    /// The tint τ of light that passes, where the model has one.
    pub const fn tint(&self) -> Option<Color> {
        match *self {
            Self::Phong(Phong { tint, .. }) | Self::ThinDielectric(ThinDielectric { tint, .. }) => Some(tint),
            Self::Dielectric(_) | Self::Conductor(_) | Self::Mirror(_) | Self::Matte(_) | Self::Coated(_) => {
                None
            }
        }
    }

    /// The tint τ of light that passes, to be changed.
    pub const fn tint_mut(&mut self) -> Option<&mut Color> {
        match self {
            Self::Phong(Phong { tint, .. }) | Self::ThinDielectric(ThinDielectric { tint, .. }) => Some(tint),
            Self::Dielectric(_) | Self::Conductor(_) | Self::Mirror(_) | Self::Matte(_) | Self::Coated(_) => {
                None
            }
        }
    }

    /// The roughness of the surface, 0 to 1, where the model has one.
    pub const fn roughness(&self) -> Option<f64> {
        match *self {
            Self::Dielectric(Dielectric { roughness, .. })
            | Self::Conductor(Conductor { roughness, .. })
            | Self::Mirror(Mirror { roughness, .. })
            | Self::Coated(Coated { roughness, .. }) => Some(roughness),
            Self::Phong(_) | Self::Matte(_) | Self::ThinDielectric(_) => None,
        }
    }

    /// The roughness of the surface, to be changed.
    pub const fn roughness_mut(&mut self) -> Option<&mut f64> {
        match self {
            Self::Dielectric(Dielectric { roughness, .. })
            | Self::Conductor(Conductor { roughness, .. })
            | Self::Mirror(Mirror { roughness, .. })
            | Self::Coated(Coated { roughness, .. }) => Some(roughness),
            Self::Phong(_) | Self::Matte(_) | Self::ThinDielectric(_) => None,
        }
    }

    /// A color that stands for it in a list: that of its ground, of its reflection, or of its depth.
    pub fn emblem(&self) -> Color {
        match self {
            Self::Phong(Phong { pattern, .. })
            | Self::Mirror(Mirror { pattern, .. })
            | Self::Matte(Matte { pattern, .. })
            | Self::Coated(Coated { pattern, .. }) => pattern.mean(),
            Self::Dielectric(dielectric) => dielectric.attenuation.color,
            Self::ThinDielectric(sheet) => sheet.tint,
            Self::Conductor(conductor) => conductor.metal.color(),
        }
    }

    /// What it reflects, in the strongest channel.
    pub fn reflects(&self) -> Share {
        match self {
            Self::Phong(phong) => phong.reflects(),
            Self::Dielectric(dielectric) => dielectric.reflects(),
            Self::Conductor(conductor) => conductor.reflects(),
            Self::Mirror(mirror) => mirror.reflects(),
            Self::Matte(_) => Share::always(0.0),
            Self::Coated(coated) => coated.reflects(),
            Self::ThinDielectric(sheet) => sheet.reflects(),
        }
    }

    /// What it lets through, in the strongest channel; of what is lost in the body nothing is known here.
    pub fn lets_through(&self) -> Share {
        match self {
            Self::Phong(phong) => phong.lets_through(),
            Self::Dielectric(dielectric) => dielectric.lets_through(),
            Self::ThinDielectric(sheet) => sheet.lets_through(),
            Self::Conductor(_) | Self::Mirror(_) | Self::Matte(_) | Self::Coated(_) => Share::always(0.0),
        }
    }

    /// Whether lights are seen in it as highlights.
    pub fn has_highlight(&self) -> bool {
        matches!(self, Self::Phong(phong) if phong.specular > 0.0)
    }

    /// Whether it reflects and refracts by facets that are turned every which way: it has neither image points nor
    /// focal points.
    pub fn is_rough(&self) -> bool {
        self.roughness().is_some_and(|roughness| roughness > 0.0)
    }

    /// The index of refraction by wavelength, if it differs.
    pub fn dispersion(&self) -> Option<Dispersion> {
        match self {
            Self::Dielectric(dielectric) => dielectric.dispersion(),
            Self::Phong(_)
            | Self::Conductor(_)
            | Self::Mirror(_)
            | Self::Matte(_)
            | Self::Coated(_)
            | Self::ThinDielectric(_) => None,
        }
    }
}

impl Default for Material {
    fn default() -> Self {
        Self::from(Model::default())
    }
}

/// The default of a model.
impl From<Model> for Material {
    fn from(model: Model) -> Self {
        match model {
            Model::Phong => Phong::default().into(),
            Model::Dielectric => Dielectric::default().into(),
            Model::Conductor => Conductor::default().into(),
            Model::Mirror => Mirror::default().into(),
            Model::Matte => Matte::default().into(),
            Model::Coated => Coated::default().into(),
            Model::ThinDielectric => ThinDielectric::default().into(),
        }
    }
}

macro_rules! models {
    ($($model:ident),+) => {
        $(impl From<$model> for Material {
            fn from(model: $model) -> Self {
                Self::$model(model)
            }
        })+
    };
}

models!(Phong, Dielectric, Conductor, Mirror, Matte, Coated, ThinDielectric);

/// The strongest channel of a color.
fn largest(color: Color) -> f64 {
    color.to_array().into_iter().fold(0.0, f64::max)
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

    /// A share by Fresnel's formulas, which reaches 1 under some angle.
    const fn fresnel(straight: f64) -> Self {
        Self { straight, most: 1.0 }
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
    /// A material of the body's own.
    pub fn own(material: impl Into<Material>) -> Self {
        Self::Inline(Box::new(material.into()))
    }

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
