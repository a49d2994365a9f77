//! The studio used as a person uses it, headless: widgets are found by their accessible labels.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests")]

mod audit;
mod card;
mod commands;
mod documents;
mod example_note;
mod experiments;
mod fit;
mod in_sight;
mod inspector;
mod kit;
mod lab;
mod manual;
mod materials;
mod menu;
mod monkey;
mod outliner;
mod parts;
mod render;
mod software;
mod spoken;
mod sweeps;
mod viewport;
mod window;

/// The program's allocator, for the test that measures memory.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;
