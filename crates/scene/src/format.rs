//! The text format `catoptric/1`: TOML whose tables and keys are those of [`keys`].

mod address;
mod build;
mod check;
mod decimal;
mod diagnostic;
mod document;
pub mod keys;
mod material;
mod message;
mod nearest;
mod number;
mod quote;
mod read;
mod record;
mod render;
mod rules;
mod schema;
pub mod spec;
mod toml;
mod tree;
mod typed;
mod update;
mod write;

pub use address::{AddressCompletion, AddressError, SceneEdit, SceneKey, ScenePath, SceneValue};
pub use check::Problem;
pub use diagnostic::{Diagnostic, Diagnostics, Related, Severity};
pub use document::Document;
pub use message::{Number, Phrase, Sentence};
pub use nearest::nearest;
pub use read::{LONGEST_TEXT, LoadedScene, ParsedScene, Warned, decode, read, read_bytes};
pub use schema::json_schema;
pub use update::update;
pub use write::{write, write_fragment};
