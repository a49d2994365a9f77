//! `catoptric studio`, and `catoptric` alone, in a program that is built without the studio

use std::path::Path;

use anyhow::{Result, bail};

use super::CommandOutcome;

pub(crate) fn run(_: Option<&Path>) -> Result<CommandOutcome> {
    bail!(
        "this program is built without the studio; `cargo run --release` builds and opens it, \
         `cargo install --path crates/catoptric` installs it; `catoptric render` makes pictures without a window"
    )
}
