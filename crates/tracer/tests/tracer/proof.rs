//! The proof of the tracer: answers that are known exactly, what must not change a picture, and an independent tracer
//! in double precision to be held against.

mod absorption;
mod cemented;
mod coincident;
mod common;
mod contacts;
mod driver;
mod edits;
mod extremes;
mod film;
mod invariance;
mod joined;
mod lenses;
mod limits;
mod local_light;
mod materials;
mod media;
mod mirrors;
mod noise;
mod paraboloid;
mod random;
mod refraction;
mod robustness;
mod samples;
mod shapes;
mod small_angles;
mod spd;
mod surfaces;
mod surroundings;
mod trees;
