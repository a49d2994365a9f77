//! The graphics card that draws the picture: the one that draws the window, so that the picture stays on it.

use std::sync::{Arc, Weak};

use catoptric_gpu::{Gpu, GpuError, GpuPicture, LossWatch};
use catoptric_live::Live;
use catoptric_tracer::twin::Unsupported;
use eframe::egui_wgpu::RenderState;
use egui::TextureId;

use crate::app::Studio;
use crate::texts::Texts;

/// The graphics card of the window, if it can trace.
#[derive(Default)]
pub(crate) struct WindowCard {
    window: Option<(RenderState, Arc<Gpu>)>,
    /// Whether it is to draw.
    is_on: bool,
    /// The loss that was reported.
    told: Option<GpuError>,
    textures: Vec<WindowTexture>,
}

/// A picture that is registered as a texture of the window.
struct WindowTexture {
    picture: Weak<GpuPicture>,
    filter: wgpu::FilterMode,
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
        let (state, gpu) = self.window.as_ref()?;
        if !picture.is_on(gpu) {
            // It was drawn for a window that is gone.
            return None;
        }
        let filter = if smooth { wgpu::FilterMode::Linear } else { wgpu::FilterMode::Nearest };
        let mut renderer = state.renderer.write();
        self.textures.retain(|texture| {
            let is_alive = texture.picture.strong_count() > 0;
            if !is_alive {
                renderer.free_texture(&texture.id);
            }
            is_alive
        });
        let is_it = |texture: &&WindowTexture| {
            std::ptr::eq(texture.picture.as_ptr(), Arc::as_ptr(picture)) && texture.filter == filter
        };
        if let Some(known) = self.textures.iter().find(is_it) {
            return Some(known.id);
        }
        let id = renderer.register_native_texture(&state.device, picture.view(), filter);
        self.textures.push(WindowTexture { picture: Arc::downgrade(picture), filter, id });
        Some(id)
    }

    /// Lets go of the window, whose device is lost. Returns whether the card was to draw the picture.
    pub(crate) fn leave_window(&mut self, live: &Live) -> bool {
        let was_on = self.is_on;
        live.draw_with(None);
        *self = Self { told: live.status().card_lost, ..Self::default() };
        was_on
    }

    fn switch(&mut self, live: &Live, is_on: bool) {
        let Some((_, gpu)) = &self.window else { return };
        self.is_on = is_on;
        self.told = None;
        live.draw_with(is_on.then(|| Arc::clone(gpu)));
    }
}

impl Studio {
    /// Lets the card that draws the window draw the picture too, if it can: a real one unless the settings say
    /// otherwise, a software driver only if they say so.
    pub fn use_window_card(&mut self, state: &RenderState) {
        let Ok(gpu) = Gpu::on(state.device.clone(), state.queue.clone()) else { return };
        self.card.window = Some((state.clone(), Arc::new(gpu)));
        self.choose_card();
    }

    /// Lets the card of a new window draw the picture too. After a loss it draws only when it is switched on again: a
    /// card that has just failed is not trusted at once.
    pub(crate) fn enter_window(&mut self, state: &RenderState, watch: &Arc<LossWatch>, is_first: bool) {
        let gpu = Gpu::watched(state.device.clone(), state.queue.clone(), Arc::clone(watch));
        self.card.window = gpu.ok().map(|gpu| (state.clone(), Arc::new(gpu)));
        if is_first {
            self.choose_card();
        }
    }

    fn choose_card(&mut self) {
        let is_real = self.card.window.as_ref().is_some_and(|(_, gpu)| !gpu.info().is_software);
        if self.settings.uses_card.unwrap_or(is_real) {
            self.card.switch(&self.live, true);
        }
    }

    /// The name of the card of the window, if it can draw the picture.
    pub fn card_name(&self) -> Option<&str> {
        self.card.window.as_ref().map(|(_, gpu)| gpu.info().name.as_str())
    }
}

/// Lets the card draw, or the processor.
pub(crate) fn toggle(studio: &mut Studio) {
    let is_on = !studio.card.is_on;
    studio.card.switch(&studio.live, is_on);
    if studio.card.is_there() {
        studio.settings.uses_card = Some(is_on);
    }
}

/// Why the card does not draw, in the words of the present language.
pub(crate) fn why(texts: &Texts, error: &GpuError) -> String {
    let key = match error {
        GpuError::Lost(_) | GpuError::NoAnswer(_) => "card-is-lost",
        GpuError::OutOfMemory(_) | GpuError::TooLarge { .. } => "card-has-no-memory",
        GpuError::Unsupported(Unsupported::LongTree) => "card-has-too-many-rays",
        GpuError::Unsupported(_) => "card-has-too-many-media",
        other => return other.to_string(),
    };
    texts.get(key).to_owned()
}

/// Tells of a card that was lost: once a frame.
pub(crate) fn keep_up(studio: &mut Studio) {
    let lost = studio.live.status().card_lost;
    if studio.card.told == lost {
        return;
    }
    if let Some(error) = &lost {
        studio.card.is_on = false;
        let text = studio.texts.with("card-lost-notice", &[("reason", why(&studio.texts, error).into())]);
        studio.toasts.warning(text);
    }
    studio.card.told = lost;
}
