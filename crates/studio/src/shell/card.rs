//! The choice whether the graphics card draws the picture.

use std::sync::Arc;

use catoptric_gpu::{Gpu, LossWatch};
use eframe::egui_wgpu::RenderState;

use crate::shell::studio::Studio;
use crate::state::card::why;

impl Studio {
    /// Lets the card that draws the window draw the picture too, if it can: a real one unless the settings say
    /// otherwise, a software driver only if they say so.
    pub fn use_window_card(&mut self, state: &RenderState) {
        let gpu = Gpu::on(state.device.clone(), state.queue.clone());
        if gpu.is_ok() {
            self.card.enter_window(state, gpu);
            self.choose_card();
        }
    }

    /// Lets the card of a new window draw the picture too. After a loss it draws only when it is switched on again: a
    /// card that has just failed is not trusted at once.
    pub(crate) fn enter_window(&mut self, state: &RenderState, watch: &Arc<LossWatch>, is_first: bool) {
        let gpu = Gpu::watched(state.device.clone(), state.queue.clone(), Arc::clone(watch));
        self.card.enter_window(state, gpu);
        if is_first {
            self.choose_card();
        }
    }

    fn choose_card(&mut self) {
        let is_real = self.card.gpu().is_some_and(|gpu| !gpu.info().is_software);
        if self.settings.uses_card.unwrap_or(is_real) {
            self.card.switch(&self.live, true);
        }
    }

    /// The name of the card of the window, if it can draw the picture.
    pub fn card_name(&self) -> Option<&str> {
        self.card.gpu().map(|gpu| gpu.info().name.as_str())
    }
}

/// Lets the card draw, or the processor.
pub(crate) fn toggle(studio: &mut Studio) {
    let is_on = !studio.card.is_on();
    studio.card.switch(&studio.live, is_on);
    if studio.card.is_there() {
        studio.settings.uses_card = Some(is_on);
    }
}

/// Tells of a card that was lost: once a frame.
pub(crate) fn keep_up(studio: &mut Studio) {
    if let Some(error) = studio.card.take_loss(&studio.live) {
        let reason = why(&studio.texts, &error);
        studio.toasts.warning(studio.texts.with("card-lost-notice", &[("reason", reason.into())]));
    }
}
