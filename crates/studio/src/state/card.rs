//! The graphics card that draws the picture: the one that draws the window, so that the picture stays on it.

use std::sync::{Arc, Weak};

use catoptric_gpu::{Gpu, GpuError, GpuPicture};
use catoptric_live::Live;
use catoptric_tracer::shaders::UnsupportedOnGpu;
use egui::TextureId;

use crate::base::texts::Texts;

/// What makes pictures on a card textures of the window that it draws.
pub(crate) trait WindowTextures {
    /// Makes a picture a texture; `smooth` where it is stretched.
    fn register(&mut self, picture: &GpuPicture, smooth: bool) -> TextureId;

    /// Forgets a texture.
    fn free(&mut self, id: TextureId);
}

/// The graphics card of the window, if it can trace.
#[derive(Default)]
pub(crate) struct WindowCard {
    window: Option<(Box<dyn WindowTextures>, Arc<Gpu>)>,
    /// Whether it is to draw.
    is_on: bool,
    /// The loss that was reported.
    told: Option<GpuError>,
    textures: Vec<WindowTexture>,
}

/// A picture that is registered as a texture of the window.
struct WindowTexture {
    picture: Weak<GpuPicture>,
    smooth: bool,
    id: TextureId,
}

impl WindowCard {
    /// Whether there is one that can draw.
    pub(crate) fn is_there(&self) -> bool {
        self.window.is_some()
    }

    /// Whether it is to draw.
    pub(crate) fn is_on(&self) -> bool {
        self.is_on
    }

    /// What the window knows a picture by; pictures that are gone are forgotten. `smooth` where it is stretched.
    pub(crate) fn texture(&mut self, picture: &Arc<GpuPicture>, smooth: bool) -> Option<TextureId> {
        let (window, gpu) = self.window.as_mut()?;
        if !picture.is_on(gpu) {
            // It was drawn for a window that is gone.
            return None;
        }
        self.textures.retain(|texture| {
            let is_alive = texture.picture.strong_count() > 0;
            if !is_alive {
                window.free(texture.id);
            }
            is_alive
        });
        let is_it = |texture: &&WindowTexture| {
            std::ptr::eq(texture.picture.as_ptr(), Arc::as_ptr(picture)) && texture.smooth == smooth
        };
        if let Some(known) = self.textures.iter().find(is_it) {
            return Some(known.id);
        }
        let id = window.register(picture, smooth);
        self.textures.push(WindowTexture { picture: Arc::downgrade(picture), smooth, id });
        Some(id)
    }

    /// Lets go of the window, whose device is lost. Returns whether the card was to draw the picture.
    pub(crate) fn leave_window(&mut self, live: &Live) -> bool {
        let was_on = self.is_on;
        live.draw_with(None);
        *self = Self { told: live.status().card_lost, ..Self::default() };
        was_on
    }

    /// The graphics card of the window, if it can trace.
    pub(crate) fn gpu(&self) -> Option<&Arc<Gpu>> {
        self.window.as_ref().map(|(_, gpu)| gpu)
    }

    /// Takes the graphics card of a window, if it can trace.
    pub(crate) fn enter_window(&mut self, window: Box<dyn WindowTextures>, gpu: Result<Gpu, GpuError>) {
        self.window = gpu.ok().map(|gpu| (window, Arc::new(gpu)));
    }

    /// Takes note of a loss. Returns it the first time, when the card no longer draws.
    pub(crate) fn take_loss(&mut self, live: &Live) -> Option<GpuError> {
        let lost = live.status().card_lost;
        if self.told == lost {
            return None;
        }
        self.is_on &= lost.is_none();
        self.told.clone_from(&lost);
        lost
    }

    /// Lets the card draw, or the processor.
    pub(crate) fn switch(&mut self, live: &Live, is_on: bool) {
        let Some((_, gpu)) = &self.window else { return };
        self.is_on = is_on;
        self.told = None;
        live.draw_with(is_on.then(|| Arc::clone(gpu)));
    }
}

/// Why the card does not draw, in the words of the present language.
pub(crate) fn why(texts: &Texts, error: &GpuError) -> String {
    let key = match error {
        GpuError::Lost(_) | GpuError::NoAnswer(_) => "card-is-lost",
        GpuError::OutOfMemory(_) | GpuError::TooLarge { .. } => "card-has-no-memory",
        GpuError::Unsupported(UnsupportedOnGpu::LongTree) => "card-has-too-many-rays",
        GpuError::Unsupported(UnsupportedOnGpu::DoublePrecision) => "card-has-no-doubles",
        GpuError::Unsupported(UnsupportedOnGpu::EyeMedia(_) | UnsupportedOnGpu::NestedMedia) => {
            "card-has-too-many-media"
        }
        other => return other.to_string(),
    };
    texts.get(key).to_owned()
}
