//! The tracer and the other methods, from outside.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests may panic as tests may"
)]

mod levels;
mod methods;
mod mitsuba;
mod proof;
mod reference;
