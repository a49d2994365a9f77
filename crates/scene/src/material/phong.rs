//! Phong's and Whitted's coefficients.

use catoptric_optics::fresnel::schlick;

use crate::color::Color;
use crate::keyed::keyed;
use crate::material::{Pattern, Share, largest};

/// The coefficients of
/// `I = k_a·C·I_a + Σ_j V_j·A(d_j)·I_j·[k_d·C·(n̂·L̂_j) + k_s·(Ŝ·R̂_j)ⁿ] + k_r·I_reflected + k_t·τ·I_refracted`
/// (Phong 1975; Whitted 1980, eq. 2), independent of each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Phong {
    /// Color C.
    pub pattern: Pattern,
    /// Ambient coefficient k_a. Default 0.1.
    pub ambient: f64,
    /// Diffuse coefficient k_d. Default 0.9.
    pub diffuse: f64,
    /// Highlight coefficient k_s. Default 0.
    pub specular: f64,
    /// Highlight exponent n. Default 32.
    pub shininess: f64,
    /// Reflection coefficient k_r; `None` (the default) takes the value of `specular`.
    pub reflection: Option<f64>,
    /// Transmission coefficient k_t; 0 (the default) is opaque.
    pub transmission: f64,
    /// Index of refraction η relative to air. Default 1.5.
    pub ior: f64,
    /// Tint τ of transmitted light. Default white.
    pub tint: Color,
    /// How k_r and k_t of a body that lets light through depend on the angle. Default not at all.
    pub fresnel: FresnelTerm,
}

/// How the coefficients of reflection and transmission of a clear body depend on the angle of incidence.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FresnelTerm {
    /// They count under every angle; where no light passes, all of it is reflected.
    #[default]
    Constant,
    /// They count k_r·R and k_t·(1 − R) with R by C. Schlick's formula (1994, An Inexpensive BRDF Model for
    /// Physically-based Rendering, eq. 15), which is 1 at total reflection; k_t counts k_t if k_r is 0 (J. Buck 2019, The
    /// Ray Tracer Challenge, chapter 11).
    Schlick,
}

keyed!(FresnelTerm { Constant = "constant", Schlick = "schlick" });

impl Phong {
    pub(crate) const DEFAULT: Self = Self {
        pattern: Pattern::DEFAULT,
        ambient: 0.1,
        diffuse: 0.9,
        specular: 0.0,
        shininess: 32.0,
        reflection: None,
        transmission: 0.0,
        ior: 1.5,
        tint: Color::WHITE,
        fresnel: FresnelTerm::Constant,
    };

    /// Reflection coefficient k_r after its default.
    pub fn reflection(&self) -> f64 {
        self.reflection.unwrap_or(self.specular)
    }

    pub(super) fn reflects(&self) -> Share {
        let most = self.reflection();
        match self.weighs_by_angle() {
            true => Share { straight: most * self.schlick(), most },
            false => Share::always(most),
        }
    }

    pub(super) fn lets_through(&self) -> Share {
        let most = self.transmission * largest(self.tint);
        match self.weighs_by_angle() && self.reflection() > 0.0 {
            true => Share { straight: most * (1.0 - self.schlick()), most },
            false => Share::always(most),
        }
    }

    /// Whether the coefficients depend on the angle.
    pub fn weighs_by_angle(&self) -> bool {
        self.fresnel == FresnelTerm::Schlick && self.transmission * largest(self.tint) > 0.0
    }

    /// R of light that falls straight on the body in air.
    fn schlick(&self) -> f64 {
        schlick(1.0, self.ior)
    }
}

impl Default for Phong {
    fn default() -> Self {
        Self::DEFAULT
    }
}
