#![doc = include_str!("../README.md")]

mod action;
pub mod bounds;
mod document;
mod fragment;
mod history;
mod names;
pub mod navigate;
pub mod recovery;
mod selection;
mod spot;

pub use action::{Action, ActionError};
pub use document::{Editor, Label, Refused, Writing};
pub use selection::{Item, Selection};
pub use spot::Spot;
