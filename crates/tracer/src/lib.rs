//! The optics: a prepared [`RenderScene`], the mathematics of rays and bodies, Whitted's tree, and the CPU driver.
//!
//! [`RenderScene::prepare`] turns a scene into flat arrays once; [`render`] traces it into a linear-light picture, [`Film`]
//! sample by sample.

mod counts;
mod facets;
mod film;
mod geometry;
mod lanes;
mod media;
mod membership;
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
pub use geometry::AcceleratorChoice;
pub use lanes::{Float, Float32};
pub use pick::RayIntersection;
pub use ray::{NO_BODY, Ray, RayOrigin};
pub use render::{
    RenderControl, RenderError, RenderOutput, RenderSettings, render, render_into, render_pixel,
    render_through,
};
pub use sampling::sample_offset;
pub use search::HitRecord;
pub use stage::{RenderCamera, RenderScene, SceneBuildError, SceneChanges, SceneEdit};
pub use vector::Vector;
pub use whitted::{
    BranchOutcome, BranchRecord, InterfaceRecord, LightContribution, LightTerm, PixelStatistics, RayKind,
    RayRecord, ReflectionModel, ShadowCrossing, ShadowRecord, SurfaceRecord, WhittedIntegrator,
};
