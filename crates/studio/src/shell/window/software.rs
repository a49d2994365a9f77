//! Drawing the window where there is no graphics card.
//!
//! egui's shader chooses in every pixel how to filter a texture and whether to dither, and egui draws the whole window
//! in every frame. A software driver (Mesa's lavapipe) computes all that is not chosen too, and needs 90 ms for a frame.
//! Here the same triangles are drawn by shaders that compute only what is wanted, and only where the window has changed:
//! 10 ms.

mod canvas;
mod pipelines;

use std::mem;

use eframe::egui_wgpu::{Callback, RenderState};
use egui::epaint::ClippedShape;
use egui::{Context, FullOutput, Plugin, Shape};

use crate::shell::repaint::Repaint;
use canvas::SoftwareCanvas;

/// Takes over the drawing of a new window, if a software driver draws it.
pub(super) fn install(context: &Context, state: &RenderState) {
    let is_software = state.adapter.get_info().device_type == wgpu::DeviceType::Cpu;
    // Colors are gamma-encoded here, as in the formats that egui prefers.
    let is_drawing = is_software && !state.target_format.is_srgb();
    context.plugin_or_default::<SoftwarePainter>().lock().drawing =
        is_drawing.then(|| SoftwareRenderer::new(state));
}

/// Lets go of a window whose device is lost.
pub(super) fn leave(context: &Context) {
    context.with_plugin(|software: &mut SoftwarePainter| software.drawing = None);
}

/// Paints egui's output on a canvas, which egui's renderer brings to the screen.
#[derive(Default)]
struct SoftwarePainter {
    /// In a window that a software driver draws.
    drawing: Option<SoftwareRenderer>,
}

/// The renderer of one window that a software driver draws.
struct SoftwareRenderer {
    state: RenderState,
    canvas: SoftwareCanvas,
    repaint: Repaint,
}

impl SoftwareRenderer {
    fn new(state: &RenderState) -> Self {
        Self { state: state.clone(), canvas: SoftwareCanvas::new(state), repaint: Repaint::default() }
    }

    fn draw(&mut self, context: &Context, output: &mut FullOutput) {
        self.repaint.note_textures(&output.textures_delta);
        // Only egui's renderer can call what others draw.
        if output.shapes.iter().any(|clipped| matches!(clipped.shape, Shape::Callback(_))) {
            self.repaint.forget();
            return;
        }
        let screen = context.viewport_rect();
        let shapes = mem::take(&mut output.shapes);
        let primitives = context.tessellate(shapes, output.pixels_per_point);
        let mut renderer = self.state.renderer.write();
        for (id, deltas) in output.textures_delta.set.drain() {
            for delta in &deltas {
                renderer.update_texture(&self.state.device, &self.state.queue, id, delta);
            }
        }
        let Some(area) = self.canvas.fit(screen, output.pixels_per_point) else {
            self.repaint.forget();
            return;
        };
        let frame = self.repaint.frame(primitives, area);
        self.canvas.draw(&frame, |id| Some(renderer.texture(&id)?.bind_group.clone()));
        if let Some(copy) = self.canvas.copy() {
            let callback = Callback::new_paint_callback(screen, copy);
            output.shapes = vec![ClippedShape::new(screen, callback)];
        }
    }
}

impl Plugin for SoftwarePainter {
    fn debug_name(&self) -> &'static str {
        "software drawing"
    }

    fn output_hook(&mut self, context: &Context, output: &mut FullOutput) {
        if let Some(drawing) = &mut self.drawing {
            drawing.draw(context, output);
        }
    }
}
