#![doc = include_str!("../README.md")]

mod card;
mod choice;
mod compile;
mod error;
mod film;
mod pipelines;
mod reading;
mod render;
mod scene;
mod scene_images;
mod screen;
mod upload;
mod watch;

pub use card::{Gpu, GpuInfo};
pub use choice::GpuChoice;
pub use error::GpuError;
pub use film::{GpuFilm, GpuPass};
pub use reading::wait;
pub use render::{GpuRendering, render};
pub use scene::GpuScene;
pub use screen::{GpuPicture, GpuScreen};
pub use watch::LossWatch;
