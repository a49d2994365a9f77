//! Colors of a surface: one color, a picture in its place, a checkerboard.

use crate::color::Color;
use crate::image::Image;

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
    /// A second color in a checkerboard. Default none.
    pub checker: Option<Checker>,
}

impl Pattern {
    pub(crate) const DEFAULT: Self = Self { color: Color::gray(0.8), texture: None, checker: None };

    /// The most that its color can be, of each channel, but for a checker's: of a texture, that of its pixels.
    pub fn brightest(&self) -> Color {
        self.opened_texture().map_or(self.color, Image::brightest)
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

/// Checkerboard: the cell (⌊x/s⌋ + ⌊y/s⌋ + ⌊z/s⌋) of a point takes the material's color when even, this one when odd.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checker {
    /// Color of odd cells. Default gray 0.2.
    pub color: Color,
    /// Edge length s of a cell, meters. Default 1.
    pub size: f64,
    /// Whose x, y and z these are. Default the world's.
    pub space: CheckerSpace,
}

impl Checker {
    pub(crate) const DEFAULT: Self = Self { color: Color::gray(0.2), size: 1.0, space: CheckerSpace::World };
}

impl Default for Checker {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// The space in which a checkerboard is laid out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum CheckerSpace {
    /// The world: bodies move through it.
    #[default]
    World,
    /// The body, from its own origin, along its own axes: it moves and turns with the body. Cells keep their size when
    /// the body is scaled.
    Body,
}

impl CheckerSpace {
    /// Both, in the order of the format.
    pub const ALL: [Self; 2] = [Self::World, Self::Body];

    /// The word in scene files.
    pub const fn key(self) -> &'static str {
        match self {
            Self::World => "world",
            Self::Body => "body",
        }
    }
}
