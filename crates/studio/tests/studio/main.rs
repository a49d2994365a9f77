//! The studio used as a person uses it, headless: widgets are found by their accessible labels.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "tests")]

mod commands;
mod kit;
mod look;
mod monkey;
mod outliner;
mod render;
mod window;
