#![doc = include_str!("../README.md")]

pub mod files;
pub mod threads;
pub mod time;
