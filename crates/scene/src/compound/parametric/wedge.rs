//! A wedge: a triangular prism whose cross section is a right triangle.

use glam::DVec3;

use super::{Expansion, MARGIN, Parametric, cuboid};
use crate::compound::BodyPart;
use crate::placement::{Anchor, Placement};
use crate::shape::Shape;

/// A ramp about the origin: of a box, the half below the plane that falls from its upper edge at −X to its lower edge at
/// +X.
///
/// ```toml
/// [[bodies]]
/// shape = "wedge"
/// size = [2.0, 1.0, 1.0]
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wedge {
    /// Width along X, height along Y and depth along Z. Default 1 each.
    pub size: DVec3,
}

impl Default for Wedge {
    fn default() -> Self {
        Self { size: DVec3::ONE }
    }
}

impl Parametric for Wedge {
    fn vector_mut(&mut self, key: &str) -> Option<&mut DVec3> {
        (key == "size").then_some(&mut self.size)
    }

    fn extent(&self) -> [DVec3; 2] {
        [-0.5 * self.size, 0.5 * self.size]
    }

    /// The plane x / width + y / height = 0; the box reaches past it at both edges.
    fn expansion(&self) -> Expansion {
        let [min, mut max] = self.extent();
        max += MARGIN * DVec3::new(self.size.x, self.size.y, 0.0);
        // The plane's normal is +Y before the turn about Z, and (height, width, 0) after it.
        let turn = -self.size.y.atan2(self.size.x).to_degrees();
        let rotation_degrees = DVec3::Z * turn;
        let anchor = Anchor::Frame { position: DVec3::ZERO, rotation_degrees };
        let placement = Placement { anchor, ..Placement::default() };
        let slope = BodyPart { shape: Shape::Plane, placement, ..BodyPart::default() };
        Expansion::intersection(vec![cuboid([min, max]), slope])
    }
}
