//! A rectangle: the part of a plane within four edges.

use glam::DVec3;

use super::{Expansion, MARGIN, Parametric, cuboid, part};
use crate::shape::{Shape, VisibleSide};

/// A flat rectangle about the origin with the normal +Y. It has no thickness, and no inside.
///
/// ```toml
/// [[bodies]]
/// shape = "rectangle"
/// width = 2.0
/// length = 1.0
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// Along X. Default 1.
    pub width: f64,
    /// Along Z. Default 1.
    pub length: f64,
    /// The sides that rays meet. Default both.
    pub side: VisibleSide,
}

impl Default for Rectangle {
    fn default() -> Self {
        Self { width: 1.0, length: 1.0, side: VisibleSide::Both }
    }
}

impl Parametric for Rectangle {
    fn number_mut(&mut self, key: &str) -> Option<&mut f64> {
        match key {
            "width" => Some(&mut self.width),
            "length" => Some(&mut self.length),
            _ => None,
        }
    }

    fn side_mut(&mut self) -> Option<&mut VisibleSide> {
        Some(&mut self.side)
    }

    fn extent(&self) -> [DVec3; 2] {
        let half = 0.5 * DVec3::new(self.width, 0.0, self.length);
        [-half, half]
    }

    fn expansion(&self) -> Expansion {
        let [min, max] = self.extent();
        let across = DVec3::Y * (MARGIN * self.width.max(self.length));
        Expansion::surface(self.side, part(Shape::Plane, 0.0), [cuboid([min - across, max + across])])
    }
}
