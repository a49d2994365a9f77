//! Lights and their laws of falloff.

use glam::DVec3;

use crate::color::Color;

/// A light: a point, or a ball that shines evenly to all sides. The ball itself is not seen.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// Unique name; empty when the file gives none.
    pub name: String,
    /// World position, meters. Default (-5, 8, 6).
    pub position: DVec3,
    /// Color. Default white.
    pub color: Color,
    /// Multiplies the color; 0 or more. Default 1.
    pub intensity: f64,
    /// How the light weakens with distance. Default none.
    pub falloff: Falloff,
    /// Radius of the ball, meters; 0 (the default) is a point. However large, it gives as much light as the point.
    pub radius: f64,
    /// Whether the light is out. Default false.
    pub hidden: bool,
    /// Whether the studio leaves the light as it is. No picture depends on it. Default false.
    pub locked: bool,
}

impl Default for Light {
    fn default() -> Self {
        Self {
            name: String::new(),
            position: DVec3::new(-5.0, 8.0, 6.0),
            color: Color::WHITE,
            intensity: 1.0,
            falloff: Falloff::None,
            radius: 0.0,
            hidden: false,
            locked: false,
        }
    }
}

/// Law of falloff A(d), d the distance in meters.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Falloff {
    /// A(d) = 1.
    #[default]
    None,
    /// A(d) = 1 / (d + K).
    Linear {
        /// K in meters, 0 or more. Default 1.
        constant: f64,
    },
    /// A(d) = 1 / d².
    InverseSquare,
}

impl Falloff {
    /// The falloff's name in scene files: `none`, `linear` or `inverse-square`.
    pub const fn key(&self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Linear { .. } => "linear",
            Self::InverseSquare => "inverse-square",
        }
    }
}
