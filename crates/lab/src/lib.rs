//! Experiments on a scene. No window: the program and the studio show what is found here.
//!
//! - [`audit`]: every number behind a pixel, and the proof that they add up.
//! - [`maps`]: a number for each pixel of a picture.
//! - [`depth`]: how many generations a scene needs.
//! - [`exact`]: where the laws of optics put an image, beside what the tracer finds.
//! - [`reflectance`]: how much a material reflects, by angle and color.
//! - [`compare`]: pictures drawn in several ways, or read from files, compared with the first of them.
//! - [`measure`]: how the time of a picture depends on what it is made of, and the law behind it.
//! - [`report`]: both as pages, tables and plots, in English or Russian.

pub mod audit;
pub mod cloud;
pub mod compare;
pub mod depth;
pub mod exact;
mod machine;
pub mod maps;
pub mod measure;
mod random;
pub mod reflectance;
pub mod report;
mod variant;
pub mod work;

pub use machine::Machine;
pub use random::Random;
pub use variant::{Variant, VariantError};
