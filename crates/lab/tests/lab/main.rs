//! Experiments against known answers.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may panic as tests may")]

mod audit;
mod depth;
mod documents;
mod exact;
mod maps;
mod scenes;
mod work;
