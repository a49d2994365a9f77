//! Draws what the toolkit has laid out, by WebGL 2.

mod changes;

use std::sync::Arc;

use egui::{ClippedPrimitive, TexturesDelta};
use egui_glow::{Painter, glow};
use js_sys::{Object, Reflect};
use wasm_bindgen::{JsCast as _, JsValue};
use web_sys::{OffscreenCanvas, WebGl2RenderingContext};

use changes::ChangesPainter;

/// What a browser gives a canvas unless it is told otherwise. The toolkit smooths edges itself: with antialiasing a glyph
/// takes colors from its neighbor in the texture, and a frame without a graphics card takes twice as long.
const UNUSED: [&str; 4] = ["alpha", "antialias", "depth", "stencil"];

/// Parts of the names of software drivers: Chromium's, Mesa's, and that of Windows.
const SOFTWARE: [&str; 4] = ["SwiftShader", "llvmpipe", "softpipe", "Basic Render"];

/// Draws into a canvas.
pub(crate) struct CanvasPainter {
    canvas: OffscreenCanvas,
    way: PaintWay,
}

enum PaintWay {
    /// The whole window, as graphics cards like it.
    Whole(Painter),
    /// What has changed, for software drivers.
    Changes(ChangesPainter),
}

impl CanvasPainter {
    /// A painter for a canvas that nothing else draws into. It draws what has changed if a software driver draws, unless
    /// `is_whole`.
    ///
    /// # Errors
    /// When the browser has no WebGL 2, or it fails.
    pub(crate) fn new(canvas: OffscreenCanvas, is_whole: bool) -> Result<Self, String> {
        let way = if !is_whole && is_software() {
            let gl = context(&canvas, true).ok_or("WebGL 2")?;
            PaintWay::Changes(ChangesPainter::new(gl)?)
        } else {
            let gl = context(&canvas, false).ok_or("WebGL 2")?;
            #[allow(clippy::arc_with_non_send_sync, reason = "the painter wants it so")]
            let gl = Arc::new(glow::Context::from_webgl2_context(gl));
            PaintWay::Whole(Painter::new(gl, "", None, false).map_err(|error| error.to_string())?)
        };
        Ok(Self { canvas, way })
    }

    pub(crate) fn max_texture_side(&self) -> usize {
        match &self.way {
            PaintWay::Whole(painter) => painter.max_texture_side(),
            PaintWay::Changes(painter) => painter.max_texture_side(),
        }
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
        primitives: Vec<ClippedPrimitive>,
        mut textures: TexturesDelta,
        pixels_per_point: f32,
        background: [f32; 4],
    ) {
        let size = [self.canvas.width(), self.canvas.height()];
        match &mut self.way {
            PaintWay::Whole(painter) => {
                painter.clear(size, background);
                painter.paint_and_update_textures(size, pixels_per_point, &primitives, &mut textures);
            }
            PaintWay::Changes(painter) => painter.paint(primitives, &textures, pixels_per_point, size),
        }
    }
}

/// Whether a software driver draws what browsers draw by WebGL.
fn is_software() -> bool {
    let Some(gl) = OffscreenCanvas::new(1, 1).ok().and_then(|canvas| context(&canvas, false)) else {
        return false;
    };
    // Firefox tells by the one what others tell by the other.
    const UNMASKED_RENDERER_WEBGL: u32 = 0x9246;
    let _ = gl.get_extension("WEBGL_debug_renderer_info");
    let names =
        [WebGl2RenderingContext::RENDERER, UNMASKED_RENDERER_WEBGL].map(|name| gl.get_parameter(name));
    let names = names.map(|name| name.ok().and_then(|name| name.as_string()).unwrap_or_default());
    names.iter().any(|name| SOFTWARE.iter().any(|part| name.contains(part)))
}

/// The canvas's context; `is_kept` if it is to keep what was drawn.
fn context(canvas: &OffscreenCanvas, is_kept: bool) -> Option<WebGl2RenderingContext> {
    let options = Object::new();
    let unused = UNUSED.map(|name| (name, false));
    for (name, value) in unused.into_iter().chain([("preserveDrawingBuffer", is_kept)]) {
        // A fresh object takes every property.
        let _ = Reflect::set(&options, &name.into(), &JsValue::from_bool(value));
    }
    let context = canvas.get_context_with_context_options("webgl2", &options).ok().flatten()?;
    context.dyn_into().ok()
}
