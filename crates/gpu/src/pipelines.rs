//! Compiled shaders, one for each kind of scene.

use std::collections::HashMap;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

use catoptric_tracer::shaders::ShaderSpecialization;

use crate::error::GpuError;

/// What the shader is bound to: the frame, seven arrays, the film, the waves of samples, and pictures.
const BINDINGS: u32 = 11;
/// Pictures are a texture.
const PICTURES: u32 = 10;
/// The bindings of storage buffers: the arrays, the film last.
pub(crate) const STORED: std::ops::RangeInclusive<u32> = 1..=8;

/// The shaders compiled so far. A program meets few kinds of scenes, and a shader is small: none is dropped.
pub(crate) struct Pipelines {
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) pipeline_layout: wgpu::PipelineLayout,
    known: Mutex<HashMap<ShaderSpecialization, PipelineState>>,
    pub(crate) compiled: Condvar,
}

/// How far the shader of a kind of scenes is.
#[derive(Clone)]
pub(crate) enum PipelineState {
    UnderWay,
    Done(Result<wgpu::ComputePipeline, GpuError>),
}

impl Pipelines {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let entries: Vec<wgpu::BindGroupLayoutEntry> = (0..BINDINGS).map(entry).collect();
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("stage and film"),
            entries: &entries,
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("tracer"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        Self { layout, pipeline_layout, known: Mutex::default(), compiled: Condvar::new() }
    }

    pub(crate) fn known(&self) -> MutexGuard<'_, HashMap<ShaderSpecialization, PipelineState>> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Whether somebody else compiles it or has done so; else the caller has to.
    pub(crate) fn claim(&self, special: ShaderSpecialization) -> Option<PipelineState> {
        let mut known = self.known();
        let state = known.get(&special).cloned();
        if state.is_none() {
            known.insert(special, PipelineState::UnderWay);
        }
        state
    }
}

fn entry(binding: u32) -> wgpu::BindGroupLayoutEntry {
    let buffer = |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let ty = match binding {
        PICTURES => wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Uint,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        },
        _ if STORED.contains(&binding) => {
            buffer(wgpu::BufferBindingType::Storage { read_only: binding != *STORED.end() })
        }
        _ => buffer(wgpu::BufferBindingType::Uniform),
    };
    wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::COMPUTE, ty, count: None }
}
