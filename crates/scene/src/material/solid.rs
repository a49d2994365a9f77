//! Solid textures: patterns that fill space, and color the surfaces that cut through them.

use glam::DVec3;

use crate::color::Color;
use crate::keyed::keyed;
use crate::placement::{Anchor, Placement};

/// A pattern of two colors that fills space (a solid texture: Peachey 1985), of which a surface shows what it cuts.
///
/// A point of the pattern's own space, in units of its size, belongs to the second color with a share that the
/// [kind](SolidKind) tells, and to the first with what is left. The first is the color or texture of the material.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidTexture {
    /// How the colors are laid out.
    pub kind: SolidKind,
    /// The second color. Default gray 0.2.
    pub color: Color,
    /// The width of a cell, meters. Default 1.
    pub size: f64,
    /// Whose axes those of the pattern are, before it is moved. Default the world's.
    pub space: PatternSpace,
    /// Where its origin stands there, meters. Default the origin.
    pub position: DVec3,
    /// How it is turned, as a body is, degrees. Default not.
    pub rotation_degrees: DVec3,
    /// Three factors of the size along its own axes. Default 1 each.
    pub scale: DVec3,
    /// A pattern in the place of the first color, which is its first color, too. Default none.
    pub first: Option<Box<Self>>,
    /// A pattern in the place of the second color, which is its first one. Default none.
    pub second: Option<Box<Self>>,
}

impl SolidTexture {
    /// How deep patterns can lie within patterns; the outermost is the first level.
    pub const MAX_DEPTH: usize = 4;

    pub(crate) const DEFAULT: Self = Self {
        kind: SolidKind::Checker,
        color: Color::gray(0.2),
        size: 1.0,
        space: PatternSpace::World,
        position: DVec3::ZERO,
        rotation_degrees: DVec3::ZERO,
        scale: DVec3::ONE,
        first: None,
        second: None,
    };

    /// A pattern of this second color, of cells of a meter along the axes of the world.
    pub fn new(kind: SolidKind, color: Color) -> Self {
        Self { kind, color, ..Self::DEFAULT }
    }

    /// Where the pattern stands in its space; its frame is in meters.
    pub const fn placement(&self) -> Placement {
        let Self { position, rotation_degrees, scale, .. } = *self;
        Placement { anchor: Anchor::Frame { position, rotation_degrees }, scale }
    }

    /// This pattern and all within it, each before those within it, the first color's first.
    pub fn all(&self) -> Vec<&Self> {
        let within = [&self.first, &self.second].into_iter().flatten().flat_map(|inner| inner.all());
        std::iter::once(self).chain(within).collect()
    }

    /// How many levels it has.
    pub(crate) fn depth(&self) -> usize {
        let within = [&self.first, &self.second].into_iter().flatten();
        1 + within.map(|inner| inner.depth()).max().unwrap_or(0)
    }
}

impl Default for SolidTexture {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// How the colors of a pattern are laid out: the share of the second at x, y, z (Buck 2019, chapter 10).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SolidKind {
    /// Cubes: all where ⌊x⌋ + ⌊y⌋ + ⌊z⌋ is odd.
    #[default]
    Checker,
    /// Layers across the x axis: all where ⌊x⌋ is odd.
    Stripes,
    /// Tubes about the y axis: all where ⌊√(x² + z²)⌋ is odd.
    Rings,
    /// From one color to the other along the x axis, again and again: x − ⌊x⌋.
    Gradient,
}

impl SolidKind {
    /// All, in the order of the format.
    pub const ALL: [Self; 4] = [Self::Checker, Self::Stripes, Self::Rings, Self::Gradient];

    /// The key in scene files.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Checker => "checker",
            Self::Stripes => "stripes",
            Self::Rings => "rings",
            Self::Gradient => "gradient",
        }
    }
}

/// The space in which a pattern is laid out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PatternSpace {
    /// The world: bodies move through it.
    #[default]
    World,
    /// The body, from its own origin, along its own axes: it moves and turns with the body. Cells keep their size when
    /// the body is scaled.
    Body,
}

keyed!(PatternSpace { World = "world", Body = "body" });

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn patterns_are_told_in_their_order() {
        let of = |size, first, second| {
            Some(Box::new(SolidTexture { size, first, second, ..SolidTexture::default() }))
        };
        let inner = of(1.0, of(2.0, None, None), of(3.0, None, of(4.0, None, None)));
        let sizes: Vec<f64> = inner.iter().flat_map(|outer| outer.all()).map(|solid| solid.size).collect();
        assert_eq!((sizes, inner.unwrap().depth()), (vec![1.0, 2.0, 3.0, 4.0], 3));
    }
}
