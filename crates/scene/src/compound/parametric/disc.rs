//! A disc: the part of a plane within a circle.

use glam::DVec3;

use super::{Expansion, MARGIN, Parametric, cylinder, part, round_extent};
use crate::shape::Shape;

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
}

impl Default for Disc {
    fn default() -> Self {
        Self { radius: 0.5 }
    }
}

impl Parametric for Disc {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        (key == "radius").then_some(&mut self.radius)
    }

    fn extent(&self) -> [DVec3; 2] {
        round_extent(self.radius, 0.0, 0.0)
    }

    fn expansion(&self) -> Expansion {
        let half = MARGIN * self.radius;
        Expansion::surface(part(Shape::Plane, 0.0), [cylinder(self.radius, -half, half)])
    }
}
