#![doc = include_str!("../README.md")]

mod clear;
mod dispersion;
pub mod fresnel;
mod metal;
pub mod observer;

pub use clear::{CLEAR, ClearSubstance};
pub use dispersion::{Dispersion, FraunhoferLines};
pub use metal::{METALS, Metal};
