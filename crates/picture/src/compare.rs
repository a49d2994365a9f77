//! How two pictures differ. Each measure has a file of its own.

pub(crate) mod difference;
pub(crate) mod heat;
mod inferno;
