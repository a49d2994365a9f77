//! The tracer on graphics cards: it uploads the stage, runs the tracer's shaders and brings the picture back.
//!
//! There is no optics here: what the shaders compute stands beside its Rust twin in `catoptric-tracer`
//! ([`catoptric_tracer::twin`]). This crate finds a card ([`Gpu::open`]) or takes a device from outside ([`Gpu::on`]),
//! keeps a stage in its memory ([`GpuScene`], to which an edit sends only what it changed) and adds samples to a
//! picture there ([`GpuFilm`]). [`render`] does all of it once.
//!
//! Long work is cut into pieces, so that the desktop stays alive and work can be stopped. What a card cannot do is an
//! error that says why; nothing is ever drawn wrongly, and nothing panics: the CPU draws then.

mod card;
mod choice;
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
pub use render::{GpuRendering, render};
pub use scene::GpuScene;
pub use screen::{GpuPicture, GpuScreen};
pub use watch::LossWatch;
