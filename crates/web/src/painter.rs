//! Draws what the toolkit has laid out, by WebGL 2.

use std::sync::Arc;

use egui::{ClippedPrimitive, TexturesDelta};
use egui_glow::{Painter, glow};
use js_sys::{Object, Reflect};
use wasm_bindgen::{JsCast as _, JsValue};
use web_sys::{OffscreenCanvas, WebGl2RenderingContext};

/// What a browser gives a canvas unless it is told otherwise. The toolkit smooths edges itself: with antialiasing a glyph
/// takes colors from its neighbor in the texture, and a frame without a graphics card takes twice as long.
const UNUSED: [&str; 4] = ["alpha", "antialias", "depth", "stencil"];

/// Draws into a canvas.
pub(crate) struct CanvasPainter {
    canvas: OffscreenCanvas,
    painter: Painter,
}

impl CanvasPainter {
    /// A painter for a canvas that nothing else draws into.
    ///
    /// # Errors
    /// When the browser has no WebGL 2, or it fails.
    pub(crate) fn new(canvas: OffscreenCanvas) -> Result<Self, String> {
        let context = canvas
            .get_context_with_context_options("webgl2", &without(&UNUSED))
            .ok()
            .flatten()
            .and_then(|context| context.dyn_into::<WebGl2RenderingContext>().ok())
            .ok_or("WebGL 2")?;
        #[allow(clippy::arc_with_non_send_sync, reason = "the painter wants it so")]
        let gl = Arc::new(glow::Context::from_webgl2_context(context));
        let painter = Painter::new(gl, "", None, false).map_err(|error| error.to_string())?;
        Ok(Self { canvas, painter })
    }

    pub(crate) fn max_texture_side(&self) -> usize {
        self.painter.max_texture_side()
    }

    /// Gives the canvas another size, pixels.
    pub(crate) fn resize(&self, [width, height]: [u32; 2]) {
        if [self.canvas.width(), self.canvas.height()] != [width, height] {
            self.canvas.set_width(width);
            self.canvas.set_height(height);
        }
    }

    pub(crate) fn paint(
        &mut self,
        primitives: &[ClippedPrimitive],
        mut textures: TexturesDelta,
        pixels_per_point: f32,
        background: [f32; 4],
    ) {
        let size = [self.canvas.width(), self.canvas.height()];
        self.painter.clear(size, background);
        self.painter.paint_and_update_textures(size, pixels_per_point, primitives, &mut textures);
    }
}

/// Options that are all off.
fn without(names: &[&str]) -> JsValue {
    let options = Object::new();
    for name in names {
        // A fresh object takes every property.
        let _ = Reflect::set(&options, &(*name).into(), &JsValue::FALSE);
    }
    options.into()
}
