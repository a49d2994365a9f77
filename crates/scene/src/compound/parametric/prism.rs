//! A prism over a regular polygon.

use glam::DVec3;

use super::{Expansion, MARGIN, Parametric, cuboid};
use crate::compound::BodyPart;
use crate::placement::{Anchor, Placement};
use crate::shape::Shape;

/// A regular prism from the origin along +Y. One of its sides faces +Z.
///
/// ```toml
/// [[bodies]]
/// shape = "prism"
/// sides = 6
/// radius = 0.5
/// height = 1.0
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prism {
    /// Number of sides, 3 to [`Self::MAX_SIDES`]. Default 3.
    pub sides: u32,
    /// Distance of the vertical edges from the axis. Default 0.5.
    pub radius: f64,
    /// Default 1.
    pub height: f64,
}

impl Default for Prism {
    fn default() -> Self {
        Self { sides: 3, radius: 0.5, height: 1.0 }
    }
}

impl Prism {
    /// The largest number of sides: a part for each, and one more, can be joined.
    pub const MAX_SIDES: u32 = 60;

    /// The angle of a side's normal about Y from +Z, degrees. Exact for the four axes.
    fn turn_degrees(&self, side: u32) -> f64 {
        360.0 * f64::from(side) / f64::from(self.sides.max(1))
    }

    /// The distance of the sides from the axis.
    fn apothem(&self) -> f64 {
        self.radius * (std::f64::consts::PI / f64::from(self.sides.max(1))).cos()
    }

    /// How far the polygon reaches along one of the four axes, whose angle from +Z is `axis_degrees`, and whether a side
    /// faces there.
    fn reach(&self, axis_degrees: f64) -> (f64, bool) {
        let step = 360.0 / f64::from(self.sides.max(1));
        let from_side = axis_degrees.rem_euclid(step);
        // Between the normals of two sides stands the edge of both.
        let from_edge = (from_side - 0.5 * step).to_radians();
        match (0..self.sides).any(|side| self.turn_degrees(side) == axis_degrees) {
            true => (self.apothem(), true),
            false => (self.radius * from_edge.cos(), false),
        }
    }

    /// The box around it, made larger by `past` where no side faces along the axis.
    fn around(&self, past: f64) -> [DVec3; 2] {
        let [front, right, back, left] = [0.0, 90.0, 180.0, 270.0].map(|axis| {
            let (reach, has_side) = self.reach(axis);
            if has_side { reach } else { reach + past }
        });
        [DVec3::new(-left, 0.0, -back), DVec3::new(right, self.height, front)]
    }
}

impl Parametric for Prism {
    fn number(&self, key: &str) -> Option<f64> {
        match key {
            "sides" => Some(f64::from(self.sides)),
            "radius" => Some(self.radius),
            "height" => Some(self.height),
            _ => None,
        }
    }

    fn set_number(&mut self, key: &str, value: f64) {
        match key {
            "sides" => self.sides = value.round() as u32,
            "radius" => self.radius = value,
            "height" => self.height = value,
            _ => {}
        }
    }

    fn extent(&self) -> [DVec3; 2] {
        self.around(0.0)
    }

    /// The box has the sides along its axes; a plane is each of the others.
    fn expansion(&self) -> Expansion {
        let apothem = self.apothem();
        let plane = |side: u32| {
            let degrees = self.turn_degrees(side);
            let (sine, cosine) = degrees.to_radians().sin_cos();
            // +Y becomes +Z by the turn about X, and the side's normal by that about Y.
            let rotation_degrees = DVec3::new(90.0, degrees, 0.0);
            let position = apothem * DVec3::new(sine, 0.0, cosine);
            let placement =
                Placement { anchor: Anchor::Frame { position, rotation_degrees }, ..Placement::default() };
            BodyPart { shape: Shape::Plane, placement, ..BodyPart::default() }
        };
        let is_oblique = |side: &u32| self.turn_degrees(*side) % 90.0 != 0.0;
        let planes = (0..self.sides.min(Self::MAX_SIDES)).filter(is_oblique).map(plane);
        let around = cuboid(self.around(MARGIN * self.radius));
        Expansion::intersection([around].into_iter().chain(planes).collect())
    }
}
