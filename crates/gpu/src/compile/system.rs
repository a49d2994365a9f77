//! Compiling on a thread of its own.

use std::io;
use std::sync::Arc;

use catoptric_platform::threads;
use catoptric_tracer::shaders::ShaderSpecialization;

use crate::card::Gpu;
use crate::reading::wait;

pub(super) fn prepare(
    gpu: Arc<Gpu>,
    special: ShaderSpecialization,
    ready: impl FnOnce() + Send + 'static,
) -> io::Result<()> {
    threads::start_or_do("shader", move || {
        let _ = wait(gpu.prepare_for(special));
        ready();
    })
}

/// Nothing is compiled ahead: the thread waits for the driver.
pub(super) async fn compile_ahead(_: &wgpu::Device, _: &str, _: &str) {}
