//! The sides of a surface without inside that rays meet.

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

impl VisibleSide {
    /// All of them, in the order in which to offer them.
    pub const ALL: [Self; 3] = [Self::Both, Self::Outer, Self::Inner];

    /// Their words.
    pub(crate) const KEYS: &[&str] = &[Self::Both.key(), Self::Outer.key(), Self::Inner.key()];

    /// The word for it in scene files.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Both => "both",
            Self::Outer => "outer",
            Self::Inner => "inner",
        }
    }

    /// The one of this word.
    pub fn of_key(key: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|side| side.key() == key)
    }

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
