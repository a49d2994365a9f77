//! Compiled shaders, one for each kind of stage.

use std::collections::HashMap;
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

use catoptric_tracer::twin::{ENTRY_POINT, Specialization, shader};

use crate::card::Gpu;
use crate::error::GpuError;

/// What the shader is bound to: the frame, seven arrays, the film, the waves of samples, and pictures.
const BINDINGS: u32 = 11;
/// Pictures are a texture.
const PICTURES: u32 = 10;
/// The bindings of storage buffers: the arrays, the film last.
pub(crate) const STORED: std::ops::RangeInclusive<u32> = 1..=8;

/// The shaders compiled so far. A program meets few kinds of stages, and a shader is small: none is dropped.
pub(crate) struct Pipelines {
    pub(crate) layout: wgpu::BindGroupLayout,
    pipeline_layout: wgpu::PipelineLayout,
    known: Mutex<HashMap<Specialization, PipelineState>>,
    compiled: Condvar,
}

#[derive(Clone)]
enum PipelineState {
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

    fn known(&self) -> MutexGuard<'_, HashMap<Specialization, PipelineState>> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Whether somebody else compiles it or has done so; else the caller has to.
    fn claim(&self, special: Specialization) -> Option<PipelineState> {
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

impl Gpu {
    /// The compiled shader of a kind; waits for it.
    pub(crate) fn pipeline(&self, special: Specialization) -> Result<wgpu::ComputePipeline, GpuError> {
        match self.pipelines.claim(special) {
            Some(PipelineState::Done(done)) => done,
            Some(PipelineState::UnderWay) => {
                let known = self.pipelines.known();
                let is_under_way = |known: &mut HashMap<Specialization, PipelineState>| {
                    matches!(known.get(&special), Some(PipelineState::UnderWay))
                };
                let known = self.pipelines.compiled.wait_while(known, is_under_way);
                match known.unwrap_or_else(PoisonError::into_inner).get(&special) {
                    Some(PipelineState::Done(done)) => done.clone(),
                    _ => Err(GpuError::Refused("the shader was not compiled".to_owned())),
                }
            }
            None => self.compile(special),
        }
    }

    /// Whether the shader for such stages is compiled, so that drawing begins at once.
    pub fn is_ready_for(&self, special: Specialization) -> bool {
        matches!(self.pipelines.known().get(&special), Some(PipelineState::Done(_)))
    }

    /// Compiles the shader for such stages on a thread of its own, unless that is done or under way; `ready` is called
    /// from there.
    pub fn compile_in_background(
        self: &Arc<Self>,
        special: Specialization,
        ready: impl FnOnce() + Send + 'static,
    ) {
        if self.pipelines.claim(special).is_some() {
            return;
        }
        let gpu = Arc::clone(self);
        let compile = move || {
            let _ = gpu.compile(special);
            ready();
        };
        if std::thread::Builder::new().name("shader".to_owned()).spawn(compile).is_err() {
            self.pipelines.known().remove(&special);
        }
    }

    fn compile(&self, special: Specialization) -> Result<wgpu::ComputePipeline, GpuError> {
        let done = self.guarded(0, |device| {
            let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("tracer"),
                source: wgpu::ShaderSource::Wgsl(shader(&special).into()),
            });
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("tracer"),
                layout: Some(&self.pipelines.pipeline_layout),
                module: &module,
                entry_point: Some(ENTRY_POINT),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            })
        });
        self.pipelines.known().insert(special, PipelineState::Done(done.clone()));
        self.pipelines.compiled.notify_all();
        done
    }
}
