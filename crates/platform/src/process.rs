//! The process, which in a browser is a page.

#[cfg(target_family = "wasm")]
use std::sync::OnceLock;

#[cfg(target_family = "wasm")]
static NUMBER: OnceLock<u32> = OnceLock::new();

/// From now on this is the number of the process, which no other page has. Only the first call counts.
#[cfg(target_family = "wasm")]
pub fn use_number(number: u32) {
    let _ = NUMBER.set(number);
}

/// A number that no other process has that runs now; on a page 0 until it has one.
pub fn number() -> u32 {
    #[cfg(not(target_family = "wasm"))]
    let number = std::process::id();
    #[cfg(target_family = "wasm")]
    let number = NUMBER.get().copied().unwrap_or_default();
    number
}
