//! An open cone: a cone or frustum without its caps.

use glam::DVec3;

use super::{Expansion, Parametric, part, round_extent};
use crate::shape::{Shape, VisibleSide};

/// The curved surface of a cone from the origin along +Y. It has no inside.
///
/// ```toml
/// [[bodies]]
/// shape = "open-cone"
/// radius = 0.5
/// top_radius = 0.2
/// height = 2.0
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OpenCone {
    /// Radius of the lower rim. Default 0.5.
    pub radius: f64,
    /// Radius of the upper rim; 0 (the default) makes a pointed cone.
    pub top_radius: f64,
    /// Default 1.
    pub height: f64,
    /// The sides that rays meet. Default both.
    pub side: VisibleSide,
}

impl Default for OpenCone {
    fn default() -> Self {
        Self { radius: 0.5, top_radius: 0.0, height: 1.0, side: VisibleSide::Both }
    }
}

impl Parametric for OpenCone {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "radius" => Some(&mut self.radius),
            "top_radius" => Some(&mut self.top_radius),
            "height" => Some(&mut self.height),
            _ => None,
        }
    }

    fn side_mut(&mut self) -> Option<&mut VisibleSide> {
        Some(&mut self.side)
    }

    fn extent(&self) -> [DVec3; 2] {
        round_extent(self.radius.max(self.top_radius), 0.0, self.height)
    }

    fn expansion(&self) -> Expansion {
        let Self { radius, top_radius, height, side } = *self;
        Expansion::surface(side, part(Shape::Cone { radius, top_radius, height }, 0.0), [])
    }
}
