//! Colors as the tracer has them.

use catoptric_scene::Color;

/// The components of a color, linear light, in single precision.
pub(crate) fn linear_rgb(color: Color) -> [f32; 3] {
    color.to_array().map(|component| component as f32)
}
