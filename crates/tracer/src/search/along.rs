//! What of a handful of bodies rays may meet, as far as it is known before they are tested.

use crate::stage::VisibleBodies;

/// What is known of a handful of bodies before rays are tested.
#[derive(Clone, Copy)]
pub(crate) enum Candidates<'a> {
    /// Nothing.
    Anything,
    /// The rays come from the point that these bodies are seen from, or go to it, or they are inside of a body that only these
    /// reach into; others they do not meet.
    Seen(&'a VisibleBodies),
}

impl Candidates<'_> {
    /// Whether there is surely no body.
    #[inline(always)]
    pub(crate) fn is_free(self) -> bool {
        match self {
            Self::Anything => false,
            Self::Seen(sights) => sights.bodies.is_empty() && sights.planes.is_empty(),
        }
    }
}
