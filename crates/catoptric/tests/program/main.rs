//! The program as its users meet it: commands, files, streams, signals, the window.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "helpers of tests may panic as tests may"
)]

mod audit;
mod check;
mod common;
mod compare;
mod completion;
mod control;
mod convert;
#[cfg(all(target_os = "linux", feature = "studio"))]
mod desk;
mod diff;
mod examples;
mod foreign;
mod formats;
#[allow(dead_code, unreachable_pub, reason = "the tests of the laboratory use all of it")]
#[path = "../../../lab/tests/independent/mod.rs"]
mod independent;
#[cfg(unix)]
mod interrupt;
mod marking;
mod measure;
#[cfg(target_os = "linux")]
mod memory;
mod methods;
mod overwriting;
mod render;
#[cfg(feature = "serve")]
mod serve;
mod set;
#[cfg(unix)]
mod streams;
#[cfg(feature = "studio")]
mod studio;
#[cfg(all(target_os = "linux", feature = "studio"))]
mod window;
