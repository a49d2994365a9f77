//! The other ways of drawing reflections, held against the traced picture and against known answers.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may panic as tests may")]

mod common;
mod driver;
mod extreme;
mod mirrored;
mod reasons;
mod shaded;
