//! Which of a few bodies rays may meet, as far as it is known before they are tested.

use crate::geometry::visible_bodies::VisibleBodies;

/// The bodies that rays may meet.
#[derive(Clone, Copy)]
pub(crate) enum Candidates<'a> {
    /// All of the scene.
    All,
    /// Only these: the rays come from the point that these are seen from, or go to it.
    Only(&'a VisibleBodies),
}

impl Candidates<'_> {
    /// Whether the rays surely meet nothing.
    #[inline(always)]
    pub(crate) fn is_empty(self) -> bool {
        match self {
            Self::All => false,
            Self::Only(visible) => visible.bodies.is_empty() && visible.planes.is_empty(),
        }
    }
}
