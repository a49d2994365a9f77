#![doc = include_str!("../README.md")]

mod counts;
mod facets;
mod film;
mod lanes;
mod media;
pub mod method;
mod pick;
mod ray;
mod render;
mod sampling;
mod search;
pub mod shape;
mod stage;
pub mod surface;
mod tile;
pub mod twin;
mod vector;
mod whitted;

pub use counts::RayCounts;
pub use film::Film;
pub use lanes::{Float, Real};
pub use pick::SurfaceHit;
pub use ray::{NO_BODY, Ray, Start};
pub use render::{
    Control, RenderError, RenderSettings, Rendering, render, render_into, render_pixel, render_through,
};
pub use sampling::sample_offset;
pub use search::Hit;
pub use stage::{Search, Stage, StageCamera, StageChanges, StageEdit, StageError};
pub use vector::Vector;
pub use whitted::{
    Branch, Fate, Interface, LightAnswer, LightTerm, RayKind, ReflectionLaw, Shadow, ShadowCrossing,
    SurfaceAnswer, Tally, TracedRay, Whitted,
};
