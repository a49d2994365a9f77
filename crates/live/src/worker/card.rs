//! The choice between the graphics card and the processor.

use std::sync::Arc;

use catoptric_gpu::{Gpu, GpuError};

use super::Worker;
use crate::canvas::{CardRenderer, PassError};
use crate::pace::Pace;
use crate::status::LiveError;

impl Worker {
    /// Lets a card draw from now on, or the processor.
    pub(super) fn change_card(&mut self, gpu: Option<Arc<Gpu>>) {
        let opened = gpu.map(CardRenderer::new).transpose();
        let lost = opened.as_ref().err().cloned();
        self.card = opened.unwrap_or_default();
        let name = self.card.as_ref().map(|card| card.gpu.info().name.clone());
        self.shared.change_status(|status| {
            (status.card, status.card_refuses, status.card_lost) = (name, None, lost);
        });
        self.draw_anew();
    }

    /// Draws the picture again, if it is one that a card can draw: by whatever is to draw now.
    pub(super) fn draw_anew(&mut self) {
        let Some(view) = &mut self.view else { return };
        if view.request.method.abilities().runs_on_gpu && !view.is_at_rest {
            // What a picture takes is another matter now.
            self.pace = Pace::new(1e3 * self.budget.as_secs_f64());
            view.due.picture = true;
        }
    }

    /// Whether the card has the scene and can draw it at once. While its shader is compiled, the processor draws.
    pub(super) fn is_card_ready(&mut self) -> bool {
        let (Some(view), Some(card)) = (&self.view, &mut self.card) else { return false };
        if card.refused.is_some() {
            return false;
        }
        let shared = Arc::clone(&self.shared);
        let prepared =
            self.pool.install(|| card.prepare(&view.render_scene, &view.camera, move || shared.tell_ready()));
        match prepared {
            Ok(is_ready) => {
                self.shared.change_status(|status| status.card_refuses = None);
                is_ready
            }
            Err(error) => {
                self.card_fails(error);
                false
            }
        }
    }

    /// Goes on with the processor: for this scene if it is one that the card cannot draw, or for good.
    pub(super) fn card_fails(&mut self, error: GpuError) {
        if let Some(view) = &mut self.view {
            view.due.picture = true;
        }
        match error {
            GpuError::Unsupported(_) | GpuError::TooLarge { .. } => {
                self.shared.change_status(|status| status.card_refuses = Some(error.clone()));
                if let Some(card) = &mut self.card {
                    card.refused = Some(error);
                }
            }
            error => {
                self.card = None;
                self.shared.change_status(|status| {
                    (status.card, status.card_refuses, status.card_lost) = (None, None, Some(error));
                });
                self.shared.wake();
            }
        }
        self.pace = Pace::new(1e3 * self.budget.as_secs_f64());
    }

    /// What to do when there is no memory for a film.
    pub(super) fn without_film(&mut self, error: PassError) -> Result<(), LiveError> {
        match error {
            PassError::Cancelled => Ok(()),
            PassError::Size(error) => Err(error.into()),
            PassError::Card(error) => {
                self.card_fails(error);
                Ok(())
            }
        }
    }
}
