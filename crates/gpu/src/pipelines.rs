//! Compiled shaders, one for each kind of scene.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::task::{Poll, Waker};

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
}

/// How far the shader of a kind of scenes is.
pub(crate) enum PipelineState {
    /// Those who wait for it.
    UnderWay(Vec<Waker>),
    Done(Result<wgpu::ComputePipeline, GpuError>),
}

/// The answer to somebody who needs a shader.
pub(crate) enum PipelineAnswer<'p> {
    Done(Result<wgpu::ComputePipeline, GpuError>),
    /// The asker has to compile it.
    Claimed(PipelineClaim<'p>),
}

/// The right to compile a shader, and the duty. If it is dropped, another one of those who wait gets it.
pub(crate) struct PipelineClaim<'p> {
    pipelines: &'p Pipelines,
    special: ShaderSpecialization,
}

impl Pipelines {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let entries = layout_entries();
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("stage and film"),
            entries: &entries,
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("tracer"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        Self { layout, pipeline_layout, known: Mutex::default() }
    }

    pub(crate) fn known(&self) -> MutexGuard<'_, HashMap<ShaderSpecialization, PipelineState>> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The shader of a kind, or the right to compile it. While somebody else does, `waker` is called later.
    pub(crate) fn ask(&self, special: ShaderSpecialization, waker: &Waker) -> Poll<PipelineAnswer<'_>> {
        match self.known().entry(special) {
            Entry::Vacant(place) => {
                place.insert(PipelineState::UnderWay(Vec::new()));
                Poll::Ready(PipelineAnswer::Claimed(PipelineClaim { pipelines: self, special }))
            }
            Entry::Occupied(mut state) => match state.get_mut() {
                PipelineState::Done(done) => Poll::Ready(PipelineAnswer::Done(done.clone())),
                PipelineState::UnderWay(waiting) => {
                    if !waiting.iter().any(|known| known.will_wake(waker)) {
                        waiting.push(waker.clone());
                    }
                    Poll::Pending
                }
            },
        }
    }

    /// Puts what has become of a shader in the place of the work under way, and wakes those who wait for it.
    fn end(&self, special: ShaderSpecialization, done: Option<Result<wgpu::ComputePipeline, GpuError>>) {
        let state = {
            let mut known = self.known();
            match done {
                Some(done) => known.insert(special, PipelineState::Done(done)),
                None => known.remove(&special),
            }
        };
        if let Some(PipelineState::UnderWay(waiting)) = state {
            waiting.into_iter().for_each(Waker::wake);
        }
    }
}

impl PipelineClaim<'_> {
    pub(crate) fn special(&self) -> ShaderSpecialization {
        self.special
    }

    pub(crate) fn finish(self, done: Result<wgpu::ComputePipeline, GpuError>) {
        self.pipelines.end(self.special, Some(done));
        std::mem::forget(self);
    }
}

impl Drop for PipelineClaim<'_> {
    fn drop(&mut self) {
        self.pipelines.end(self.special, None);
    }
}

/// What the shader is bound to.
pub(crate) fn layout_entries() -> Vec<wgpu::BindGroupLayoutEntry> {
    (0..BINDINGS).map(entry).collect()
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
