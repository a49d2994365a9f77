//! Messages about scene files and scenes, each with its English and its Russian sentence.
//!
//! A finding keeps the message and its arguments; it becomes a text when somebody reads it, in the language of the
//! reader.

mod catalog;
mod image;
mod messages;
mod phrase;
mod size;
mod syntax;

pub(crate) use catalog::Message;
pub(crate) use phrase::{
    Collection, Component, Conjunction, Enumeration, FoundValue, KeyMeaning, Requirement, Subject,
};
pub use phrase::{Number, Phrase, Sentence};
pub(crate) use size::{size_fault, size_help};

#[cfg(test)]
mod tests;
