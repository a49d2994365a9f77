//! Scenes of other ray tracers, from outside.

mod challenge;
mod common;
mod fuzz;
mod minirt;
mod nff;
mod round_trips;
