//! The card that draws the window draws the picture, too.

use std::sync::Arc;

use catoptric_gpu::{Gpu, GpuError, GpuPicture, LossWatch};
use eframe::egui_wgpu::RenderState;
use egui::TextureId;

use crate::shell::studio::Studio;
use crate::state::card::{KnownCard, WindowTextures};

/// Textures of the toolkit's renderer.
struct RendererTextures(RenderState);

impl WindowTextures for RendererTextures {
    fn register(&mut self, picture: &GpuPicture, smooth: bool) -> TextureId {
        let filter = if smooth { wgpu::FilterMode::Linear } else { wgpu::FilterMode::Nearest };
        self.0.renderer.write().register_native_texture(&self.0.device, picture.view(), filter)
    }

    fn free(&mut self, id: TextureId) {
        self.0.renderer.write().free_texture(&id);
    }
}

/// The card of a window, if it can trace.
fn of_window(state: &RenderState, gpu: Result<Gpu, GpuError>) -> Option<KnownCard> {
    let gpu = Arc::new(gpu.ok()?);
    let (name, is_software) = (gpu.info().name.clone(), gpu.info().is_software);
    let given = Arc::clone(&gpu);
    Some(KnownCard {
        name,
        is_software,
        source: Box::new(move || Arc::clone(&given).into()),
        window: Some((Box::new(RendererTextures(state.clone())), gpu)),
    })
}

impl Studio {
    /// Lets the card that draws the window draw the picture too, if it can: a real one unless the settings say
    /// otherwise, a software driver only if they say so.
    pub fn use_window_card(&mut self, state: &RenderState) {
        let gpu = Gpu::on(state.device.clone(), state.queue.clone());
        if gpu.is_ok() {
            self.card.take(of_window(state, gpu));
            self.choose_card();
        }
    }

    /// Lets the card of a new window draw the picture too. After a loss it draws only when it is switched on again: a
    /// card that has just failed is not trusted at once.
    pub(crate) fn enter_window(&mut self, state: &RenderState, watch: &Arc<LossWatch>, is_first: bool) {
        let gpu = Gpu::watched(state.device.clone(), state.queue.clone(), Arc::clone(watch));
        self.card.take(of_window(state, gpu));
        if is_first {
            self.choose_card();
        }
    }
}
