//! A picture from beginning to end.

use catoptric_picture::Picture;
use catoptric_tracer::{RenderCamera, RenderControl, RenderScene, RenderSettings};

use crate::card::Gpu;
use crate::error::GpuError;
use crate::film::{GpuFilm, GpuPass};
use crate::scene::GpuScene;

/// A finished render.
#[derive(Clone, Debug)]
pub struct GpuRendering {
    /// Linear light.
    pub picture: Picture,
    /// The rays traced, and what they took.
    pub pass: GpuPass,
}

/// Traces `render_scene` into a picture on a card; the twin of [`render`](catoptric_tracer::render).
///
/// # Errors
/// When the size is 0 or too large, the scene cannot be drawn, the card is lost, or the render is cancelled.
pub async fn render(
    gpu: &Gpu,
    render_scene: &RenderScene,
    camera: &RenderCamera,
    settings: RenderSettings,
    control: &RenderControl,
) -> Result<GpuRendering, GpuError> {
    let mut film = GpuFilm::new(gpu, settings.width, settings.height).await?;
    let mut on_card = GpuScene::new(gpu).await?;
    on_card.follow(gpu, render_scene, camera).await?;
    let samples = settings.samples.max(1);
    let pass = film.add_samples(gpu, (render_scene, &on_card), camera, samples, control).await?;
    Ok(GpuRendering { picture: film.picture(gpu).await?, pass })
}
