//! The task that drives a card.

use std::sync::{Arc, Weak};

use catoptric_gpu::{Gpu, GpuError, GpuFilm, GpuPicture, GpuScene, GpuScreen};
use catoptric_picture::Development;
use catoptric_platform::time::Instant;
use catoptric_tracer::shaders::ShaderSpecialization;
use catoptric_tracer::{RayCounts, RenderCamera, RenderControl, RenderScene};

use super::picture::CardPicture;
use super::source::CardSource;
use crate::pace::milliseconds_since;

/// What the worker asks of a card.
pub(super) enum CardOrder {
    /// To take what is new of a scene, and to compile its shader.
    Prepare { render_scene: Arc<RenderScene>, camera: RenderCamera },
    /// To add a sample to a film.
    Sample {
        film: Weak<()>,
        size: [u32; 2],
        render_scene: Arc<RenderScene>,
        camera: RenderCamera,
        control: Arc<RenderControl>,
    },
    /// To make a film visible.
    Develop { film: Weak<()>, development: Development },
}

/// What became of an order.
pub(super) enum CardAnswer {
    /// Whether the card can draw the scene at once. If not, its shader is being compiled.
    Prepared(bool),
    Sampled(CardPass),
    Developed(ShownPicture),
}

/// A sample that a card added.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CardPass {
    pub(crate) rays: RayCounts,
    /// Samples in every pixel now.
    pub(crate) samples: u32,
    /// Pixels that were traced for it, and what they took, milliseconds.
    pub(crate) work: (u64, f64),
}

/// A picture that can be shown.
#[derive(Clone, Debug)]
pub(crate) struct ShownPicture {
    /// The picture on the card, where a window can show that.
    pub(crate) card: Option<Arc<CardPicture>>,
    /// Otherwise red, green, blue (sRGB) and 255 for every pixel.
    pub(crate) pixels: Arc<Vec<u8>>,
}

/// An open card with its copy of the scene, and its films.
pub(super) struct CardRenderer {
    gpu: Arc<Gpu>,
    render_scene: GpuScene,
    screen: GpuScreen,
    /// Films by the slots that the worker knows them by. The memory of one whose slot is gone is used again.
    films: Vec<(Weak<()>, GpuFilm)>,
    /// The shaders that were begun to compile.
    begun: Vec<ShaderSpecialization>,
    /// Called when a shader is compiled.
    ready: Arc<dyn Fn() + Send + Sync>,
}

impl CardRenderer {
    pub(super) async fn open(
        source: CardSource,
        ready: Arc<dyn Fn() + Send + Sync>,
    ) -> Result<Self, GpuError> {
        let gpu = source.gpu().await?;
        let (render_scene, screen) = (GpuScene::new(&gpu).await?, GpuScreen::new(&gpu).await?);
        Ok(Self { gpu, render_scene, screen, films: Vec::new(), begun: Vec::new(), ready })
    }

    pub(super) fn name(&self) -> &str {
        &self.gpu.info().name
    }

    pub(super) async fn fulfil(&mut self, order: CardOrder) -> Result<CardAnswer, GpuError> {
        match order {
            CardOrder::Prepare { render_scene, camera } => {
                self.prepare(&render_scene, &camera).await.map(CardAnswer::Prepared)
            }
            CardOrder::Sample { film: slot, size, render_scene, camera, control } => {
                let start = Instant::now();
                let mut film = self.take_film(&slot, size).await?;
                let scenes = (&*render_scene, &self.render_scene);
                let done = film.add_samples(&self.gpu, scenes, &camera, 1, &control).await;
                let samples = film.samples();
                self.films.push((slot, film));
                let work = (control.pixels_done(), milliseconds_since(start));
                Ok(CardAnswer::Sampled(CardPass { rays: done?.counts, samples, work }))
            }
            CardOrder::Develop { film: slot, development } => {
                let known = self.films.iter().find(|(known, _)| known.ptr_eq(&slot));
                let (_, film) = known.ok_or(GpuError::Cancelled)?;
                let picture = self.screen.develop(&self.gpu, film, &development).await?;
                shown(&mut self.screen, picture).await.map(CardAnswer::Developed)
            }
        }
    }

    /// Sends what is new of a scene. False while its shader is compiled.
    async fn prepare(&mut self, render_scene: &RenderScene, camera: &RenderCamera) -> Result<bool, GpuError> {
        self.render_scene.follow(&self.gpu, render_scene, camera).await?;
        let special = self.render_scene.specialization(render_scene, camera)?;
        if self.gpu.is_ready_for(special) {
            return Ok(true);
        }
        if !self.begun.contains(&special) {
            let ready = Arc::clone(&self.ready);
            if self.gpu.prepare_beside(special, move || ready()).is_ok() {
                self.begun.push(special);
            }
        }
        Ok(false)
    }

    /// The film of a slot; a blank one for a slot that is new.
    async fn take_film(&mut self, slot: &Weak<()>, size: [u32; 2]) -> Result<GpuFilm, GpuError> {
        if let Some(place) = self.films.iter().position(|(known, _)| known.ptr_eq(slot)) {
            return Ok(self.films.swap_remove(place).1);
        }
        let is_free = |(known, film): &(Weak<()>, GpuFilm)| known.strong_count() == 0 && film.size() == size;
        let free = self.films.iter().position(is_free).map(|place| self.films.swap_remove(place).1);
        self.films.retain(|(known, _)| known.strong_count() > 0);
        match free {
            Some(mut film) => {
                film.clear();
                Ok(film)
            }
            None => GpuFilm::new(&self.gpu, size[0], size[1]).await,
        }
    }
}

/// The picture where a window finds it.
#[cfg(not(target_family = "wasm"))]
async fn shown(_: &mut GpuScreen, picture: Arc<GpuPicture>) -> Result<ShownPicture, GpuError> {
    Ok(ShownPicture { card: Some(picture), pixels: Arc::default() })
}

/// The picture where a window finds it.
#[cfg(target_family = "wasm")]
async fn shown(screen: &mut GpuScreen, picture: Arc<GpuPicture>) -> Result<ShownPicture, GpuError> {
    Ok(ShownPicture { card: None, pixels: Arc::new(screen.read(&picture).await?) })
}
