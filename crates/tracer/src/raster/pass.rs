//! The parts of the work of a method.

/// A part of the work of a method, timed by itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PassName {
    /// Whitted's tree of rays.
    Trace,
    /// Bodies become faces.
    Tessellate,
    /// The local terms at faces, vertices, or in pixels.
    Light,
    /// Faces become pixels.
    Rasterize,
    /// The points that pixels show, and their local light.
    FirstHits,
    /// Cube maps of the surroundings.
    CubeMaps,
    /// Reflected rays on the screen, or looked up in cube maps.
    Reflect,
}

impl PassName {
    /// The name in statistics and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Trace => "trace",
            Self::Tessellate => "tessellate",
            Self::Light => "light",
            Self::Rasterize => "rasterize",
            Self::FirstHits => "first-hits",
            Self::CubeMaps => "cube-maps",
            Self::Reflect => "reflect",
        }
    }
}
