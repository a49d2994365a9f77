//! Reasons why an address or its value is refused.

use std::fmt;

use crate::format::diagnostic::Diagnostic;
use crate::format::message::Message;
use crate::language::Language;

/// The reason why there is no value at an address, or why it cannot be set. Its words are those that findings about
/// scene files have, in the language that they are asked for in.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct AddressError {
    path: String,
    finding: Box<Diagnostic>,
}

impl AddressError {
    pub(super) fn new(path: &impl ToString, finding: impl Into<Box<Diagnostic>>) -> Self {
        Self { path: path.to_string(), finding: finding.into() }
    }

    /// The address, as far as it was one.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// What is wrong.
    pub fn message(&self, language: Language) -> String {
        self.finding.message(language)
    }

    /// The likely meaning of a misspelled name, or the choice that stands in the way; `None` if there is neither.
    pub fn label(&self, language: Language) -> Option<String> {
        let repeats = |label: &Message| {
            matches!(label, Message::UnknownKey | Message::UnknownWord { .. } | Message::NotDefined)
        };
        self.finding.label.as_ref().filter(|label| !repeats(label)).map(|label| label.text(language))
    }

    /// What is allowed, or what to do.
    pub fn help(&self, language: Language) -> Option<String> {
        self.finding.help(language)
    }
}

/// Message, label and help in English, without the address.
impl fmt::Display for AddressError {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let language = Language::English;
        out.write_str(&self.message(language))?;
        for more in self.label(language).into_iter().chain(self.help(language)) {
            write!(out, "; {more}")?;
        }
        Ok(())
    }
}

impl std::error::Error for AddressError {}

/// A finding about an address, which has no place in a text.
pub(super) fn refused(message: Message) -> Diagnostic {
    Diagnostic::error(0..0, message)
}
