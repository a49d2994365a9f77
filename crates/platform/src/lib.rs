#![doc = include_str!("../README.md")]

pub mod files;
pub mod process;
pub mod threads;
pub mod time;
