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
    fn number(&self, key: &str) -> Option<f64> {
        match key {
            "radius" => Some(self.radius),
            "inner_radius" => Some(self.inner_radius),
            "thickness" => Some(self.thickness),
            _ => None,
        }
    }

    fn set_number(&mut self, key: &str, value: f64) {
        match key {
            "radius" => self.radius = value,
            "inner_radius" => self.inner_radius = value,
            "thickness" => self.thickness = value,
            _ => {}
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
