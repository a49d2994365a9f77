#![doc = include_str!("../README.md")]
#![cfg_attr(not(target_family = "wasm"), allow(dead_code, reason = "only a browser starts the studio so"))]

mod check;
mod host;
mod page;
#[cfg(target_family = "wasm")]
mod painter;
mod picture;
#[cfg(target_family = "wasm")]
mod studio;
#[cfg(target_family = "wasm")]
mod threads;
#[cfg(target_family = "wasm")]
mod web_check;

#[cfg(target_family = "wasm")]
pub use studio::{WebPicture, WebStudio, put_file, take_changes};
#[cfg(target_family = "wasm")]
pub use threads::{run_thread, use_page_threads};
#[cfg(target_family = "wasm")]
pub use web_check::WebCheck;
