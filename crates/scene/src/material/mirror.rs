//! Mirrors.

use crate::material::{Pattern, Share, largest};

/// Reflects its color under every angle.
#[derive(Clone, Debug, PartialEq)]
pub struct Mirror {
    /// What it reflects of white light.
    pub pattern: Pattern,
    /// Reflection coefficient k_r; `None` (the default) is 1.
    pub reflection: Option<f64>,
    /// How rough the surface is, 0 (the default, smooth) to 1: the square root of the width α of the slopes of its
    /// facets.
    pub roughness: f64,
}

impl Mirror {
    pub(crate) const DEFAULT: Self = Self { pattern: Pattern::DEFAULT, reflection: None, roughness: 0.0 };

    /// Reflection coefficient k_r after its default.
    pub fn reflection(&self) -> f64 {
        self.reflection.unwrap_or(1.0)
    }

    pub(super) fn reflects(&self) -> Share {
        Share::always(self.reflection() * largest(self.pattern.brightest()))
    }
}

impl Default for Mirror {
    fn default() -> Self {
        Self::DEFAULT
    }
}
