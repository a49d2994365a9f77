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
mod maps;
mod measuring;
mod scenes;
mod work;
