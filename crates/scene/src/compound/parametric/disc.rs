//! A disc: the part of a plane within a circle.

use glam::DVec3;

use super::{Expansion, MARGIN, Parametric, cylinder, part, round_extent};
use crate::shape::{Shape, VisibleSide};

/// A flat disc about the origin with the normal +Y. It has no thickness, and no inside.
///
/// ```toml
/// [[bodies]]
/// shape = "disc"
/// radius = 0.5
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Disc {
    /// Default 0.5.
    pub radius: f64,
    /// The sides that rays meet. Default both.
    pub side: VisibleSide,
}

impl Default for Disc {
    fn default() -> Self {
        Self { radius: 0.5, side: VisibleSide::Both }
    }
}

impl Parametric for Disc {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        (key == "radius").then_some(&mut self.radius)
    }

    fn side_mut(&mut self) -> Option<&mut VisibleSide> {
        Some(&mut self.side)
    }

    fn extent(&self) -> [DVec3; 2] {
        round_extent(self.radius, 0.0, 0.0)
    }

    fn expansion(&self) -> Expansion {
        let half = MARGIN * self.radius;
        Expansion::surface(self.side, part(Shape::Plane, 0.0), [cylinder(self.radius, -half, half)])
    }
}
