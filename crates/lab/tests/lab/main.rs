//! Experiments against known answers.
#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may panic as tests may")]

mod agreement;
mod audit;
mod comparing;
mod depth;
mod detective;
mod documents;
mod exact;
mod first_look;
mod independent;
#[allow(unreachable_pub, reason = "tests of other crates use it, too")]
#[path = "../independent/mod.rs"]
mod independent_tracer;
mod maps;
mod measuring;
mod scenes;
mod work;
