//! Experiments against known answers.

mod audit;
mod scenes;
