//! The compiling of shaders, each once.

#[cfg(target_family = "wasm")]
#[path = "compile/page.rs"]
mod beside;
#[cfg(not(target_family = "wasm"))]
#[path = "compile/system.rs"]
mod beside;

use std::future::poll_fn;
use std::io;
use std::sync::Arc;

use catoptric_tracer::shaders::{ENTRY_POINT, ShaderSpecialization, shader};

use crate::card::Gpu;
use crate::error::GpuError;
use crate::pipelines::{PipelineAnswer, PipelineClaim, PipelineState};

impl Gpu {
    /// The compiled shader of a kind; waits for whoever compiles it.
    pub(crate) async fn pipeline(
        &self,
        special: ShaderSpecialization,
    ) -> Result<wgpu::ComputePipeline, GpuError> {
        match poll_fn(|context| self.pipelines.ask(special, context.waker())).await {
            PipelineAnswer::Done(done) => done,
            PipelineAnswer::Claimed(claim) => self.compile(claim).await,
        }
    }

    /// Whether the shader for such scenes is compiled, so that drawing begins at once.
    pub fn is_ready_for(&self, special: ShaderSpecialization) -> bool {
        matches!(self.pipelines.known().get(&special), Some(PipelineState::Done(_)))
    }

    /// Compiles the shader for such scenes, unless that is done. It takes a while: a window does it on another thread.
    ///
    /// # Errors
    /// When the driver refuses, or the card is lost; drawing fails in the same way then.
    pub async fn prepare_for(&self, special: ShaderSpecialization) -> Result<(), GpuError> {
        self.pipeline(special).await.map(|_| ())
    }

    /// Compiles the shader for such scenes beside other work, and calls `ready` then, however it ends: what goes wrong is
    /// told when it is drawn with.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn prepare_beside(
        self: &Arc<Self>,
        special: ShaderSpecialization,
        ready: impl FnOnce() + Send + 'static,
    ) -> io::Result<()> {
        beside::prepare(Arc::clone(self), special, ready)
    }

    async fn compile(&self, claim: PipelineClaim<'_>) -> Result<wgpu::ComputePipeline, GpuError> {
        let source = shader(&claim.special());
        // What is compiled already is not compiled again while this is alive.
        let _ahead = beside::compile_ahead(&self.device, &source, ENTRY_POINT).await;
        let compiled = self.guarded(0, |device| {
            let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("tracer"),
                source: wgpu::ShaderSource::Wgsl(source.into()),
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
        let done = compiled.await;
        claim.finish(done.clone());
        done
    }
}
