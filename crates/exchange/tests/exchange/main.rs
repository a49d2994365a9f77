//! Scenes of other ray tracers, from outside.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests may panic as tests may"
)]

mod acceptance;
mod challenge;
mod common;
mod fuzz;
mod minirt;
mod nff;
mod patterns;
mod round_trips;
mod spd;
mod surfaces;
