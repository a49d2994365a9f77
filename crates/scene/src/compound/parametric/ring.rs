//! A flat ring: a disc with a hole, such as a washer or a stop of an optical bench.

use glam::DVec3;

use super::tube::hollow;
use super::{BrokenSize, Expansion, Parametric, round_extent, smaller};

/// A flat ring about the origin; its axis is Y.
///
/// ```toml
/// [[bodies]]
/// shape = "ring"
/// radius = 0.5
/// inner_radius = 0.3
/// thickness = 0.1
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ring {
    /// Outer radius. Default 0.5.
    pub radius: f64,
    /// Radius of the hole, less than `radius`. Default 0.3.
    pub inner_radius: f64,
    /// Along the axis. Default 0.1.
    pub thickness: f64,
}

impl Default for Ring {
    fn default() -> Self {
        Self { radius: 0.5, inner_radius: 0.3, thickness: 0.1 }
    }
}

impl Parametric for Ring {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "radius" => Some(&mut self.radius),
            "inner_radius" => Some(&mut self.inner_radius),
            "thickness" => Some(&mut self.thickness),
            _ => None,
        }
    }

    fn broken_size(&self) -> Option<BrokenSize> {
        smaller("inner_radius", self.inner_radius, "radius", self.radius)
    }

    fn extent(&self) -> [DVec3; 2] {
        round_extent(self.radius, -0.5 * self.thickness, 0.5 * self.thickness)
    }

    fn expansion(&self) -> Expansion {
        hollow([self.radius, self.inner_radius], [-0.5 * self.thickness, 0.5 * self.thickness])
    }
}
