//! Scene files on a real disk.

#![allow(clippy::unwrap_used, reason = "helpers of tests may panic as tests may")]

mod files;
