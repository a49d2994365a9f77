//! The environment of the bodies.

use crate::color::Color;
use crate::contact::Contact;
use crate::image::Image;

/// The infinitely distant surroundings of the bodies, and what lies between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// The color of even surroundings. Default (0.2, 0.35, 0.6).
    pub background: Color,
    /// Ambient light I_a. Default white.
    pub ambient: Color,
    /// What a ray that hits nothing brings. Default the background.
    pub surroundings: Surroundings,
    /// How far a picture is turned about the world's y axis, degrees, from z to x as bodies turn. Default 0.
    pub rotation_degrees: f64,
    /// A factor of the light of a sky or a picture. Default 1.
    pub strength: f64,
    /// What lies between bodies that touch and say nothing of it themselves. Default air.
    pub contact: Contact,
}

impl Default for Environment {
    fn default() -> Self {
        Self {
            background: Color::new(0.2, 0.35, 0.6),
            ambient: Color::WHITE,
            surroundings: Surroundings::Even,
            rotation_degrees: 0.0,
            strength: 1.0,
            contact: Contact::Air,
        }
    }
}

/// The light that comes from all around.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Surroundings {
    /// Equal light from all directions: [`Environment::background`].
    #[default]
    Even,
    /// The light of a clear sky over a ground.
    Sky(Sky),
    /// Light of an equirectangular picture: longitudes across, latitudes down, the middle where −z is, x to the right
    /// of it, the zenith all along the upper edge.
    Picture(Image),
}

impl Surroundings {
    /// The sky, if it is one.
    pub fn sky(&self) -> Option<&Sky> {
        match self {
            Self::Sky(sky) => Some(sky),
            Self::Even | Self::Picture(_) => None,
        }
    }

    /// The picture, if it is one.
    pub fn picture(&self) -> Option<&Image> {
        match self {
            Self::Picture(image) => Some(image),
            Self::Even | Self::Sky(_) => None,
        }
    }
}

/// A gradient. From a direction of length 1 and height y comes `horizon + (zenith − horizon)·y` where y ≥ 0, and
/// `horizon + (nadir − horizon)·(−y)` below.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sky {
    /// Light from straight above. Default (0.12, 0.28, 0.65).
    pub zenith: Color,
    /// Light from the horizon. Default (0.8, 0.88, 1).
    pub horizon: Color,
    /// Light from straight below. Default (0.16, 0.14, 0.12).
    pub nadir: Color,
}

impl Default for Sky {
    fn default() -> Self {
        Self {
            zenith: Color::new(0.12, 0.28, 0.65),
            horizon: Color::new(0.8, 0.88, 1.0),
            nadir: Color::new(0.16, 0.14, 0.12),
        }
    }
}
