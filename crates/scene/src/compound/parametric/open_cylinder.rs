//! An open cylinder: a cylinder without its caps.

use glam::DVec3;

use super::{Expansion, Parametric, cylinder, round_extent};
use crate::shape::VisibleSide;

/// The curved surface of a cylinder from the origin along +Y. It has no inside.
///
/// ```toml
/// [[bodies]]
/// shape = "open-cylinder"
/// radius = 0.5
/// height = 2.0
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenCylinder {
    /// Default 0.5.
    pub radius: f64,
    /// Default 1.
    pub height: f64,
    /// The sides that rays meet. Default both.
    pub side: VisibleSide,
}

impl Default for OpenCylinder {
    fn default() -> Self {
        Self { radius: 0.5, height: 1.0, side: VisibleSide::Both }
    }
}

impl Parametric for OpenCylinder {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "radius" => Some(&mut self.radius),
            "height" => Some(&mut self.height),
            _ => None,
        }
    }

    fn side_mut(&mut self) -> Option<&mut VisibleSide> {
        Some(&mut self.side)
    }

    fn extent(&self) -> [DVec3; 2] {
        round_extent(self.radius, 0.0, self.height)
    }

    fn expansion(&self) -> Expansion {
        Expansion::surface(self.side, cylinder(self.radius, 0.0, self.height), [])
    }
}
