//! Chalk, plaster, paper.

use crate::material::{Pattern, Phong};

/// Scatters its color to all sides (J. H. Lambert 1760).
#[derive(Clone, Debug, PartialEq)]
pub struct Matte {
    /// Color C.
    pub pattern: Pattern,
    /// Ambient coefficient k_a. Default 0.1.
    pub ambient: f64,
}

impl Matte {
    pub(crate) const DEFAULT: Self = Self { pattern: Pattern::DEFAULT, ambient: Phong::DEFAULT.ambient };
}

impl Default for Matte {
    fn default() -> Self {
        Self::DEFAULT
    }
}
