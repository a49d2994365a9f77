//! A mirror dish: a solid disc with a concave face, a paraboloid or a part of a ball.

use glam::DVec3;

use super::{BrokenSize, Expansion, MARGIN, Parametric, SizeFault, cylinder, is_length, part, round_extent};
use crate::keyed::keyed;
use crate::shape::{ParaboloidDepth, Shape};

/// A solid disc with a concave face that opens along +Y from its vertex at the origin; its back is flat.
///
/// ```toml
/// [[bodies]]
/// shape = "mirror-dish"
/// material = "silver"
/// radius = 0.5
/// thickness = 0.1
/// focal_length = 0.5
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MirrorDish {
    /// Of the rim. Default 0.5.
    pub radius: f64,
    /// Below the vertex, where the dish is thinnest. Default 0.1.
    pub thickness: f64,
    /// The curve of the concave face. Default a parabola.
    pub profile: DishProfile,
    /// How deep it is. Default a focal length of 0.5.
    pub depth: DishDepth,
}

/// The curve of the concave face of a mirror dish.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DishProfile {
    /// A parabola: light along the axis meets in one point.
    #[default]
    Parabolic,
    /// A circle.
    Spherical,
}

/// What says how deep a mirror dish is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DishDepth {
    /// The distance of the focus from the vertex: half the radius of curvature.
    FocalLength(f64),
    /// The radius of curvature at the vertex.
    CurvatureRadius(f64),
}

keyed!(DishProfile { Parabolic = "parabolic", Spherical = "spherical" });

impl Default for MirrorDish {
    fn default() -> Self {
        let (profile, depth) = (DishProfile::Parabolic, DishDepth::FocalLength(0.5));
        Self { radius: 0.5, thickness: 0.1, profile, depth }
    }
}

impl MirrorDish {
    /// The distance of the focus from the vertex, meters.
    pub fn focal_length(&self) -> f64 {
        match self.depth {
            DishDepth::FocalLength(length) => length,
            DishDepth::CurvatureRadius(radius) => 0.5 * radius,
        }
    }

    /// The height of the rim above the vertex, meters: r² / 4f, or R − √(R² − r²) without cancellation. NaN if the ball is
    /// smaller than the rim.
    pub fn rim(&self) -> f64 {
        let (square, curvature) = (self.radius * self.radius, 2.0 * self.focal_length());
        match self.profile {
            DishProfile::Parabolic => square / (2.0 * curvature),
            DishProfile::Spherical => square / (curvature + (curvature * curvature - square).sqrt()),
        }
    }
}

impl Parametric for MirrorDish {
    fn number(&self, key: &str) -> Option<f64> {
        match (key, self.depth) {
            ("radius", _) => Some(self.radius),
            ("thickness", _) => Some(self.thickness),
            ("focal_length", DishDepth::FocalLength(length)) => Some(length),
            ("curvature_radius", DishDepth::CurvatureRadius(radius)) => Some(radius),
            _ => None,
        }
    }

    fn derived_number(&self, key: &str) -> Option<f64> {
        match key {
            "focal_length" => Some(self.focal_length()),
            "curvature_radius" => Some(2.0 * self.focal_length()),
            _ => None,
        }
    }

    fn set_number(&mut self, key: &str, value: f64) {
        match key {
            "radius" => self.radius = value,
            "thickness" => self.thickness = value,
            "focal_length" => self.depth = DishDepth::FocalLength(value),
            "curvature_radius" => self.depth = DishDepth::CurvatureRadius(value),
            _ => {}
        }
    }

    fn broken_size(&self) -> Option<BrokenSize> {
        let key = match self.depth {
            DishDepth::FocalLength(length) => {
                if !is_length(length) {
                    return Some(SizeFault::NoLength { value: length }.at("focal_length"));
                }
                "focal_length"
            }
            DishDepth::CurvatureRadius(_) => "curvature_radius",
        };
        let curvature = 2.0 * self.focal_length();
        if self.profile == DishProfile::Spherical && curvature <= self.radius {
            let fault = SizeFault::FaceTooNarrow { radius: curvature };
            return Some(fault.at(key));
        }
        (!is_length(self.rim())).then(|| SizeFault::DishDepth.at(key))
    }

    fn extent(&self) -> [DVec3; 2] {
        round_extent(self.radius, -self.thickness, self.rim())
    }

    /// The disc reaches past the rim, where what is cut from it is wider, and that reaches past the disc.
    fn expansion(&self) -> Expansion {
        let (rim, focal_length) = (self.rim(), self.focal_length());
        let curvature = 2.0 * focal_length;
        let past = MARGIN * (self.radius + self.thickness);
        let (past, cutter) = match self.profile {
            DishProfile::Parabolic => {
                let radius = (self.radius * self.radius + 8.0 * focal_length * past).sqrt();
                let depth = ParaboloidDepth::FocalLength(focal_length);
                (past, part(Shape::Paraboloid { radius, depth }, 0.0))
            }
            DishProfile::Spherical => {
                let room = (curvature * curvature - self.radius * self.radius).max(0.0).sqrt();
                (past.min(0.5 * room), part(Shape::Sphere { radius: curvature }, curvature))
            }
        };
        Expansion::difference(cylinder(self.radius, -self.thickness, rim + past), [cutter])
    }
}
