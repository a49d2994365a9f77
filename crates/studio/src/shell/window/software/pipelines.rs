//! The pipelines that draw triangles.

use std::num::NonZeroU64;

use crate::shell::repaint::{CanvasVertex, FillKind};

/// The format of the canvas: like the formats that egui prefers, it holds gamma-encoded colors.
pub(super) const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// A pipeline for each kind of triangle, and one that copies the canvas to the screen.
pub(super) struct CanvasPipelines {
    opaque: wgpu::RenderPipeline,
    plain: wgpu::RenderPipeline,
    textured: wgpu::RenderPipeline,
    picture: wgpu::RenderPipeline,
    pub(super) copied: wgpu::RenderPipeline,
    /// The layout of what is copied.
    pub(super) window: wgpu::BindGroupLayout,
}

impl CanvasPipelines {
    pub(super) fn new(device: &wgpu::Device, target: wgpu::TextureFormat) -> Self {
        let module = device.create_shader_module(wgpu::include_wgsl!("shader.wgsl"));
        let (texture, window) = (texture_layout(device), window_layout(device));
        let attributes = wgpu::vertex_attr_array![0 => Float32x2, 1 => Float32x2, 2 => Unorm8x4];
        let corners = [Some(wgpu::VertexBufferLayout {
            array_stride: size_of::<CanvasVertex>() as u64,
            step_mode: wgpu::VertexStepMode::Vertex,
            attributes: &attributes,
        })];
        let pipeline = |[vertex, fragment]: [&str; 2], format, blend, layout| {
            let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some(fragment),
                bind_group_layouts: &[layout],
                immediate_size: 0,
            });
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(fragment),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some(vertex),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: if vertex == "corner" { &corners } else { &[] },
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: None,
                multisample: wgpu::MultisampleState::default(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(fragment),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    targets: &[Some(wgpu::ColorTargetState {
                        format,
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
            opaque: pipeline(["corner", "plain"], FORMAT, None, None),
            plain: pipeline(["corner", "plain"], FORMAT, over, None),
            textured: pipeline(["corner", "textured"], FORMAT, over, Some(&texture)),
            picture: pipeline(["corner", "textured"], FORMAT, None, Some(&texture)),
            copied: pipeline(["everywhere", "copied"], target, None, Some(&window)),
            window,
        }
    }

    pub(super) fn of(&self, kind: FillKind) -> &wgpu::RenderPipeline {
        match kind {
            FillKind::Opaque => &self.opaque,
            FillKind::Plain => &self.plain,
            FillKind::Textured => &self.textured,
            FillKind::Picture => &self.picture,
        }
    }
}

/// The layout of a texture's bind group, equal to egui's so that its bind groups fit.
fn texture_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let flags = wgpu::BindingType::Buffer {
        has_dynamic_offset: false,
        min_binding_size: NonZeroU64::new(16),
        ty: wgpu::BufferBindingType::Uniform,
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
    layout(device, &[entry(0, image(true)), entry(1, sampler), entry(2, flags)])
}

fn window_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    layout(device, &[entry(0, image(false))])
}

fn layout(device: &wgpu::Device, entries: &[wgpu::BindGroupLayoutEntry]) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries })
}

fn entry(binding: u32, ty: wgpu::BindingType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::FRAGMENT, ty, count: None }
}

fn image(filterable: bool) -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        multisampled: false,
        sample_type: wgpu::TextureSampleType::Float { filterable },
        view_dimension: wgpu::TextureViewDimension::D2,
    }
}
