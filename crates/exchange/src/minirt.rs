//! Scenes of *miniRT*: one element on each line.

mod arguments;
mod dialect;
mod property;
mod read;
mod write;

pub(crate) use arguments::Argument;
pub use dialect::{Dialect, UnknownDialect};
pub(crate) use read::read;
pub(crate) use write::write;
