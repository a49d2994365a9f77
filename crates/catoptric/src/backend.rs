//! The processor or a graphics card.

use std::time::{Duration, Instant};

use anyhow::{Context as _, Result, anyhow, bail};
use catoptric_gpu::{Gpu, GpuChoice, GpuError, GpuInfo};
use catoptric_tracer::raster::{Method, MethodOutput, draw};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::arguments::{Backend, BackendArguments};

/// So many threads; as many as the machine has for 0.
pub(crate) fn threads(count: usize) -> Result<ThreadPool> {
    let pool = ThreadPoolBuilder::new().num_threads(count).build();
    pool.map_err(|error| anyhow!("cannot start the threads; ask for fewer with --threads: {error}"))
}

/// Starts the threads of a command that has no pool of its own. Left to themselves they would start when they are needed,
/// and end the program where the system refuses them.
pub(crate) fn start_threads() -> Result<()> {
    let started = ThreadPoolBuilder::new().build_global();
    started.map_err(|error| anyhow!("cannot start the threads; the system refuses them memory: {error}"))
}

/// Who draws.
pub(crate) struct Renderer {
    gpu: Option<Gpu>,
    /// Whether the processor may draw what the card cannot.
    may_fall_back: bool,
}

/// A picture, and who drew it.
pub(crate) struct RenderedPicture {
    pub drawing: MethodOutput,
    /// What the card worked, by its own clock.
    pub on_card: Option<Duration>,
    /// Why the processor drew it though there is a card.
    pub fallen_back: Option<GpuError>,
}

impl Renderer {
    /// Opens a card if it is wanted and there is one. Cards draw Whitted's tree, and no maps.
    pub(crate) fn chosen(arguments: &BackendArguments, method: &Method, is_map: bool) -> Result<Self> {
        let BackendArguments { backend, gpu, software_gpu } = arguments;
        let choice = GpuChoice { software: *software_gpu, name: gpu.clone() };
        let runs_on_gpu = method.abilities().runs_on_gpu && !is_map;
        let gpu = match backend {
            Backend::Cpu if gpu.is_some() || *software_gpu => {
                bail!("--backend cpu uses no graphics card; leave out --gpu and --software-gpu")
            }
            Backend::Cpu => None,
            Backend::Auto if runs_on_gpu && choice.is_likely() => Gpu::open(&choice).ok(),
            Backend::Auto => None,
            Backend::Gpu if !runs_on_gpu => {
                bail!("graphics cards draw --method whitted without --map only; use --backend cpu")
            }
            Backend::Gpu => Some(Gpu::open(&choice).context(advice(&choice))?),
        };
        Ok(Self { gpu, may_fall_back: *backend == Backend::Auto })
    }

    /// The card, if one is open.
    pub(crate) fn card(&self) -> Option<&GpuInfo> {
        self.gpu.as_ref().map(Gpu::info)
    }

    /// Draws a scene.
    pub(crate) fn draw(
        &self,
        render_scene: &RenderScene,
        method: &Method,
        settings: RenderSettings,
        pool: &ThreadPool,
        control: &RenderControl,
    ) -> Result<RenderedPicture> {
        let on_cpu = || pool.install(|| draw(render_scene, method, settings, control));
        let Some(gpu) = &self.gpu else {
            return Ok(RenderedPicture { drawing: on_cpu()?, on_card: None, fallen_back: None });
        };
        let start = Instant::now();
        match pool
            .install(|| catoptric_gpu::render(gpu, render_scene, render_scene.camera(), settings, control))
        {
            Ok(rendering) => {
                let pass = rendering.pass;
                let drawing = MethodOutput::traced(rendering.picture, pass.counts, start.elapsed());
                Ok(RenderedPicture { drawing, on_card: pass.on_card, fallen_back: None })
            }
            Err(error) if self.may_fall_back && !matches!(error, GpuError::Cancelled | GpuError::Size(_)) => {
                Ok(RenderedPicture { drawing: on_cpu()?, on_card: None, fallen_back: Some(error) })
            }
            Err(error) => Err(error).context("the graphics card cannot draw this; use --backend cpu"),
        }
    }
}

/// What to do when there is no card.
fn advice(choice: &GpuChoice) -> &'static str {
    match choice {
        GpuChoice { software: false, .. } => {
            "no graphics card can be used; use --backend cpu, or a driver without a card with --software-gpu"
        }
        GpuChoice { .. } => "no graphics driver can be used; use --backend cpu",
    }
}
