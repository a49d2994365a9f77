//! Drawing the window where there is no graphics card.
//!
//! egui's shader chooses in every pixel how to filter a texture and whether to dither. A graphics card skips what is
//! not chosen; a software driver (Mesa's lavapipe) computes all of it, and a frame takes 90 ms instead of 10. Here the
//! same triangles are drawn with shaders that compute only what is wanted, and no texture is read where there is none.

use std::mem;
use std::num::NonZeroU64;
use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use eframe::egui_wgpu::{Callback, CallbackResources, CallbackTrait, RenderState};
use egui::epaint::{ClippedPrimitive, ClippedShape, Mesh, Primitive, Vertex, WHITE_UV};
use egui::{Context, FullOutput, PaintCallbackInfo, Plugin, Rect, Shape, TextureId};
use wgpu::util::DeviceExt as _;

/// Takes over the drawing of the window, if a software driver draws it.
pub(super) fn install(context: &Context, state: &RenderState) {
    let is_software = state.adapter.get_info().device_type == wgpu::DeviceType::Cpu;
    // The shaders write gamma-encoded colors, as egui's do into the formats it prefers.
    if is_software && !state.target_format.is_srgb() {
        context.add_plugin(Lean { pipelines: Pipelines::new(state), state: state.clone() });
    }
}

/// Replaces what egui would draw by one piece that draws the same with less work.
struct Lean {
    state: RenderState,
    pipelines: Pipelines,
}

impl Plugin for Lean {
    fn debug_name(&self) -> &'static str {
        "lean"
    }

    fn output_hook(&mut self, context: &Context, output: &mut FullOutput) {
        // A callback here would be somebody else's drawing: only egui's renderer can call it.
        if output.shapes.iter().any(|clipped| matches!(clipped.shape, Shape::Callback(_))) {
            return;
        }
        let shapes = mem::take(&mut output.shapes);
        let primitives = context.tessellate(shapes, output.pixels_per_point);
        let mut renderer = self.state.renderer.write();
        for (id, deltas) in output.textures_delta.set.drain() {
            for delta in &deltas {
                renderer.update_texture(&self.state.device, &self.state.queue, id, delta);
            }
        }
        let texture = |id| renderer.texture(&id).map(|texture| texture.bind_group.clone());
        let screen = context.viewport_rect();
        let drawing = Drawing::new(&self.state.device, &self.pipelines, screen, &primitives, texture);
        let callback = Callback::new_paint_callback(screen, drawing);
        output.shapes = vec![ClippedShape::new(screen, callback)];
    }
}

/// Triangles of at least this area, in square points, are worth a change of the shader.
const LARGE: f32 = 2000.0;

fn area([one, two, three]: &[Vertex; 3]) -> f32 {
    let (along, aside) = (two.pos - one.pos, three.pos - one.pos);
    0.5 * (along.x * aside.y - along.y * aside.x).abs()
}

/// How a triangle is colored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// By its corners, hiding what is behind.
    Opaque,
    /// By its corners, over what is behind.
    Plain,
    /// By its corners and a texture, over what is behind.
    Textured,
}

impl Kind {
    fn of(corners: [Vertex; 3], texture: TextureId) -> Self {
        // egui draws areas with the white corner of its font's texture.
        if area(&corners) < LARGE || texture != TextureId::default() || corners.iter().any(|corner| corner.uv != WHITE_UV) {
            Self::Textured
        } else if corners.iter().all(|corner| corner.color.is_opaque()) {
            Self::Opaque
        } else {
            Self::Plain
        }
    }
}

#[derive(Clone)]
struct Pipelines {
    opaque: wgpu::RenderPipeline,
    plain: wgpu::RenderPipeline,
    textured: wgpu::RenderPipeline,
}

impl Pipelines {
    fn new(state: &RenderState) -> Self {
        let device = &state.device;
        let module = device.create_shader_module(wgpu::include_wgsl!("lean.wgsl"));
        // The same entries as in egui's layout, so that its bind groups fit.
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty,
            count: None,
        };
        let texture = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("lean texture"),
            entries: &[
                entry(
                    0,
                    wgpu::BindingType::Texture {
                        multisampled: false,
                        sample_type: wgpu::TextureSampleType::Float { filterable: true },
                        view_dimension: wgpu::TextureViewDimension::D2,
                    },
                ),
                entry(1, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)),
                entry(
                    2,
                    wgpu::BindingType::Buffer {
                        has_dynamic_offset: false,
                        min_binding_size: NonZeroU64::new(16),
                        ty: wgpu::BufferBindingType::Uniform,
                    },
                ),
            ],
        });
        let pipeline = |label, entry_point, blend, layouts: &[Option<&wgpu::BindGroupLayout>]| {
            let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(label),
                bind_group_layouts: layouts,
                immediate_size: 0,
            });
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(label),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("corner"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[Some(wgpu::VertexBufferLayout {
                        array_stride: size_of::<Corner>() as u64,
                        step_mode: wgpu::VertexStepMode::Vertex,
                        attributes: &wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x2, 2 => Unorm8x4],
                    })],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(entry_point),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &[Some(wgpu::ColorTargetState {
                        format: state.target_format,
                        blend,
                        write_mask: wgpu::ColorWrites::ALL,
                    })],
                }),
                multiview_mask: None,
                cache: None,
            })
        };
        let over = Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING);
        Self {
            opaque: pipeline("lean opaque", "plain", None, &[]),
            plain: pipeline("lean plain", "plain", over, &[]),
            textured: pipeline("lean textured", "textured", over, &[Some(&texture)]),
        }
    }
}

