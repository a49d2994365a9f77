//! A tube: a cylinder without the narrower one within it.

use glam::DVec3;

use super::{BrokenSize, Expansion, MARGIN, Parametric, cylinder, round_extent, smaller};

/// A tube from the origin along +Y, open at both ends.
///
/// ```toml
/// [[bodies]]
/// shape = "tube"
/// radius = 0.5
/// inner_radius = 0.4
/// height = 2.0
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tube {
    /// Outer radius. Default 0.5.
    pub radius: f64,
    /// Radius of the bore, less than `radius`. Default 0.4.
    pub inner_radius: f64,
    /// Default 1.
    pub height: f64,
}

impl Default for Tube {
    fn default() -> Self {
        Self { radius: 0.5, inner_radius: 0.4, height: 1.0 }
    }
}

/// What lies between two radii and two heights; the bore reaches past both caps.
pub(super) fn hollow([radius, inner_radius]: [f64; 2], [bottom, top]: [f64; 2]) -> Expansion {
    let past = MARGIN * (top - bottom).max(radius);
    let bore = cylinder(inner_radius, bottom - past, top + past);
    Expansion::difference(cylinder(radius, bottom, top), [bore])
}

impl Parametric for Tube {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "radius" => Some(&mut self.radius),
            "inner_radius" => Some(&mut self.inner_radius),
            "height" => Some(&mut self.height),
            _ => None,
        }
    }

    fn broken_size(&self) -> Option<BrokenSize> {
        smaller("inner_radius", self.inner_radius, "radius", self.radius)
    }

    fn extent(&self) -> [DVec3; 2] {
        round_extent(self.radius, 0.0, self.height)
    }

    fn expansion(&self) -> Expansion {
        hollow([self.radius, self.inner_radius], [0.0, self.height])
    }
}
