//! The languages that messages are written in.

use std::borrow::Cow;

/// A language of findings and problems.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    /// English, the default, and the language of `Display`.
    #[default]
    English,
    /// Russian.
    Russian,
}

impl Language {
    /// All languages.
    pub const ALL: [Self; 2] = [Self::English, Self::Russian];

    /// The words of this language.
    pub const fn pick(self, english: &'static str, russian: &'static str) -> &'static str {
        match self {
            Self::English => english,
            Self::Russian => russian,
        }
    }

    /// A number that was written with a decimal point, as the language writes it.
    pub(crate) fn number(self, number: &str) -> Cow<'_, str> {
        match self {
            Self::English => number.into(),
            Self::Russian => number.replace('.', ",").into(),
        }
    }
}

/// The Russian form of a noun in the genitive that goes with a count: `из 21 значения`, `из 5 значений`.
pub(crate) fn russian_genitive<'a>(count: usize, singular: &'a str, plural: &'a str) -> &'a str {
    if count % 10 == 1 && count % 100 != 11 { singular } else { plural }
}
