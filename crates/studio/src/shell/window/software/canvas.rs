//! A picture of the window that is kept from frame to frame.

use std::sync::Arc;

use eframe::egui_wgpu::{CallbackResources, CallbackTrait, RenderState};
use egui::{PaintCallbackInfo, Rect, TextureId};

use super::pipelines::{CanvasPipelines, FORMAT};
use crate::shell::repaint::{CanvasArea, FrameTriangles};

pub(super) struct SoftwareCanvas {
    device: wgpu::Device,
    queue: wgpu::Queue,
    pipelines: Arc<CanvasPipelines>,
    sheet: Option<CanvasPixels>,
}

/// The pixels of the canvas as a texture.
struct CanvasPixels {
    view: wgpu::TextureView,
    bind_group: wgpu::BindGroup,
    area: CanvasArea,
}

impl SoftwareCanvas {
    pub(super) fn new(state: &RenderState) -> Self {
        Self {
            device: state.device.clone(),
            queue: state.queue.clone(),
            pipelines: Arc::new(CanvasPipelines::new(&state.device, state.target_format)),
            sheet: None,
        }
    }

    /// Makes the canvas as large as the window, and gives it back; `None` for a window without pixels.
    pub(super) fn fit(&mut self, screen: Rect, pixels_per_point: f32) -> Option<CanvasArea> {
        let limit = self.device.limits().max_texture_dimension_2d;
        let sides = screen.size() * pixels_per_point;
        let size = [sides.x, sides.y].map(|side| (side.round() as u32).min(limit));
        let area = CanvasArea { size, screen, pixels_per_point };
        if self.sheet.as_ref().is_some_and(|sheet| sheet.area == area) {
            return Some(area);
        }
        self.sheet = (!size.contains(&0)).then(|| {
            let texture = self.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("window"),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: FORMAT,
                usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            });
            let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
            let bind_group = self.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("window"),
                layout: &self.pipelines.window,
                entries: &[wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::TextureView(&view),
                }],
            });
            CanvasPixels { view, bind_group, area }
        });
        self.sheet.as_ref().map(|sheet| sheet.area)
    }

    /// Draws triangles with textures by their numbers; without a texture they are left out.
    pub(super) fn draw(
        &self,
        frame: &FrameTriangles,
        texture: impl Fn(TextureId) -> Option<wgpu::BindGroup>,
    ) {
        if let Some(sheet) = &self.sheet
            && !frame.runs.is_empty()
        {
            self.submit(sheet, frame, texture);
        }
    }

    fn submit(
        &self,
        sheet: &CanvasPixels,
        frame: &FrameTriangles,
        texture: impl Fn(TextureId) -> Option<wgpu::BindGroup>,
    ) {
        let bytes = frame.bytes();
        // Not written while it is mapped: that panics when the device is lost.
        let corners = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("corners"),
            size: bytes.len() as u64,
            usage: wgpu::BufferUsages::VERTEX | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        self.queue.write_buffer(&corners, 0, bytes);
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("window"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &sheet.view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
            })],
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_vertex_buffer(0, corners.slice(..));
        for run in &frame.runs {
            let [x, y, width, height] = run.scissor;
            pass.set_scissor_rect(x, y, width, height);
            pass.set_pipeline(self.pipelines.of(run.kind));
            if run.kind.is_textured() {
                let Some(texture) = texture(run.texture) else { continue };
                pass.set_bind_group(0, &texture, &[]);
            }
            pass.draw(run.corners.clone(), 0..1);
        }
        drop(pass);
        self.queue.submit([encoder.finish()]);
    }

    /// What brings the canvas to the screen.
    pub(super) fn copy(&self) -> Option<CanvasCopy> {
        let bind_group = self.sheet.as_ref()?.bind_group.clone();
        Some(CanvasCopy { pipelines: Arc::clone(&self.pipelines), bind_group })
    }
}

/// Copies a canvas to the screen.
pub(super) struct CanvasCopy {
    pipelines: Arc<CanvasPipelines>,
    bind_group: wgpu::BindGroup,
}

impl CallbackTrait for CanvasCopy {
    fn paint(
        &self,
        info: PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        _resources: &CallbackResources,
    ) {
        let [width, height] = info.screen_size_px;
        pass.set_viewport(0.0, 0.0, width as f32, height as f32, 0.0, 1.0);
        pass.set_scissor_rect(0, 0, width, height);
        pass.set_pipeline(&self.pipelines.copied);
        pass.set_bind_group(0, &self.bind_group, &[]);
        pass.draw(0..3, 0..1);
    }
}
