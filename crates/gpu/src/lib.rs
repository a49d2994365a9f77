#![doc = include_str!("../README.md")]

mod card;
mod choice;
mod error;
mod film;
mod pictures;
mod pipelines;
mod reading;
mod render;
mod screen;
mod stage;
mod upload;
mod watch;

pub use card::{Gpu, GpuInfo};
pub use choice::GpuChoice;
pub use error::GpuError;
pub use film::{GpuFilm, GpuPass};
pub use render::{GpuRendering, render};
pub use screen::{GpuPicture, GpuScreen};
pub use stage::StageOnCard;
pub use watch::Watch;
