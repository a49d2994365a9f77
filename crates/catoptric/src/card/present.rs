//! A graphics card by `catoptric-gpu`.

use std::time::Instant;

use anyhow::{Context as _, Result};
use catoptric_gpu::{Gpu, GpuChoice, GpuError, render, wait};
use catoptric_tracer::raster::MethodOutput;
use catoptric_tracer::{RenderControl, RenderScene, RenderSettings};
use serde_json::{Value, json};

use super::CardOutcome;
use crate::arguments::BackendArguments;

/// An open card.
pub(crate) struct Card(Gpu);

/// Whether the arguments make a card likely, so that opening one is worth the time.
pub(crate) fn is_likely(arguments: &BackendArguments) -> bool {
    choice(arguments).is_likely()
}

impl Card {
    /// Opens the card that is asked for.
    pub(crate) fn open(arguments: &BackendArguments) -> Result<Self> {
        let choice = choice(arguments);
        wait(Gpu::open(&choice)).map(Self).context(advice(&choice))
    }

    pub(crate) fn name(&self) -> &str {
        &self.0.info().name
    }

    /// What `--stats` tells of the card.
    pub(crate) fn to_json(&self) -> Value {
        let info = self.0.info();
        json!({
            "name": info.name,
            "interface": info.interface,
            "driver": info.driver,
            "is_software": info.is_software,
        })
    }

    /// Draws Whitted's tree. Fails where the processor could not draw either.
    pub(crate) fn draw(
        &self,
        render_scene: &RenderScene,
        settings: RenderSettings,
        control: &RenderControl,
    ) -> Result<CardOutcome> {
        let start = Instant::now();
        match wait(render(&self.0, render_scene, render_scene.camera(), settings, control)) {
            Ok(rendering) => {
                let pass = rendering.pass;
                let drawing = MethodOutput::traced(rendering.picture, pass.counts, start.elapsed());
                Ok(CardOutcome::Drawn(drawing, pass.on_card))
            }
            Err(error @ (GpuError::Cancelled | GpuError::Size(_))) => Err(error.into()),
            Err(error) => Ok(CardOutcome::Refused(error.into())),
        }
    }
}

fn choice(arguments: &BackendArguments) -> GpuChoice {
    GpuChoice { software: arguments.software_gpu, name: arguments.gpu.clone() }
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
