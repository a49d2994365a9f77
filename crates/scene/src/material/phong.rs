//! Phong's and Whitted's coefficients.

use crate::color::Color;
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
}

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
    };

    /// Reflection coefficient k_r after its default.
    pub fn reflection(&self) -> f64 {
        self.reflection.unwrap_or(self.specular)
    }

    pub(super) fn reflects(&self) -> Share {
        Share::always(self.reflection())
    }

    pub(super) fn lets_through(&self) -> Share {
        Share::always(self.transmission * largest(self.tint))
    }
}

impl Default for Phong {
    fn default() -> Self {
        Self::DEFAULT
    }
}
