//! How light is carried: the scene as it is traced, surfaces, lights, media, integrators, tiles and the film.

pub(crate) mod camera;
pub(crate) mod cemented;
pub(crate) mod color;
pub(crate) mod control;
pub(crate) mod counts;
pub(crate) mod environment;
pub(crate) mod film;
pub(crate) mod integrator;
pub(crate) mod interaction;
pub(crate) mod light;
pub(crate) mod media;
pub(crate) mod path;
pub(crate) mod pick;
pub(crate) mod record;
pub(crate) mod render;
pub(crate) mod sampler;
pub(crate) mod sampling;
pub(crate) mod scene;
pub(crate) mod shading;
pub(crate) mod spectrum;
pub(crate) mod stream;
pub mod surface;
pub(crate) mod texture;
pub(crate) mod tile;
pub(crate) mod tile_candidates;
pub(crate) mod tile_rect;
