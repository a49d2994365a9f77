//! The GPU's twin against the CPU, and what becomes of faults.
//!
//! What needs a driver runs through whatever there is, Mesa's lavapipe if nothing else, and says so when it is skipped.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may panic as tests may")]

mod cemented;
mod common;
mod extremes;
mod faults;
mod follow;
mod joined;
mod layout;
mod numbers;
mod parity;
mod physical;
mod pictures;
mod precision;
mod screen;
mod shaders;
