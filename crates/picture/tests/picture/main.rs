//! Pictures, their files and their comparison, from outside.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests may panic as tests may"
)]

mod broken;
mod comparing;
mod files;
mod formats;
mod palette;
mod perception;
mod pfm;
mod reading;
mod samples;
