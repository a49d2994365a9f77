//! The other ways of drawing reflections, held against the traced picture and against known answers.

mod common;
mod driver;
mod extreme;
mod mirrored;
mod reasons;
mod shaded;
