//! The processor or a graphics card.

use std::time::Duration;

use anyhow::{Result, anyhow, bail};
use catoptric_tracer::raster::{Method, MethodOutput, draw};
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::arguments::{Backend, BackendArguments};
use crate::card::{self, Card, CardOutcome};

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
    card: Option<Card>,
    /// Whether the processor may draw what the card cannot.
    may_fall_back: bool,
}

/// A picture, and who drew it.
pub(crate) struct RenderedPicture {
    pub drawing: MethodOutput,
    /// What the card worked, by its own clock.
    pub on_card: Option<Duration>,
    /// Why the processor drew it though there is a card.
    pub fallen_back: Option<anyhow::Error>,
}

impl Renderer {
    /// Opens a card if it is wanted and there is one. Cards draw Whitted's tree, and no maps.
    pub(crate) fn chosen(arguments: &BackendArguments, method: &Method, is_map: bool) -> Result<Self> {
        let BackendArguments { backend, gpu, software_gpu } = arguments;
        let runs_on_gpu = method.abilities().runs_on_gpu && !is_map;
        let card = match backend {
            Backend::Cpu if gpu.is_some() || *software_gpu => {
                bail!("--backend cpu uses no graphics card; leave out --gpu and --software-gpu")
            }
            Backend::Cpu => None,
            Backend::Auto if runs_on_gpu && card::is_likely(arguments) => Card::open(arguments).ok(),
            Backend::Auto => None,
            Backend::Gpu if !runs_on_gpu => {
                bail!("graphics cards draw --method whitted without --map only; use --backend cpu")
            }
            Backend::Gpu => Some(Card::open(arguments)?),
        };
        Ok(Self { card, may_fall_back: *backend == Backend::Auto })
    }

    /// The card, if one is open.
    pub(crate) fn card(&self) -> Option<&Card> {
        self.card.as_ref()
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
        let mut fallen_back = None;
        if let Some(card) = &self.card {
            match pool.install(|| card.draw(render_scene, settings, control))? {
                CardOutcome::Drawn(drawing, on_card) => {
                    return Ok(RenderedPicture { drawing, on_card, fallen_back });
                }
                CardOutcome::Refused(reason) if self.may_fall_back => fallen_back = Some(reason),
                CardOutcome::Refused(reason) => {
                    return Err(reason.context("the graphics card cannot draw this; use --backend cpu"));
                }
            }
        }
        let drawing = pool.install(|| draw(render_scene, method, settings, control))?;
        Ok(RenderedPicture { drawing, on_card: None, fallen_back })
    }
}
