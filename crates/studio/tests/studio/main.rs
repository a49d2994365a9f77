//! The studio used as a person uses it, headless: widgets are found by their accessible labels.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "tests")]

mod kit;
mod look;
mod render;
mod window;
