//! Glass, water, gems.

use catoptric_optics::{CLEAR, ClearSubstance, Dispersion, FraunhoferLines, fresnel};

use crate::color::Color;
use crate::material::Share;

/// The smooth or rough boundary of a clear substance: reflects by Fresnel's formulas, and lets through the rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Dielectric {
    /// How much it refracts light. Default η = 1.5 with the Abbe number 58.
    pub index: RefractiveIndex,
    /// Whether it refracts light of different colors differently. Default false.
    pub dispersion: bool,
    /// What light loses inside. Default nothing.
    pub attenuation: Attenuation,
    /// How rough the surface is, 0 (the default, smooth) to 1: the square root of the width α of the slopes of its
    /// facets.
    pub roughness: f64,
}

impl Dielectric {
    pub(crate) const DEFAULT: Self = Self {
        index: RefractiveIndex::DEFAULT,
        dispersion: false,
        attenuation: Attenuation::DEFAULT,
        roughness: 0.0,
    };

    /// The index of refraction by wavelength, if it differs.
    pub fn dispersion(&self) -> Option<Dispersion> {
        self.dispersion.then(|| self.index.dispersion())
    }

    /// The reflectance of light that falls in straight.
    fn reflectance(&self) -> f64 {
        fresnel::dielectric(1.0, self.index.ior()).mean()
    }

    pub(super) fn reflects(&self) -> Share {
        if self.index.ior() == 1.0 { Share::always(0.0) } else { Share::fresnel(self.reflectance()) }
    }

    pub(super) fn lets_through(&self) -> Share {
        Share::fresnel(1.0 - self.reflectance())
    }
}

impl Default for Dielectric {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// How much a clear substance refracts light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RefractiveIndex {
    /// As these numbers say.
    Own {
        /// Index of refraction η of yellow light (589 nm) relative to air. Default 1.5.
        ior: f64,
        /// Abbe number, how little light of different colors is refracted differently. Default 58.
        abbe: f64,
    },
    /// As a measured substance does.
    Substance(&'static ClearSubstance),
}

impl RefractiveIndex {
    pub(crate) const DEFAULT: Self = Self::Own { ior: Self::DEFAULT_IOR, abbe: Self::DEFAULT_ABBE };
    pub(crate) const DEFAULT_IOR: f64 = 1.5;
    pub(crate) const DEFAULT_ABBE: f64 = 58.0;

    /// The index of refraction of yellow light, relative to air.
    pub fn ior(self) -> f64 {
        match self {
            Self::Own { ior, .. } => ior,
            Self::Substance(substance) => substance.dispersion.index(FraunhoferLines::D),
        }
    }

    /// The index of refraction by wavelength.
    pub fn dispersion(self) -> Dispersion {
        match self {
            Self::Own { ior, abbe } => Dispersion::from_abbe(ior, abbe),
            Self::Substance(substance) => substance.dispersion,
        }
    }

    /// The measured substance, if it is one.
    pub fn substance(self) -> Option<&'static ClearSubstance> {
        match self {
            Self::Own { .. } => None,
            Self::Substance(substance) => Some(substance),
        }
    }
}

impl Default for RefractiveIndex {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// An index of refraction of yellow light with the default Abbe number.
impl From<f64> for RefractiveIndex {
    fn from(ior: f64) -> Self {
        Self::Own { ior, abbe: Self::DEFAULT_ABBE }
    }
}

/// What light loses on its way through a clear substance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attenuation {
    /// Color that white light has after [`distance`](Self::distance), at most 1 in each channel. Default white.
    pub color: Color,
    /// Meters. Default 1.
    pub distance: f64,
}

impl Attenuation {
    pub(crate) const DEFAULT: Self = Self { color: Color::WHITE, distance: 1.0 };
}

impl Default for Attenuation {
    fn default() -> Self {
        Self::DEFAULT
    }
}

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
