//! A picture of the window that is kept from frame to frame.

use std::sync::Arc;

use eframe::egui_wgpu::{CallbackResources, CallbackTrait, RenderState};
use egui::epaint::{Vertex, WHITE_UV};
use egui::{Color32, PaintCallbackInfo, Pos2, Rect, TextureId, Vec2, vec2};

use super::damage::{DrawBatch, Triangle, around};
use super::pipelines::{CanvasPipelines, CanvasVertex, FORMAT, FillKind};

/// A texture of the software renderer.
pub(super) struct SoftwareTexture {
    /// With egui's layout.
    pub(super) bind_group: wgpu::BindGroup,
    pub(super) is_opaque: bool,
}

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
    /// Width and height, pixels.
    size: [u32; 2],
    screen: Rect,
    pixels_per_point: f32,
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

    /// Forgets what is on the canvas.
    pub(super) fn forget(&mut self) {
        self.sheet = None;
    }

    /// Makes the canvas as large as the window. Returns whether what was drawn is still there.
    pub(super) fn fit(&mut self, screen: Rect, pixels_per_point: f32) -> bool {
        let is_fitting =
            |sheet: &CanvasPixels| sheet.screen == screen && sheet.pixels_per_point == pixels_per_point;
        if self.sheet.as_ref().is_some_and(is_fitting) {
            return true;
        }
        let limit = self.device.limits().max_texture_dimension_2d;
        let sides = screen.size() * pixels_per_point;
        let size = [sides.x, sides.y].map(|side| (side.round() as u32).min(limit));
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
            CanvasPixels { view, bind_group, size, screen, pixels_per_point }
        });
        false
    }

    /// Draws `pieces` anew in the parts `damage`.
    pub(super) fn draw(
        &self,
        pieces: &[DrawBatch],
        damage: &[Rect],
        texture: impl Fn(TextureId) -> Option<SoftwareTexture>,
    ) {
        let Some(sheet) = &self.sheet else { return };
        let textures: Vec<_> = pieces.iter().map(|piece| texture(piece.texture)).collect();
        let mut batch = FrameTriangles::default();
        for part in damage {
            // Rounding may have left out a pixel at the edge.
            let part = part.expand(1.0);
            batch.add(sheet, part, None, FillKind::Opaque, &blank(part));
            for (piece, texture) in pieces.iter().zip(&textures) {
                let Some(texture) = texture else { continue };
                let is_own = piece.texture == TextureId::default();
                let kind = |triangle: &Triangle| FillKind::of(triangle, is_own, texture.is_opaque);
                for run in piece.triangles.chunk_by(|one, next| kind(one) == kind(next)) {
                    let Some(first) = run.first() else { continue };
                    batch.add(sheet, part.intersect(piece.clip), Some(texture), kind(first), run);
                }
            }
        }
        if !batch.runs.is_empty() {
            self.submit(sheet, &batch);
        }
    }

    fn submit(&self, sheet: &CanvasPixels, batch: &FrameTriangles<'_>) {
        let bytes: &[u8] = bytemuck::cast_slice(&batch.corners);
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
        for run in &batch.runs {
            let [x, y, width, height] = run.scissor;
            pass.set_scissor_rect(x, y, width, height);
            pass.set_pipeline(self.pipelines.of(run.kind));
            if let (FillKind::Textured | FillKind::Picture, Some(texture)) = (run.kind, run.texture) {
                pass.set_bind_group(0, &texture.bind_group, &[]);
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

/// Two triangles that hide what was there.
fn blank(part: Rect) -> [Triangle; 2] {
    let corner = |pos: Pos2| Vertex { pos, uv: WHITE_UV, color: Color32::BLACK };
    let [one, two, three, four] =
        [part.left_top(), part.right_top(), part.right_bottom(), part.left_bottom()].map(corner);
    [[one, two, three], [one, three, four]]
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

/// The triangles of a frame.
#[derive(Default)]
struct FrameTriangles<'a> {
    corners: Vec<CanvasVertex>,
    runs: Vec<TriangleRun<'a>>,
}

/// Neighboring triangles of one kind, drawn by one call.
struct TriangleRun<'a> {
    kind: FillKind,
    texture: Option<&'a SoftwareTexture>,
    scissor: [u32; 4],
    corners: std::ops::Range<u32>,
}

impl<'a> FrameTriangles<'a> {
    /// Adds the triangles that reach into the part `clip`.
    fn add(
        &mut self,
        sheet: &CanvasPixels,
        clip: Rect,
        texture: Option<&'a SoftwareTexture>,
        kind: FillKind,
        run: &[Triangle],
    ) {
        let Some(scissor) = sheet.pixels(clip) else { return };
        let start = self.corners.len() as u32;
        let reaching = run.iter().filter(|triangle| around(triangle).intersects(clip));
        self.corners.extend(reaching.flatten().map(|vertex| sheet.corner(vertex)));
        let end = self.corners.len() as u32;
        match self.runs.last_mut() {
            _ if start == end => {}
            // What was left out in between has brought them together.
            Some(last)
                if last.kind == kind
                    && last.scissor == scissor
                    && last.texture.map(std::ptr::from_ref) == texture.map(std::ptr::from_ref) =>
            {
                last.corners.end = end;
            }
            _ => self.runs.push(TriangleRun { kind, texture, scissor, corners: start..end }),
        }
    }
}

impl CanvasPixels {
    fn corner(&self, vertex: &Vertex) -> CanvasVertex {
        let points = vec2(self.size[0] as f32, self.size[1] as f32) / self.pixels_per_point;
        let Vec2 { x, y } = (vertex.pos - self.screen.min) / points;
        CanvasVertex {
            position: [2.0 * x - 1.0, 1.0 - 2.0 * y],
            uv: vertex.uv.into(),
            color: vertex.color.to_array(),
        }
    }

    /// A part of the window in pixels: left, top, width, height. None if nothing of it is on the canvas.
    fn pixels(&self, part: Rect) -> Option<[u32; 4]> {
        let part = part.translate(-self.screen.min.to_vec2());
        let to = |place: f32, side: u32| ((place * self.pixels_per_point).round() as u32).min(side);
        let [left, right] = [part.left(), part.right()].map(|x| to(x, self.size[0]));
        let [top, bottom] = [part.top(), part.bottom()].map(|y| to(y, self.size[1]));
        (left < right && top < bottom).then(|| [left, top, right - left, bottom - top])
    }
}
