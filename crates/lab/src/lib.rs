#![doc = include_str!("../README.md")]

pub mod audit;
pub mod cloud;
pub mod compare;
pub mod depth;
pub mod detective;
pub mod exact;
mod machine;
pub mod maps;
pub mod marking;
pub mod measure;
mod random;
pub mod reflectance;
pub mod report;
mod variant;
pub mod work;

pub use machine::Machine;
pub use random::Random;
pub use variant::{Variant, VariantError};
