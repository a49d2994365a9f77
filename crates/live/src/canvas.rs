//! The light of a picture, in the memory of the processor or of a graphics card.

use std::sync::Arc;

use catoptric_gpu::{Gpu, GpuError, GpuFilm, GpuScene, GpuScreen, wait};
use catoptric_picture::SizeError;
use catoptric_platform::threads;
use catoptric_tracer::shaders::{ShaderSpecialization, UnsupportedOnGpu};
use catoptric_tracer::{Film, RayCounts, RenderCamera, RenderControl, RenderError, RenderScene};

/// The light of a picture.
pub(crate) enum Canvas {
    Processor(Film),
    Card(Box<GpuFilm>),
}

/// A graphics card that draws, with its copy of the scene.
pub(crate) struct CardRenderer {
    pub(crate) gpu: Arc<Gpu>,
    pub(crate) render_scene: GpuScene,
    pub(crate) screen: GpuScreen,
    /// What in the present scene it cannot draw.
    pub(crate) refused: Option<GpuError>,
    /// The shaders that were begun to compile in the background.
    begun: Vec<ShaderSpecialization>,
}

/// The reason why a pass was not finished.
pub(crate) enum PassError {
    Cancelled,
    Size(SizeError),
    Card(GpuError),
}

impl CardRenderer {
    pub(crate) fn new(gpu: Arc<Gpu>) -> Result<Self, GpuError> {
        let (render_scene, screen) = (wait(GpuScene::new(&gpu))?, wait(GpuScreen::new(&gpu))?);
        Ok(Self { gpu, render_scene, screen, refused: None, begun: Vec::new() })
    }

    /// Forgets what it could not draw, if it may be able to now: another scene, or from elsewhere.
    pub(crate) fn look_again(&mut self, is_other_scene: bool) {
        let is_of_eye = matches!(self.refused, Some(GpuError::Unsupported(UnsupportedOnGpu::EyeMedia(_))));
        if is_other_scene || is_of_eye {
            self.refused = None;
        }
    }

    /// Sends what is new of a scene. False while its shader is compiled; then `ready` is called later.
    pub(crate) fn prepare(
        &mut self,
        render_scene: &RenderScene,
        camera: &RenderCamera,
        ready: impl FnOnce() + Send + 'static,
    ) -> Result<bool, GpuError> {
        wait(self.render_scene.follow(&self.gpu, render_scene, camera))?;
        let special = self.render_scene.specialization(render_scene, camera)?;
        if self.gpu.is_ready_for(special) {
            return Ok(true);
        }
        if !self.begun.contains(&special) {
            let gpu = Arc::clone(&self.gpu);
            let compile = move || {
                // What goes wrong is told when it is drawn with.
                let _ = wait(gpu.prepare_for(special));
                ready();
            };
            if threads::start_or_do("shader", compile).is_ok() {
                self.begun.push(special);
            }
        }
        Ok(false)
    }
}

impl Canvas {
    /// A canvas without light, on `card` if there is one.
    pub(crate) fn new(card: Option<&CardRenderer>, [width, height]: [u32; 2]) -> Result<Self, PassError> {
        Ok(match card {
            Some(card) => Self::Card(Box::new(wait(GpuFilm::new(&card.gpu, width, height))?)),
            None => Self::Processor(Film::new(width, height)?),
        })
    }

    pub(crate) fn is_on_card(&self) -> bool {
        matches!(self, Self::Card(_))
    }

    /// Width and height, pixels.
    pub(crate) fn size(&self) -> [u32; 2] {
        match self {
            Self::Processor(film) => [film.width(), film.height()],
            Self::Card(film) => film.size(),
        }
    }

    /// Samples that every pixel has.
    pub(crate) fn samples(&self) -> u32 {
        match self {
            Self::Processor(film) => film.samples(),
            Self::Card(film) => film.samples(),
        }
    }

    /// Forgets all light.
    pub(crate) fn clear(&mut self) {
        match self {
            Self::Processor(film) => film.clear(),
            Self::Card(film) => film.clear(),
        }
    }

    /// Adds a sample to every pixel.
    pub(crate) fn add_sample(
        &mut self,
        card: Option<&CardRenderer>,
        render_scene: &RenderScene,
        camera: &RenderCamera,
        control: &RenderControl,
    ) -> Result<RayCounts, PassError> {
        match (self, card) {
            (Self::Processor(film), _) => Ok(film.add_sample(render_scene, camera, control)?),
            (Self::Card(film), Some(card)) => {
                let scenes = (render_scene, &card.render_scene);
                Ok(wait(film.add_samples(&card.gpu, scenes, camera, 1, control))?.counts)
            }
            // The card was taken away: what was drawn on it is of no use.
            (Self::Card(_), None) => Err(PassError::Cancelled),
        }
    }
}

impl From<RenderError> for PassError {
    fn from(error: RenderError) -> Self {
        match error {
            RenderError::Cancelled => Self::Cancelled,
            RenderError::Size(error) => Self::Size(error),
        }
    }
}

impl From<SizeError> for PassError {
    fn from(error: SizeError) -> Self {
        Self::Size(error)
    }
}

impl From<GpuError> for PassError {
    fn from(error: GpuError) -> Self {
        match error {
            GpuError::Cancelled => Self::Cancelled,
            GpuError::Size(error) => Self::Size(error),
            error => Self::Card(error),
        }
    }
}
