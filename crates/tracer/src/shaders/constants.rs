//! Limits that Rust and the shaders share, and constants as the source of a shader.

use std::fmt::Write as _;

/// The most bodies that a list of media of the shaders has room for.
pub(crate) const MOST_MEDIA: usize = 16;

/// The most transparent bodies on the way to a light that the shaders have room for, where some of them absorb.
pub(crate) const MOST_INTERVALS: u32 = 24;

/// The most surfaces of clear bodies on the way to a light that the shaders have room for, where some are cemented.
pub(crate) const MOST_CROSSINGS: u32 = 2 * MOST_INTERVALS;

/// The most rays of one tree: what a thread of a slow card can trace before its driver takes it for hung.
pub(crate) const MOST_RAYS: u32 = 1 << 16;

/// The most samples of one [`FrameUniforms`](super::FrameUniforms).
pub const FRAME_PLACES: usize = 16;

/// Constants of the Rust side, and those that a shader is specialized by.
pub(crate) struct ShaderConstants {
    pub(crate) words: Vec<(&'static str, u32)>,
    pub(crate) numbers: Vec<(&'static str, f32)>,
    pub(crate) flags: Vec<(&'static str, bool)>,
}

impl ShaderConstants {
    pub(crate) fn text(&self) -> String {
        let mut text = String::new();
        // Writing to a string does not fail.
        for (name, value) in &self.words {
            let _ = writeln!(text, "const {name}: u32 = {value}u;");
        }
        for (name, value) in &self.numbers {
            let _ = writeln!(text, "const {name}: f32 = {value:e}f;");
        }
        for (name, value) in &self.flags {
            let _ = writeln!(text, "const {name}: bool = {value};");
        }
        text
    }
}
