#![doc = include_str!("../README.md")]

mod action;
pub mod bounds;
mod document;
mod fragment;
mod history;
mod names;
pub mod navigate;
mod new_body;
pub mod recovery;
mod selection;

pub use action::{Action, ActionError};
pub use document::{Editor, Label, RefusedChange, SceneWriter};
pub use new_body::NewBodyPlacement;
pub use selection::{Item, Selection};
