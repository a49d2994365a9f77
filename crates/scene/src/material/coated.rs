//! Plastic, lacquer, glazed ceramic.

use catoptric_optics::fresnel;

use crate::material::{Pattern, Phong, RefractiveIndex, Share};

/// Matte under a clear coat.
#[derive(Clone, Debug, PartialEq)]
pub struct Coated {
    /// Color C of the ground.
    pub pattern: Pattern,
    /// Ambient coefficient k_a. Default 0.1.
    pub ambient: f64,
    /// Index of refraction η of the coat relative to air. Default 1.5.
    pub ior: f64,
    /// How rough the coat is, 0 (the default, smooth) to 1: the square root of the width α of the slopes of its facets.
    pub roughness: f64,
}

impl Coated {
    pub(crate) const DEFAULT: Self = Self {
        pattern: Pattern::DEFAULT,
        ambient: Phong::DEFAULT.ambient,
        ior: RefractiveIndex::DEFAULT_IOR,
        roughness: 0.0,
    };

    pub(super) fn reflects(&self) -> Share {
        Share::fresnel(fresnel::dielectric(1.0, self.ior).mean())
    }
}

impl Default for Coated {
    fn default() -> Self {
        Self::DEFAULT
    }
}
