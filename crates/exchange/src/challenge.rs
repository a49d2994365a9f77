//! Scenes of *The Ray Tracer Challenge* (Buck 2019), as its author publishes them.

mod csg;
mod material;
mod object;
mod pattern;
mod read;
mod shape;
mod table;
mod transform;
mod write;
mod yaml;

pub(crate) use read::read;
pub(crate) use write::write;
