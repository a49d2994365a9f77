//! Window panes, glass bulbs.

use catoptric_optics::fresnel;

use crate::color::Color;
use crate::material::{RefractiveIndex, Share, largest};

/// The body's surface is a thin sheet of a clear substance with air on both sides: it reflects by Fresnel's formulas, and
/// light that passes goes straight on.
#[derive(Clone, Debug, PartialEq)]
pub struct ThinDielectric {
    /// Index of refraction η of the sheet relative to air. Default 1.5.
    pub ior: f64,
    /// What is left of white light that goes through the sheet, of each channel. Default white.
    pub tint: Color,
}

impl ThinDielectric {
    pub(crate) const DEFAULT: Self = Self { ior: RefractiveIndex::DEFAULT_IOR, tint: Color::WHITE };

    pub(super) fn reflects(&self) -> Share {
        if self.ior == 1.0 {
            Share::always(0.0)
        } else {
            Share::fresnel(fresnel::sheet(1.0, self.ior).mean())
        }
    }

    pub(super) fn lets_through(&self) -> Share {
        let most = largest(self.tint);
        Share { straight: (1.0 - fresnel::sheet(1.0, self.ior).mean()) * most, most }
    }
}

impl Default for ThinDielectric {
    fn default() -> Self {
        Self::DEFAULT
    }
}