/// A corner of a triangle: its place on the screen from -1 to 1, in a texture from 0 to 1, and its color.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct Corner {
    position: [f32; 2],
    uv: [f32; 2],
    color: [u8; 4],
}

/// Triangles of one kind, next to each other.
struct Run {
    kind: Kind,
    clip: Rect,
    texture: wgpu::BindGroup,
    indices: Range<u32>,
}

/// All that is drawn in a frame.
struct Drawing {
    pipelines: Pipelines,
    corners: wgpu::Buffer,
    indices: wgpu::Buffer,
    runs: Vec<Run>,
}

impl Drawing {
    fn new(
        device: &wgpu::Device,
        pipelines: &Pipelines,
        screen: Rect,
        primitives: &[ClippedPrimitive],
        texture: impl Fn(TextureId) -> Option<wgpu::BindGroup>,
    ) -> Self {
        let mut corners = Vec::new();
        let mut indices = Vec::new();
        let mut runs = Vec::new();
        for ClippedPrimitive { clip_rect, primitive } in primitives {
            let Primitive::Mesh(mesh) = primitive else { continue };
            let Some(texture) = texture(mesh.texture_id) else { continue };
            let first = corners.len() as u32;
            corners.extend(mesh.vertices.iter().map(|vertex| Corner::new(vertex, screen)));
            for (kind, part) in kinds(mesh) {
                let start = indices.len() as u32;
                indices.extend(part.iter().map(|index| first + index));
                let indices = start..indices.len() as u32;
                runs.push(Run { kind, clip: *clip_rect, texture: texture.clone(), indices });
            }
        }
        let buffer = |label, contents, usage| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage })
        };
        Self {
            pipelines: pipelines.clone(),
            corners: buffer("lean corners", bytemuck::cast_slice(&corners), wgpu::BufferUsages::VERTEX),
            indices: buffer("lean indices", bytemuck::cast_slice(&indices), wgpu::BufferUsages::INDEX),
            runs,
        }
    }
}

impl CallbackTrait for Drawing {
    fn paint(
        &self,
        info: PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        _resources: &CallbackResources,
    ) {
        let [width, height] = info.screen_size_px;
        pass.set_viewport(0.0, 0.0, width as f32, height as f32, 0.0, 1.0);
        pass.set_vertex_buffer(0, self.corners.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        for run in &self.runs {
            let Some([x, y, wide, high]) = pixels(run.clip, info.pixels_per_point, [width, height]) else {
                continue;
            };
            pass.set_scissor_rect(x, y, wide, high);
            match run.kind {
                Kind::Opaque => pass.set_pipeline(&self.pipelines.opaque),
                Kind::Plain => pass.set_pipeline(&self.pipelines.plain),
                Kind::Textured => {
                    pass.set_pipeline(&self.pipelines.textured);
                    pass.set_bind_group(0, &run.texture, &[]);
                }
            }
            pass.draw_indexed(run.indices.clone(), 0, 0..1);
        }
    }
}

impl Corner {
    fn new(vertex: &Vertex, screen: Rect) -> Self {
        let across = (vertex.pos - screen.min) / screen.size();
        Self {
            position: [2.0 * across.x - 1.0, 1.0 - 2.0 * across.y],
            uv: vertex.uv.into(),
            color: vertex.color.to_array(),
        }
    }
}

/// The triangles of a mesh, cut where the kind changes.
fn kinds(mesh: &Mesh) -> Vec<(Kind, &[u32])> {
    let kind = |triangle: &[u32]| {
        let corner = |at: usize| {
            let index = triangle.get(at).map_or(0, |&index| index as usize);
            mesh.vertices.get(index).copied().unwrap_or_default()
        };
        Kind::of([corner(0), corner(1), corner(2)], mesh.texture_id)
    };
    let (triangles, _) = mesh.indices.as_chunks::<3>();
    let parts = triangles.chunk_by(|one, next| kind(one) == kind(next));
    parts.filter_map(|part| Some((kind(part.first()?), part.as_flattened()))).collect()
}

/// A part of the screen in pixels: left, top, width, height. None if nothing of it is on the screen.
fn pixels(rect: Rect, pixels_per_point: f32, screen: [u32; 2]) -> Option<[u32; 4]> {
    let to = |place: f32, side: u32| ((place * pixels_per_point).round() as u32).min(side);
    let [left, right] = [rect.left(), rect.right()].map(|x| to(x, screen[0]));
    let [top, bottom] = [rect.top(), rect.bottom()].map(|y| to(y, screen[1]));
    (left < right && top < bottom).then(|| [left, top, right - left, bottom - top])
}
