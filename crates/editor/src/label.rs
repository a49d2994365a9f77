//! The names of undo steps.

/// The label of an undo step, for a history menu.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Label {
    /// A key of message catalogues, such as `edit-move`.
    pub key: &'static str,
    /// The name of what was edited; may be empty.
    pub subject: String,
}

impl Label {
    /// A label with a subject.
    pub fn new(key: &'static str, subject: impl Into<String>) -> Self {
        Self { key, subject: subject.into() }
    }
}
