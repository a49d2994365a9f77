//! The graphics card that can draw the picture: the one that draws the window, so that the picture stays on it; on a page
//! one of its own.

use std::sync::{Arc, Weak};

use catoptric_gpu::{Gpu, GpuError};
use catoptric_live::{CardPicture, CardSource, Live};
use catoptric_tracer::shaders::UnsupportedOnGpu;
use egui::TextureId;

use crate::base::texts::Texts;

/// What makes pictures on a card textures of the window that it draws.
pub(crate) trait WindowTextures {
    /// Makes a picture a texture; `smooth` where it is stretched.
    fn register(&mut self, picture: &CardPicture, smooth: bool) -> TextureId;

    /// Forgets a texture.
    fn free(&mut self, id: TextureId);
}

/// A graphics card that can trace.
pub(crate) struct KnownCard {
    pub(crate) name: String,
    /// Whether it is a driver that computes on the processor.
    pub(crate) is_software: bool,
    /// Hands it to whoever draws.
    pub(crate) source: Box<dyn Fn() -> CardSource>,
    /// The window that it draws, which can show what lies on it.
    pub(crate) window: Option<(Box<dyn WindowTextures>, Arc<Gpu>)>,
}

/// The graphics card of the window or the page, if it can trace.
#[derive(Default)]
pub(crate) struct WindowCard {
    known: Option<KnownCard>,
    /// Whether it is to draw.
    is_on: bool,
    /// The loss that was reported.
    told: Option<GpuError>,
    textures: Vec<WindowTexture>,
}

/// A picture that is registered as a texture of the window.
struct WindowTexture {
    picture: Weak<CardPicture>,
    smooth: bool,
    id: TextureId,
}

impl WindowCard {
    /// Whether there is one that can draw.
    pub(crate) fn is_there(&self) -> bool {
        self.known.is_some()
    }

    /// Whether it is to draw.
    pub(crate) fn is_on(&self) -> bool {
        self.is_on
    }

    /// What the window knows a picture by; pictures that are gone are forgotten. `smooth` where it is stretched.
    pub(crate) fn texture(&mut self, picture: &Arc<CardPicture>, smooth: bool) -> Option<TextureId> {
        let (window, gpu) = self.known.as_mut()?.window.as_mut()?;
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

    /// The card, if it can trace.
    pub(crate) fn known(&self) -> Option<&KnownCard> {
        self.known.as_ref()
    }

    /// Takes a card that can trace, or none, in place of the one before.
    pub(crate) fn take(&mut self, card: Option<KnownCard>) {
        self.known = card;
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
        let Some(card) = &self.known else { return };
        self.is_on = is_on;
        self.told = None;
        live.draw_with(is_on.then(|| (card.source)()));
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
