//! Scenes for measuring, made by rule: the same on every machine.

mod cloud;
mod glass_grid;
mod sphereflake;

pub(crate) use cloud::{CloudArguments, write_cloud};
pub(crate) use glass_grid::{glass_grid, lens_grid};
pub(crate) use sphereflake::sphereflake;
