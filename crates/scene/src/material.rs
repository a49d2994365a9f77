//! Materials: Whitted's and Phong's coefficients.

use crate::color::Color;

/// How a surface answers light: the coefficients of
/// `I = k_a·C·I_a + Σ_j V_j·A(d_j)·I_j·[k_d·C·(n̂·L̂_j) + k_s·(Ŝ·R̂_j)ⁿ] + k_r·I_reflected + k_t·τ·I_refracted`
/// (Phong 1975; Whitted 1980, eq. 2). Coefficients are independent of each other and not negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Color C of the body. Default gray 0.8.
    pub color: Color,
    /// Ambient coefficient k_a. Default 0.1.
    pub ambient: f64,
    /// Diffuse coefficient k_d. Default 0.9.
    pub diffuse: f64,
    /// Highlight coefficient k_s. Default 0.
    pub specular: f64,
    /// Highlight exponent n. Default 32.
    pub shininess: f64,
    /// Reflection coefficient k_r; `None` (the default) takes the same value as `specular`.
    pub reflection: Option<f64>,
    /// Transmission coefficient k_t; 0 (the default) is opaque.
    pub transmission: f64,
    /// Index of refraction η relative to air. Default 1.5.
    pub ior: f64,
    /// Tint τ of transmitted light. Default white.
    pub tint: Color,
    /// A second color in a checkerboard of the world's axes. Default none.
    pub checker: Option<Checker>,
}

impl Material {
    /// Reflection coefficient k_r after its default.
    pub fn reflection(&self) -> f64 {
        self.reflection.unwrap_or(self.specular)
    }
}

impl Default for Material {
    fn default() -> Self {
        Self {
            color: Color::gray(0.8),
            ambient: 0.1,
            diffuse: 0.9,
            specular: 0.0,
            shininess: 32.0,
            reflection: None,
            transmission: 0.0,
            ior: 1.5,
            tint: Color::WHITE,
            checker: None,
        }
    }
}

/// Checkerboard: the cell (⌊x/s⌋ + ⌊y/s⌋ + ⌊z/s⌋) of a world point takes the material's color when even, this one when odd.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checker {
    /// Color of odd cells. Default gray 0.2.
    pub color: Color,
    /// Edge length s of a cell, meters. Default 1.
    pub size: f64,
}

impl Default for Checker {
    fn default() -> Self {
        Self { color: Color::gray(0.2), size: 1.0 }
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

/// What a body is made of.
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
