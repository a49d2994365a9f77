//! The sides of a surface without inside that rays meet.

use crate::keyed::keyed;

/// Which sides of a surface rays meet; by the others they pass as if nothing were there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum VisibleSide {
    /// Both sides.
    #[default]
    Both,
    /// The side that the normal points to: the outer one of what is round, the upper one of what is flat.
    Outer,
    /// The other side.
    Inner,
}

keyed!(VisibleSide { Both = "both", Outer = "outer", Inner = "inner" });

impl VisibleSide {
    /// Whether a ray meets the surface that comes from its outer side, or from its inner one.
    ///
    /// ```
    /// use catoptric_scene::VisibleSide;
    /// assert!(VisibleSide::Both.is_met(true) && VisibleSide::Both.is_met(false));
    /// assert!(VisibleSide::Inner.is_met(false) && !VisibleSide::Inner.is_met(true));
    /// ```
    pub const fn is_met(self, from_outside: bool) -> bool {
        match self {
            Self::Both => true,
            Self::Outer => from_outside,
            Self::Inner => !from_outside,
        }
    }
}
