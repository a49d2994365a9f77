#![doc = include_str!("../README.md")]

mod action;
pub mod bounds;
mod document;
mod edited_scene;
mod history;
mod identity;
mod label;
mod names;
pub mod navigate;
mod new_body;
mod part_path;
pub mod recovery;
mod selection;
mod sequence;

pub use action::{Action, ActionError, PartSlot};
pub use document::{Editor, RefusedChange, SceneWriter};
pub use edited_scene::EditedScene;
pub use identity::{Item, ItemId};
pub use label::Label;
pub use new_body::NewBodyPlacement;
pub use part_path::{PartPath, joined_parts};
pub use selection::Selection;
