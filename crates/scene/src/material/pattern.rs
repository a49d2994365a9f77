//! Colors of a surface: one color, a picture in its place, a pattern.

use crate::color::Color;
use crate::image::Image;
use crate::material::solid::SolidTexture;

/// The color C of a surface, which may change from point to point.
#[derive(Clone, Debug, PartialEq)]
pub struct Pattern {
    /// Color of the body; of a mirror, what it reflects. Default gray 0.8.
    pub color: Color,
    /// A picture on the body, in the place of its color. Default none.
    ///
    /// It is wrapped once around spheres, cylinders and cones, seen upright from outside, its middle towards z; it
    /// covers each face of a cube and, as far as a circle goes, each cap; on a plane it is repeated every meter.
    pub texture: Option<Image>,
    /// A pattern of which this is the first color. Default none.
    pub solid: Option<SolidTexture>,
}

impl Pattern {
    pub(crate) const DEFAULT: Self = Self { color: Color::gray(0.8), texture: None, solid: None };

    /// The most that its color can be, of each channel: of a texture, that of its pixels; of patterns, that of their
    /// colors.
    pub fn brightest(&self) -> Color {
        let own = self.opened_texture().map_or(self.color, Image::brightest);
        let colors = self.solid.iter().flat_map(SolidTexture::all).map(|solid| solid.color);
        colors.fold(own, |one, other| Color::new(one.r.max(other.r), one.g.max(other.g), one.b.max(other.b)))
    }

    /// The mean of its texture, or else its color.
    pub fn mean(&self) -> Color {
        self.opened_texture().map_or(self.color, Image::mean)
    }

    fn opened_texture(&self) -> Option<&Image> {
        self.texture.as_ref().filter(|image| image.pixels().is_some())
    }
}

impl Default for Pattern {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// One color everywhere.
impl From<Color> for Pattern {
    fn from(color: Color) -> Self {
        Self { color, ..Self::DEFAULT }
    }
}
