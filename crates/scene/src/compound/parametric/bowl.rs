//! A bowl: the lower part of a spherical shell.

use glam::DVec3;

use super::{BrokenSize, Expansion, MARGIN, Parametric, SizeFault, cuboid, part, round_extent, smaller};
use crate::shape::Shape;

/// A bowl that stands on the origin and opens along +Y, with a flat rim.
///
/// ```toml
/// [[bodies]]
/// shape = "bowl"
/// radius = 0.5
/// thickness = 0.05
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bowl {
    /// Radius of the outer ball. Default 0.5.
    pub radius: f64,
    /// Of the wall, less than `radius`. Default 0.05.
    pub thickness: f64,
    /// Of the rim, so that the inner ball is open there. `None`, the default, is `radius`: half a shell.
    pub height: Option<f64>,
}

impl Default for Bowl {
    fn default() -> Self {
        Self { radius: 0.5, thickness: 0.05, height: None }
    }
}

impl Bowl {
    /// The height of the rim, meters.
    pub fn rim(&self) -> f64 {
        self.height.unwrap_or(self.radius)
    }

    /// The largest distance from the axis.
    fn width(&self) -> f64 {
        let (radius, rim) = (self.radius, self.rim());
        if rim < radius { (rim * (2.0 * radius - rim)).max(0.0).sqrt() } else { radius }
    }
}

impl Parametric for Bowl {
    fn number(&self, key: &str) -> Option<f64> {
        match key {
            "radius" => Some(self.radius),
            "thickness" => Some(self.thickness),
            "height" => self.height,
            _ => None,
        }
    }

    fn derived_number(&self, key: &str) -> Option<f64> {
        (key == "height").then(|| self.rim())
    }

    fn set_number(&mut self, key: &str, value: f64) {
        match key {
            "radius" => self.radius = value,
            "thickness" => self.thickness = value,
            "height" => self.height = Some(value),
            _ => {}
        }
    }

    fn broken_size(&self) -> Option<BrokenSize> {
        let too_thick = smaller("thickness", self.thickness, "radius", self.radius);
        let (least, most) = (self.thickness, 2.0 * self.radius - self.thickness);
        let is_open = self.rim() > least && self.rim() < most;
        let closed = || {
            let fault = SizeFault::BowlClosed { least, most };
            (!is_open).then(|| fault.at("height"))
        };
        too_thick.or_else(closed)
    }

    fn extent(&self) -> [DVec3; 2] {
        round_extent(self.width(), 0.0, self.rim())
    }

    /// The box that ends the outer ball at the rim touches it nowhere else.
    fn expansion(&self) -> Expansion {
        let past = MARGIN * self.radius;
        let around = round_extent(self.width() + past, -past, self.rim());
        let ball = part(Shape::Sphere { radius: self.radius }, self.radius);
        let inner = part(Shape::Sphere { radius: self.radius - self.thickness }, self.radius);
        let outer = Expansion::intersection(vec![ball, cuboid(around)]).into_part();
        Expansion::difference(outer, [inner])
    }
}
