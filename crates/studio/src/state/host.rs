//! What the system around the studio has.

/// What the system has besides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HostAbilities {
    /// Whether the studio can be reached by links.
    pub has_links: bool,
    /// Whether the studio can close its window.
    pub can_quit: bool,
    /// Whether the studio comes back as it was left, without a question, when there is only one thing to come back to.
    pub comes_back: bool,
}

impl HostAbilities {
    /// Those of a desktop.
    pub const DESKTOP: Self = Self { has_links: false, can_quit: true, comes_back: false };
}
