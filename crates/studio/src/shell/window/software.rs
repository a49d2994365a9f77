//! Drawing the window where there is no graphics card.
//!
//! egui's shader chooses in every pixel how to filter a texture and whether to dither, and egui draws the whole window
//! in every frame. A graphics card does not mind; a software driver (Mesa's lavapipe) computes all that is not chosen
//! too, and needs 90 ms for a frame. Here the same triangles are drawn by shaders that compute only what is wanted, and
//! only where the window has changed: 10 ms.

mod canvas;
mod damage;
mod pipelines;

use std::collections::HashSet;
use std::mem;

use eframe::egui_wgpu::{Callback, RenderState};
use egui::epaint::{ClippedShape, ImageData};
use egui::{Color32, Context, FullOutput, Plugin, Shape, TextureId};

use canvas::{SoftwareCanvas, SoftwareTexture};
use damage::{DrawBatch, damage, pieces};

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
    /// What is on the canvas.
    drawn: Vec<DrawBatch>,
    /// The textures that nothing is seen through.
    opaque: HashSet<TextureId>,
}

impl SoftwareRenderer {
    fn new(state: &RenderState) -> Self {
        Self {
            state: state.clone(),
            canvas: SoftwareCanvas::new(state),
            drawn: Vec::new(),
            opaque: HashSet::new(),
        }
    }

    /// Brings the textures up to date, and tells which of them look otherwise where they were used before.
    fn update_textures(&mut self, output: &mut FullOutput) -> HashSet<TextureId> {
        let mut renderer = self.state.renderer.write();
        let mut renewed = HashSet::new();
        self.opaque.retain(|id| !output.textures_delta.free.contains(id));
        for (id, deltas) in output.textures_delta.set.drain() {
            for delta in &deltas {
                renderer.update_texture(&self.state.device, &self.state.queue, id, delta);
                let ImageData::Color(image) = &delta.image;
                let is_part = delta.pos.is_some();
                // A part that is opaque does not tell of the whole.
                if !is_part && image.pixels.iter().all(Color32::is_opaque) {
                    self.opaque.insert(id);
                } else {
                    self.opaque.remove(&id);
                }
                // Glyphs are only added to the texture of the fonts, where there was nothing.
                if !is_part || id != TextureId::default() {
                    renewed.insert(id);
                }
            }
        }
        renewed
    }

    fn draw(&mut self, context: &Context, output: &mut FullOutput) {
        // Only egui's renderer can call what others draw.
        if output.shapes.iter().any(|clipped| matches!(clipped.shape, Shape::Callback(_))) {
            self.drawn.clear();
            self.canvas.forget();
            return;
        }
        let screen = context.viewport_rect();
        let shapes = mem::take(&mut output.shapes);
        let new = pieces(context.tessellate(shapes, output.pixels_per_point));
        let renewed = self.update_textures(output);
        let damage = if self.canvas.fit(screen, output.pixels_per_point) {
            damage(&self.drawn, &new, &renewed)
        } else {
            vec![screen]
        };
        let renderer = self.state.renderer.read();
        self.canvas.draw(&new, &damage, |id| {
            let bind_group = renderer.texture(&id)?.bind_group.clone();
            Some(SoftwareTexture { bind_group, is_opaque: self.opaque.contains(&id) })
        });
        self.drawn = new;
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
