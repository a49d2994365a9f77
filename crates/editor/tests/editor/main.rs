//! The editor as a user interface sees it: gestures, history, actions, clipboard, saving, and a monkey.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests may panic as tests may")]

mod actions;
mod addresses;
mod clipboard;
mod common;
mod document;
mod history;
mod identity;
mod images;
mod instances;
mod join;
mod materials;
mod monkey;
mod parts;
