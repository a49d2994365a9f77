#![doc = include_str!("../README.md")]

mod action;
pub mod bounds;
mod document;
mod history;
mod label;
mod names;
pub mod navigate;
mod new_body;
pub mod recovery;
mod selection;

pub use action::{Action, ActionError};
pub use document::{Editor, RefusedChange, SceneWriter};
pub use label::Label;
pub use new_body::NewBodyPlacement;
pub use selection::{Item, Selection};
