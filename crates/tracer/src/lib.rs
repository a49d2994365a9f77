#![doc = include_str!("../README.md")]

mod geometry;
pub mod raster;
pub mod shaders;
mod simd;
mod transport;

pub use geometry::shape;
pub use transport::surface;

pub use geometry::AcceleratorChoice;
pub use geometry::query::HitRecord;
pub use geometry::ray::{NO_BODY, Ray, RayOrigin};
pub use simd::vector::Vector;
pub use simd::wide::SimdLevel;
pub use simd::{Float, Float32};
pub use transport::camera::RenderCamera;
pub use transport::control::RenderControl;
pub use transport::counts::RayCounts;
pub use transport::film::Film;
pub use transport::integrator::whitted::WhittedIntegrator;
pub use transport::integrator::whitted::statistics::PixelStatistics;
pub use transport::pick::RayIntersection;
pub use transport::record::{
    BranchOutcome, BranchRecord, ContactRecord, InterfaceRecord, LightContribution, LightTerm, RayKind,
    RayRecord, ShadowCrossing, ShadowRecord, SurfaceRecord,
};
pub use transport::render::{
    RenderError, RenderOutput, RenderSettings, render, render_into, render_pixel, render_through,
};
pub use transport::sampling::sample_offset;
pub use transport::scene::edit::SceneEdit;
pub use transport::scene::log::SceneChanges;
pub use transport::scene::{RenderScene, SceneBuildError};
pub use transport::surface::model::ReflectionModel;
