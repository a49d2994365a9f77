//! A triangle: the part of a plane between three corners.

use glam::DVec3;

use super::polygon::{self, FLAT};
use super::{BrokenSize, Expansion, Parametric, SizeFault};
use crate::shape::VisibleSide;

/// A flat triangle. Its normal is on the side from which the corners go around against the clock. It has no thickness, and
/// no inside.
///
/// ```toml
/// [[bodies]]
/// shape = "triangle"
/// a = [-0.5, 0.0, 0.5]
/// b = [0.5, 0.0, 0.5]
/// c = [0.0, 0.0, -0.5]
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// A corner, meters. Default (−0.5, 0, 0.5).
    pub a: DVec3,
    /// Another one. Default (0.5, 0, 0.5).
    pub b: DVec3,
    /// The third one. Default (0, 0, −0.5).
    pub c: DVec3,
    /// The sides that rays meet. Default both.
    pub side: VisibleSide,
}

impl Default for Triangle {
    fn default() -> Self {
        let (a, b, c) = (DVec3::new(-0.5, 0.0, 0.5), DVec3::new(0.5, 0.0, 0.5), DVec3::new(0.0, 0.0, -0.5));
        Self { a, b, c, side: VisibleSide::Both }
    }
}

impl Triangle {
    fn corners(&self) -> [DVec3; 3] {
        [self.a, self.b, self.c]
    }
}

impl Parametric for Triangle {
    fn vector_mut(&mut self, key: &str) -> Option<&mut DVec3> {
        match key {
            "a" => Some(&mut self.a),
            "b" => Some(&mut self.b),
            "c" => Some(&mut self.c),
            _ => None,
        }
    }

    fn side_mut(&mut self) -> Option<&mut VisibleSide> {
        Some(&mut self.side)
    }

    fn broken_size(&self) -> Option<BrokenSize> {
        let corners = self.corners();
        let is_flat = polygon::normal(&corners).length() <= FLAT * polygon::longest_side(&corners).powi(2);
        is_flat.then(|| SizeFault::FlatTriangle.at("c"))
    }

    fn extent(&self) -> [DVec3; 2] {
        let [a, b, c] = self.corners();
        [a.min(b).min(c), a.max(b).max(c)]
    }

    fn expansion(&self) -> Expansion {
        polygon::expansion(self.side, &self.corners())
    }
}
