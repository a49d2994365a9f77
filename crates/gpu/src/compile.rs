//! The compiling of shaders, each once and perhaps on a thread of its own.

use std::collections::HashMap;
use std::sync::{Arc, PoisonError};

use catoptric_platform::threads;
use catoptric_tracer::shaders::{ENTRY_POINT, ShaderSpecialization, shader};

use crate::card::Gpu;
use crate::error::GpuError;
use crate::pipelines::PipelineState;

impl Gpu {
    /// The compiled shader of a kind; waits for it.
    pub(crate) fn pipeline(&self, special: ShaderSpecialization) -> Result<wgpu::ComputePipeline, GpuError> {
        match self.pipelines.claim(special) {
            Some(PipelineState::Done(done)) => done,
            Some(PipelineState::UnderWay) => {
                let known = self.pipelines.known();
                let is_under_way = |known: &mut HashMap<ShaderSpecialization, PipelineState>| {
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

    /// Whether the shader for such scenes is compiled, so that drawing begins at once.
    pub fn is_ready_for(&self, special: ShaderSpecialization) -> bool {
        matches!(self.pipelines.known().get(&special), Some(PipelineState::Done(_)))
    }

    /// Compiles the shader for such scenes on a thread of its own, unless that is done or under way; `ready` is called
    /// from there.
    pub fn compile_in_background(
        self: &Arc<Self>,
        special: ShaderSpecialization,
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
        if threads::start_or_do("shader", compile).is_err() {
            self.pipelines.known().remove(&special);
        }
    }

    fn compile(&self, special: ShaderSpecialization) -> Result<wgpu::ComputePipeline, GpuError> {
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
