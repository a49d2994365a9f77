//! Scenes of *miniRT*: one element on each line.

mod arguments;
mod cone;
mod property;
mod read;
mod write;

pub(crate) use read::read;
pub(crate) use write::write;
