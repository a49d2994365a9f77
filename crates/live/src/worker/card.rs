//! The choice between the graphics card and the processor.

use std::sync::Arc;

use catoptric_gpu::GpuError;

use super::Worker;
use crate::canvas::PassError;
use crate::card::{CardNews, CardPort, CardSource, CardState, NoAnswer};
use crate::pace::Pace;
use crate::request_state::{RequestState, is_new};
use crate::shared::WaitLimit;
use crate::status::LiveError;

impl Worker {
    /// Lets a card draw from now on, or the processor.
    pub(super) fn change_card(&mut self, source: Option<CardSource>) {
        self.card = source.map(|source| {
            let shared = Arc::clone(&self.shared);
            CardPort::open(source, self.slice_end.is_none(), move |news| match news {
                CardNews::Ready => shared.tell_ready(),
                CardNews::Answered => shared.wake(),
            })
        });
        self.shared.change_status(|status| {
            (status.card, status.card_refuses, status.card_lost) = (None, None, None);
        });
        self.draw_anew();
    }

    /// Takes note that the card is open, has failed, or can draw what it could not before.
    pub(super) fn take_card_news(&mut self) {
        if let Some(card) = &self.card {
            card.forget_answer();
        }
        match self.card.as_ref().map(CardPort::state) {
            Some(CardState::Open(name)) => {
                self.shared.change_status(|status| status.card = Some(name));
                self.draw_anew();
            }
            Some(CardState::Failed(error)) => self.card_fails(error),
            Some(CardState::Opening) | None => {}
        }
    }

    /// How long there is nothing to do.
    pub(super) fn wait(&self) -> WaitLimit {
        let wait = self.view.as_ref().map_or(WaitLimit::ForEver, RequestState::wait);
        let is_opening = self.card.as_ref().is_some_and(|card| card.state() == CardState::Opening);
        if is_opening && wait == WaitLimit::ForEver { WaitLimit::ForCard } else { wait }
    }

    /// Whether there is nothing to do before the card has answered. It is told to hurry when something newer is asked for.
    pub(super) fn waits_for_card(&mut self) -> bool {
        let Some(card) = self.card.as_ref().filter(|card| card.is_busy()) else { return false };
        if let Some(view) = self.view.as_ref().filter(|view| !view.is_patient())
            && self.shared.is_superseded(|request| is_new(request, &view.request))
            && let Some((pixels, milliseconds)) = card.cancel()
        {
            self.pace.gave_up(pixels, milliseconds);
        }
        true
    }

    /// Draws the picture again, if it is one that a card can draw: by whatever is to draw now.
    pub(super) fn draw_anew(&mut self) {
        let Some(view) = &mut self.view else { return };
        if view.request.method.abilities().runs_on_gpu && !view.is_at_rest {
            // What a picture takes is another matter now.
            self.pace = Pace::new(1e3 * self.budget.as_secs_f64());
            view.due.picture = true;
            view.begun = None;
        }
    }

    /// Whether the card has the scene and can draw it at once. While its shader is compiled, the processor draws. `None`
    /// when that is not known yet.
    pub(super) fn is_card_ready(&mut self) -> Option<bool> {
        let (Some(view), Some(card)) = (&self.view, &self.card) else { return Some(false) };
        if card.refused.is_some() || card.state() == CardState::Opening {
            return Some(false);
        }
        match card.prepare(&view.render_scene, &view.camera) {
            Ok(is_ready) => {
                self.shared.change_status(|status| status.card_refuses = None);
                Some(is_ready)
            }
            Err(NoAnswer::Yet) => None,
            Err(NoAnswer::Gpu(error)) => {
                self.card_fails(error);
                Some(false)
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
            PassError::Cancelled | PassError::UnderWay => Ok(()),
            PassError::Size(error) => Err(error.into()),
            PassError::Card(error) => {
                self.card_fails(error);
                Ok(())
            }
        }
    }
}
