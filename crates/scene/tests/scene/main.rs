//! The document and its text format, from outside.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests may panic as tests may"
)]

mod address;
mod any_key;
mod common;
mod hints;
mod instances;
mod malformed;
mod parametric;
mod properties;
mod reading;
mod schema;
mod update;
