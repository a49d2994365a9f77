//! Experiments on a scene. No window: the program and the studio show what is found here.
//!
//! - [`compare`]: pictures drawn in several ways, or read from files, held against the first of them.
//! - [`measure`]: how the time of a picture depends on what it is made of, and the law behind it.
//! - [`report`]: both as pages, tables and plots, in English or Russian.

pub mod cloud;
pub mod compare;
mod machine;
pub mod measure;
mod random;
pub mod report;

mod variant;

pub use machine::Machine;
pub use random::Random;
pub use variant::{Variant, VariantError};
