//! `catoptric serve` in a program that is built without the server

use anyhow::{Result, bail};

use super::CommandOutcome;
use crate::arguments::ServeArguments;

pub(crate) fn run(_: &ServeArguments) -> Result<CommandOutcome> {
    bail!(
        "this program is built without the server; `cargo install --path crates/catoptric` builds all of it"
    )
}
