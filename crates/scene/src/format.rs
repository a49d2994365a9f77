//! The text format `catoptric/1`: TOML whose tables and keys are those of [`keys`].

mod build;
mod diagnostic;
pub mod keys;
mod nearest;
mod number;
mod quote;
mod read;
mod render;
mod rules;
pub mod spec;
mod toml;
mod tree;
mod typed;

pub use diagnostic::{Diagnostic, Diagnostics, Related, Severity};
pub use read::{LONGEST_TEXT, Reading, Warned, read, read_bytes};
