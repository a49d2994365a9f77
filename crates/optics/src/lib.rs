#![doc = include_str!("../README.md")]

mod clear;
mod dispersion;
pub mod fresnel;
mod metal;
pub mod observer;

pub use clear::{CLEAR, Clear};
pub use dispersion::{Dispersion, Lines};
pub use metal::{METALS, Metal};
